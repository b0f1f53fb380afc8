"""The check of the documentation on a small tree, with one defect or none."""
import pathlib
import tempfile
import unittest

from check_docs import SECTIONS, missing_deviations, missing_paths, missing_sections

TABLE = "| section | what | file |\n|---|---|---|\n" + "".join(f"| {s} | x | `stages/a.h` |\n" for s in SECTIONS)


def tree(folder, readme="", table=TABLE):
    root = pathlib.Path(folder)
    (root / "docs").mkdir()
    (root / "stages").mkdir()
    (root / "stages/a.h").write_text("")
    (root / "README.md").write_text(readme)
    (root / "docs/parameterization.md").write_text(table)
    return root


class CheckDocs(unittest.TestCase):
    def defects(self, **parts):
        with tempfile.TemporaryDirectory() as folder:
            root = tree(folder, **parts)
            return [*missing_paths(root), *missing_sections(root)]

    def test_finds_nothing_where_all_is_there(self):
        self.assertEqual(self.defects(readme="see `stages/a.h`, `stages/` and `docs/*.md`"), [])

    def test_finds_a_path_that_is_gone(self):
        self.assertEqual(len(self.defects(readme="see `stages/b.h`")), 1)

    def test_finds_a_section_without_a_file(self):
        self.assertEqual(len(self.defects(table=TABLE.replace("| 5.3 |", "| 9 |"))), 1)

    def test_finds_a_file_of_a_section_that_is_gone(self):
        self.assertEqual(len(self.defects(table=TABLE.replace("| 5.3 | x | `stages/a.h`", "| 5.3 | x | `stages/c.h`"))), 2)

    def test_finds_a_deviation_that_the_table_lacks(self):
        with tempfile.TemporaryDirectory() as folder:
            root = tree(folder)
            (root / "formats/files/readers").mkdir(parents=True)
            (root / "formats/files/readers/deviations.h").write_text(
                'DeviationKind{Deviation::kA, "an " "a", "left out"}, DeviationKind{Deviation::kB, "a b", "read"}')
            (root / "docs/formats-read.md").write_text("| an a | left out |\n")
            self.assertEqual(list(missing_deviations(root)), ["docs/formats-read.md: lacks the row | a b | read |"])


if __name__ == "__main__":
    unittest.main()

"""The check of the includes on small trees, each with one breach or none."""
import pathlib
import tempfile
import unittest

from check_includes import breaches

FILES = {
    "formats/domain.h": "",
    "stages/import/import.h": '#include "formats/domain.h"\n',
    "stages/bake/bake.h": "#include <vector>\n",
    "pipeline/build.cpp": '#include <fmt/format.h>\n#include "stages/bake/bake.h"\n',
    "tools/main.cpp": '#include "pipeline/build.h"\n',
    "pipeline/build.h": "",
}


def breaches_with(changed):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**FILES, **changed}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        return list(breaches(root))


class CheckIncludes(unittest.TestCase):
    def test_finds_nothing_in_a_tidy_house(self):
        self.assertEqual(breaches_with({}), [])

    def test_finds_a_format_that_includes_a_stage(self):
        self.assertEqual(len(breaches_with({"formats/a.cpp": '#include "stages/bake/bake.h"\n'})), 1)

    def test_finds_a_stage_that_includes_another(self):
        self.assertEqual(len(breaches_with({"stages/bake/a.cpp": '#include "stages/import/import.h"\n'})), 1)

    def test_lets_the_test_of_a_stage_use_another(self):
        self.assertEqual(breaches_with({"stages/bake/a_test.cpp": '#include "stages/import/import.h"\n'}), [])

    def test_finds_a_stage_that_includes_the_pipeline(self):
        self.assertEqual(len(breaches_with({"stages/bake/a_test.cpp": '#include "pipeline/build.h"\n'})), 1)

    def test_finds_a_heavy_header_that_spreads_through_ours(self):
        heavy = {"formats/a.h": "#include <Eigen/Dense>\n"}
        self.assertEqual(breaches_with({**heavy, "formats/b.cpp": '#include "formats/a.h"\n'}), [])
        self.assertEqual(len(breaches_with({**heavy, "formats/b.h": '#include "formats/a.h"\n'})), 1)

    def test_finds_an_include_that_is_not_written_from_the_root(self):
        self.assertEqual(len(breaches_with({"formats/a.cpp": '#include "domain.h"\n'})), 1)


if __name__ == "__main__":
    unittest.main()

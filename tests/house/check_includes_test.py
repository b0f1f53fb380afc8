"""The check of the includes on small trees, each with one breach or none."""
import pathlib
import tempfile
import unittest

from check_includes import breaches

FILES = {
    "formats/base/vector.h": "",
    "formats/surface/source_mesh.h": '#include "formats/base/vector.h"\n',
    "formats/surface/source_mesh.cpp": "",
    "formats/domain/domain.h": '#include "formats/surface/source_mesh.h"\n',
    "formats/domain/sphere_fixtures.h": '#include "formats/domain/domain.h"\n',
    "formats/patches/patch_set.h": '#include "formats/domain/domain.h"\n',
    "formats/files/patch_set_file.h": '#include "formats/patches/patch_set.h"\n',
    "formats/files/readers/ply.h": "",
    "stages/import/import.h": '#include "formats/files/readers/ply.h"\n',
    "stages/bake/bake.h": '#include "formats/patches/patch_set.h"\n',
    "stages/parameterize/map/working_map.h": '#include "formats/domain/domain.h"\n',
    "stages/parameterize/relax/newton.h": '#include "stages/parameterize/map/working_map.h"\n',
    "stages/parameterize/search/decimation.h": '#include "stages/parameterize/relax/newton.h"\n',
    "stages/parameterize/parameterize.h": '#include "stages/parameterize/search/decimation.h"\n',
    "pipeline/quality/quality_report.h": "",
    "pipeline/batch/batch.h": "",
    "pipeline/build.cpp": '#include <fmt/format.h>\n#include "stages/bake/bake.h"\n#include "stages/import/import.h"\n',
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
    def finds_one(self, name, included):
        self.assertEqual(len(breaches_with({name: f'#include "{included}"\n'})), 1)

    def finds_none(self, name, included):
        self.assertEqual(breaches_with({name: f'#include "{included}"\n'}), [])

    def test_finds_nothing_in_a_tidy_house(self):
        self.assertEqual(breaches_with({}), [])

    def test_finds_an_arrow_up_between_any_two_floors(self):
        floors = ["formats/base/vector.h", "formats/surface/source_mesh.h", "formats/domain/domain.h", "formats/patches/patch_set.h",
                  "formats/files/patch_set_file.h", "stages/import/import.h", "pipeline/build.h"]
        for lower, upper in zip(floors, floors[1:]):
            self.finds_one(str(pathlib.PurePath(lower).with_name("new.cpp")), upper)
            self.finds_none(str(pathlib.PurePath(upper).with_name("new.cpp")), lower)
        self.finds_one("formats/files/new.cpp", "stages/import/import.h")

    def test_finds_a_file_that_stands_in_no_room(self):
        self.finds_one("formats/new.h", "formats/base/vector.h")

    def test_finds_a_stage_that_includes_another(self):
        self.finds_one("stages/bake/new.cpp", "stages/import/import.h")

    def test_finds_a_stage_of_mere_computing_that_sees_a_file(self):
        for stage in ("parameterize", "sample", "pack", "bake"):
            self.finds_one(f"stages/{stage}/new.cpp", "formats/files/patch_set_file.h")
        self.finds_none("stages/export/new.cpp", "formats/files/patch_set_file.h")

    def test_finds_an_arrow_up_inside_of_parameterize(self):
        self.finds_one("stages/parameterize/map/new.h", "stages/parameterize/relax/newton.h")
        self.finds_one("stages/parameterize/relax/new.cpp", "stages/parameterize/search/decimation.h")
        self.finds_one("stages/parameterize/search/new.cpp", "stages/parameterize/parameterize.h")
        self.finds_none("stages/parameterize/new.cpp", "stages/parameterize/map/working_map.h")

    def test_finds_an_arrow_up_inside_of_pipeline(self):
        self.finds_one("pipeline/quality/new.cpp", "pipeline/batch/batch.h")
        self.finds_one("pipeline/batch/new.cpp", "pipeline/build.h")
        self.finds_none("pipeline/new.cpp", "pipeline/quality/quality_report.h")

    def test_lets_the_tests_of_a_stage_use_another_and_look_up(self):
        self.finds_none("stages/bake/new_test.cpp", "stages/import/import.h")
        self.finds_none("stages/parameterize/map/new_test.cpp", "stages/parameterize/search/decimation.h")
        self.finds_none("formats/surface/new_test.cpp", "formats/domain/sphere_fixtures.h")
        self.finds_one("formats/surface/new_test.cpp", "stages/import/import.h")
        self.finds_one("stages/bake/new_test.cpp", "pipeline/build.h")

    def test_finds_help_for_tests_that_others_use(self):
        self.finds_one("stages/bake/new.cpp", "formats/domain/sphere_fixtures.h")

    def test_finds_help_for_tests_that_would_be_installed(self):
        helper = {"stages/bake/shapes.h": ""}
        self.assertEqual(len(breaches_with({**helper, "stages/bake/a_test.cpp": '#include "stages/bake/shapes.h"\n'})), 1)
        used = {**helper, "stages/bake/a_test.cpp": '#include "stages/bake/shapes.h"\n', "stages/bake/a.cpp": '#include "stages/bake/shapes.h"\n'}
        self.assertEqual(breaches_with(used), [])

    def test_finds_a_heavy_header_that_spreads_through_ours(self):
        heavy = {"formats/base/a.h": "#include <Eigen/Dense>\n"}
        self.assertEqual(breaches_with({**heavy, "formats/base/b.cpp": '#include "formats/base/a.h"\n'}), [])
        self.assertEqual(len(breaches_with({**heavy, "formats/base/b.h": '#include "formats/base/a.h"\n'})), 1)

    def test_finds_a_second_way_to_run_in_parallel(self):
        threads = "#include <tbb/parallel_for.h>\n"
        self.assertEqual(len(breaches_with({"stages/bake/a.cpp": threads})), 1)
        for name in ("formats/base/parallel.cpp", "stages/bake/a_test.cpp"):
            self.assertEqual(breaches_with({name: threads}), [])

    def test_finds_an_include_that_is_not_written_from_the_root(self):
        self.finds_one("formats/base/a.cpp", "vector.h")


if __name__ == "__main__":
    unittest.main()

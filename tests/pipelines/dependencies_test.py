"""make, ninja and CMake build what a changed file is a part of, and nothing else."""
import os
import shutil
import subprocess
import tempfile
import time
import unittest

from pipeline_case import PLAIN, PROGRAM, QUICKEST, FEW_FACES, TEXTURED, PipelineCase, main, unpack_glb

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
OPTIONS = " ".join([*QUICKEST, *FEW_FACES, "--quiet"])

MAKEFILE = f"""
all: out/plain.glb out/with\\ space.glb
out/plain.glb: plain.glb
	{PROGRAM} build plain.glb -o out {OPTIONS} --depfile out/plain.d
out/with\\ space.glb: with\\ space.gltf
	{PROGRAM} build 'with space.gltf' -o out {OPTIONS} --depfile out/textured.d
-include out/plain.d out/textured.d
"""

NINJA = f"""
rule asset
  command = {PROGRAM} build $in -o out {OPTIONS} --depfile $name.d
  depfile = $name.d
  deps = gcc
build out/plain.glb: asset plain.glb
  name = plain
build out/with$ space.glb: asset with$ space.gltf
  name = textured
"""

CMAKE = """
cmake_minimum_required(VERSION 3.22)
project(assets LANGUAGES NONE)
include({source}/cmake/lozengeAssets.cmake)
lozenge_add_assets(TARGET assets ALL SOURCES plain.glb "with space.gltf" OUTPUT_DIRECTORY ${{CMAKE_SOURCE_DIR}}/out
                   OPTIONS {options})
"""


class BuildSystems(PipelineCase):
    """All with one cache: what is built again is seen by the times of outputs, and needn't take any."""

    @classmethod
    def setUpClass(cls):
        cls.cache = tempfile.TemporaryDirectory(prefix="lozenge_pipelines_")
        cls.environment = {**os.environ, "LOZENGE_CACHE": cls.cache.name}

    @classmethod
    def tearDownClass(cls):
        cls.cache.cleanup()

    def setUp(self):
        super().setUp()
        shutil.copy(PLAIN, self.folder / "plain.glb")
        unpack_glb(TEXTURED, self.folder, "with space")
        self.outputs = [self.folder / "out/plain.glb", self.folder / "out/with space.glb"]

    def call(self, *words):
        done = subprocess.run(words, cwd=self.folder, env=self.environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def times(self):
        return [file.stat().st_mtime_ns for file in self.outputs]

    def touch(self, name):
        time.sleep(0.05)  # the clock of file systems moves in steps
        os.utime(self.folder / name)
        time.sleep(0.05)

    def check(self, *command):
        """Builds with `command`: all, nothing, what a texture is a part of, what a buffer is."""
        self.call(*command)
        first = self.times()
        self.call(*command)
        self.assertEqual(self.times(), first, "there was nothing to do")
        self.touch("with space.0.png")
        self.call(*command)
        second = self.times()
        self.assertEqual(second[0], first[0], "the texture is no part of this one")
        self.assertNotEqual(second[1], first[1])
        self.call(*command)
        self.assertEqual(self.times(), second, "that was done")
        self.touch("plain.glb")
        self.call(*command)
        self.assertNotEqual(self.times()[0], second[0])
        self.assertEqual(self.times()[1], second[1])

    @unittest.skipUnless(shutil.which("make"), "there is no make")
    def test_Make(self):
        (self.folder / "Makefile").write_text(MAKEFILE)
        self.check("make")
        (self.folder / "with space.0.png").unlink()
        self.call("make")  # a texture that is gone is no file that can't be made

    @unittest.skipUnless(shutil.which("ninja"), "there is no ninja")
    def test_Ninja(self):
        (self.folder / "build.ninja").write_text(NINJA)
        self.check("ninja")
        self.assertIn("no work to do", self.call("ninja"))
        (self.folder / "with space.0.png").unlink()
        self.call("ninja")

    def check_cmake(self, generator):
        (self.folder / "CMakeLists.txt").write_text(CMAKE.format(source=os.path.normpath(SOURCE), options=OPTIONS.replace("--quiet", "")))
        self.call("cmake", "-S", ".", "-B", "build", "-G", generator, "-D", f"LOZENGE_PROGRAM={PROGRAM}")
        self.check("cmake", "--build", "build")

    @unittest.skipUnless(shutil.which("make"), "there is no make")
    def test_CMakeWithMake(self):
        self.check_cmake("Unix Makefiles")

    @unittest.skipUnless(shutil.which("ninja"), "there is no ninja")
    def test_CMakeWithNinja(self):
        self.check_cmake("Ninja")


if __name__ == "__main__":
    main()

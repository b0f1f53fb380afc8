"""Makes the Debian packages of a build folder, and looks into them. Ends with 77 where Debian's tools aren't there."""
import gzip
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["LOZENGE_BUILD"])
CPACK = os.environ.get("LOZENGE_CPACK", "cpack")
HAS_MODULE = bool(list(BUILD.glob("python/lozenge/_lozenge.*.so")))
ARCHITECTURE = os.environ.get("LOZENGE_ARCHITECTURE", "")
TOOLS = ["dpkg-deb", "dpkg-shlibdeps", "gzip"]


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.place.name)
        # Quickly, not small.
        run(CPACK, "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip",
            cwd=BUILD)
        cls.packages = {}
        for package in ("lozenge", "liblozenge-dev", *(["python3-lozenge"] if HAS_MODULE else [])):
            found = list(cls.folder.glob(f"{package}_*.deb"))
            assert len(found) == 1, f"{package}: {found}"
            run("dpkg-deb", "--extract", found[0], cls.folder / package)
            cls.packages[package] = found[0]

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def field(self, package, name):
        return run("dpkg-deb", "--field", self.packages[package], name).strip()

    def files(self, package):
        root = self.folder / package
        return {path.relative_to(root).as_posix() for path in root.rglob("*") if not path.is_dir()}

    def test_the_program_depends_on_the_libraries_that_it_is_linked_with(self):
        depends = self.field("lozenge", "Depends")
        for library in ("libc6 (>=", "libopenimageio", "libembree", "libtbb", "libopenexr"):
            self.assertIn(library, depends)
        self.assertNotIn("-dev", depends)

    def test_the_description_says_what_processor_is_needed(self):
        for package in self.packages:
            self.assertIn(f"Built for {ARCHITECTURE or 'the compiler'}", self.field(package, "Description"))

    def test_the_program_starts_where_it_is_installed(self):
        program = self.folder / "lozenge/usr/bin/lozenge"
        # The second is handed to the other program, in libexec.
        self.assertIn("lozenge", run(program, "--version"))
        self.assertIn("lozenge build", run(program, "build", "--help"))

    def test_the_script_that_encodes_textures_lies_beside_the_program_that_calls_it(self):
        folder = "usr/libexec/lozenge"
        self.assertLessEqual({f"{folder}/lozenge-whole", f"{folder}/basisu/basisu.mjs", f"{folder}/basisu/package.json"},
                             self.files("lozenge"))

    def test_each_command_has_a_manual_page_that_tells_its_options(self):
        program = self.folder / "lozenge/usr/bin/lozenge"
        manual = self.folder / "lozenge/usr/share/man/man1"
        self.assertIn("game\\-ready", gzip.decompress((manual / "lozenge.1.gz").read_bytes()).decode())
        listed = [line.split()[0] for line in run(program, "--help").splitlines() if line.startswith("  ")]
        commands = [page.name.split(".")[0].removeprefix("lozenge-") for page in manual.glob("lozenge-*.1.gz")]
        self.assertGreater(len(commands), 10)
        for command in commands:
            self.assertIn(command, listed)
            page = gzip.decompress((manual / f"lozenge-{command}.1.gz").read_bytes()).decode().replace("\\-", "-")
            for line in run(program, command, "--help").splitlines():
                word = line.split()[0].split(",")[-1] if line.startswith("  -") else "--help"
                self.assertIn(f"\\fB{word}\\fR", page, command)
        self.assertEqual({"build", "unwrap", "import", "bake", "batch", "cache"} - set(commands), set())

    @unittest.skipUnless(shutil.which("man"), "man isn't installed")
    def test_manual_pages_are_sound_roff(self):
        for page in (self.folder / "lozenge/usr/share/man/man1").glob("*.gz"):
            done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", page],
                                  capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), page.name)

    def complete(self, *words):
        script = self.folder / "lozenge/usr/share/bash-completion/completions/lozenge"
        quoted = " ".join(f"'{word}'" for word in words)
        return run("bash", "-c", f"compopt() {{ :; }}; source '{script}'; COMP_WORDS=({quoted}); "
                   f"COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _lozenge; printf '%s\\n' \"${{COMPREPLY[@]}}\"",
                   cwd=self.folder).split()

    def test_bash_completes_commands_options_words_and_files(self):
        self.assertEqual(self.complete("lozenge", "para"), ["parameterize"])
        self.assertIn("--domain-faces", self.complete("lozenge", "build", "x.glb", "--do"))
        self.assertEqual(self.complete("lozenge", "build", "--map-format", "p"), ["png"])
        self.assertEqual(self.complete("lozenge", "cache", "pr"), ["prune"])
        self.assertIn("liblozenge-dev", self.complete("lozenge", "build", "--cache", "liblozenge-"))
        self.assertEqual(self.complete("lozenge", "build", "--threads", ""), [])

    def test_the_library_is_there_for_cmake(self):
        files = self.files("liblozenge-dev")
        for suffix in ("lozengeConfig.cmake", "lozengeTargets.cmake", "liblozenge_formats.a",
                       "include/lozenge/formats/domain/domain.h"):
            self.assertTrue(any(file.endswith(suffix) for file in files), suffix)
        self.assertIn("lozenge (=", self.field("liblozenge-dev", "Depends"))
        self.assertIn("libopenexr-dev", self.field("liblozenge-dev", "Depends"))
        self.assertEqual(files & self.files("lozenge"), set())

    @unittest.skipUnless(HAS_MODULE, "the Python module isn't built")
    def test_the_module_works_where_it_is_installed(self):
        folder = self.folder / "python3-lozenge/usr/lib/python3/dist-packages"
        # A map of a tetrahedron, with NumPy, where the package lies; then the reader of arrays, which has its own file.
        script = ("import lozenge, lozenge.data\n"
                  "map = lozenge.parameterize([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])\n"
                  "print(lozenge.__file__, len(map.domain))")
        environment = {**os.environ, "PYTHONPATH": str(folder)}
        file, faces = run("/usr/bin/python3", "-c", script, env=environment, cwd=self.folder).split()
        self.assertEqual(pathlib.Path(file), folder / "lozenge/__init__.py")
        self.assertEqual(faces, "4")
        files = self.files("python3-lozenge")
        for name in ("lozenge/__init__.pyi", "lozenge/py.typed", "lozenge/data.py"):
            self.assertIn(f"usr/lib/python3/dist-packages/{name}", files)
        self.assertIn("usr/share/doc/python3-lozenge/examples/heat.py", files)
        self.assertFalse([file for file in files if "__pycache__" in file])

    @unittest.skipUnless(HAS_MODULE, "the Python module isn't built")
    def test_the_module_depends_on_the_python_that_it_was_built_for_and_on_numpy(self):
        depends = self.field("python3-lozenge", "Depends")
        for package in ("python3 (>= 3.", "python3 (<< 3.", "python3-numpy", "libopenimageio", "libc6 (>="):
            self.assertIn(package, depends)
        self.assertNotIn("-dev", depends)
        control = self.folder / "control"
        run("dpkg-deb", "--control", self.packages["python3-lozenge"], control)
        for script in ("postinst", "prerm"):
            self.assertTrue(os.access(control / script, os.X_OK))

    def test_nothing_lies_where_a_package_may_not_put_it(self):
        for package in self.packages:
            for file in self.files(package):
                self.assertRegex(file, r"^usr/(bin|lib|libexec|include|share)/")
            documents = self.folder / package / "usr/share/doc" / package
            self.assertTrue((documents / "copyright").exists())
            self.assertTrue((documents / "changelog.Debian.gz").exists())

    @unittest.skipUnless(shutil.which("lintian"), "lintian isn't installed")
    def test_lintian_finds_no_error(self):
        done = subprocess.run(["lintian", "--fail-on", "error", "--allow-root", *map(str, self.packages.values())],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    if missing:
        print(f"skipped: {', '.join(missing)} not found; they are in the Debian package dpkg-dev")
        sys.exit(77)
    unittest.main(verbosity=2)

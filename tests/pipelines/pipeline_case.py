"""What the tests of caches, build systems, batches and farms share.

CTest says where things are: LOZENGE_PROGRAM, LOZENGE_TEST_ASSETS (a folder of small assets), and for CMake's function
LOZENGE_BUILD (a build folder to install from) and LOZENGE_GENERATOR.
"""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest

PROGRAM = os.environ.get("LOZENGE_PROGRAM", "lozenge")
ASSETS = pathlib.Path(os.environ.get("LOZENGE_TEST_ASSETS", "."))

# The quickest of all assets, and one with textures: that needs a domain for which small maps have room.
PLAIN = ASSETS / "triangle.glb"
TEXTURED = ASSETS / "textured.glb"
FEW_FACES = ["--domain-faces", "12"]

QUICK = ["--map-size", "64", "--occlusion-size", "16", "--occlusion-rays", "1"]
QUICKEST = QUICK + ["--no-preview"]


def content_of(folder, hidden=True):
    """{path below the folder: bytes} of all files."""
    files = {}
    for path in sorted(pathlib.Path(folder).rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and (hidden or not any(part.startswith(".") for part in name.split("/"))):
            files[name] = path.read_bytes()
    return files


def hidden_in(folder):
    """What somebody left: hidden files and folders."""
    return [path.name for path in pathlib.Path(folder).rglob(".*")]


def unpack_glb(glb, folder, name):
    """Writes a .glb of one buffer as NAME.gltf, NAME.bin and NAME.0.png and so on. Returns the .gltf."""
    data = glb.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + length])
    binary = data[28 + length:]
    for number, image in enumerate(document.get("images", [])):
        view = document["bufferViews"][image.pop("bufferView")]
        image.pop("mimeType")
        image["uri"] = f"{name}.{number}.png"
        start = view.get("byteOffset", 0)
        (folder / image["uri"]).write_bytes(binary[start:start + view["byteLength"]])
    document["buffers"][0]["uri"] = f"{name}.bin"
    (folder / f"{name}.bin").write_bytes(binary)
    file = folder / f"{name}.gltf"
    file.write_text(json.dumps(document))
    return file


class PipelineCase(unittest.TestCase):
    """A test with an empty folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lozenge_pipelines_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_program(self, *words, code=0, **options):
        """Runs lozenge; its end must be as told."""
        environment = {**os.environ, **options.pop("env", {})}
        done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, env=environment, check=False, **options)
        self.assertEqual(done.returncode, code, f"{words}\n{done.stdout}\n{done.stderr}")
        return done

    def build(self, asset, out, *words, **options):
        """Builds, and gives the report."""
        return json.loads(self.run_program("build", asset, "-o", out, "--json", *(words or QUICKEST), **options).stdout)


def main():
    """Ends with 77 where all tests were skipped, which CTest calls skipped, too."""
    program = unittest.main(exit=False, verbosity=2)
    result = program.result
    if not result.wasSuccessful():
        raise SystemExit(1)
    if result.testsRun and len(result.skipped) == result.testsRun:
        raise SystemExit(77)

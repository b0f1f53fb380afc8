"""What is taken from a cache is what would be made, and nothing is taken that wouldn't."""
import json
import os
import shutil
import subprocess

from pipeline_case import FEW_FACES, PLAIN, PROGRAM, QUICK, QUICKEST, TEXTURED, PipelineCase, content_of, hidden_in, main, unpack_glb


class CacheOfBuilds(PipelineCase):
    def test_AnEqualBuildIsTakenWholeAndATouchedAssetIsEqual(self):
        cache = ["--cache", self.folder / "cache"]
        asset = self.folder / "triangle.glb"
        shutil.copy(PLAIN, asset)
        made = self.build(asset, self.folder / "a", *QUICKEST, *cache)
        self.assertNotIn("cached", made)
        os.utime(asset, (1e9, 1e9))
        report = self.folder / "report.json"
        taken = self.build(asset, self.folder / "b", *QUICKEST, *cache, "--report", report)
        self.assertTrue(taken["cached"])
        self.assertEqual(content_of(self.folder / "a"), content_of(self.folder / "b"))
        self.assertEqual({**made, "cached": True}, taken)
        self.assertEqual(json.loads(report.read_text()), taken)
        elsewhere = self.build(asset, self.folder / "c", *QUICKEST, env={"LOZENGE_CACHE": str(self.folder / "cache")})
        self.assertTrue(elsewhere["cached"])
        # Other names of the asset or the outputs are parts of what is made.
        shutil.copy(asset, self.folder / "other.glb")
        self.assertNotIn("cached", self.build(self.folder / "other.glb", self.folder / "d", *QUICKEST, *cache))

    def test_AnotherSizeOfMapsDoesNotParameterizeAgainAndIsTheSame(self):
        smaller = [*QUICKEST, *FEW_FACES]
        larger = ["96" if word == "64" else word for word in smaller]
        cache = ["--cache", self.folder / "cache"]
        asset = TEXTURED
        first = self.build(asset, self.folder / "a", *smaller, *cache)
        second = self.build(asset, self.folder / "b", *larger, *cache)
        fresh = self.build(asset, self.folder / "c", *larger)
        stages = [stage["name"] for stage in second["stages"]]
        self.assertNotIn("parameterize", stages)
        self.assertNotIn("import", stages)
        self.assertEqual(content_of(self.folder / "b"), content_of(self.folder / "c"))
        for key in ("source", "repairs", "instances", "domain", "distortion", "patches"):
            self.assertEqual(second[key], fresh[key], key)
        self.assertEqual(first["domain"], second["domain"])

    def test_EveryFileThatTheAssetNamesIsAPartOfTheKey(self):
        asset = unpack_glb(TEXTURED, self.folder, "textured")
        words = ["import", asset, "-o", self.folder / "a.glb", "--cache", self.folder / "cache", "--json"]

        def is_taken():
            return json.loads(self.run_program(*words).stdout).get("cached", False)

        self.assertFalse(is_taken())
        texture = self.folder / "textured.0.png"
        original = texture.read_bytes()
        texture.unlink()
        self.assertFalse(is_taken(), "a texture is gone")
        texture.write_bytes(original)
        self.assertTrue(is_taken(), "it is back")
        binary = self.folder / "textured.bin"
        data = bytearray(binary.read_bytes())
        data[0] ^= 1  # the last bits of a float
        binary.write_bytes(data)
        self.assertFalse(is_taken(), "a buffer has changed")

    def test_WhatIsDamagedIsMadeAgain(self):
        cache = ["--cache", self.folder / "cache"]
        asset = PLAIN
        self.build(asset, self.folder / "a", *QUICKEST, *cache)
        for entry in (self.folder / "cache").rglob("*.entry"):
            data = bytearray(entry.read_bytes())
            data[len(data) * 2 // 3] ^= 1
            entry.write_bytes(data)
        self.assertNotIn("cached", self.build(asset, self.folder / "b", *QUICKEST, *cache))
        self.assertEqual(content_of(self.folder / "a"), content_of(self.folder / "b"))
        self.assertTrue(self.build(asset, self.folder / "b", *QUICKEST, *cache)["cached"])
        self.run_program("cache", "prune", "--max-size", "0", *cache)
        facts = json.loads(self.run_program("cache", "info", "--json", *cache).stdout)
        self.assertEqual((facts["entries"], facts["bytes"]), (0, 0))


class CacheOfStages(PipelineCase):
    def chain(self, out, cache):
        """All stages, one after the other. Returns which of them were taken from the cache."""
        out.mkdir()
        name = "triangle"
        steps = [
            ["import", PLAIN, "-o", out / f"{name}.mesh.glb"],
            ["parameterize", out / f"{name}.mesh.glb", "-o", out / f"{name}.map.glb"],
            ["sample", out / f"{name}.map.glb", "-o", out / f"{name}.patches.exr", "--samples", "5"],
            ["pack", out / f"{name}.patches.exr", "-o", out / f"{name}.gim.exr"],
            ["bake", out / f"{name}.map.glb", out / f"{name}.gim.exr", "-o", out / name, "--map-size", "64",
             "--occlusion-size", "16", "--occlusion-rays", "1"],
            ["export", out / f"{name}.gim.exr", "--map", out / f"{name}.normal.png", "--source", out / f"{name}.map.glb",
             "-o", out / f"{name}.glb", "--separate-lods"],
            ["unwrap", PLAIN, "-o", out / f"{name}.uv.glb", "--map-size", "64"],
        ]
        taken = []
        for step in steps:
            done = self.run_program(*step, "--cache", cache, "--threads", "1", "--json")
            if json.loads(done.stdout).get("cached"):
                taken.append(step[0])
        return taken

    def test_EachStageIsTakenFromTheCacheWithAllOfItsFiles(self):
        cache = self.folder / "cache"
        self.assertEqual(self.chain(self.folder / "a", cache), [])
        stages = ["import", "parameterize", "sample", "pack", "bake", "export", "unwrap"]
        self.assertEqual(self.chain(self.folder / "b", cache), stages)
        made = content_of(self.folder / "a")
        self.assertEqual(made, content_of(self.folder / "b"))
        self.assertIn("triangle.gim.json", made)
        # An option that doesn't matter takes it, too; one that does doesn't.
        words = ["sample", self.folder / "a/triangle.map.glb", "-o", self.folder / "triangle.patches.exr", "--cache", cache, "--json"]
        self.assertTrue(json.loads(self.run_program(*words, "--samples", "5").stdout)["cached"])
        self.assertNotIn("cached", json.loads(self.run_program(*words, "--samples", "3").stdout))

    def test_AFileInAnOptionIsAPartOfTheKey(self):
        cones = self.folder / "cones.txt"
        words = ["parameterize", TEXTURED, "-o", self.folder / "map.glb", "--cones", f"@{cones}", *FEW_FACES, "--cache",
                 self.folder / "cache", "--json"]
        cones.write_text("1 5")
        self.run_program(*words)
        self.assertTrue(json.loads(self.run_program(*words).stdout)["cached"])
        cones.write_text("1 6")
        self.assertNotIn("cached", json.loads(self.run_program(*words).stdout))


class SmallDisk(PipelineCase):
    """A file system of a few kilobytes, where one can be mounted."""

    def run_on_disk(self, kilobytes, *words):
        """Runs lozenge with a small disk at FOLDER/disk. Returns how it ended, and what is on the disk then."""
        (self.folder / "disk").mkdir(exist_ok=True)
        script = ('mount -t tmpfs -o size="$1"k tmpfs "$2" || exit 99; disk=$2; shift 2; "$@"; code=$?; '
                  'find "$disk" -mindepth 1; exit $code')
        users = [] if os.geteuid() == 0 else ["--map-root-user"]
        done = subprocess.run(["unshare", *users, "--mount", "sh", "-c", script, "sh", str(kilobytes), self.folder / "disk", PROGRAM,
                               *map(str, words)], capture_output=True, text=True, check=False)
        if done.returncode == 99 or "unshare:" in done.stderr:
            self.skipTest(f"no file system can be mounted here: {done.stderr.strip()}")
        left = [line for line in done.stdout.splitlines() if line.startswith(str(self.folder / "disk"))]
        return done, left

    def test_AFullDiskHasAnExitCodeOfItsOwnAndKeepsNothingHalf(self):
        disk = self.folder / "disk"
        self.run_program("parameterize", TEXTURED, "-o", self.folder / "map.glb", *FEW_FACES)
        self.run_program("sample", self.folder / "map.glb", "-o", self.folder / "patches.exr", "--samples", "33")
        for words in (["import", TEXTURED, "-o", disk / "a.glb"],
                      ["sample", self.folder / "map.glb", "-o", disk / "a.exr", "--samples", "33"],
                      ["pack", self.folder / "patches.exr", "-o", disk / "a.exr"]):
            for kilobytes in (4, 12, 40):
                done, left = self.run_on_disk(kilobytes, *words)
                self.assertEqual(done.returncode, 6, done.stderr)
                self.assertIn("can't be written", done.stderr)
                self.assertEqual(left, [])

    def test_AFullDiskUnderTheOutputsOfABuildLeavesNothing(self):
        for kilobytes in (8, 64):
            done, left = self.run_on_disk(kilobytes, "build", PLAIN, "-o", self.folder / "disk/out", *QUICK)
            self.assertEqual(done.returncode, 6, done.stderr)
            self.assertEqual(left, [])

    def test_AFullDiskUnderTheCacheCostsNothingButTheEntry(self):
        done, left = self.run_on_disk(8, "import", TEXTURED, "-o", self.folder / "a.glb", "--cache",
                                      self.folder / "disk/cache")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("isn't put into the cache", done.stderr)
        self.assertFalse([path for path in left if path.endswith((".entry", ".tmp"))])
        self.run_program("import", TEXTURED, "-o", self.folder / "b.glb")
        self.assertEqual((self.folder / "a.glb").read_bytes(), (self.folder / "b.glb").read_bytes())
        self.assertEqual(hidden_in(self.folder), [])


if __name__ == "__main__":
    main()

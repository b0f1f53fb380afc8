"""A batch builds each asset by itself, remembers what became of each, and shows it."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

from pipeline_case import ASSETS, FEW_FACES, PROGRAM, QUICK, QUICKEST, PipelineCase, content_of, hidden_in, main, unpack_glb

SMALL = [*QUICKEST, *FEW_FACES]


def rows_in(manifest):
    return {row["asset"]: row for row in map(json.loads, manifest.read_text().splitlines())}


class Batches(PipelineCase):
    def setUp(self):
        super().setUp()
        self.assets = self.folder / "assets"
        self.out = self.folder / "out"
        (self.assets / "sub").mkdir(parents=True)
        self.manifest = self.out / "manifest.jsonl"

    def take(self, *names):
        for name in names:
            shutil.copy(ASSETS / f"{name}.glb", self.assets / f"{name}.glb")

    def batch(self, *words, code=0):
        return json.loads(self.run_program("batch", self.assets, "-o", self.out, "--json", *words, code=code).stdout)

    def test_SixAssetsGiveWhatBuildGivesOneByOneAndARowEach(self):
        self.take("triangle", "textured", "two_components")
        for copy in ("again", "sub/again"):
            shutil.copy(ASSETS / "triangle.glb", self.assets / f"{copy}.glb")
        unpack_glb(ASSETS / "textured.glb", self.assets / "sub", "unpacked")
        summary = self.batch("--jobs", "2", *SMALL)
        self.assertEqual((summary["assets"], summary["done"], summary["code"]), (6, 6, 0))
        rows = rows_in(self.manifest)
        self.assertEqual(sorted(rows), ["again.glb", "sub/again.glb", "sub/unpacked.gltf", "textured.glb", "triangle.glb",
                                        "two_components.glb"])
        self.build(self.assets / "textured.glb", self.folder / "alone", *SMALL)
        for name, content in content_of(self.folder / "alone").items():
            self.assertEqual(content, (self.out / name).read_bytes(), name)
        row = rows["textured.glb"]
        self.assertEqual((row["status"], row["code"], row["output"]), ("done", 0, "textured"))
        self.assertEqual(row["options"], " ".join(sorted_options(SMALL)))
        self.assertGreater(row["memory_mb"], 50)
        self.assertGreaterEqual(len(row["triangles"]), 2)
        self.assertGreater(row["triangles"][0], row["triangles"][1])
        self.assertTrue({"seconds", "samples", "distortion", "deviation", "hash"} <= row.keys())
        self.assertEqual(hidden_in(self.out), [])
        # Again: nothing is to be done. Then what changed alone is, and what is gone.
        self.assertEqual(self.batch(*SMALL)["kept"], 6)
        shutil.copy(ASSETS / "two_components.glb", self.assets / "again.glb")
        (self.out / "triangle.glb").unlink()
        self.assertEqual(self.batch(*SMALL)["kept"], 4)
        self.assertEqual(self.batch(*SMALL)["kept"], 6)

    def test_OneThatFailsHangsOrIsKilledCostsNoOtherAnything(self):
        self.take("triangle")
        (self.assets / "broken.glb").write_bytes(b"glTF\2\0\0\0")
        self.take("torus")  # has many patches, whose samples take longer than the timeout; the triangle has three
        slow = ["--keep-going", "--samples", "257", *QUICKEST[2:], "--map-size", "128"]
        words = ["--jobs", "2", "--timeout", "3", *slow]
        with_failures = self.batch(*words, code=3)
        self.assertEqual([with_failures[key] for key in ("done", "failed", "timeout", "killed")], [1, 1, 1, 0])
        rows = rows_in(self.manifest)
        self.assertEqual(rows["broken.glb"]["code"], 3)
        self.assertTrue(rows["broken.glb"]["message"])
        self.assertEqual(rows["torus.glb"]["status"], "timeout")
        self.assertEqual(hidden_in(self.out), [])
        # What was refused for what it is isn't tried again; what took too long is, and here is killed.
        process = self.start_batch(*slow)
        os.kill(self.child_of(process), signal.SIGKILL)
        self.assertEqual(process.wait(), 3)
        rows = rows_in(self.manifest)
        self.assertEqual(rows["torus.glb"]["status"], "killed")
        self.assertIn("signal 9", rows["torus.glb"]["message"])
        self.assertEqual(rows["triangle.glb"]["status"], "done")

    def test_WithoutKeepGoingNothingBeginsAfterAFailure(self):
        self.take("triangle")
        (self.assets / "broken.glb").write_bytes(b"glTF\2\0\0\0" + bytes(10000))  # the largest, and so the first
        summary = self.batch(*SMALL, code=3)
        self.assertEqual((summary["failed"], summary["not_begun"]), (1, 1))
        self.assertFalse((self.out / "triangle.glb").exists())

    def start_batch(self, *words):
        return subprocess.Popen([PROGRAM, "batch", self.assets, "-o", self.out, *words], stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL)

    def child_of(self, process):
        """Waits for a process that the batch has started."""
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
        for _ in range(6000):
            found = children.read_text().split()
            if found:
                return int(found[0])
            time.sleep(0.01)
        self.fail("nothing was started")

    def test_WhatIsStoppedResumesAndTakesItsChildrenAlong(self):
        self.take("triangle", "torus")  # the torus is larger, and takes a while
        process = self.start_batch(*QUICKEST)
        child = self.child_of(process)
        process.kill()
        process.wait()
        for _ in range(6000):
            if not pathlib.Path(f"/proc/{child}").exists():
                break
            time.sleep(0.01)
        else:
            self.fail("a child outlived the batch")
        # The batch was killed in the middle of a row, too.
        with self.manifest.open("a") as manifest:
            manifest.write('{"asset": "triangle.glb", "ha')
        (self.assets / "torus.glb").unlink()
        self.assertEqual(self.batch(*SMALL)["done"], 1)
        self.assertEqual(rows_in(self.manifest)["triangle.glb"]["status"], "done")
        self.assertEqual(hidden_in(self.out), [])

    def test_AListNamesItsOutputsAndTakesTheSameFromTheCache(self):
        self.take("triangle")
        assets = self.folder / "list.txt"
        assets.write_text(f"# two\n{self.assets}/triangle.glb\n{self.assets}/triangle.glb\tnamed/too/triangle\n")
        words = ["batch", assets, "-o", self.out, "--json", "--cache", self.folder / "cache", *QUICKEST]
        rows = json.loads(self.run_program(*words).stdout)["rows"]
        self.assertEqual(sorted(row["output"] for row in rows), ["named/too/triangle", "triangle"])
        self.assertEqual([row["cached"] for row in rows].count(True), 1)
        assets.write_text(f"{self.assets}/triangle.glb\t../outside\n")
        self.run_program(*words, code=2)


def sorted_options(words):
    """As the manifest has them: by name."""
    options, name = {}, None
    for word in words:
        if word.startswith("--"):
            name = word
            options[name] = []
        else:
            options[name].append(word)
    return [word for option in sorted(options) for word in (option, *options[option])]


@unittest.skipUnless(shutil.which("chromium"), "there is no chromium to look at the page with")
class Pages(PipelineCase):
    def look(self, address):
        """The page as Chromium has it once its script has run."""
        done = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                               f"--user-data-dir={self.folder}/profile", "--virtual-time-budget=3000", "--dump-dom", address],
                              capture_output=True, text=True, check=False, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def assets_on(self, page):
        return re.findall(r'<td class="text" data-value="([^"]*)">\1</td><td class="text" data-value="(?:done|failed)">', page)

    def test_ThePageShowsWhatFailedFirstSortsAndHasAPreviewOfEach(self):
        assets, out = self.folder / "assets", self.folder / "out"
        assets.mkdir()
        shutil.copy(ASSETS / "triangle.glb", assets / "triangle.glb")
        shutil.copy(ASSETS / "triangle.glb", assets / "a #1 & b.glb")
        (assets / "c<b>.glb").write_bytes(b"glTF")
        self.run_program("batch", assets, "-o", out, "--keep-going", *QUICK, code=3)
        page = out / "summary.html"
        named = ["c&lt;b&gt;.glb", "a #1 &amp; b.glb", "triangle.glb"]
        text = self.look(page.as_uri())
        self.assertEqual(self.assets_on(text), named)
        self.assertEqual(text.count("<img "), 2)
        self.assertNotIn(">no preview<", text)
        by_name = sorted(named)
        self.assertEqual(self.assets_on(self.look(page.as_uri() + "#sort=asset")), by_name)
        self.assertEqual(self.assets_on(self.look(page.as_uri() + "#sort=-asset")), by_name[::-1])
        # A click does the same, and a second one the other way round; a picture that is gone is said to be.
        (out / "triangle.preview.png").unlink()
        clicks = "<script>for (const key of ['asset', 'asset']) document.querySelector(`[data-key=${key}]`).click();" \
                 "for (const image of document.images) image.loading = 'eager';</script></html>"
        page.write_text(page.read_text().replace("</html>", clicks))
        text = self.look(page.as_uri())
        self.assertEqual(self.assets_on(text), by_name[::-1])
        self.assertEqual(text.count("<img "), 1)
        self.assertIn(">no preview<", text)


if __name__ == "__main__":
    main()

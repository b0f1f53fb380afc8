"""Geometry images as arrays, from a surface of two parts: a torus with a hole in it, and a small whole one."""
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import lozenge
from lozenge import data

import module_test

PROGRAM = os.environ["LOZENGE_PROGRAM"]
SOURCES = pathlib.Path(__file__).resolve().parent.parent
QUICK = ["--domain-faces", "60", "--map-size", "128", "--occlusion-size", "32", "--occlusion-rays", "1", "--no-preview", "--quiet"]


def run(*words):
    subprocess.run([PROGRAM, *map(str, words)], check=True, stdout=subprocess.DEVNULL)


def two_parts():
    positions, triangles = module_test.torus(32, 16)
    small = positions * 0.08 + np.array([0, 0, 3], np.float32)
    of_hole = (positions[triangles].mean(1)[:, 0] > 2.2) & (np.abs(positions[triangles].mean(1)[:, 1]) < 0.9)
    return np.concatenate([positions, small]), np.concatenate([triangles[~of_hole], triangles + len(positions)])


class DataTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)
        (cls.path / "assets").mkdir()
        module_test.write_ply(cls.path / "assets/parts.ply", *two_parts())
        module_test.write_ply(cls.path / "assets/torus.ply", *module_test.torus())
        run("batch", cls.path / "assets", "-o", cls.path / "out", "--arrays", "--samples", "9", *QUICK)
        cls.out = cls.path / "out"
        cls.parts = data.load(cls.out / "parts.npz")
        cls.torus = data.load(cls.out / "torus.npz")
        cls.image = lozenge.read_geometry_image(cls.out / "parts.gim.exr")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_arrays_of_a_build_are_those_that_export_makes_of_its_files(self):
        run("import", self.path / "assets/torus.ply", "-o", self.path / "torus.mesh.glb", "--quiet")
        run("parameterize", self.path / "torus.mesh.glb", "-o", self.path / "torus.map.glb", "--domain-faces", "60", "--quiet")
        export = ["export", self.out / "torus.gim.exr", "--source", self.path / "torus.map.glb", "--quiet", "--map",
                  self.out / "torus.normal.png", self.out / "torus.occlusion.png"]
        run(*export, "--as", "npz", "-o", self.path / "again.npz")
        self.assertEqual((self.path / "again.npz").read_bytes(), (self.out / "torus.npz").read_bytes())
        run(*export, "--as", "png16", "-o", self.path / "torus.json")
        pictures = json.loads((self.path / "torus.json").read_text())
        self.assertEqual(pictures["geometry_image"]["adjacency"], self.torus.adjacency.tolist())
        self.assertIn("torus.positions.png", [picture["file"] for picture in pictures["pictures"]])
        for picture in pictures["pictures"]:
            self.assertEqual((self.path / picture["file"]).read_bytes()[:4], b"\x89PNG")

    def test_parts_have_scales_of_their_own(self):
        self.assertGreater(len(self.parts.grids), 1)
        for grid in self.parts.grids:
            level = int(self.parts["first_levels"][grid.patches.start])
            np.testing.assert_array_equal(grid["positions"], self.image.positions(level)[grid.patches.start:])
            np.testing.assert_array_equal(grid["mask"], self.image.mask(level)[grid.patches.start:])
            self.assertEqual(grid.side, 8 // 2 ** level + 1)
        with self.assertRaisesRegex(ValueError, "different numbers"):
            self.parts["positions"]
        padded = self.parts.padded("normals")
        self.assertEqual(padded.shape, (len(self.parts), 9, 9, 3))
        self.assertEqual(padded.astype(bool).any(-1).sum(), self.parts.flat("mask").sum())

    def test_coarser_levels_are_those_of_the_image(self):
        coarsest = int(self.parts["first_levels"].max())
        level = self.parts.at(8 // 2 ** coarsest + 1)
        np.testing.assert_array_equal(level["positions"], self.image.positions(coarsest))
        np.testing.assert_array_equal(level["mask"], self.image.mask(coarsest))
        self.assertEqual(self.parts.at(9).flat("normals").shape, self.parts.flat("normals").shape)
        with self.assertRaises(ValueError):
            self.parts.at(4)

    def test_samples_lie_where_their_source_says(self):
        for patches in (self.parts, self.torus):
            there = patches.flat("mask")
            corners = patches["mesh_positions"][patches["mesh_triangles"][patches.flat("source_triangles")[there]]]
            places = (corners * patches.flat("source_weights")[there][..., None]).sum(1)
            np.testing.assert_allclose(places, patches.flat("positions")[there], atol=1e-5)
            self.assertTrue((patches.flat("source_triangles")[~there] == -1).all())

    def test_vertices_follow_from_the_adjacency_alone(self):
        for patches, euler in ((self.parts, -1), (self.torus, 0)):
            vertex, count = patches.vertices()
            there, positions = vertex >= 0, patches.flat("positions")
            np.testing.assert_array_equal(there, patches.flat("mask"))
            self.assertEqual(count, len(np.unique(positions[there], axis=0)))
            first = np.zeros(count, int)
            first[vertex[there]] = np.nonzero(there)[0]
            np.testing.assert_array_equal(positions[first[vertex[there]]], positions[there])
            corners = vertex[patches.triangles()]
            self.assertTrue((corners >= 0).all())
            edges = np.unique(np.sort(corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), 1), axis=0)
            self.assertEqual(count - len(edges) + len(corners), euler)

    def test_texels_of_a_map_lie_between_samples(self):
        grid = self.torus.grids[0]
        at = grid["map_normal_at"]
        self.assertEqual((at[0], at[-1], len(at)), (0, 1, grid["map_normal"].shape[1]))
        self.assertEqual(grid["map_occlusion"].shape[::3], (len(self.torus), 1))
        np.testing.assert_allclose(np.linalg.norm(grid["map_normal"], axis=-1), 1, atol=0.02)

    def test_a_batch_is_a_sequence_of_assets(self):
        assets = data.Assets(self.out / "manifest.jsonl")
        self.assertEqual([row["output"] for row in assets.rows], ["parts", "torus"])
        self.assertEqual([len(patches) for patches in assets], [len(self.parts), len(self.torus)])
        self.assertEqual(data.Assets(self.out / "manifest.jsonl", transform=len)[1], len(self.torus))
        with open(self.path / "manifest.jsonl", "w") as file:
            file.write('{"output": "gone", "status": "failed"}\n{"outp')
        self.assertEqual(len(data.Assets(self.path / "manifest.jsonl")), 0)
        with open(self.path / "manifest.jsonl", "w") as file:
            file.write('{"output": "gone", "status": "done"}\n')
        with self.assertRaisesRegex(FileNotFoundError, "--arrays"):
            data.Assets(self.path / "manifest.jsonl")

    def test_collated_assets_keep_their_neighbours(self):
        assets = data.Assets(self.out / "manifest.jsonl", transform=lambda patches: patches.at(2))
        joined = data.collate(assets, tensors=False)
        first = len(self.parts)
        self.assertEqual(joined["positions"].shape, (first + len(self.torus), 2, 2, 3))
        np.testing.assert_array_equal(np.bincount(joined["asset"]), [first, len(self.torus)])
        codes = joined["adjacency"].ravel()
        here = np.nonzero(codes >= 0)[0]
        np.testing.assert_array_equal(codes[codes[here]], here)
        np.testing.assert_array_equal(joined["adjacency"][first:] - 4 * first, self.torus.adjacency)
        with self.assertRaisesRegex(ValueError, "Patches.at"):
            data.collate([self.parts, self.torus], tensors=False)

    @unittest.skipUnless(importlib.util.find_spec("torch"), "PyTorch isn't installed")
    def test_pytorch_loads_a_batch(self):
        from torch.utils.data import DataLoader, Dataset
        assets = data.Assets(self.out / "manifest.jsonl", transform=lambda patches: patches.at(2))
        self.assertIsInstance(assets, Dataset)
        loaded = list(DataLoader(assets, batch_size=2, collate_fn=data.collate))
        self.assertEqual(tuple(loaded[0]["positions"].shape), (len(self.parts) + len(self.torus), 2, 2, 3))

    def test_the_reader_needs_numpy_alone(self):
        script = ("import sys, importlib.util; sys.modules['torch'] = None\n"
                  f"spec = importlib.util.spec_from_file_location('data', {str(SOURCES / 'lozenge/data.py')!r})\n"
                  "data = importlib.util.module_from_spec(spec); spec.loader.exec_module(data)\n"
                  f"assets = data.Assets({str(self.out / 'manifest.jsonl')!r})\n"
                  "print(len(data.collate([assets[1]])['adjacency']), any(m.startswith('lozenge') for m in sys.modules))")
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        done = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.split(), [str(len(self.torus)), "False"])

    def test_other_files_are_refused(self):
        np.savez(self.path / "other.npz", positions=np.zeros((1, 2, 2, 3)))
        with self.assertRaisesRegex(ValueError, "other.npz: isn't what"):
            data.load(self.path / "other.npz")
        with np.load(self.out / "torus.npz") as file:
            arrays = {name: file[name] for name in file.files}
        np.savez(self.path / "fewer.npz", **{**arrays, "positions": arrays["positions"][1:]})
        with self.assertRaisesRegex(ValueError, "fewer.npz"):
            data.load(self.path / "fewer.npz")

    def test_heat_spreads_over_the_samples_as_over_the_source(self):
        spec = importlib.util.spec_from_file_location("heat", SOURCES / "examples/heat.py")
        heat = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(heat)
        for patches in (self.torus, self.parts):
            on_samples, on_source, mass = heat.solve(patches)
            error = np.sqrt((mass * (on_samples - on_source) ** 2).sum() / (mass * on_source ** 2).sum())
            self.assertLess(error, 0.02)
            self.assertGreater((mass * on_source).sum() / mass.sum(), 0.02 * on_source.max())
        heat.draw(self.parts, on_samples, self.path / "heat.png", size=64, finer=2)
        self.assertGreater((self.path / "heat.png").stat().st_size, 500)


if __name__ == "__main__":
    unittest.main(verbosity=2)

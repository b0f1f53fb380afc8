"""The Python module on a small torus: arrays in, arrays out, errors, and the same as the command."""
import pathlib
import subprocess
import os
import tempfile
import time
import unittest

import numpy as np

import lozenge


FACES = 24  # of the domain: few are found quickly


def torus(ring=24, tube=12):
    u, v = np.meshgrid(np.arange(ring) * 2 * np.pi / ring, np.arange(tube) * 2 * np.pi / tube, indexing="ij")
    positions = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], -1)
    i, j = (n.ravel() for n in np.meshgrid(np.arange(ring), np.arange(tube), indexing="ij"))
    a, b, c, d = (((i + s) % ring) * tube + (j + t) % tube for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)))
    triangles = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])
    return positions.reshape(-1, 3).astype(np.float32), triangles.astype(np.int32)


def area(positions, triangles):
    a, b, c = (positions[triangles[:, k]].astype(float) for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=-1).sum() / 2


def write_ply(path, positions, triangles, colours=None):
    lines = ["ply", "format ascii 1.0", f"element vertex {len(positions)}", "property float x", "property float y", "property float z"]
    lines += [] if colours is None else [f"property uchar {name}" for name in ("red", "green", "blue")]
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header"]
    rows = positions if colours is None else np.hstack([positions, colours])
    lines += [" ".join(f"{x:.9g}" for x in row) for row in rows]
    lines += ["3 " + " ".join(map(str, t)) for t in triangles]
    path.write_text("\n".join(lines) + "\n")


class ModuleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.positions, cls.triangles = torus()
        cls.map = lozenge.parameterize(cls.positions, cls.triangles, domain_faces=FACES)
        cls.image = cls.map.sample(9).geometry_image
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_map_is_that_of_the_same_arrays_again(self):
        again = lozenge.parameterize(self.positions.astype(float), self.triangles.astype(np.uint64), domain_faces=FACES)
        np.testing.assert_array_equal(again.alpha_beta, self.map.alpha_beta)
        np.testing.assert_array_equal(again.domain, self.map.domain)
        np.testing.assert_array_equal(again.positions, self.map.positions)

    def test_positions_on_the_domain_are_barycentric(self):
        self.assertEqual(self.map.domain_triangle.shape, (len(self.map.positions),))
        self.assertTrue(np.all(self.map.domain_triangle < len(self.map.domain)))
        self.assertTrue(np.all((self.map.alpha_beta >= 0) & (self.map.alpha_beta <= 1)))

    def test_neighbours_are_reciprocal(self):
        across = self.map.neighbours
        t, s = across[..., 0], across[..., 1]
        self.assertTrue(np.all(across[t, s, 0] == np.arange(len(across))[:, None]))

    def test_arrays_are_views_that_keep_their_owner(self):
        positions = lozenge.parameterize(self.positions, self.triangles, domain_faces=FACES).positions
        self.assertFalse(positions.flags.owndata)
        self.assertFalse(positions.flags.writeable)
        self.assertTrue(np.all(np.isfinite(positions)))

    def test_texels_lie_where_the_baked_positions_are(self):
        maps = lozenge.bake(self.map, self.image, ["position"], size=128)
        found = self.map.correspondence(128, self.image)
        places = found.interpolate(self.triangles, self.positions)
        there = found.triangles >= 0
        self.assertGreater(there.mean(), 0.5)
        np.testing.assert_allclose(found.weights[there].sum(-1), 1, atol=1e-5)
        np.testing.assert_allclose(places[there], maps["position"][there], atol=1e-5)

    def test_texels_of_a_painted_mesh_lie_where_its_maps_have_them(self):
        painted = self.path / "painted.ply"
        write_ply(painted, self.positions, self.triangles, colours=np.where(self.positions > 0, 255, 25))
        mesh = lozenge.read(painted)
        map = lozenge.parameterize(mesh, domain_faces=FACES)
        image = map.sample(9).geometry_image
        maps = lozenge.bake(map, image, ["position"], size=128)
        found = map.correspondence(128, image, maps=maps)
        there = found.triangles >= 0
        np.testing.assert_allclose(found.interpolate(mesh.triangles, mesh.positions)[there], maps["position"][there], atol=1e-5)
        self.assertFalse(np.array_equal(found.triangles, map.correspondence(128, image).triangles), "its patches are ordered")
        with self.assertRaisesRegex(lozenge.UsageError, "another one, of 128 x 128"):
            map.correspondence(64, image, maps=maps)

    def test_samples_lie_where_their_source_says(self):
        samples = self.map.sample(9)
        found = samples.sources(self.map)
        np.testing.assert_allclose(found.interpolate(self.triangles, self.positions), samples.positions, atol=1e-5)
        self.assertEqual(samples.first[-1], len(samples.positions))

    def test_a_geometry_image_is_read_as_it_was_written(self):
        lozenge.write_geometry_image(self.path / "torus.gim.exr", self.image)
        again = lozenge.read_geometry_image(self.path / "torus.gim.exr")
        for level in range(again.levels):
            np.testing.assert_array_equal(again.positions(level), self.image.positions(level))
        np.testing.assert_array_equal(again.adjacency, self.image.adjacency)
        self.assertEqual(again.positions().shape, (again.patches, 9, 9, 3))
        self.assertEqual(again.places.shape, (again.patches, 6))
        self.assertTrue(again.mask().all())

    def test_unwrapping_keeps_the_surface_and_says_where_vertices_come_from(self):
        made = lozenge.unwrap(self.positions, self.triangles, map_size=256, domain_faces=FACES)
        between = (self.positions[made.source_vertices] * made.weights[..., None]).sum(1)
        np.testing.assert_allclose(between, made.positions, atol=1e-5)
        self.assertAlmostEqual(area(made.positions, made.triangles), area(self.positions, self.triangles), places=3)
        self.assertTrue(np.all((made.uvs >= 0) & (made.uvs <= 1)))
        flat = np.concatenate([made.uvs, np.zeros((len(made.uvs), 1))], 1)
        self.assertGreater(area(flat, made.triangles), 0.3)

    def test_a_field_becomes_a_textured_asset(self):
        maps = lozenge.bake(self.map, self.image, ["normal"], size=128)
        places = self.map.correspondence(128, self.image).interpolate(self.triangles, self.positions)
        maps["base-color"] = 0.5 + 0.5 * np.sin(places)
        self.assertEqual(list(maps), ["normal", "base-color"])
        lozenge.export(self.path / "field.glb", self.map, self.image, maps)
        self.assertIn(b"basecolor", (self.path / "field.glb").read_bytes())

    def test_build_makes_the_same_bytes_as_the_command(self):
        mesh = self.path / "torus.ply"
        write_ply(mesh, self.positions, self.triangles)
        made = lozenge.build(mesh, self.path / "ours", map_size=64, samples=5, domain_faces=FACES, preview=False)
        subprocess.run([os.environ["LOZENGE_PROGRAM"], "build", mesh, "-o", self.path / "theirs", "--map-size", "64", "--samples",
                        "5", "--domain-faces", str(FACES), "--no-preview", "--quiet"], check=True, stdout=subprocess.DEVNULL)
        theirs = {file.name: file.read_bytes() for file in (self.path / "theirs").iterdir()}
        self.assertEqual({file.name: file.read_bytes() for file in made.files}, theirs)
        self.assertEqual(made.report["domain"]["triangles"], len(self.map.domain))

    def test_a_file_is_mapped_as_the_arrays_in_it(self):
        mesh = self.path / "read.ply"
        write_ply(mesh, self.positions, self.triangles)
        read = lozenge.read(mesh)
        map = lozenge.parameterize(read, domain_faces=FACES)
        np.testing.assert_array_equal(map.alpha_beta, self.map.alpha_beta)
        places = map.correspondence(64).interpolate(read.triangles, read.positions)
        self.assertLess(np.abs(np.linalg.norm(places, axis=-1).max() - 3), 0.1)

    def test_errors_have_the_kind_of_the_exit_code(self):
        with self.assertRaisesRegex(lozenge.UnusableInputError, "triangle 0 names vertex 99") as caught:
            lozenge.parameterize(self.positions[:3], np.array([[0, 1, 99]]))
        self.assertEqual(caught.exception.code, 3)
        with self.assertRaisesRegex(lozenge.UsageError, r"shape \(4, 2\)"):
            lozenge.unwrap(np.zeros((4, 2)), self.triangles)
        with self.assertRaisesRegex(lozenge.UsageError, "integers"):
            lozenge.parameterize(self.positions, self.triangles.astype(float))
        with self.assertRaises(ValueError):
            lozenge.parameterize(self.positions, self.triangles, domain_faces=(9, 3))
        with self.assertRaises(lozenge.UnusableInputError):
            lozenge.parameterize(self.positions * np.nan, self.triangles)
        with self.assertRaises(lozenge.UnusableInputError):
            lozenge.parameterize(np.zeros((0, 3)), np.zeros((0, 3), int))
        with self.assertRaises(lozenge.Error):
            lozenge.read(self.path / "missing.glb")

    def test_what_doesnt_belong_together_is_refused(self):
        other = lozenge.parameterize(self.positions, self.triangles, domain_faces=FACES - 4)
        with self.assertRaises(lozenge.UsageError):
            other.correspondence(64, self.image)
        for call in (lambda: lozenge.bake(self.map, None), lambda: self.map.sample(9).sources(None)):
            with self.assertRaises(TypeError):
                call()
        with self.assertRaises(lozenge.UsageError):
            lozenge.bake(self.map, self.image, ["colour"])
        maps = lozenge.bake(self.map, self.image, ["position"], size=64)
        with self.assertRaises(lozenge.UsageError):
            maps["base-color"] = np.zeros((60, 64, 3))
        with self.assertRaises(lozenge.UnusableInputError):
            maps["base-color"] = np.full((64, 64, 3), 2.0)

    def test_a_view_of_a_map_outlives_its_replacement(self):
        maps = lozenge.bake(self.map, self.image, ["position"], size=64)
        maps["base-color"] = np.zeros((64, 64, 3))
        black = maps["base-color"]
        maps["base-color"] = np.ones((32, 32, 4))
        del maps
        self.assertEqual(black.sum(), 0)

    def test_threads_are_as_many_as_asked_for_and_change_no_bit(self):
        one = lozenge.parameterize(self.positions, self.triangles, domain_faces=FACES, threads=1)
        np.testing.assert_array_equal(one.alpha_beta, self.map.alpha_beta)
        baked = [lozenge.bake(self.map, self.image, ["normal"], size=64, threads=threads)["normal"] for threads in (1, 3)]
        np.testing.assert_array_equal(*baked)
        with self.assertRaisesRegex(lozenge.UsageError, "threads"):
            lozenge.unwrap(self.positions, self.triangles, threads=-1)
        # One thread is the caller's own.
        everybody, caller = time.process_time(), time.thread_time()
        image = one.sample(9, threads=1).geometry_image
        lozenge.bake(one, image, size=256, threads=1)
        caller = time.thread_time() - caller
        self.assertLess(time.process_time() - everybody - caller, 0.3 * caller)

    def test_an_exception_of_the_progress_stops_the_work(self):
        def stop(what, done):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            lozenge.parameterize(self.positions, self.triangles, progress=stop)


if __name__ == "__main__":
    unittest.main()

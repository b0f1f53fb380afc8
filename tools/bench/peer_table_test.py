"""The table of both on figures whose ratios are known."""
import unittest

from peer_table import aggregate, lines, median_run

TABLE = {
    "vertices": 10000, "triangles": 20000, "closed_manifold": True, "irregular_percent": 0.2, "min_angle_degrees": 20,
    "mean_min_angle_degrees": 50, "area": {"sigma_percent": 10, "min_percent": 50, "max_percent": 200},
    "edge": {"sigma_percent": 5, "min_percent": 60, "max_percent": 150},
}


def run(seconds):
    return {step: {"seconds": s, "user": s, "system": 0.5, "peak_kb": 1000} for step, s in zip(("import", "parameterize", "remesh"), seconds)}


OURS = {
    "mesh": "a.off", "range": "100..200", "runs": [run((1, 9, 1)), run((1, 2, 1)), run((1, 3, 1))], "table": TABLE,
    "report": {"source": {"triangles": 52000}, "domain": {"triangles": 140},
               "distortion": {"area": 0.01, "angle": 0.1, "aggregate": aggregate(0.01, 0.1), "l2_stretch": 1.05,
                              "folded_triangles": 0}},
}
PEER = {"mesh": "a.off", "range": "100..200", "table": None,
        "filter": {"domain": 148, "area": 0.02, "angle": 0.2, "seconds": 100, "user": 120, "system": 6, "peak_kb": 3000}}


def row(name, made):
    return next(line for line in made if line.startswith(f"| {name} |"))


class PeerTable(unittest.TestCase):
    def test_aggregate_is_that_of_the_paper(self):
        # Table 3, Armadillo.
        self.assertAlmostEqual(aggregate(0.0213, 0.1730), 0.0573, delta=0.0002)

    def test_takes_the_run_of_the_median_time(self):
        self.assertEqual(median_run(OURS["runs"]), run((1, 3, 1)))

    def test_gives_ratios_of_what_both_know(self):
        made = list(lines(OURS, PEER))
        self.assertEqual(row("seconds", made), "| seconds | 5.00 | 100.00 | 20.00 |")
        self.assertEqual(row("CPU seconds", made), "| CPU seconds | 6.50 | 126.00 | 19.38 |")
        self.assertEqual(row("area distortion", made), "| area distortion | 0.0100 | 0.0200 | 2.00 |")
        self.assertEqual(row("L2 stretch", made), "| L2 stretch | 1.0500 | – |  |")
        self.assertEqual(row("area sigma %", made), "| area sigma % | 10.00 | – |  |")
        self.assertEqual(row("domain triangles", made), "| domain triangles | 140 | 148 |  |")

    def test_leaves_out_a_peer_that_was_not_run(self):
        self.assertEqual(row("seconds", lines(OURS, None)), "| seconds | 5.00 | – |  |")

    def test_says_why_the_peer_failed(self):
        failed = {**PEER, "filter": {"failed": "exit code 255", "seconds": 20, "user": 20, "system": 0, "peak_kb": 3000}}
        made = list(lines(OURS, failed))
        self.assertIn("MeshLab failed: exit code 255.", made)
        self.assertEqual(row("area distortion", made), "| area distortion | 0.0100 | – |  |")

    def test_takes_the_remesh_of_both(self):
        self.assertEqual(row("edge max %", lines(OURS, {**PEER, "table": TABLE})), "| edge max % | 150.00 | 150.00 |  |")


if __name__ == "__main__":
    unittest.main()

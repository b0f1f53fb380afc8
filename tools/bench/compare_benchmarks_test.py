"""The comparison of two builds on times whose ratios are known."""
import unittest

from compare_benchmarks import compared, lines, runs_of, together


def report(name, times, unit="ms"):
    rows = [{"name": f"{name}/process_time/real_time", "run_name": f"{name}/process_time/real_time", "run_type": "iteration",
             "real_time": t, "cpu_time": 2 * t, "time_unit": unit} for t in times]
    median = {**rows[0], "name": f"{name}_median", "run_type": "aggregate", "real_time": 1e9}
    return {"benchmarks": [*rows, median]}


class CompareBenchmarks(unittest.TestCase):
    def test_marks_a_difference_larger_than_the_noise(self):
        old = [100, 101, 102, 103, 104]
        self.assertEqual(compared(old, [t / 2 for t in old])[2], "-")
        self.assertEqual(compared(old, [t * 2 for t in old])[2], "+")

    def test_marks_nothing_inside_of_the_noise(self):
        self.assertEqual(compared([80, 90, 100, 110, 120], [90, 100, 110, 120, 130])[2], "")

    def test_one_outlier_among_five_hides_no_difference(self):
        self.assertEqual(compared([100, 100, 101, 101, 500], [80, 80, 81, 81, 81])[2], "-")

    def test_marks_no_difference_below_two_percent_however_small_the_noise(self):
        self.assertEqual(compared([100] * 5, [101] * 5)[2], "")

    def test_knows_no_noise_of_two_runs(self):
        self.assertEqual(compared([100, 100], [50, 50]), (0.5, None, "?"))

    def test_takes_single_runs_in_any_unit_and_leaves_summaries_out(self):
        self.assertEqual(dict(runs_of(report("flip", [1, 2], "us"))),
                         {("flip", "clock"): [1e3, 2e3], ("flip", "processor"): [2e3, 4e3]})

    def test_puts_the_runs_of_several_files_together(self):
        self.assertEqual(together([report("flip", [1]), report("flip", [3])])["flip", "clock"], [1e6, 3e6])

    def test_names_what_only_one_build_has(self):
        made = list(lines(together([report("a", [1]), report("b", [1])]), together([report("b", [1]), report("c", [1])])))
        self.assertIn("Only in the old: a", made)
        self.assertIn("Only in the new: c", made)
        self.assertTrue(any(line.startswith("| b | clock | 1 ms | 1 ms | 1.000 |") for line in made))


if __name__ == "__main__":
    unittest.main()

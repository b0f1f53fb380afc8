#!/usr/bin/env python3
"""Two builds' times of the same benchmarks, side by side, as a Markdown table.

Usage: compare_benchmarks.py OLD NEW

OLD and NEW are JSON files that a benchmark program wrote (--benchmark_out), or folders of such files, whose runs count together;
compare.sh makes them. A ratio is the median of all new runs over that of all old ones: below 1, the new build is faster. Noise is what
the middle halves of both builds' runs spread over, in percent of their medians, added up. A difference larger than that, and larger
than 2 %, is marked: - is faster, + is slower. Fewer than 3 runs of a build have no noise, and ? stands there.
"""
import collections
import json
import pathlib
import statistics
import sys

# Smaller differences are another place in memory for the same code, as a rule.
LEAST_DIFFERENCE = 0.02
LEAST_RUNS = 3
NANOSECONDS = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}
FIGURES = {"clock": "real_time", "processor": "cpu_time"}


def runs_of(report):
    """(name, figure) -> nanoseconds of each run; what Google Benchmark itself summed up is left out."""
    runs = collections.defaultdict(list)
    for row in report["benchmarks"]:
        if row.get("run_type", "iteration") != "iteration" or row.get("error_occurred"):
            continue
        name = row.get("run_name", row["name"]).removesuffix("/real_time").removesuffix("/process_time")
        for figure, field in FIGURES.items():
            runs[name, figure].append(row[field] * NANOSECONDS[row["time_unit"]])
    return runs


def together(reports):
    runs = collections.defaultdict(list)
    for report in reports:
        for key, times in runs_of(report).items():
            runs[key] += times
    return runs


def spread(times):
    """Of the middle half, as a share of the median."""
    low, middle, high = statistics.quantiles(times, n=4, method="inclusive")
    return (high - low) / middle if middle else 0


def compared(old, new):
    """(ratio, noise, mark); no noise where there are too few runs."""
    ratio = statistics.median(new) / statistics.median(old) if statistics.median(old) else float("nan")
    if min(len(old), len(new)) < LEAST_RUNS:
        return ratio, None, "?"
    noise = spread(old) + spread(new)
    if abs(ratio - 1) <= max(noise, LEAST_DIFFERENCE):
        return ratio, noise, ""
    return ratio, noise, "-" if ratio < 1 else "+"


def in_words(nanoseconds):
    for unit in ("s", "ms", "us"):
        if nanoseconds >= NANOSECONDS[unit]:
            return f"{nanoseconds / NANOSECONDS[unit]:.3g} {unit}"
    return f"{nanoseconds:.3g} ns"


def lines(old, new):
    yield "| benchmark | figure | old | new | new / old | noise % | |"
    yield "|---|---|---|---|---|---|---|"
    for name, figure in old:
        before, after = old[name, figure], new.get((name, figure))
        if after is None:
            continue
        ratio, noise, mark = compared(before, after)
        told = "" if noise is None else f"{100 * noise:.1f}"
        yield (f"| {name} | {figure} | {in_words(statistics.median(before))} | {in_words(statistics.median(after))} "
               f"| {ratio:.3f} | {told} | {mark} |")
    for title, names in (("Only in the old", old.keys() - new.keys()), ("Only in the new", new.keys() - old.keys())):
        if names:
            yield ""
            yield f"{title}: {', '.join(sorted({name for name, _ in names}))}"


def read(path):
    path = pathlib.Path(path)
    files = sorted(path.glob("*.json")) if path.is_dir() else [path]
    if not files:
        sys.exit(f"compare_benchmarks.py: {path} holds no .json")
    return together(json.loads(file.read_text()) for file in files)


def main():
    if len(sys.argv) != 3:
        sys.exit("Usage: compare_benchmarks.py OLD NEW")
    for line in lines(read(sys.argv[1]), read(sys.argv[2])):
        print(line)


if __name__ == "__main__":
    main()

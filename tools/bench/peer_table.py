#!/usr/bin/env python3
"""The figures of Lozenge and of MeshLab's filter on one mesh, side by side, as a Markdown table.

Usage: peer_table.py OURS.json PEER.json

The files are what peer.sh makes; PEER.json may be empty. Of all figures but domain triangles, vertices and the smallest areas, edges
and angles, less is better; the last column is MeshLab's over Lozenge's, so above 1 is for Lozenge.
"""
import json
import pathlib
import statistics
import sys


def aggregate(area, angle):
    """The paper's (4) with gamma = 3."""
    return ((1 + area) ** 3 * (1 + angle)) ** 0.25 - 1


def total(run):
    return sum(step["seconds"] for step in run.values())


def cpu_seconds(step):
    """Of all threads; says more than the clock on a machine that others use."""
    return step["user"] + step["system"]


def median_run(runs):
    """The run of the median time; of two in the middle, the slower."""
    return sorted(runs, key=total)[len(runs) // 2]


def table_figures(table):
    """The columns of the paper's Table 1."""
    return {
        "remesh vertices": table["vertices"],
        "area sigma %": table["area"]["sigma_percent"],
        "area min %": table["area"]["min_percent"],
        "area max %": table["area"]["max_percent"],
        "min angle": table["min_angle_degrees"],
        "mean min angle": table["mean_min_angle_degrees"],
        "edge sigma %": table["edge"]["sigma_percent"],
        "edge min %": table["edge"]["min_percent"],
        "edge max %": table["edge"]["max_percent"],
        "irregular vertices %": table["irregular_percent"],
    }


def our_figures(ours):
    """[name] value, of what was measured."""
    distortion = ours["report"]["distortion"]
    run = median_run(ours["runs"])
    return {
        "domain triangles": ours["report"]["domain"]["triangles"],
        "area distortion": distortion["area"],
        "angle distortion": distortion["angle"],
        "aggregate distortion": distortion["aggregate"],
        "L2 stretch": distortion["l2_stretch"],
        "folded triangles": distortion["folded_triangles"],
        "seconds": statistics.median(total(r) for r in ours["runs"]),
        "of them import": run["import"]["seconds"],
        "of them remesh": run["remesh"]["seconds"],
        "CPU seconds": sum(cpu_seconds(step) for step in run.values()),
        "peak memory MB": max(step["peak_kb"] for step in run.values()) * 1024 / 1e6,
        **table_figures(ours["table"]),
    }


def peer_figures(peer):
    """As our_figures; what the filter doesn't tell isn't there, nor what it has after it failed."""
    figures = {
        "seconds": peer["filter"]["seconds"],
        "CPU seconds": cpu_seconds(peer["filter"]),
        "peak memory MB": peer["filter"]["peak_kb"] * 1024 / 1e6,
    }
    if "failed" in peer["filter"]:
        return figures
    area, angle = peer["filter"]["area"], peer["filter"]["angle"]
    figures.update({
        "domain triangles": peer["filter"]["domain"],
        "area distortion": area,
        "angle distortion": angle,
        "aggregate distortion": aggregate(area, angle),
    })
    if peer["table"] is not None:
        figures.update(table_figures(peer["table"]))
    return figures


COUNTS = {"domain triangles", "remesh vertices", "folded triangles"}
COMPARED = {"area distortion", "angle distortion", "aggregate distortion", "seconds", "CPU seconds", "peak memory MB",
            "area sigma %", "edge sigma %", "irregular vertices %"}


def cell(name, figures):
    if name not in figures:
        return "–"
    if name in COUNTS:
        return f"{figures[name]:d}"
    digits = 4 if "distortion" in name or "stretch" in name else 2
    return f"{figures[name]:.{digits}f}"


def ratio(name, ours, theirs):
    if name not in COMPARED or name not in theirs or not ours[name] > 0:
        return ""
    return f"{theirs[name] / ours[name]:.2f}"


def lines(ours, peer):
    """The table, line by line."""
    triangles = ours["report"]["source"]["triangles"]
    yield f"### {ours['mesh']}, {triangles} triangles, domain {ours['range']}"
    yield ""
    mine = our_figures(ours)
    theirs = peer_figures(peer) if peer else {}
    yield "| | Lozenge | MeshLab | MeshLab / Lozenge |"
    yield "|---|---:|---:|---:|"
    for name in mine:
        yield f"| {name} | {cell(name, mine)} | {cell(name, theirs)} | {ratio(name, mine, theirs)} |"
    yield ""
    if peer and "failed" in peer["filter"]:
        yield f"MeshLab failed: {peer['filter']['failed']}."
        yield ""


def main():
    ours = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    peer = pathlib.Path(sys.argv[2]).read_text(encoding="utf-8")
    print("\n".join(lines(ours, json.loads(peer) if peer.strip() else None)))


if __name__ == "__main__":
    main()

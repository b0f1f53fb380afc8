#!/usr/bin/env python3
"""Proves that includes point one way: tools -> pipeline -> stages -> formats.

A stage never includes another stage, every include of ours names a file that is there, and heavy headers of other people don't
spread: a header of ours that needs one is included by .cpp files only.

Usage: check_includes.py ROOT
"""
import pathlib
import re
import sys

# What the files of a folder may include of ours, besides their own folder.
ALLOWED = {
    "formats": (),
    "stages": ("formats",),
    "pipeline": ("stages", "formats"),
    "tools": ("pipeline", "stages", "formats"),
    "test_assets": ("pipeline", "stages", "formats"),
}

# The test of a stage may make its input with the stages before it.
TEST_FILE = re.compile(r"_test\.cpp$")

HEAVY = re.compile(r"^(tiny_gltf\.h|OpenImageIO/|OpenEXR/|Imf|embree|draco/|Eigen/|nlohmann/json\.hpp$|CLI/|spdlog/|fmt/|tbb/|oneapi/)")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def part_of(path):
    """The folder whose rules hold for a file: formats, stages/import, ..."""
    first, *others = path.split("/")
    return f"stages/{others[0]}" if first == "stages" and len(others) > 1 else first


def breaches(root):
    """Sentences, one for each include that breaks a rule."""
    for folder, allowed in ALLOWED.items():
        for file in sorted((root / folder).rglob("*")):
            if file.suffix in (".h", ".cpp"):
                yield from breaches_in(root, file.relative_to(root).as_posix(), allowed)


def includes_of(file):
    """(bracket, name) of each include."""
    return INCLUDE.findall(file.read_text(encoding="utf-8"))


def is_heavy(file):
    return any(HEAVY.match(included) for _, included in includes_of(file))


def breaches_in(root, name, allowed):
    for bracket, included in includes_of(root / name):
        if bracket == "<" or HEAVY.match(included):
            continue
        if not (root / included).is_file():
            yield f"{name}: includes {included}, which is not there; includes are written from the root"
            continue
        if name.endswith(".h") and is_heavy(root / included):
            yield f"{name}: includes {included}, which includes heavy headers: only .cpp files may"
        if part_of(included) == part_of(name) or included.split("/")[0] in allowed:
            continue
        if TEST_FILE.search(name) and included.startswith("stages/") and name.startswith("stages/"):
            continue
        yield f"{name}: includes {included}; includes point from tools to pipeline to stages to formats"


def main():
    found = list(breaches(pathlib.Path(sys.argv[1])))
    for breach in found:
        print(breach)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

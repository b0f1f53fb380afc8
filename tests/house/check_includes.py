#!/usr/bin/env python3
"""Proves that includes point one way: tools -> pipeline -> stages -> formats/files -> patches -> domain -> surface -> base.

A stage never includes another stage, and those that only compute never see a file. Inside of stages/parameterize and of pipeline arrows
run down the rooms only. Every include of ours names a file that is there; heavy headers of other people don't spread: a header of ours that
needs one is included by .cpp files only; oneTBB is known to formats/base/parallel.cpp alone; and what helps tests alone is called so
(*_fixtures.h), for that is never installed.

Usage: check_includes.py ROOT
"""
import pathlib
import re
import sys

FOLDERS = ("formats", "stages", "pipeline", "tools", "test_assets")

# Floors of the house, the ground floor first: what is on one includes its own and those below.
FLOORS = (
    "formats/base",
    "formats/surface",
    "formats/domain",
    "formats/patches",
    "formats/files",
    "stages",
    "pipeline",
    "tools",
    "test_assets",
)

# The same inside of folders that are houses of their own; what stands beside the rooms is above all of them.
ROOMS = {
    "stages/parameterize": ("map", "relax", "operations", "levels", "search"),
    "pipeline": ("maps", "quality", "cache", "batch", "unwrap"),
}

# They compute, and know nothing of files.
WITHOUT_FILES = ("stages/parameterize", "stages/sample", "stages/pack", "stages/bake")

# What serves tests may look up: the test of a stage may make its input with other stages.
OF_TESTS = re.compile(r"_(test|fixtures)\.(cpp|h)$")
FIXTURES = re.compile(r"_fixtures\.h$")

HEAVY = re.compile(r"^(tiny_gltf\.h|OpenImageIO/|OpenEXR/|Imf|embree|draco/|Eigen/|nlohmann/json\.hpp$|CLI/|spdlog/|fmt/|tbb/|oneapi/)")

# Who knows oneTBB: all others say formats/base/parallel.h. Tests may limit its threads.
THREADS = re.compile(r"^(tbb|oneapi)/")
KNOW_THREADS = ("formats/base/parallel.cpp", "tools/threads.cpp")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def floor_of(path):
    """The number of a file's floor; -1 where it stands on none."""
    for number, floor in enumerate(FLOORS):
        if path.startswith(floor + "/"):
            return number
    return -1


def stage_of(path):
    first, *others = path.split("/")
    return f"stages/{others[0]}" if first == "stages" and len(others) > 1 else None


def room_of(path, house):
    """The number of a file's room in a house of rooms; what stands beside the rooms comes after all of them."""
    rooms = ROOMS[house]
    name = path[len(house) + 1:].split("/")[0]
    return rooms.index(name) if name in rooms else len(rooms)


def includes_of(file):
    """(bracket, name) of each include."""
    return INCLUDE.findall(file.read_text(encoding="utf-8"))


def is_heavy(file):
    return any(HEAVY.match(included) for _, included in includes_of(file))


def breach_of_floors(name, included):
    """What is wrong with an include from one file of ours to another, or None."""
    if floor_of(name) < 0:
        return "stands in none of the house's rooms"
    if OF_TESTS.search(name):
        # Tests of the nouns know no stages, those of a stage no pipeline.
        top = "formats/files" if name.startswith("formats/") else "stages" if name.startswith("stages/") else "test_assets"
        return None if floor_of(included) <= FLOORS.index(top) else "the tests of a part don't know what stands above it"
    if floor_of(included) > floor_of(name):
        return "includes point from tools to pipeline to stages to files to the nouns, patches to domain to surface to base"
    if stage_of(name) and stage_of(included) and stage_of(name) != stage_of(included):
        return "a stage never includes another stage: what two of them need is a noun"
    if stage_of(name) in WITHOUT_FILES and included.startswith("formats/files/"):
        return "this stage computes, and knows nothing of files"
    house = next((house for house in ROOMS if name.startswith(house + "/")), None)
    if house and included.startswith(house + "/") and room_of(included, house) > room_of(name, house):
        return f"inside of {house} arrows run down: {' <- '.join(ROOMS[house])} <- what stands beside them"
    return None


def breaches_in(root, name):
    for bracket, included in includes_of(root / name):
        if THREADS.match(included) and name not in KNOW_THREADS and not OF_TESTS.search(name):
            yield f"{name}: includes {included}; loops in parallel are those of formats/base/parallel.h"
        if bracket == "<" or HEAVY.match(included):
            continue
        if not (root / included).is_file():
            yield f"{name}: includes {included}, which is not there; includes are written from the root"
            continue
        if name.endswith(".h") and is_heavy(root / included):
            yield f"{name}: includes {included}, which includes heavy headers: only .cpp files may"
        if FIXTURES.search(included) and not OF_TESTS.search(name):
            yield f"{name}: includes {included}, which is for tests alone"
        if wrong := breach_of_floors(name, included):
            yield f"{name}: includes {included}; {wrong}"


def helpers_without_the_name(root, files):
    """Headers that tests alone include, and that don't say so in their names."""
    users = {}
    for folder in (*FOLDERS, "tests"):
        for file in sorted((root / folder).rglob("*")):
            if file.suffix in (".h", ".cpp"):
                name = file.relative_to(root).as_posix()
                for bracket, included in includes_of(file):
                    # A header that nothing but its own .cpp includes serves somebody else: those who install it.
                    if bracket == '"' and pathlib.PurePath(included).with_suffix("") != pathlib.PurePath(name).with_suffix(""):
                        users.setdefault(included, []).append(name)
    for header in files:
        by = users.get(header, [])
        own_source = (root / header).with_suffix(".cpp").is_file()
        if header.endswith(".h") and header.startswith(("formats/", "stages/", "pipeline/")) and not FIXTURES.search(header) \
                and not own_source and by and all(OF_TESTS.search(name) or name.startswith("tests/") for name in by):
            yield f"{header}: nothing but tests includes it; its name should end in _fixtures.h, so that it is not installed"


def breaches(root):
    """Sentences, one for each include that breaks a rule."""
    files = [file.relative_to(root).as_posix() for folder in FOLDERS for file in sorted((root / folder).rglob("*"))
             if file.suffix in (".h", ".cpp")]
    for name in files:
        yield from breaches_in(root, name)
    yield from helpers_without_the_name(root, files)


def main():
    found = list(breaches(pathlib.Path(sys.argv[1])))
    for breach in found:
        print(breach)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

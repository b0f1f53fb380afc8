#!/usr/bin/env python3
"""Proves that the documentation names what is there.

Every path in backticks that begins with a folder of the house names a file or a folder; and the table of the paper's sections
(docs/parameterization.md) has a row for each of them, whose every file exists; and the table of deviations (docs/formats-read.md) is the source's.

Usage: check_docs.py ROOT
"""
import pathlib
import re
import sys

# The sections of the paper that describe the method.
SECTIONS = ("4", "4.1", "4.2", "5.1", "5.2", "5.3", "5.4", "5.5", "5.6", "5.7", "5.8", "6.0.1")

PATH = re.compile(r"`((?:formats|stages|pipeline|tools|tests|test_assets|docs|cmake)/[\w./*-]*)`")
ROW = re.compile(r"^\| *([\d.]+|–) *\|[^|]*\|([^|]*)\|", re.MULTILINE)
TEXT = re.compile(r'"([^"]*)"')
DEVIATION = re.compile(r'DeviationKind\{Deviation::\w+,\s*((?:"[^"]*"\s*)+),\s*((?:"[^"]*"\s*)+)\}')
FILE = re.compile(r"`([\w./]+\.(?:h|cpp))`")


def documents(root):
    yield from (root / name for name in ("README.md", "CONTRIBUTING.md") if (root / name).is_file())
    yield from sorted((root / "docs").glob("*.md"))


def missing_paths(root):
    for document in documents(root):
        for path in PATH.findall(document.read_text(encoding="utf-8")):
            if not any(root.glob(path.rstrip("/"))):
                yield f"{document.relative_to(root)}: names {path}, which is not there"


def missing_sections(root):
    text = (root / "docs/parameterization.md").read_text(encoding="utf-8")
    rows = [(section, FILE.findall(files)) for section, files in ROW.findall(text)]
    for section in SECTIONS:
        if not any(section == row and files for row, files in rows):
            yield f"docs/parameterization.md: no row of the table names a file of section {section}"
    for section, files in rows:
        for file in files:
            if not any((root / folder / file).is_file() for folder in ("", "stages/parameterize")):
                yield f"docs/parameterization.md: the row of section {section} names {file}, which is not there"


def missing_deviations(root):
    """The table of what is read against the rules is the source's (formats/files/readers/deviations.h)."""
    source = root / "formats/files/readers/deviations.h"
    if not source.is_file():
        return
    rows = (root / "docs/formats-read.md").read_text(encoding="utf-8")
    for what, fate in DEVIATION.findall(source.read_text(encoding="utf-8")):
        row = f"| {''.join(TEXT.findall(what))} | {''.join(TEXT.findall(fate))} |"
        if row not in rows:
            yield f"docs/formats-read.md: lacks the row {row}"


def main():
    root = pathlib.Path(sys.argv[1])
    found = [*missing_paths(root), *missing_sections(root), *missing_deviations(root)]
    for defect in found:
        print(defect)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

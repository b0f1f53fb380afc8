#!/usr/bin/env python3
"""Sums up a JUnit file that CTest wrote: what was skipped and why, what failed, and one last line for people and CI:

    N passed, N failed[, N skipped]

Usage: summarize_tests.py RESULTS.xml
The exit code is 0 where at least one test passed and none failed.
"""
import re
import sys
import xml.etree.ElementTree


def is_skipped(case):
    """CTest also says `skipped` of a test whose program is missing: that one failed."""
    skipped = case.find("skipped")
    return skipped is not None and skipped.get("message", "").startswith("SKIP_")


def outcome(case):
    if case.get("status") == "run":
        return "passed"
    return "skipped" if is_skipped(case) or case.get("status") == "disabled" else "failed"


def skip_reason(case):
    """GoogleTest prints the reason on the line after the place in the source where the test was skipped."""
    output = case.findtext("system-out", "")
    found = re.search(r"^\S+:\d+: Skipped\n+(.+)$", output, re.MULTILINE)
    if found:
        return found.group(1).strip()
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    return lines[-1] if lines else "no reason given"


def main():
    try:
        cases = xml.etree.ElementTree.parse(sys.argv[1]).getroot().findall("testcase")
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        print(f"no test results: {error}", file=sys.stderr)
        cases = []

    names = {"passed": [], "failed": [], "skipped": []}
    for case in cases:
        names[outcome(case)].append(case)
    for case in names["skipped"]:
        print(f"skipped: {case.get('name')}: {skip_reason(case)}")
    for case in names["failed"]:
        print(f"failed: {case.get('name')}")

    summary = f"{len(names['passed'])} passed, {len(names['failed'])} failed"
    if names["skipped"]:
        summary += f", {len(names['skipped'])} skipped"
    print(summary)
    return 0 if names["passed"] and not names["failed"] else 1


if __name__ == "__main__":
    sys.exit(main())

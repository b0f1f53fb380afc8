#!/usr/bin/env python3
"""Hashes of all that `lozenge build` makes of some assets: before and after a change that must not change any of it.

    tools/output_hashes.py build/release/lozenge ASSETS... >before
    ...
    tools/output_hashes.py build/release/lozenge ASSETS... >after
    diff before after

A line for each file but the preview (a picture, for people), for the report without what differs between any two runs, and for the
exit code; in the order of the names. ASSETS are files, or folders of .glb and .gltf files. Options after `--` go to `build`.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

# Keys of the report that no two runs agree on.
KEYS_OF_A_RUN = {"seconds", "peak_memory_mb", "rays_per_second"}


def assets_below(paths):
    for path in map(pathlib.Path, paths):
        yield from sorted(f for f in path.iterdir() if f.suffix in (".glb", ".gltf")) if path.is_dir() else [path]


def without_run(value):
    if isinstance(value, dict):
        return {key: without_run(each) for key, each in value.items() if key not in KEYS_OF_A_RUN}
    return [without_run(each) for each in value] if isinstance(value, list) else value


def digest_of(file):
    data = file.read_bytes()
    if file.name == "report.json":
        data = json.dumps(without_run(json.loads(data)), sort_keys=True).encode()
    return hashlib.sha256(data).hexdigest()[:32]


def lines_of(program, asset, options):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        command = [program, "build", asset, "-o", out, "--quiet", "--threads", "1", "--report", out / "report.json", *options]
        run = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        made = sorted(f for f in out.rglob("*") if f.is_file() and not f.name.endswith(".preview.png"))
        return [f"exit {run.returncode:<27}  {asset.name}"] + [f"{digest_of(f)}  {asset.name}/{f.relative_to(out)}" for f in made]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the program `lozenge`")
    parser.add_argument("assets", nargs="+", metavar="ASSET")
    arguments = sys.argv[1:]
    options = arguments[arguments.index("--") + 1:] if "--" in arguments else []
    parsed = parser.parse_args(arguments[:arguments.index("--")] if "--" in arguments else arguments)
    assets = list(assets_below(parsed.assets))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for lines in pool.map(lambda asset: lines_of(parsed.program, asset, options), assets):
            print("\n".join(lines), flush=True)


if __name__ == "__main__":
    main()

"""Kills builds at random moments, and proves that outputs and cache stay sound.

After each kill every output is whole: it is one that an undisturbed build makes, or not there. Whatever the cache then has
is right, and the next build leaves nothing of the killed one.

Usage: kills.py [--kills N] [--asset FILE] [--seed S] [-- options of build]
"""
import argparse
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

from pipeline_case import PLAIN, PROGRAM, QUICK, content_of, hidden_in


def start(words):
    return subprocess.Popen([PROGRAM, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)


def require(condition, message):
    if not condition:
        sys.exit(f"unsound: {message}")


class Kills:
    def __init__(self, folder, asset, options):
        self.out = folder / "out"
        self.cache = folder / "cache"
        self.asset = asset
        self.options = options

    def words(self, options, out):
        return ["build", self.asset, "-o", out, *options]

    def reference(self, options, folder):
        """What an undisturbed build makes, and how long it takes."""
        began = time.monotonic()
        require(start(self.words(options, folder)).wait() == 0, "an undisturbed build failed")
        return content_of(folder), time.monotonic() - began

    def check_outputs(self, made, when):
        for name, content in content_of(self.out, hidden=False).items():
            require(name in made and content in made[name], f"{name} is neither old nor new {when}")

    def run(self, kills, seed):
        generator = random.Random(seed)
        other = [*self.options, "--samples", "5"]
        first, seconds = self.reference(self.options, self.out.parent / "first")
        second, _ = self.reference(other, self.out.parent / "second")
        made = {name: {first[name], second[name]} for name in first}
        for kill in range(kills):
            # Two builds take turns, so that old outputs are there to be replaced; a hit is a moment worth hitting, too.
            options = self.options if kill % 2 else other
            if generator.random() < 0.5:
                shutil.rmtree(self.cache, ignore_errors=True)
            warm = self.cache.exists()
            moment = generator.uniform(0, 0.3 if warm and generator.random() < 0.5 else 1.1 * seconds)
            process = start(self.words(options, self.out) + ["--cache", self.cache])
            try:
                process.wait(timeout=moment)
                ended = "ended before"
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                ended = "killed"
            print(f"kill {kill + 1}: {moment:.2f} s, {'warm' if warm else 'cold'}, {ended}", flush=True)
            if self.out.exists():
                self.check_outputs(made, f"after kill {kill + 1}")
        for options, wanted in ((self.options, first), (other, second)):
            for _ in range(2):  # the second is taken from the cache
                require(start(self.words(options, self.out) + ["--cache", self.cache]).wait() == 0, "a build failed afterwards")
                require(content_of(self.out) == wanted, "a build after the kills isn't what it is without them")
        require(start(["cache", "prune", "--max-size", "1T", "--cache", self.cache]).wait() == 0, "pruning failed")
        require(not hidden_in(self.out), f"left in the outputs: {hidden_in(self.out)}")
        require(not hidden_in(self.cache), f"left in the cache: {hidden_in(self.cache)}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--kills", type=int, default=6)
    parser.add_argument("--asset", default=PLAIN)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("options", nargs="*", default=QUICK)
    arguments = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="lozenge_kills_"))
    try:
        Kills(folder, arguments.asset, arguments.options).run(arguments.kills, arguments.seed)
    finally:
        shutil.rmtree(folder)
    print(f"{arguments.kills} kills, nothing unsound")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Times whole jobs: design to PNG files, through the command line, as a user meets them.

usage: whole_jobs.py OMBRE [--runs N] [--threads N] [DESIGN ...]

Prints one row a job with the median of several runs and their spread. Figures are for comparing two builds
on one machine in one sitting; nothing is asserted.
"""
import argparse
import json
import math
import pathlib
import shutil
import statistics
import subprocess
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent

# name, design, arguments
jobs = [
    ("sphere", "sphere(10);", ["--printer", "j750"]),
    ("sphere, graded", 'fgrade(["0.5 + x/20", "0.5 - x/20"], ["red", "blue"], "prob") { sphere(10); }', ["--printer", "j750"]),
    ("gyroid in a box", 'intersection() { cube(15); function("sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)"); }', ["--printer", "j750"]),
    ("gear, a mesh", f'mesh("{root}/examples/models/gear.stl");', ["--printer", "j750"]),
    ("500 struts", 'for (i = [0:499]) rotate(0, i*7, i*31) strut((0, 0, 0), (10, 0, 0), 0.2, "red");', ["--printer", "j750"]),
]


def run(ombre, design, arguments, threads):
    folder = tempfile.mkdtemp(prefix="ombre-bench-")
    try:
        command = [ombre, "slice", str(design), "-o", folder, "--force", "--json", "--threads", str(threads), *arguments]
        events = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
        events = {event["event"]: event for event in map(json.loads, events)}
        return math.prod(events["plan"]["voxels"]), events["done"]["seconds"]
    finally:
        shutil.rmtree(folder)


def row(name, ombre, design, arguments, threads, runs):
    results = [run(ombre, design, arguments, threads) for _ in range(runs)]
    seconds = sorted(seconds for _, seconds in results)
    voxels = results[0][0]
    median = statistics.median(seconds)
    print(f"{name:28} {voxels / 1e6:10.1f} {median:9.3f} {seconds[-1] - seconds[0]:9.3f} {voxels / median / 1e6:12.1f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ombre")
    parser.add_argument("designs", nargs="*", help="designs to time instead of the usual jobs")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--threads", type=int, default=1)
    a = parser.parse_args()
    print(f"{'job':28} {'M voxels':>10} {'median s':>9} {'spread s':>9} {'M voxels/s':>12}   ({a.threads} threads)")
    if a.designs:
        for design in a.designs:
            row(pathlib.Path(design).stem, a.ombre, design, [], a.threads, a.runs)
        return
    with tempfile.TemporaryDirectory() as folder:
        for name, text, arguments in jobs:
            design = pathlib.Path(folder) / "job.vcad"
            design.write_text(text)
            row(name, a.ombre, design, arguments, a.threads, a.runs)


if __name__ == "__main__":
    main()

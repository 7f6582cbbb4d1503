#!/usr/bin/env python3
"""Measures the examples that repeat the objects of Foundry (2016), as its Table 1 does: a coarse and a fine picture of a
slice, the whole job for the printer, and the most memory.

    python3 bench/objects.py build/release/apps/ombre/ombre [NAME ...] [--printer j750]
"""
import argparse
import json
import math
import pathlib
import re
import tempfile

import programs

# Planes of the pictures, which cut the parts where most of them is.
OBJECTS = {"paddle": "z=0", "ski": "z=4.5", "tweel": "z=0", "bone": "x=0", "helmet": "y=0"}
COLUMNS = ("object", "nodes", "operations", "coarse s", "coarse cpu s", "fine s", "fine cpu s", "10^9 voxels", "job s", "job cpu s", "most MB")


def picture(ombre, name, plane, pixels, scratch):
    """What a picture of a slice takes whose longer side has so many pixels."""
    return programs.run([ombre, "render", ombre_file(name), "--slice", plane, "--size", f"{pixels}x{pixels}",
                         "-o", scratch / "slice.png", "--force", "--quiet"])


def ombre_file(name):
    return programs.ROOT / "examples" / f"{name}.vcad"


def counts(ombre, name):
    """Nodes of the design and operations of its program, as `--emit stats` says."""
    text = programs.run([ombre, "slice", ombre_file(name), "--emit", "stats"]).output
    return [re.search(rf"^{word} +([\d,]*\d)", text, re.MULTILINE)[1] for word in ("nodes", "operations")]


def measure(ombre, name, printer, scratch):
    coarse = picture(ombre, name, OBJECTS[name], 128, scratch)
    fine = picture(ombre, name, OBJECTS[name], 2048, scratch)
    job = programs.run([ombre, "slice", ombre_file(name), "--printer", printer, "-o", scratch / name, "--json"])
    planned = next(event for event in map(json.loads, job.output.splitlines()) if event["event"] == "plan")
    voxels = math.prod(planned["voxels"])
    return (name, *counts(ombre, name), f"{coarse.seconds:.2f}", f"{coarse.cpu_seconds:.2f}", f"{fine.seconds:.2f}", f"{fine.cpu_seconds:.2f}",
            f"{voxels / 1e9:.2f}", f"{job.seconds:.1f}", f"{job.cpu_seconds:.1f}",
            f"{max(job.peak_bytes, fine.peak_bytes) / 1e6:.0f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ombre", type=pathlib.Path)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"{', '.join(OBJECTS)} (default: all)")
    parser.add_argument("--printer", default="j750", help="profile of the whole job (j750)")
    args = parser.parse_args()
    programs.stop_on_signals()
    ombre = args.ombre.resolve()
    print(*COLUMNS, sep="\t", flush=True)
    for name in args.names or OBJECTS:
        with tempfile.TemporaryDirectory() as scratch:
            print(*measure(ombre, name, args.printer, pathlib.Path(scratch)), sep="\t", flush=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Compares what `ombre scad` makes of OpenSCAD scripts with what an installed openscad makes: volume, area, box, centroid and
second moments of solids, area and box of drawings, and all messages. Colours, which keep solids apart in Ombre, are taken out
of the scripts. Prints a row for each script, and the times of both.

    python3 tools/compare_openscad.py build/release/apps/ombre/ombre /usr/share/openscad/examples [--limit SECONDS] [NAME...]
"""
import argparse
import difflib
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import numpy

TOLERANCE = 1e-4
WITHOUT_COLOURS = "\nmodule color(c, alpha) { children(); }\n"


def triangles_of_stl(path):
    data = path.read_bytes()
    if data[:5] == b"solid":
        numbers = [line.split()[1:] for line in data.decode().splitlines() if line.strip().startswith("vertex")]
        return numpy.array(numbers, dtype=float).reshape(-1, 3, 3)
    records = numpy.frombuffer(data[84:], dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    return records["v"].astype(float)


def of_solid(path):
    """Volume, area, box, centroid, and the integrals of x^2, y^2, z^2 about it, in mm."""
    corners = triangles_of_stl(path)
    if len(corners) == 0:
        return None
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    middle = (low + high) / 2
    a, b, c = (corners[:, n] - middle for n in range(3))
    cross = numpy.cross(b - a, c - a)
    volumes = numpy.einsum("ij,ij->i", a, numpy.cross(b, c)) / 6
    volume = volumes.sum()
    centroid = (volumes[:, None] * (a + b + c) / 4).sum(axis=0) / volume
    squares = a * a + b * b + c * c + a * b + b * c + c * a
    second = (volumes[:, None] * squares / 10).sum(axis=0) - volume * centroid**2
    area = numpy.linalg.norm(cross, axis=1).sum() / 2
    return {"volume": volume, "area": area, "low": low, "high": high, "centroid": centroid + middle, "second": second}


def of_drawing(path):
    """Area and box of the paths of an SVG file, in mm."""
    text = path.read_text(encoding="utf-8")
    area, points = 0.0, []
    for data in re.findall(r'<path[^>]*\sd="([^"]*)"', text):
        for ring in re.findall(r"M([^Mz]*)", data):
            numbers = [float(n) for n in re.findall(r"-?\d+\.?\d*(?:e[-+]?\d+)?", ring)]
            ring = numpy.array(numbers).reshape(-1, 2)
            x, y = ring[:, 0], ring[:, 1]
            area += (x * numpy.roll(y, -1) - numpy.roll(x, -1) * y).sum() / 2
            points.append(ring)
    if not points:
        return None
    points = numpy.concatenate(points)
    return {"area": abs(area), "low": points.min(axis=0), "high": points.max(axis=0)}


def run(command, limit):
    start = time.monotonic()
    try:
        result = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=limit, check=False)
        return result, time.monotonic() - start
    except subprocess.TimeoutExpired:
        return None, limit


def far(name, ours, theirs, size):
    """By how much more than the tolerance they differ, as text."""
    scale = {"volume": size**3, "area": size**2, "second": size**5}.get(name, size)
    apart = numpy.abs(numpy.asarray(ours) - theirs).max()
    relative = apart / max(float(numpy.abs(theirs).max()), 1e-12) if name in ("volume", "area") else apart / scale
    return f"{name} {ours} is not {theirs}" if relative > TOLERANCE else ""


def messages(text):
    """Without what says how long it took and how the geometry is kept."""
    kept = [line for line in text.splitlines() if re.match(r"(ECHO|WARNING|ERROR|DEPRECATED|TRACE)\b", line)]
    return [re.sub(r"in file \S*/", "in file ", line) for line in kept]


def compare(ombre, script, scratch, limit):
    problems = []
    theirs, their_time = run(["openscad", "-o", scratch / "theirs.stl", script], limit)
    ending = "stl"
    if theirs and "not a 3D object" in theirs.stderr:
        ending = "svg"
        theirs, their_time = run(["openscad", "-o", scratch / "theirs.svg", script], limit)
    ours, our_time = run([ombre, "scad", "-o", scratch / f"ours.{ending}", script], limit)
    times = f"{our_time:7.2f} {their_time:7.2f}"
    if not ours or not theirs:
        return times, ["took longer than the limit: " + ", ".join(n for n, r in (("ombre", ours), ("openscad", theirs)) if not r)]
    before, after = messages(theirs.stderr), messages(ours.stdout + ours.stderr)
    if before != after:
        problems += list(difflib.unified_diff(before, after, "openscad", "ombre", lineterm="", n=0))[2:8]
    files = [scratch / f"{who}.{ending}" for who in ("ours", "theirs")]
    read = of_solid if ending == "stl" else of_drawing
    found = [read(file) if file.exists() else None for file in files]
    if None in found:
        if found != [None, None]:
            problems.append(f"geometry of ombre: {found[0] is not None}, of openscad: {found[1] is not None}: "
                            + ours.stderr.strip()[-300:])
        return times, problems
    size = float(numpy.linalg.norm(found[1]["high"] - found[1]["low"]))
    problems += filter(None, (far(name, found[0][name], found[1][name], size) for name in found[1]))
    return times, problems


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ombre", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--limit", type=float, default=100, help="seconds for each program and script")
    arguments = parser.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        copies = pathlib.Path(scratch) / "scripts"
        shutil.copytree(arguments.folder, copies)
        for script in sorted(copies.rglob("*.scad")):
            if arguments.names and script.stem not in arguments.names:
                continue
            script.write_text(script.read_text(encoding="utf-8") + WITHOUT_COLOURS, encoding="utf-8")
            with tempfile.TemporaryDirectory() as results:
                times, problems = compare(arguments.ombre.resolve(), script, pathlib.Path(results), arguments.limit)
            failed += bool(problems)
            print(f"{script.stem:24} {times}  {'DIFFERS' if problems else 'same'}", flush=True)
            for problem in problems:
                print("    " + problem)
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()

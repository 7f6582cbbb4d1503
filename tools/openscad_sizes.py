#!/usr/bin/env python3
"""Volume, area and box of what Debian's openscad makes of scripts: the numbers in src/solids/operations_test.cpp.

    tools/openscad_sizes.py 'linear_extrude(10, twist=90) square(5);' ...
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def run(script: str, ending: str) -> str | None:
    """The text of the file that openscad writes, nothing if it writes none."""
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder) / "in.scad", Path(folder) / f"out.{ending}"
        source.write_text(script)
        subprocess.run(["openscad", "-o", target, source], capture_output=True, check=False)
        return target.read_text() if target.exists() else None


def solid_size(text: str) -> tuple[float, list[tuple[float, float]]]:
    """mm3 and box of an OFF file."""
    words = text.split()
    vertices, faces = int(words[1]), int(words[2])
    points = [tuple(map(float, words[4 + 3 * n : 7 + 3 * n])) for n in range(vertices)]
    at, six = 4 + 3 * vertices, 0.0
    for _ in range(faces):
        count = int(words[at])
        corners = [points[int(n)] for n in words[at + 1 : at + 1 + count]]
        at += count + 1
        for b, c in zip(corners[1:], corners[2:]):
            a = corners[0]
            six += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    return six / 6, [(min(axis), max(axis)) for axis in zip(*points)]


def region_size(text: str) -> tuple[float, list[tuple[float, float]]]:
    """mm2 and box of an SVG file."""
    doubled, points = 0.0, []
    for data in re.findall(r'\sd="([^"]*)"', text):
        for ring in data.split("z"):
            corners = [tuple(map(float, pair.split(","))) for pair in re.findall(r"[-\d.e+]+,[-\d.e+]+", ring)]
            points += corners
            doubled += sum(x1 * y0 - x0 * y1 for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1]))
    return doubled / 2, [(min(axis), max(axis)) for axis in zip(*((x, -y) for x, y in points))]


def main() -> None:
    for script in sys.argv[1:]:
        if text := run(script, "off"):
            print(script, "volume {:.9g} box {}".format(*solid_size(text)))
        elif text := run(script, "svg"):
            print(script, "area {:.9g} box {}".format(*region_size(text)))
        else:
            print(script, "nothing")


if __name__ == "__main__":
    main()

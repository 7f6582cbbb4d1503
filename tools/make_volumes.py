#!/usr/bin/env python3
"""Writes the sample volume of examples/models/ and those of tests/cases/volumes/. Same bytes on every machine.

    tools/make_volumes.py
"""

import gzip
import struct
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def write_nrrd(path, type_name, code, sizes, directions, origin, space, value, packed=True):
    """value(i, j, k) of each voxel; the numbers are low byte first."""
    nx, ny, nz = sizes
    numbers = [value(i, j, k) for k in range(nz) for j in range(ny) for i in range(nx)]
    data = struct.pack(f"<{len(numbers)}{code}", *numbers)
    vectors = " ".join("(" + ",".join(f"{c:g}" for c in v) + ")" for v in directions)
    header = (f"NRRD0004\ntype: {type_name}\ndimension: 3\nspace: {space}\nsizes: {nx} {ny} {nz}\n"
              f"space directions: {vectors}\nkinds: domain domain domain\nendian: little\n"
              f"encoding: {'gzip' if packed else 'raw'}\nspace origin: ({','.join(f'{c:g}' for c in origin)})\n\n")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(header.encode() + (gzip.compress(data, 9, mtime=0) if packed else data))


def along_axes(spacing):
    x, y, z = spacing
    return (x, 0, 0), (0, y, 0), (0, 0, z)


def two_lobes(path):
    """A large and a small ball that meet, in voxels of 0.5 x 0.5 x 1 mm: 200 in their middles, less outwards."""
    def value(i, j, k):
        x, y, z = -12 + 0.5 * i, -9 + 0.5 * j, -9 + k
        large = 1 - ((x + 3) ** 2 + y ** 2 + z ** 2) / 72
        small = 1 - ((x - 4.5) ** 2 + (y - 1) ** 2 + z ** 2) / 32
        return round(200 * max(large, small, 0) ** 0.5)
    write_nrrd(path, "uint8", "B", (46, 37, 19), along_axes((0.5, 0.5, 1)), (-12, -9, -9), "left-posterior-superior", value)


def ball(path):
    """4 (81 - r^2) around the origin, in voxels of 0.5 x 0.5 x 3 mm: 0 on the ball of 9 mm."""
    def value(i, j, k):
        x, y, z = i - 21, j - 21, 3 * (k - 4)  # half millimetres in x and y
        return 4 * 81 - x * x - y * y - 4 * z * z
    write_nrrd(path, "int16", "h", (43, 43, 9), along_axes((0.5, 0.5, 3)), (-10.5, -10.5, -12),
               "left-posterior-superior", value)


def arms(path, space):
    """Label 1 runs from the first voxel along the file's first axis, 2 along the second, 3 along the third."""
    def value(i, j, k):
        if j == 0 and k == 0:
            return 1
        return 2 if i == 0 and k == 0 else 3 if i == 0 and j == 0 else 0
    write_nrrd(path, "uint16", "H", (6, 5, 4), ((-1, 0, 0), (0, 2, 0), (0, 0, 3)), (10, 20, 30), space, value, packed=False)


def main():
    two_lobes(ROOT / "examples" / "models" / "two_lobes.nrrd")
    fixtures = ROOT / "tests" / "cases" / "volumes" / "fixtures"
    ball(fixtures / "ball.nrrd")
    arms(fixtures / "arms.nrrd", "left-posterior-superior")
    arms(fixtures / "arms_left_handed.nrrd", "left-anterior-superior")


if __name__ == "__main__":
    main()

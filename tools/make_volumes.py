#!/usr/bin/env python3
"""Writes the sample volume of examples/models/ and those of tests/cases/volumes/. Same bytes on every machine.

    tools/make_volumes.py
"""

import gzip
import math
import struct
import zlib
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


def head(path):
    """A head as computed tomography sees it, much simplified, in voxels of 2.5 x 2.5 x 3 mm and Hounsfield units in
    steps of 10: skin and brain, a skull with a jaw, sinuses, and a tumour on the left. LPS: x to the left, y backwards."""
    def ball(x, y, z, middle, radii):
        return sum(((a - m) / r) ** 2 for a, m, r in zip((x, y, z), middle, radii)) ** 0.5

    def value(i, j, k):
        x, y, z = -87.5 + 2.5 * i, -112.5 + 2.5 * j, -105 + 3 * k
        scalp = ball(x, y, z, (0, 0, 20), (76, 94, 80))
        face = ball(x, y, z, (0, -52, -40), (52, 44, 62))
        nose = ball(x, y, z, (0, -96, -18), (11, 16, 20))
        neck = ball(x, y, min(z, 0), (0, 18, 0), (46, 48, 400)) + max(z, 0)
        # A border of a voxel or two, in which air and skin share.
        share = min(max(0.5 + 20 * (1 - min(scalp, face, nose, neck)), 0), 1)
        if share == 0:
            return -1000
        number = 40
        skull, brain = ball(x, y, z, (0, 0, 22), (69, 87, 72)), ball(x, y, z, (0, 0, 22), (62, 80, 65))
        if skull < 1:
            number = 900 if brain >= 1 else 30
        jaw = ball(x, y, z, (0, -44, -66), (42, 44, 18))
        if ball(x, y, z, (0, -30, -66), (34, 44, 30)) > 1 > jaw or (jaw < 1 and z < -78 and abs(x) < 40):
            number = 1100
        for side in (-1, 1):
            if ball(x, y, z, (28 * side, -76, 2), (15, 14, 13)) < 1:
                number = 10  # an eye
        if ball(x, y, z, (0, -74, -22), (14, 22, 12)) < 1:
            number = -900  # sinuses
        if ball(x, y, z, (0, 22, -70), (11, 11, 60)) < 1 and z < -10:
            number = 700  # the spine
        tumour = ball(x, y, z, (30, 18, 40), (17, 20, 15))
        if tumour < 1:
            number = 110 if tumour > 0.55 else 70
        return round((-1000 + (number + 1000) * share) / 10) * 10
    write_nrrd(path, "int16", "h", (71, 86, 68), along_axes((2.5, 2.5, 3)), (-87.5, -112.5, -105),
               "left-posterior-superior", value)


def noise(*numbers):
    """A number of a normal distribution that the numbers decide, the same on every machine: the sum of twelve even ones."""
    state = 0x9E3779B9
    for number in numbers:
        state = (state ^ number) * 0x85EBCA6B % 2**32
        state ^= state >> 13
    total = 0
    for _ in range(12):
        state = (1664525 * state + 1013904223) % 2**32
        total += state >> 8
    return total / 2**24 - 6


SPOTS = ((22, 36, 15, 8), (42, 26, 16, 6), (38, 44, 15, 5), (26, 20, 16, 5))  # places and radii, voxels


def is_in_spot(i, j, k):
    """The truth that noisy_scan blurs."""
    return any((i - a)**2 + (j - b)**2 + (k - c)**2 < r * r for a, b, c, r in SPOTS)


def noisy_scan(path):
    """A body with four spots in voxels of 1 mm, as a scanner blurs it: 50 in the body, 250 in spots, with a standard
    deviation of 20, and borders that are eight voxels wide; 0 around it."""
    size, sigma = (64, 64, 32), 2.0
    reach = 8
    weights = [math.exp(-n * n / (2 * sigma * sigma)) for n in range(-reach, reach + 1)]
    weights = [w / sum(weights) for w in weights]
    nx, ny, nz = size
    values = [1.0 * is_in_spot(i, j, k) for k in range(nz) for j in range(ny) for i in range(nx)]
    for step, count in ((1, nx), (nx, ny), (nx * ny, nz)):  # along one axis after another
        values = [sum(w * values[n + (m - reach) * step] for m, w in enumerate(weights)
                      if 0 <= n // step % count + m - reach < count) for n in range(len(values))]

    def value(i, j, k):
        if ((i - 31.5) / 30)**2 + ((j - 31.5) / 30)**2 + ((k - 15.5) / 15)**2 >= 1:
            return 0
        return min(max(round(50 + 200 * values[(k * ny + j) * nx + i] + 20 * noise(i, j, k)), 26), 255)
    write_nrrd(path, "uint8", "B", size, along_axes((1, 1, 1)), (-31.5, -31.5, -15.5), "left-posterior-superior", value)


def write_png(path, rows):
    """Rows of (red, green, blue, alpha) from the top."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 6, 0, 0, 0)
    data = b"".join(b"\0" + b"".join(bytes(pixel) for pixel in row) for row in rows)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))


def stack(folder):
    """A red ball with a blue core, of 20 x 20 x 10 pixels."""
    for k in range(10):
        def pixel(i, j, z=2 * k + 1):
            r = ((i - 9.5) ** 2 + (j - 9.5) ** 2 + (z - 10) ** 2) ** 0.5
            return (0, 80, 255, 255) if r < 5 else (255, 0, 0, 255) if r < 9.5 else (0, 0, 0, 0)
        write_png(folder / f"layer_{k}.png", [[pixel(i, j) for i in range(20)] for j in range(20)])


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
    head(ROOT / "examples" / "models" / "head.nrrd")
    noisy_scan(ROOT / "examples" / "models" / "noisy_scan.nrrd")
    stack(ROOT / "examples" / "models" / "stack")
    fixtures = ROOT / "tests" / "cases" / "volumes" / "fixtures"
    ball(fixtures / "ball.nrrd")
    arms(fixtures / "arms.nrrd", "left-posterior-superior")
    arms(fixtures / "arms_left_handed.nrrd", "left-anterior-superior")


if __name__ == "__main__":
    main()

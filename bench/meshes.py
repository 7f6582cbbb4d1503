"""Makes the meshes of the suite: stand-ins of the sizes that the 2023 paper's Table 4 states."""
import math
import struct

# Rows of 5 x 7 cells, the top one first.
LETTERS = {
    "O": ("01110", "10001", "10001", "10001", "10001", "10001", "01110"),
    "p": ("00000", "00000", "11110", "10001", "11110", "10000", "10000"),
    "e": ("00000", "00000", "01110", "10001", "11111", "10000", "01110"),
    "n": ("00000", "00000", "10110", "11001", "10001", "10001", "10001"),
    "V": ("10001", "10001", "10001", "10001", "10001", "01010", "00100"),
    "C": ("01110", "10001", "10000", "10000", "10000", "10001", "01110"),
    "A": ("01110", "10001", "10001", "11111", "10001", "10001", "10001"),
    "D": ("11110", "10001", "10001", "10001", "10001", "10001", "11110"),
}


def write_stl(path, triangles):
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(triangles)))
        for corners in triangles:
            coordinates = [c for corner in corners for c in corner]
            file.write(struct.pack("<12fH", 0, 0, 0, *coordinates, 0))


def _cells(word):
    """(column, row) of the filled cells, rows counted from below; a column is left free between letters."""
    return {(6 * place + x, 6 - y) for place, letter in enumerate(word)
            for y, row in enumerate(LETTERS[letter]) for x, cell in enumerate(row) if cell == "1"}


def _quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def block_letters(word, size):
    """The word as cells extruded along y, centred on the origin: the faces between a filled cell and none."""
    filled = _cells(word)
    columns = 6 * len(word) - 1
    wide, deep, high = size

    def corner(column, side, row):
        return (wide * (column / columns - 0.5), deep * (side - 0.5), high * (row / 7 - 0.5))

    triangles = []
    for x, z in sorted(filled):
        front = [corner(x, 0, z), corner(x + 1, 0, z), corner(x + 1, 0, z + 1), corner(x, 0, z + 1)]
        back = [corner(x, 1, z), corner(x + 1, 1, z), corner(x + 1, 1, z + 1), corner(x, 1, z + 1)]
        triangles += _quad(*front) + _quad(*reversed(back))
        for edge, beside in enumerate([(x, z - 1), (x + 1, z), (x, z + 1), (x - 1, z)]):
            if beside not in filled:
                after = (edge + 1) % 4
                triangles += _quad(front[after], front[edge], back[edge], back[after])
    return triangles


def _screwdriver_ring(y, around):
    """A ring of the screwdriver at y: a lobed handle below -12 mm, a shaft, and a flat tip above 60 mm."""
    handle_end, flat_from, tip = -12.0, 60.0, 72.0
    ring = []
    for i in range(around):
        angle = 2 * math.pi * i / around
        if y < handle_end:
            belly = math.sin(math.pi * (y + 72) / (handle_end + 72)) ** 0.5
            radius = (4 + 7 * belly) * (1 - 0.06 * (1 - math.cos(8 * angle)) / 2)
            x, z = radius * math.cos(angle), radius * math.sin(angle)
        else:
            flat = max(0.0, (y - flat_from) / (tip - flat_from))
            x, z = (3 + flat) * math.cos(angle), (3 - 2.4 * flat) * math.sin(angle)
        ring.append((x, y, z))
    return ring


def screwdriver(stations=161, around=152):
    """About 49,000 triangles in 22 x 144 x 22 mm, its axis along y."""
    rings = [_screwdriver_ring(-72 + 144 * k / (stations - 1), around) for k in range(stations)]
    triangles = []
    for lower, upper in zip(rings, rings[1:]):
        for i in range(around):
            j = (i + 1) % around
            triangles += _quad(lower[i], upper[i], upper[j], lower[j])
    for ring, is_first in ((rings[0], True), (rings[-1], False)):
        middle = (0.0, ring[0][1], 0.0)
        for i in range(around):
            a, b = ring[i], ring[(i + 1) % around]
            triangles.append((middle, a, b) if is_first else (middle, b, a))
    return triangles


def bumpy_ball(cuts=110):
    """A ball of about 48 mm with bumps of two sizes: an octahedron whose faces are cut, 8 cuts^2 triangles."""
    def place(corner):
        x, y, z = (c / math.hypot(*corner) for c in corner)
        radius = (24 + 1.2 * math.sin(9 * x + 1) * math.sin(11 * y + 2) * math.sin(10 * z)
                  + 0.4 * math.sin(31 * x) * math.sin(29 * y) * math.sin(37 * z))
        return (radius * x, radius * y, radius * z)

    triangles = []
    for signs in [(sx, sy, sz) for sx in (1, -1) for sy in (1, -1) for sz in (1, -1)]:
        def corner(i, j):
            return place(tuple(s * c for s, c in zip(signs, (i, j, cuts - i - j))))

        for i in range(cuts):
            for j in range(cuts - i):
                found = [(corner(i, j), corner(i + 1, j), corner(i, j + 1))]
                if i + j < cuts - 1:
                    found.append((corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)))
                triangles += found if math.prod(signs) > 0 else [(a, c, b) for a, b, c in found]
    return triangles


def make(folder):
    """Writes the meshes that are not in the folder yet."""
    folder.mkdir(parents=True, exist_ok=True)
    makers = {"text.stl": lambda: block_letters("OpenVCAD", (140, 7, 28)), "screwdriver.stl": screwdriver,
              "bumpy_ball.stl": bumpy_ball}
    for name, maker in makers.items():
        if not (folder / name).exists():
            write_stl(folder / name, maker())

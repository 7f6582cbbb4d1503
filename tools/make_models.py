#!/usr/bin/env python3
"""Writes the sample meshes of examples/models/. Same bytes on every machine.
beam_lattice.3mf is made by ombre, as beam_lattice.vcad beside it says; made_up_inks.json and .icc by
ombre calibrations --measured made_up_patches.csv -o made_up_inks.json.

    tools/make_models.py [FOLDER]
"""

import colorsys
import itertools
import json
import math
import struct
import sys
from pathlib import Path

DEFAULT_FOLDER = Path(__file__).resolve().parent.parent / "examples" / "models"

# Coordinates are rounded to this many digits of a millimetre, far above what libraries disagree about.
DIGITS = 5


def rounded(point):
    return tuple(round(c, DIGITS) + 0.0 for c in point)


class Mesh:
    """Vertices, and faces that run counter-clockwise seen from outside."""

    def __init__(self):
        self.vertices = []
        self.faces = []

    def add(self, points):
        """Adds vertices and returns their numbers."""
        first = len(self.vertices)
        self.vertices.extend(rounded(p) for p in points)
        return list(range(first, len(self.vertices)))

    def band(self, lower, upper):
        """Quads between two closed rings; outside is on the right of the rings' way, upper above lower."""
        for i in range(len(lower)):
            j = (i + 1) % len(lower)
            self.triangle(lower[i], lower[j], upper[j])
            self.triangle(lower[i], upper[j], upper[i])

    def triangle(self, a, b, c):
        self.faces.append((a, b, c))

    def triangles(self):
        for face in self.faces:
            for i in range(1, len(face) - 1):
                yield face[0], face[i], face[i + 1]


# --- writers ---------------------------------------------------------------------------------------


def normal(a, b, c):
    u = [b[i] - a[i] for i in range(3)]
    v = [c[i] - a[i] for i in range(3)]
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    size = math.sqrt(sum(x * x for x in n))
    # Few digits: square roots and quotients end differently here and there.
    return tuple(round(x / size, 3) + 0.0 for x in n)


def write_binary_stl(path, mesh, title):
    triangles = list(mesh.triangles())
    data = bytearray(title.encode("ascii").ljust(80, b"\0"))
    data += struct.pack("<I", len(triangles))
    for corners in triangles:
        points = [mesh.vertices[i] for i in corners]
        for point in [normal(*points)] + points:
            data += struct.pack("<3f", *point)
        data += struct.pack("<H", 0)
    path.write_bytes(data)


def number(value):
    return f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")


def write_lines(path, lines):
    path.write_bytes(("\n".join(lines) + "\n").encode("ascii"))


def write_off(path, mesh):
    lines = ["OFF", f"{len(mesh.vertices)} {len(mesh.faces)} 0"]
    lines += [" ".join(map(number, p)) for p in mesh.vertices]
    lines += [" ".join(map(str, (len(face), *face))) for face in mesh.faces]
    write_lines(path, lines)


def write_ply(path, mesh, comment):
    lines = ["ply", "format ascii 1.0", f"comment {comment}"]
    lines += [f"element vertex {len(mesh.vertices)}"] + [f"property double {axis}" for axis in "xyz"]
    lines += [f"element face {len(mesh.faces)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(number, p)) for p in mesh.vertices]
    lines += [" ".join(map(str, (len(face), *face))) for face in mesh.faces]
    write_lines(path, lines)


# --- shapes ----------------------------------------------------------------------------------------


def extrude(outline, height, bore=None):
    """A prism about z = 0 of a counter-clockwise outline that its centre sees whole, perhaps with a
    bore whose points lie on the same rays as the outline's."""
    mesh = Mesh()
    bottom = mesh.add([(x, y, -height / 2) for x, y in outline])
    top = mesh.add([(x, y, height / 2) for x, y in outline])
    mesh.band(bottom, top)
    if bore is None:
        middle_bottom, middle_top = mesh.add([(0, 0, -height / 2), (0, 0, height / 2)])
        for i in range(len(outline)):
            j = (i + 1) % len(outline)
            mesh.triangle(middle_top, top[i], top[j])
            mesh.triangle(middle_bottom, bottom[j], bottom[i])
        return mesh
    inner_bottom = mesh.add([(x, y, -height / 2) for x, y in bore])
    inner_top = mesh.add([(x, y, height / 2) for x, y in bore])
    mesh.band(inner_top, inner_bottom)
    mesh.band(top, inner_top)
    mesh.band(inner_bottom, bottom)
    return mesh


def airfoil(points_per_side, camber=0.02, camber_at=0.4, thickness=0.12):
    """NACA four digits, by default 2412, chord 1 along +x, blunt at the trailing edge;
    counter-clockwise, without a point twice."""

    def surface(x, side):
        half = 5 * thickness * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1015 * x**4)
        if x < camber_at:
            mean = camber / camber_at**2 * (2 * camber_at * x - x**2)
            slope = 2 * camber / camber_at**2 * (camber_at - x)
        else:
            mean = camber / (1 - camber_at) ** 2 * (1 - 2 * camber_at + 2 * camber_at * x - x**2)
            slope = 2 * camber / (1 - camber_at) ** 2 * (camber_at - x)
        angle = math.atan(slope)
        return x - side * half * math.sin(angle), mean + side * half * math.cos(angle)

    # Denser at the nose, where the curve is.
    stations = [(1 - math.cos(math.pi * i / points_per_side)) / 2 for i in range(points_per_side + 1)]
    upper = [surface(x, 1) for x in reversed(stations)]
    lower = [surface(x, -1) for x in stations[1:]]
    return upper + lower


def wing():
    """A tapered wing of 46 mm along x, its nose towards -y, within (-23, -5, -1) .. (23, 5, 3)."""
    section = airfoil(28)
    mesh = Mesh()
    rings = []
    for i in range(21):
        x = -23 + 2.3 * i
        taper = abs(x) / 23
        chord = 9.6 - 4.2 * taper
        # The quarter chords lie on one line, and the tips are raised a little.
        rings.append(mesh.add([(x, (u - 0.25) * chord - 2.3, v * chord * 1.6 + 1.2 * taper) for u, v in section]))
    for left, right in zip(rings, rings[1:]):
        mesh.band(left, right)
    for ring, is_left in ((rings[0], True), (rings[-1], False)):
        # Strips from the upper to the lower side, trailing edge first.
        n = len(ring)
        for i in range(n // 2):
            a, b, c, d = ring[i], ring[i + 1], ring[n - 2 - i], ring[n - 1 - i]
            for corners in [(a, b, c), (a, c, d)]:
                if len(set(corners)) == 3:
                    mesh.triangle(*(reversed(corners) if is_left else corners))
    return mesh


def involute(angle):
    """How far an involute has turned at a pressure angle."""
    return math.tan(angle) - angle


def gear(teeth=18, module=1.5, height=8.0, bore_radius=4.0, pressure_angle=math.radians(20)):
    """A spur gear about z with involute flanks; its outer diameter is module * (teeth + 2) = 30 mm."""
    pitch_radius = module * teeth / 2
    base_radius = pitch_radius * math.cos(pressure_angle)
    outer_radius, root_radius = pitch_radius + module, pitch_radius - 1.25 * module
    half_tooth = math.pi / (2 * teeth) + involute(pressure_angle)

    def half_angle(radius):
        """Half of what a tooth takes of the circle."""
        return half_tooth - (involute(math.acos(base_radius / radius)) if radius > base_radius else 0)

    steps = 6
    start = max(base_radius, root_radius)
    flank = [start + (outer_radius - start) * i / steps for i in range(steps + 1)]
    polar = []
    for tooth in range(teeth):
        middle = 2 * math.pi * tooth / teeth
        # Below the base circle the flank is radial.
        first = half_angle(start)
        polar.append((root_radius, middle - first - 0.004))
        polar += [(r, middle - half_angle(r)) for r in flank]
        polar.append((outer_radius, middle))
        polar += [(r, middle + half_angle(r)) for r in reversed(flank)]
        polar.append((root_radius, middle + first + 0.004))
    outline = [(r * math.cos(a), r * math.sin(a)) for r, a in polar]
    bore = [(bore_radius * math.cos(a), bore_radius * math.sin(a)) for _, a in polar]
    return extrude(outline, height, bore)


def arc(center, radius, begin, end, steps):
    """Points from one angle (degrees) to another, both included."""
    angles = [math.radians(begin + (end - begin) * i / steps) for i in range(steps + 1)]
    return [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a)) for a in angles]


def tensile_bar():
    """ASTM D412 die C: 115 x 25 mm, 33 x 6 mm in the narrow part, 3 mm thick."""
    half_length, half_width = 57.5, 12.5
    half_narrow_length, half_narrow_width = 16.5, 3.0
    inner_radius, outer_radius = 25.0, 14.0
    # The narrow part's fillet curves away from the axis, the shoulder curves back; where both meet,
    # they have turned by the same angle, and together they climb to the full width.
    climb = half_width - half_narrow_width
    turned = math.degrees(math.acos(1 - climb / (inner_radius + outer_radius)))
    reach = (inner_radius + outer_radius) * math.sin(math.radians(turned))
    fillet = arc((half_narrow_length, half_narrow_width + inner_radius), inner_radius, -90, -90 + turned, 64)
    shoulder = arc((half_narrow_length + reach, half_width - outer_radius), outer_radius, 90 + turned, 90, 64)
    # From the middle to the end of one quarter.
    quarter = fillet + shoulder[1:] + [(half_length, half_width)]

    mesh = Mesh()
    half_height = 1.5
    stations = [(-x, y) for x, y in reversed(quarter)] + quarter
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    rings = [mesh.add([(x, y * side, half_height * up) for side, up in corners]) for x, y in stations]
    for left, right in zip(rings, rings[1:]):
        mesh.band(left, right)
    for ring, is_left in ((rings[0], True), (rings[-1], False)):
        ring = ring[::-1] if is_left else ring
        mesh.triangle(ring[0], ring[1], ring[2])
        mesh.triangle(ring[0], ring[2], ring[3])
    return mesh


def tetrahedron(half=10.0):
    mesh = Mesh()
    a, b, c, d = mesh.add([(half, half, half), (-half, -half, half), (-half, half, -half), (half, -half, -half)])
    mesh.faces = [(a, c, b), (a, b, d), (a, d, c), (b, c, d)]
    return mesh


CUBE_FACES = {
    "bottom": (0, 2, 3, 1),
    "top": (4, 5, 7, 6),
    "front": (0, 1, 5, 4),
    "back": (2, 6, 7, 3),
    "left": (0, 4, 6, 2),
    "right": (1, 3, 7, 5),
}


def cube_points(half):
    return [(half if i & 1 else -half, half if i & 2 else -half, half if i & 4 else -half) for i in range(8)]


def two_shells(outer=10.0, inner=5.0):
    """A cube with a cavity: the inner shell faces inward."""
    mesh = Mesh()
    outside, inside = mesh.add(cube_points(outer)), mesh.add(cube_points(inner))
    for face in CUBE_FACES.values():
        mesh.faces.append(tuple(outside[i] for i in face))
    for face in CUBE_FACES.values():
        mesh.faces.append(tuple(inside[i] for i in reversed(face)))
    return mesh


def linear_of_srgb(value):
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


# X, Y and Z relative to the white of D50, from linear light of sRGB.
D50_FROM_LIGHT = [[0.4360747 / 0.96422, 0.3850649 / 0.96422, 0.1430804 / 0.96422], [0.2225045, 0.7168786, 0.0606169],
                  [0.0139322 / 0.82521, 0.0971045 / 0.82521, 0.7141733 / 0.82521]]


def lab_of_light(light):
    def curve(t):
        return t ** (1 / 3) if t > (6 / 29) ** 3 else t / (3 * (6 / 29) ** 2) + 4 / 29

    x, y, z = (curve(sum(a * b for a, b in zip(row, light))) for row in D50_FROM_LIGHT)
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def write_made_up_patches(path, steps=4):
    """Patches of cyan, magenta, yellow and white of the usual materials, as if the light of droplets added up."""
    table = json.loads((Path(__file__).parent.parent / "materials/default.json").read_text())["materials"]
    names = ["cyan", "magenta", "yellow", "white"]
    lights = [[linear_of_srgb(next(m for m in table if m["name"] == name)[part] / 255) for part in "rgb"]
              for name in names]
    lines = ["# Made up: the mean light of droplets in the colours of materials/default.json. Measure your own.",
             "patch," + ",".join(names) + ",L,a,b"]
    for shares in mixtures(len(names), steps):
        light = [sum(share * own[part] for share, own in zip(shares, lights)) for part in range(3)]
        numbers = [number(share) for share in shares] + [f"{value:.3f}" for value in lab_of_light(light)]
        lines.append(f"{len(lines) - 1}," + ",".join(numbers))
    write_lines(path, lines)


def mixtures(materials, steps):
    """All shares in steps of 1/steps; the last material takes what the others leave."""
    for counts in itertools.product(range(steps + 1), repeat=materials - 1):
        if sum(counts) <= steps:
            yield [count / steps for count in (*counts, steps - sum(counts))]


def write_target(path, steps=4):
    """The shares of the patches of ink_target.vcad, with places for what is measured."""
    lines = ["# Write L*, a* and b* under D50 behind the last comma of each line, separated by commas.",
             "patch,cyan,magenta,yellow,black,white,L,a,b"]
    for n, shares in enumerate(mixtures(5, steps), 1):
        lines.append(",".join([str(n), *map(number, shares), ""]))
    write_lines(path, lines)


def write_painted_ball(path, radius=15.0, rings=24, spokes=48):
    """A ball whose vertices have the hue of their longitude, white at the upper pole and gray at the lower one."""
    mesh, colours = Mesh(), []
    poles = mesh.add([(0, 0, -radius), (0, 0, radius)])
    colours += [(150, 150, 150), (255, 255, 255)]
    circles = []
    for ring in range(1, rings):
        polar = math.pi * ring / rings
        circles.append(mesh.add([(radius * math.sin(polar) * math.cos(2 * math.pi * n / spokes),
                                  radius * math.sin(polar) * math.sin(2 * math.pi * n / spokes),
                                  -radius * math.cos(polar)) for n in range(spokes)]))
        height = ring / rings
        for n in range(spokes):
            hue = colorsys.hsv_to_rgb(n / spokes, min(0.75, 4 * height, 1.5 - 1.5 * height), min(1.0, 0.6 + 0.8 * height))
            colours.append(tuple(round(255 * part) for part in hue))
    for n in range(spokes):
        after = (n + 1) % spokes
        mesh.triangle(poles[0], circles[0][after], circles[0][n])
        mesh.triangle(poles[1], circles[-1][n], circles[-1][after])
        for low, high in zip(circles, circles[1:]):
            mesh.triangle(low[n], low[after], high[after])
            mesh.triangle(low[n], high[after], high[n])
    lines = ["ply", "format ascii 1.0", "comment a ball with colours at its vertices"]
    lines += [f"element vertex {len(mesh.vertices)}"] + [f"property double {axis}" for axis in "xyz"]
    lines += [f"property uchar {part}" for part in ("red", "green", "blue")]
    lines += [f"element face {len(mesh.faces)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join([f"{value:.3f}" for value in p] + [str(part) for part in colour])
              for p, colour in zip(mesh.vertices, colours)]
    lines += [" ".join(map(str, (len(face), *face))) for face in mesh.faces]
    write_lines(path, lines)


def write_textured_cube(path, half=10.0):
    """Each face is a group with a sixth of the picture, three across and two up."""
    lines = ["# a cube with a group and a part of a picture for each face", "o cube"]
    lines += ["v " + " ".join(map(number, p)) for p in cube_points(half)]
    for i in range(len(CUBE_FACES)):
        u, v = i % 3 / 3, i // 3 / 2
        for s, t in [(u, v), (u + 1 / 3, v), (u + 1 / 3, v + 1 / 2), (u, v + 1 / 2)]:
            lines.append(f"vt {number(s)} {number(t)}")
    for i, (name, face) in enumerate(CUBE_FACES.items()):
        lines += [f"g {name}", "usemtl " + ("soft" if name in ("top", "bottom") else "hard")]
        lines.append("f " + " ".join(f"{corner + 1}/{4 * i + n + 1}" for n, corner in enumerate(face)))
    write_lines(path, lines)


def sheet(columns, rows, at):
    """An open surface over columns x rows rectangles, seen from outside where x runs right and y up."""
    mesh = Mesh()
    numbers = [mesh.add([at(i / columns, j / rows) for i in range(columns + 1)]) for j in range(rows + 1)]
    for low, high in zip(numbers, numbers[1:]):
        for i in range(columns):
            mesh.triangle(low[i], low[i + 1], high[i + 1])
            mesh.triangle(low[i], high[i + 1], high[i])
    return mesh


def insole():
    """The top of a small insole, heel at x = 0: a cup around the heel and an arch on one side."""

    def at(along, across):
        x, t = 120 * along, 2 * across - 1
        width = 15 + 7 * math.sin(math.pi * min(1, along / 0.75 * 0.5)) ** 2
        ends = min(1, math.sqrt(0.25 + 9 * along), math.sqrt(0.25 + 7 * (1 - along)))
        y = width * ends * t
        cup = 5 * t**2 * max(0, 1 - along / 0.4) ** 2
        arch = 7 * max(0, t) ** 2 * math.exp(-(((along - 0.42) / 0.16) ** 2))
        return (x, y, cup + arch + 2 * along**3)

    return sheet(48, 16, at)


def cap(radii, steep, rings=14, spokes=40, dent=0):
    """The upper part of an ellipsoid, down to an angle from the top, in degrees; perhaps with a dent at the sides."""
    mesh = Mesh()

    def ring(angle):
        points = []
        for k in range(spokes):
            turn = 2 * math.pi * k / spokes
            side = 1 - dent * math.sin(turn) ** 2 * math.sin(angle) ** 2
            flat = math.sin(angle) * side
            points.append((radii[0] * flat * math.cos(turn), radii[1] * flat * math.sin(turn), radii[2] * math.cos(angle)))
        return mesh.add(points)

    rows = [ring(math.radians(steep) * n / rings) for n in range(rings, 0, -1)]
    for lower, upper in zip(rows, rows[1:]):
        mesh.band(lower, upper)
    (top,) = mesh.add([(0, 0, radii[2])])
    for k in range(spokes):
        mesh.triangle(rows[-1][k], rows[-1][(k + 1) % spokes], top)
    return mesh


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else DEFAULT_FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    write_binary_stl(folder / "wing.stl", wing(), "a tapered wing, NACA 2412, thickened")
    write_binary_stl(folder / "gear.stl", gear(), "a spur gear of 18 teeth, module 1.5")
    write_binary_stl(folder / "tensile_bar.stl", tensile_bar(), "a tensile bar, ASTM D412 die C")
    write_off(folder / "tetrahedron.off", tetrahedron())
    write_off(folder / "insole.off", insole())
    write_off(folder / "head.off", cap((38, 30, 34), 75, dent=0.06))
    write_textured_cube(folder / "textured_cube.obj")
    write_painted_ball(folder / "painted_ball.ply")
    write_made_up_patches(folder / "made_up_patches.csv")
    write_target(folder / "ink_target.csv")
    write_ply(folder / "two_shells.ply", two_shells(), "a cube with a cavity")


if __name__ == "__main__":
    main()

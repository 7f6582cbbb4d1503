"""The share that cells of every kind fill, at five sizes, against integrals of their definitions."""
import itertools
import math

import numpy
import pytest

import ombre
from test_lattices import surface

def points_of_cell(*counts):
    """Middles of boxes that fill a cell of 1 mm, off its planes of symmetry."""
    steps = numpy.stack(numpy.meshgrid(*map(numpy.arange, counts), indexing="ij"), axis=-1).reshape(-1, 3)
    return (steps + (0.31, 0.43, 0.57)) / counts


POINTS = points_of_cell(40, 40, 40)
CELL = ombre.box_cells(size=(1, 1, 1))
WITHIN = 1e-3


def share(solid, points=POINTS):
    return float(numpy.mean(solid.inside(points)))


# Surfaces

def value_and_slope(name, p):
    """The function of a surface, and the length of its gradient by central differences."""
    step = 1e-5 * numpy.eye(3)
    by = [(surface(name, *(p + h).T) - surface(name, *(p - h).T)) / 2e-5 for h in step]
    return surface(name, *p.T), numpy.sqrt(sum(b * b for b in by))


SURFACES = ["gyroid", "schwarz_p", "schwarz_d", "neovius", "lidinoid", "iwp", "split_p"]


@pytest.mark.parametrize("name", SURFACES)
def test_walls_of_surfaces_fill_what_lies_near_them(name):
    value, slope = value_and_slope(name, POINTS)
    for thickness in (0.02, 0.05, 0.1, 0.15, 0.2):
        wanted = numpy.mean(numpy.abs(value) <= thickness / 2 * slope)
        assert share(ombre.tpms(name, map=CELL, thickness=thickness)) == pytest.approx(wanted, abs=WITHIN)


@pytest.mark.parametrize("name", SURFACES)
def test_densities_of_surfaces_are_those_that_are_wanted(name):
    points = points_of_cell(71, 79, 87)  # without a common divisor
    for density in (0.05, 0.1, 0.2, 0.3, 0.4):
        sheet = ombre.tpms(name, cell=(1, 1, 1), density=density)
        assert share(sheet, points) == pytest.approx(density, abs=WITHIN)
    for density in (0.1, 0.25, 0.4, 0.55, 0.7):
        solid = ombre.tpms(name, kind="solid", cell=(1, 1, 1), density=density)
        assert share(solid, points) == pytest.approx(density, abs=WITHIN)


# Struts

CORNERS = list(itertools.product((0, 1), repeat=3))


def pairs(points, length):
    """The pairs of points at this distance."""
    return [(a, b) for a, b in itertools.combinations(points, 2) if abs(math.dist(a, b) - length) < 1e-9]


def around(points):
    """The points in the cells around the cell, too."""
    return sorted({tuple(c + s for c, s in zip(p, shift)) for p in points for shift in itertools.product((-1, 0, 1), repeat=3)})


FACES = [(0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5)]
CENTRE = (0.5, 0.5, 0.5)
CUBIC, BCC = around([(0, 0, 0)]), around([(0, 0, 0), CENTRE])
FCC, FACE_CENTRES = around([(0, 0, 0), *FACES]), around(FACES)
UPRIGHT = [(a, b) for a, b in pairs(CUBIC, 1) if a[2] != b[2]]
# Corners of truncated octahedra around the points of a body-centred lattice: permutations of (0, 1/4, 1/2).
TRUNCATED = around({tuple(s * c for s, c in zip(signs, order)) for order in itertools.permutations((0, 0.25, 0.5))
                    for signs in itertools.product((-1, 1), repeat=3)})
# Corners of rhombic dodecahedra around the middles of the edges and the centre of a cell.
EIGHTHS = around(itertools.product((0.25, 0.75), repeat=3))
DIAMOND = around([tuple(a + s for a, s in zip(p, shift)) for p in [(0, 0, 0), *FACES] for shift in ((0, 0, 0), (0.25, 0.25, 0.25))])
DIAGONAL, HALF = math.sqrt(0.5), math.sqrt(3) / 2
STRUTS = {
    "cubic": pairs(CUBIC, 1), "bcc": pairs(BCC, HALF), "bccz": pairs(BCC, HALF) + UPRIGHT,
    "fcc": [(a, b) for a, b in pairs(FCC, DIAGONAL) if a not in FACE_CENTRES or b not in FACE_CENTRES],
    "octahedral": pairs(FACE_CENTRES, DIAGONAL), "octet": pairs(FCC, DIAGONAL), "kelvin": pairs(TRUNCATED, DIAGONAL / 2),
    "diamond": pairs(DIAMOND, HALF / 2), "rhombic_dodecahedron": [(a, b) for a, b in pairs(FCC + EIGHTHS, HALF / 2) if a in FCC or b in FCC],
}
STRUTS["fccz"] = STRUTS["fcc"] + UPRIGHT
STRUTS["f2bcc"] = STRUTS["fcc"] + STRUTS["bcc"]


def distance_to_struts(struts, points):
    nearest = numpy.full(len(points), numpy.inf)
    for a, b in struts:
        a, b = numpy.array(a, float), numpy.array(b, float)
        if (numpy.minimum(a, b) > 1.3).any() or (numpy.maximum(a, b) < -0.3).any():
            continue
        along = numpy.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        away = points - a - along[:, None] * (b - a)
        numpy.minimum(nearest, numpy.einsum("ij,ij->i", away, away), out=nearest)
    return numpy.sqrt(nearest)


@pytest.mark.parametrize("name", sorted(STRUTS))
def test_struts_fill_what_lies_near_their_axes(name):
    distance = distance_to_struts(STRUTS[name], POINTS)
    for radius in (0.03, 0.06, 0.09, 0.12, 0.15):
        found = share(ombre.lattice(name, map=CELL, radius=radius))
        assert found == pytest.approx(float(numpy.mean(distance <= radius)), abs=WITHIN), radius


# Plates and honeycombs

def test_plates_fill_what_lies_near_their_planes():
    x, y, z = POINTS.T
    planes = {"cubic": [x, y, z], "octet": [x + y + z, x + y - z, x - y + z, y + z - x]}
    planes["cubic_octet"] = planes["cubic"] + planes["octet"]
    for kind, levels in planes.items():
        off = numpy.min([numpy.abs(f - numpy.round(f)) / (1 if n < 3 and kind != "octet" else math.sqrt(3))
                         for n, f in enumerate(levels)], axis=0)
        for thickness in (0.03, 0.06, 0.1, 0.15, 0.2):
            solid = ombre.plates(CELL, kind, thickness)
            assert share(solid) == pytest.approx(float(numpy.mean(off <= thickness / 2)), abs=WITHIN), kind


def test_regular_hexagons_leave_hexagons_free():
    """A hexagon whose opposite sides are 1 apart, with walls of t, leaves (1 - t)^2 of itself free."""
    cells = ombre.box_cells(size=(1, math.sqrt(3), 1))
    for thickness in (0.05, 0.1, 0.2, 0.3, 0.4):
        points = numpy.stack(numpy.meshgrid(numpy.arange(300), numpy.arange(300)), axis=-1).reshape(-1, 2) + (0.31, 0.43)
        flat = numpy.column_stack([points / 300 * (1, math.sqrt(3)), numpy.full(len(points), 0.5)])
        found = float(numpy.mean(ombre.honeycomb(cells, thickness).inside(flat)))
        assert found == pytest.approx(1 - (1 - thickness) ** 2, abs=WITHIN)

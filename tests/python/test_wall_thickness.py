"""Walls of every minimal surface on maps of every kind, measured by rays along their normals."""
import numpy
import pytest

import ombre

# Maps, and a thirtieth of their smallest cell, mm.
MAPS = {
    "box": (lambda: ombre.box_cells(size=(6, 6, 6), min=(0, 0, 0), max=(18, 18, 18)), 0.2),
    "pipe": (lambda: ombre.cylinder_cells(16, 22, 24, count=(20, 4, 1)), 0.165),
    "cone": (lambda: ombre.frustum_cells(16, 22, 12, 18, 24, count=(18, 4, 1)), 0.135),
    "ball": (lambda: ombre.ball_cells(16, 22, -50, 50, count=(20, 5, 1)), 0.1),
    "curve": (lambda: ombre.curve_cells([(0, 0, 0), (30, 0, 0), (40, 30, 10)], 6, 6, count=(10, 1, 1)), 0.18),
    "formula": (lambda: ombre.formula_cells(v="v + 0.03*v^2", of=ombre.cylinder_cells(16, 22, 24, count=(20, 4, 1))), 0.155),
    "between": (lambda: ombre.between_cells(ombre.sphere(16), ombre.sphere(22), ombre.ball_cells(15, 23, -50, 50, count=(20, 5, 1))), 0.1),
}
# Greatest shares by which walls may differ from their thickness, as docs/user/cells.md states them.
WITHIN = {"lidinoid": 0.04}


def normals(solid, points):
    step = 1e-4 * numpy.eye(3)
    return numpy.stack([(solid.distance(points + h) - solid.distance(points - h)) / 2e-4 for h in step], axis=-1)


def points_on(surface, region, margin):
    """Random points of a surface in a region, and its normals there, by Newton's method."""
    low, high = (numpy.array(corner) for corner in region.bounds)
    points = numpy.random.default_rng(1).uniform(low, high, (4000, 3))
    points = points[region.distance(points) < -margin][:320]
    for _ in range(10):
        slope = normals(surface, points)
        points = points - (surface.distance(points) / numpy.maximum((slope * slope).sum(-1), 1e-9))[:, None] * slope
    points = points[(numpy.abs(surface.distance(points)) < 1e-6) & (region.distance(points) < -margin)][:100]
    slope = normals(surface, points)
    return points, slope / numpy.linalg.norm(slope, axis=-1)[:, None]


def ways_out(wall, points, directions, most):
    inside, outside = numpy.zeros(len(points)), numpy.full(len(points), most)
    for _ in range(25):
        middle = (inside + outside) / 2
        is_in = wall.inside(points + middle[:, None] * directions)
        inside, outside = numpy.where(is_in, middle, inside), numpy.where(is_in, outside, middle)
    return inside


@pytest.mark.parametrize("name", MAPS)
def test_walls_have_their_thickness_along_rays(name):
    make, thickness = MAPS[name]
    cells = make()
    region = cells.region.design()
    for surface in ("gyroid", "schwarz_p", "schwarz_d", "neovius", "lidinoid", "iwp", "split_p"):
        side = ombre.tpms(surface, map=cells, kind="solid").design()
        wall = ombre.tpms(surface, map=cells, thickness=thickness).design()
        points, normal = points_on(side, region, 2 * thickness)
        assert len(points) > 40
        found = ways_out(wall, points, normal, 2 * thickness) + ways_out(wall, points, -normal, 2 * thickness)
        assert found == pytest.approx(thickness, rel=WITHIN.get(surface, 0.02)), surface

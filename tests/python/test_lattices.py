"""Lattices, tiles and smooth booleans: pyvcad's interface and ombre's."""
import math
import pathlib

import numpy
import pytest

import ombre
import pyvcad as pv

here = pathlib.Path(__file__).resolve().parent
origin = pv.Vec3(0, 0, 0)


def bcc_distance(p, size, radius):
    """To the nearest half diagonal of a body-centred lattice, by its definition."""
    x, y, z = (abs(v - size * numpy.round(v / size)) for v in p)
    along = numpy.clip((x + y + z) / 3, 0, size / 2)
    return numpy.sqrt((x - along) ** 2 + (y - along) ** 2 + (z - along) ** 2) - radius


def test_listing_4():
    design = ombre.load(here / "listings" / "listing4.py")
    assert design.bounds == ((-10, -10, -10), (10, 10, 10))
    p = numpy.random.default_rng(1).uniform(-10, 10, (3000, 3))
    expected = numpy.maximum(bcc_distance(p.T, 5, 0.35), numpy.linalg.norm(p, axis=1) - 10)
    assert numpy.allclose(design.distance(p), expected, atol=1e-9)
    assert numpy.array_equal(design.inside(p), expected <= 0)
    assert set(design.volumes(0.2)) == {"gray"}


@pytest.mark.parametrize("kind, length", [
    (pv.LatticeType.BodyCenteredCubic, 4 * math.sqrt(3)), (pv.LatticeType.FaceCenteredCubic, 6 * math.sqrt(2)),
    (pv.LatticeType.Cubic, 3), (pv.LatticeType.KelvinCell, 6 * math.sqrt(2))])
def test_types_of_cells(kind, length):
    r = 0.2
    part = pv.Intersection(False, [pv.Tile(pv.GraphLattice(kind, pv.Vec3(10, 10, 10), r, 1)),
                                   pv.RectPrism(origin, pv.Vec3(10, 10, 10))])
    points = numpy.random.default_rng(2).uniform(-5, 5, (400000, 3))
    share = ombre.union([part]).inside(points).mean()
    expected = math.pi * r * r * length * 10 / 1000
    error = 4 * math.sqrt(expected / len(points))
    assert expected * 0.93 - error < share < expected + error  # joints share a little


def test_tile_of_any_child():
    balls = pv.Tile(3, 0, 0, pv.Sphere(origin, 1))
    assert balls.evaluate(7, 0, 0) == pytest.approx(0)  # the copy at 6
    assert balls.evaluate(0, 5, 0) == pytest.approx(4)
    box = pv.Tile(pv.RectPrism(origin, pv.Vec3(2, 3, 4)))  # its own size: space is full
    assert box.evaluate(17.3, -4.1, 9.9) <= 0


def smooth(k, *distances):
    total = sum(max(k - d, 0) ** 2 for d in distances)
    return max(k, min(distances)) - math.sqrt(total)


def test_smooth_booleans():
    a, b = pv.Sphere(origin, 3), pv.Sphere(pv.Vec3(4, 0, 0), 2)
    k = 1.5
    for p in ((2.4, 2, 0), (2.5, 1.6, 1), (0, 0, 0), (-5, 0, 0), (3, 0.5, 0.5), (2.6, 0.1, 2.1)):
        da, db = a.evaluate(*p), b.evaluate(*p)
        union = smooth(k, da, db)
        assert pv.Union(k, False, [a, b]).evaluate(*p) == pytest.approx(union)
        assert pv.BBoxUnion(k, [a, b]).evaluate(*p) == pytest.approx(union)
        assert pv.Intersection(k, True, [a, b]).evaluate(*p) == pytest.approx(-smooth(k, -da, -db))
        assert pv.Difference(k, a, b).evaluate(*p) == pytest.approx(-smooth(k, -da, db))


def test_ombre_takes_arrays_of_edges():
    points = numpy.array([[0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]], float)
    edges = [(points[i], points[j]) for i in range(4) for j in range(i)]
    graph = ombre.lattice(edges=edges, radius=0.5, material="red")
    assert graph.inside([5, 5, 0]) and not graph.inside([3, 3, 3])
    graded = graph.fgrade([ombre.t, 1 - ombre.t], ["red", "blue"])
    assert graded.material([[2.5, 0, 0]])["red"][0] == pytest.approx(0.75)  # that edge begins at (10, 0, 0)


def test_cells_know_their_indices():
    cell = ombre.sphere(2).fgrade([ombre.ci / 4, 1 - ombre.ci / 4], ["red", "blue"])
    row = cell.tile((5, 0, 0), first=(0, 0, 0), last=(4, 0, 0))
    assert row.bounds == ((-2, -2, -2), (22, 2, 2))
    found = row.material([[5 * i, 0, 0] for i in range(5)])["red"]
    assert numpy.allclose(found, [0, 0.25, 0.5, 0.75, 1])
    with pytest.raises(ombre.DesignError, match="nothing repeats it"):
        cell.distance([0, 0, 0])

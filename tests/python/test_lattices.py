"""Lattices, tiles and smooth booleans: pyvcad's interface and ombre's."""
import itertools
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
    design = ombre.load(here.parent / "pyvcad" / "listings" / "listing4.py")
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


def test_struts_are_lists_of_edges():
    """An octet truss has 36 struts in a cell: 24 halves of diagonals of faces, and 12 between centres of faces."""
    cells = ombre.box_cells(size=(4, 4, 4), min=(0, 0, 0), max=(8, 8, 8))
    octet = numpy.array(ombre.lattice("octet", map=cells, radius=0.3).struts)
    assert octet.shape == (36, 2, 3) and octet.min() == 0 and octet.max() == 1
    assert numpy.allclose(numpy.linalg.norm(octet[:, 1] - octet[:, 0], axis=1), math.sqrt(0.5))
    level = [strut for strut in octet if strut[0][2] == strut[1][2]]
    layers = ombre.lattice(edges=level, map=cells, radius=0.3)
    assert list(layers.inside([(1, 1, 0.05), (0.05, 1, 1)])) == [True, False]
    corners = [(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6), (1, 1, 1)]  # of a tetrahedron, and a point in it
    edges = ombre.delaunay_struts(corners, 0.5).struts
    assert sorted(map(sorted, edges)) == sorted(sorted([list(a), list(b)]) for a, b in itertools.combinations(corners, 2))
    moved = ombre.lattice("bcc").translate(1, 0, 0)  # its struts are in another frame
    with pytest.raises(AttributeError):
        moved.struts


def test_cells_know_their_indices():
    cell = ombre.sphere(2).fgrade([ombre.ci / 4, 1 - ombre.ci / 4], ["red", "blue"])
    row = cell.tile((5, 0, 0), first=(0, 0, 0), last=(4, 0, 0))
    assert row.bounds == ((-2, -2, -2), (22, 2, 2))
    found = row.material([[5 * i, 0, 0] for i in range(5)])["red"]
    assert numpy.allclose(found, [0, 0.25, 0.5, 0.75, 1])
    with pytest.raises(ombre.DesignError, match="nothing repeats it"):
        cell.distance([0, 0, 0])


def surface(name, x, y, z):
    """The usual formulas of minimal surfaces, for a period of one."""
    sin, cos = numpy.sin, numpy.cos
    x, y, z = 2 * math.pi * x, 2 * math.pi * y, 2 * math.pi * z
    return {
        "gyroid": lambda: sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x),
        "schwarz_p": lambda: cos(x) + cos(y) + cos(z),
        "schwarz_d": lambda: (sin(x) * sin(y) * sin(z) + sin(x) * cos(y) * cos(z) + cos(x) * sin(y) * cos(z)
                              + cos(x) * cos(y) * sin(z)),
        "neovius": lambda: 3 * (cos(x) + cos(y) + cos(z)) + 4 * cos(x) * cos(y) * cos(z),
        "iwp": lambda: (2 * (cos(x) * cos(y) + cos(y) * cos(z) + cos(z) * cos(x))
                        - (cos(2 * x) + cos(2 * y) + cos(2 * z))),
        "lidinoid": lambda: (0.5 * (sin(2 * x) * cos(y) * sin(z) + sin(2 * y) * cos(z) * sin(x)
                                    + sin(2 * z) * cos(x) * sin(y))
                             - 0.5 * (cos(2 * x) * cos(2 * y) + cos(2 * y) * cos(2 * z) + cos(2 * z) * cos(2 * x)) + 0.15),
        "split_p": lambda: (1.1 * (sin(2 * x) * sin(z) * cos(y) + sin(2 * y) * sin(x) * cos(z)
                                   + sin(2 * z) * sin(y) * cos(x))
                            - 0.2 * (cos(2 * x) * cos(2 * y) + cos(2 * y) * cos(2 * z) + cos(2 * z) * cos(2 * x))
                            - 0.4 * (cos(2 * x) + cos(2 * y) + cos(2 * z))),
    }[name]()


@pytest.mark.parametrize("name", ["gyroid", "schwarz_p", "schwarz_d", "neovius", "iwp", "lidinoid", "split_p"])
def test_minimal_surfaces_are_their_formulas(name):
    p = numpy.random.default_rng(3).uniform(0, 1, (200000, 3))
    f = surface(name, *p.T)
    for level in (0, 0.3):
        solid = ombre.tpms(name, "solid", cell=(10, 10, 10), level=level).inside(10 * p)
        clear = abs(f - level) > 1e-9
        assert numpy.array_equal(solid[clear], (f <= level)[clear])
    # A sheet's share is the mean of |f| <= t/2 |grad f|, with gradients from differences.
    step = 1e-5
    squares = sum((surface(name, *(p + by).T) - surface(name, *(p - by).T)) ** 2 for by in step * numpy.eye(3))
    share = numpy.mean(abs(f) <= 0.5 * 0.06 * numpy.sqrt(squares) / (2 * step))
    sheet = ombre.tpms(name, cell=(10, 10, 10), thickness=0.6).inside(10 * p).mean()
    assert sheet == pytest.approx(share, abs=1e-4)


def test_what_was_laid_around_a_cylinder_is_unrolled_by_formulas():
    flat = ombre.rectprism((40, 8, 3)) - ombre.sphere(2).translate(5, 1, 1)
    unrolled = flat.remap(radius=10).warp("(10 + z)*cos(x/10)", "(10 + z)*sin(x/10)", "y",
                                          min=(-31, -9, -9), max=(31, 9, 9))
    p = numpy.random.default_rng(4).uniform((-25, -6, -3), (25, 6, 3), (20000, 3))
    clear = abs(flat.distance(p)) > 1e-6
    assert numpy.array_equal(unrolled.inside(p)[clear], flat.inside(p)[clear])
    assert flat.inside(p).sum() > 1000

"""Solids from points: polygons, texts, hulls, tubes, and edges between points."""
import itertools
import math
import warnings

import numpy
import pytest

import ombre
import pyvcad as pv


def test_polygons_take_arrays():
    angles = numpy.linspace(0, 2 * math.pi, 6, endpoint=False)
    hexagon = 5 * numpy.stack([numpy.cos(angles), numpy.sin(angles)], axis=1)
    prism = ombre.polygon_extrude(hexagon, 4, material="red")
    assert prism.metric == "exact"
    assert prism.volume(voxel=0.1) == pytest.approx(4 * 1.5 * math.sqrt(3) * 25, rel=3e-3)
    assert prism.distance([[0, 0, 2], [9, 0, 2], [0, 0, -3]]).tolist() == pytest.approx([-2, 4, 3])
    assert prism.parameters["vertices"][1] == pytest.approx(hexagon[1].tolist())
    again = ombre.Design.from_json(prism.to_json())
    assert again.hash == prism.hash


def test_a_hole_may_be_one_list_or_several():
    square = [[0, 0], [10, 0], [10, 10], [0, 10]]
    hole = [[1, 1], [4, 1], [4, 4]]
    one = ombre.polygon_extrude(square, 2, holes=hole)
    assert one == ombre.polygon_extrude(square, 2, holes=[hole])
    assert ombre.polygon_extrude(square, 2, holes=[hole, [[6, 6], [9, 6], [9, 9]]]).inside([8.5, 7, 1]) == False  # noqa: E712


def test_wrong_polygons_raise():
    with pytest.raises(ombre.DesignError, match="polygon_extrude needs at least 3 points, found 2"):
        ombre.polygon_extrude([[0, 0], [0, 0], [1, 1], [1, 1]], 2)
    with pytest.raises(ombre.DesignError, match="beyond the axis"):
        ombre.revolve([[-1, 0], [2, 0], [1, 4]])
    with pytest.warns(ombre.DesignWarning, match="crosses itself"):
        ombre.polygon_extrude([[0, 0], [10, 10], [10, 0], [0, 10]], 2)


def test_revolved_profiles_turn_right_handed():
    ring = ombre.revolve([[4, 0], [8, 0], [8, 3], [4, 3]], 90)
    assert ring.metric == "exact"
    assert ring.inside([[6, 1, 1], [1, 6, 1], [6, -1, 1]]).tolist() == [True, True, False]
    (lo, hi) = ring.bounds
    assert lo == pytest.approx((0, 0, 0), abs=1e-9) and hi == pytest.approx((8, 8, 3))


def test_hulls_hold_their_points():
    random = numpy.random.default_rng(3)
    points = random.normal(size=(200, 3)) * 5
    hull = ombre.hull(points)
    assert hull.metric == "bounded"
    assert (hull.distance(points) <= 1e-9).all()
    far = random.normal(size=(500, 3)) * 8
    scipy_spatial = pytest.importorskip("scipy.spatial")
    expected = scipy_spatial.Delaunay(points).find_simplex(far) >= 0
    assert (hull.inside(far) == expected).all()
    assert hull.volume(voxel=0.2) == pytest.approx(scipy_spatial.ConvexHull(points).volume, rel=5e-3)


def test_tubes_go_along_their_points():
    angles = numpy.linspace(0, 4 * math.pi, 60)
    spiral = numpy.stack([6 * numpy.cos(angles), 6 * numpy.sin(angles), angles], axis=1)
    tube = ombre.tube(spiral, 0.8, curve="smooth")
    assert tube.distance(spiral) == pytest.approx([-0.8] * 60, abs=2e-3)
    way = math.hypot(6, 1) * 4 * math.pi
    assert tube.volume(voxel=0.1) == pytest.approx(way * math.pi * 0.64 + 4 / 3 * math.pi * 0.512, rel=5e-3)


def test_delaunay_edges_are_those_of_the_definition():
    points = numpy.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [1, 1, 1]], dtype=float)
    edges = ombre.delaunay_edges(points)
    assert edges.shape == (10, 2, 3)  # all pairs: each two points are in a tetrahedron with the middle one
    pairs = {frozenset((tuple(a), tuple(b))) for a, b in edges}
    assert pairs == {frozenset((tuple(a), tuple(b))) for a, b in itertools.combinations(points, 2)}


def test_voronoi_edges_are_equally_far():
    points = numpy.random.default_rng(5).uniform(-5, 5, size=(50, 3))
    edges = ombre.voronoi_edges(points, (-5, -5, -5), (5, 5, 5))
    assert edges.min() >= -5 - 1e-9 and edges.max() <= 5 + 1e-9
    middles = edges.mean(axis=1)
    far = numpy.sort(numpy.linalg.norm(points[None] - middles[:, None], axis=2), axis=1)
    assert numpy.allclose(far[:, 0], far[:, 2], atol=1e-7)
    finite = ombre.voronoi_edges(points)
    vertices = pytest.importorskip("scipy.spatial").Voronoi(points)
    ridges = {frozenset(pair) for ridge in vertices.ridge_vertices
              for pair in zip(ridge, ridge[1:] + ridge[:1]) if -1 not in pair}
    assert len(finite) == len(ridges)


@pytest.mark.parametrize("points, text", [
    ([[0, 0, 0]] * 4, "at least 5 points"),
    ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [2, 2, 0]], "in one plane"),
    ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]], "points 2 and 5 are the same"),
    ([[0, 0], [1, 0], [0, 1]], "shape"),
    ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, float("nan")], [1, 1, 0]], "not finite"),
])
def test_points_that_say_nothing(points, text):
    with pytest.raises(ValueError, match=text):
        ombre.delaunay_edges(points)


def test_boxes_of_voronoi_edges():
    points = numpy.random.default_rng(5).uniform(-5, 5, size=(9, 3))
    with pytest.raises(TypeError, match="both min and max"):
        ombre.voronoi_edges(points, min=(0, 0, 0))
    with pytest.raises(ValueError, match="nowhere above"):
        ombre.voronoi_edges(points, (1, 0, 0), (0, 1, 1))


def test_texts_have_their_capitals_height():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        text = ombre.text("H", 7, 2)
    (lo, hi) = text.bounds
    assert hi[1] - lo[1] == pytest.approx(7) and hi[2] - lo[2] == pytest.approx(2)
    assert text.metric == "exact"
    with pytest.warns(ombre.DesignWarning, match="takes its place"):
        other = ombre.text("H", 7, 2, font="No Such Font")
    assert other.design().hash == text.design().hash  # of the font's content, not of its name


class TestPyvcad:
    def test_text(self):
        text = pv.Text("I", 20.48, 3, 2)
        (lo, hi) = text.bounding_box()
        assert lo.z == pytest.approx(-1.5) and hi.z == pytest.approx(1.5)
        assert hi.y - lo.y == pytest.approx(20.48)
        assert lo.y == pytest.approx(-hi.y)
        assert text.distribution(0, 0, 0) == {2: 1.0}

    def test_text_is_aligned(self):
        lines = pv.Text("Hg\nI", 20, 3)
        (lo, hi) = lines.bounding_box()  # of all lines together
        assert (lo.y, hi.y) == (pytest.approx(-10), pytest.approx(10))
        left = pv.Text("HI\nH", 10, 2, h_align=pv.HorizontalAlignment.Left, v_align=pv.VerticalAlignment.Bottom)
        right = pv.Text("HI\nH", 10, 2, 1, pv.FontAspect.Bold, "DejaVu Sans", pv.HorizontalAlignment.Right,
                        pv.VerticalAlignment.Top)
        (left_lo, _), (_, right_hi) = left.bounding_box(), right.bounding_box()
        assert left_lo.x >= 0 and left_lo.y == pytest.approx(0)
        assert right_hi.x <= 0 and right_hi.y == pytest.approx(0)

    def test_wrong_texts(self):
        with pytest.raises(ValueError, match="letters"):
            pv.Text(" ", 10, 2)
        with pytest.raises(TypeError, match="FontAspect"):
            pv.Text("A", 10, 2, 1, "bold")

    def test_polygon_extrude(self):
        corners = [pv.Vec3(0, 0, 1), pv.Vec3(6, 0, 1), pv.Vec3(6, 4, 1), pv.Vec3(0, 4, 1)]
        block = pv.PolygonExtrude(corners, 3)
        assert block.evaluate(3, 2, 2.5) == pytest.approx(-1.5)
        assert block.evaluate(3, 2, 5) == pytest.approx(1)
        # Clockwise from above: it goes down. Symmetric: to both sides.
        assert pv.PolygonExtrude(corners[::-1], 3, material=2).evaluate(3, 2, 0) == pytest.approx(-1)
        (lo, hi) = pv.PolygonExtrude(corners, 3, True, 2).bounding_box()
        assert (lo.z, hi.z) == pytest.approx((-0.5, 2.5))

    def test_wrong_polygons(self):
        with pytest.raises(ValueError, match="at least 3 points"):
            pv.PolygonExtrude([pv.Vec3(0, 0, 0)], 3)
        bent = [pv.Vec3(0, 0, 0), pv.Vec3(6, 0, 0), pv.Vec3(6, 4, 1), pv.Vec3(0, 4, 0)]
        with pytest.raises(ombre.DesignError, match="off the plane"):
            pv.PolygonExtrude(bent, 3).evaluate(0, 0, 0)

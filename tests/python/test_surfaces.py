"""Offsets, shells, arrays, warps and patterns along surfaces, in ombre and in pyvcad."""
import math

import numpy
import pytest

import ombre
import pyvcad as pv

origin = pv.Vec3(0, 0, 0)


def test_steiner_volume_of_a_grown_box():
    a, b, c, d = 4, 5, 3, 1
    grown = ombre.rectprism((a, b, c), "red").offset(d)
    volume = a * b * c + 2 * (a * b + b * c + c * a) * d + math.pi * (a + b + c) * d**2 + 4 / 3 * math.pi * d**3
    assert grown.volume(0.1) == pytest.approx(volume, rel=2e-3)


def test_offset_takes_an_expression():
    ball = ombre.offset(ombre.sphere(5, "red"), 1 + ombre.x / 10)
    assert list(ball.inside([[6.6, 0, 0], [6.7, 0, 0], [-5.4, 0, 0], [-5.5, 0, 0]])) == [True, False, True, False]


def test_arrays_are_unions_of_their_copies():
    bar = ombre.rectprism((3, 1, 1), "red")
    points = numpy.random.default_rng(1).uniform((-3, -3, -3), (65, 23, 3), (3000, 3))
    row = ombre.array_linear(bar, 20, (3.2, 1, 0))
    copies = ombre.union([bar.translate((3.2 * i, i, 0)) for i in range(20)])
    assert (row.inside(points) == copies.inside(points)).all() and row.inside(points).any()
    assert (row.distance(points) <= copies.distance(points) + 1e-9).all()
    grid = bar.array_grid(counts=(16, 6, 1), steps=(4, 4, 1))
    cells = ombre.union([bar.translate((4 * i, 4 * j, 0)) for j in range(6) for i in range(16)])
    assert (grid.inside(points) == cells.inside(points)).all()
    with pytest.raises(ombre.DesignError, match="whole number from 1 to 100000"):
        ombre.array_linear(bar, 2.5, (1, 0, 0))


def test_a_warp_by_a_function():
    def bulge(x, y, z):
        return x / (1 + 0.5 * numpy.exp(-z * z))
    vase = ombre.warp(ombre.cylinder(4, 10, "red"), bulge, "y", "z", min=(-8, -8, -5), max=(8, 8, 5))
    assert list(vase.inside([[5.9, 0, 0], [6.1, 0, 0], [3.9, 0, 4.9], [4.1, 0, 4.9]])) == [True, False, True, False]


def test_conformal_map_takes_a_base_and_a_pattern():
    tile = ombre.rectprism((6, 4, 2), "red")
    ring = ombre.conformal_map(ombre.cylinder(10, 30), tile, mapping="cylindrical")
    angle = 0.29
    assert list(ring.inside([[10.9 * math.cos(angle), 10.9 * math.sin(angle), 1.9],
                             [10.9 * math.cos(0.31), 10.9 * math.sin(0.31), 0], [11.1, 0, 0]])) == [True, False, False]
    assert ring.material([10.5, 0, 0])["red"] == 1
    with pytest.raises(TypeError, match="needs 2 solids"):
        ombre.conformal_map(tile)
    with pytest.raises(ombre.DesignError, match="takes 2 inputs, 3 were given"):
        ombre.conformal_map(tile, tile, tile)


# The same by pyvcad.

def test_offset():
    box = pv.Offset(2, pv.RectPrism(origin, pv.Vec3(2, 4, 6), 3))
    assert box.evaluate(4, 0, 0) == pytest.approx(1)
    assert box.evaluate(1 + 3, 2 + 4, 0) == pytest.approx(3)  # a corner: 5 - 2
    assert box.bounding_box() == ((-3, -4, -5), (3, 4, 5))
    assert box.distribution(2.9, 0, 0) == {3: 1} and box.type() == "Offset"
    assert pv.Offset(-0.5, pv.Sphere(origin, 2)).evaluate(0, 0, 0) == pytest.approx(-1.5)


def test_shell():
    shell = pv.Shell(1, pv.Sphere(origin, 5, 2))
    assert [shell.evaluate(x, 0, 0) for x in (0, 3.5, 4.25, 5.5)] == pytest.approx([4, 0.5, -0.25, 0.5])
    assert shell.distribution(4.5, 0, 0) == {2: 1} and shell.distribution(0, 0, 0) == {}
    later = pv.Shell(1)
    later.set_child(pv.Sphere(origin, 5, 2))
    assert later.evaluate(4.25, 0, 0) == shell.evaluate(4.25, 0, 0)
    with pytest.raises(ValueError, match="Shell, thickness: expected a length above 0"):
        pv.Shell(0, pv.Sphere(origin, 5))


def test_conformal_map():
    base, pattern = pv.RectPrism(pv.Vec3(0, 0, -10), pv.Vec3(60, 60, 20)), pv.RectPrism(origin, pv.Vec3(4, 6, 2), 2)
    mapped = pv.ConformalMap(base, pattern)
    for point in [(0, 0, 0), (1.5, 2.5, 0.5), (3, 0, 0), (0, 0, 2)]:
        assert mapped.evaluate(*point) == pytest.approx(pattern.evaluate(*point), abs=1e-9)
    assert mapped.distribution(1, 1, 0.5) == {2: 1} and mapped.material_list() == pattern.material_list()
    later = pv.ConformalMap()
    later.set_left(base)
    later.set_right(pattern)
    assert later.evaluate(1, 2, 0.5) == mapped.evaluate(1, 2, 0.5)
    # Along x: the pattern stands on the face at x = 30, its x along y.
    side = pv.ConformalMap(base, pattern, pv.Vec3(1, 0, 0))
    assert side.evaluate(30.5, 1.5, -1) < 0 < side.evaluate(30.5, 2.5, -1)
    with pytest.raises(ValueError, match="ref_dir: expected a direction"):
        pv.ConformalMap(base, pattern, origin)

"""Every public function that takes or gives arrays, at points whose answers differ: run under the oldest and the newest
NumPy, too (tests/run_numpy.py)."""
import math

import numpy
import pytest

import ombre
import pyvcad as pv
from ombre import x, y, z

# Distances from the origin: 0, 1, 2, 5, 13.
points = numpy.array([[0, 0, 0], [1, 0, 0], [0, -2, 0], [3, 4, 0], [3, 4, 12]], dtype=float)
far = numpy.array([0, 1, 2, 5, 13], dtype=float)


def ball():
    """4 mm of radius; red grows along x from 0.5 by 0.1 a mm."""
    return ombre.sphere(4).fgrade([0.5 + x / 10, 0.5 - x / 10], ["red", "blue"])


@pytest.mark.parametrize("given", [
    points, points.tolist(), points.astype(numpy.float32), points.astype(int), numpy.asfortranarray(points),
    numpy.repeat(points, 2, axis=0)[::2], points.astype(">f8")], ids=["double", "lists", "float", "int", "fortran", "strided", "swapped"])
def test_points_of_any_layout(given):
    part = ball()
    assert numpy.array_equal(part.distance(given), far - 4)
    assert part.inside(given).tolist() == [True, True, True, False, False]
    assert numpy.allclose(part.material(given)["red"], [0.5, 0.6, 0.5, 0, 0], atol=1e-15)


def test_shapes_are_kept():
    grid = numpy.concatenate([points, points[:1]]).reshape(2, 3, 3)
    assert numpy.array_equal(ball().distance(grid), [[-4, -3, -2], [1, 9, -4]])
    assert ball().distance(points[3]) == 1 and ball().distance(numpy.zeros((0, 3))).shape == (0,)


def test_attributes():
    part = ombre.sphere(20, "red").with_attribute("heat", x + 2 * y).with_attribute("pull", [z, x, 1])
    assert numpy.array_equal(part.attribute("heat", points), [0, 1, -4, 11, 11])
    assert numpy.array_equal(part.attribute("pull", points), [[0, 0, 1], [0, 1, 1], [0, 0, 1], [0, 3, 1], [12, 3, 1]])


def test_gradients_and_nearest_points():
    outside = points[3:]
    assert numpy.allclose(ball().gradient(outside), outside / far[3:, None], atol=1e-6)
    assert numpy.allclose(ball().nearest(outside), 4 * outside / far[3:, None], atol=1e-6)


def test_everything_in_one_question():
    part = ball().with_attribute("heat", x + 2 * y).with_attribute("pull", [z, x, 1])
    found = part.sample(points.reshape(1, 5, 3))
    assert numpy.array_equal(found.distance, part.distance(points)[None])
    assert numpy.array_equal(found.inside, part.inside(points)[None])
    assert {name: values.tolist() for name, values in found.material.items()} == \
        {name: values[None].tolist() for name, values in part.material(points).items()}
    assert found.attribute.keys() == {"heat", "pull"}
    for name, values in found.attribute.items():
        assert numpy.array_equal(values, part.attribute(name, points)[None])


def test_functions_of_arrays():
    wave = ombre.function(lambda x, y, z: numpy.hypot(x, y) - 1, min=(-2, -2, -2), max=(2, 2, 2))
    assert numpy.array_equal(wave.distance(points[:3]), [-1, 0, 1])
    slow = ombre.function(ombre.pointwise(lambda x, y, z: math.hypot(x, y, z) - 1), min=(-2, -2, -2), max=(2, 2, 2))
    assert numpy.array_equal(slow.distance(points[:3]), [-1, 0, 1])


def test_edges_of_points():
    corners = numpy.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [1, 1, 1]])
    assert numpy.asarray(ombre.delaunay_edges(corners)).shape == (10, 2, 3)  # each of the five with each other one
    rng = numpy.random.default_rng(7)
    edges = numpy.asarray(ombre.voronoi_edges(rng.uniform(0, 1, (20, 3)), (0, 0, 0), (1, 1, 1)), dtype=float)
    assert edges.ndim == 3 and edges.shape[1:] == (2, 3) and edges.min() >= -1e-9 and edges.max() <= 1 + 1e-9


def test_grids():
    block = ombre.rectprism((3, 2, 1), "red")
    grid = block.voxels(1)
    assert grid.values.shape == (1, 2, 3) and (grid.values == block.materials.names.index("red")).all()
    assert numpy.array_equal(grid.centers()[0, :, :, 0], [[-1, 0, 1], [-1, 0, 1]])
    assert block.volumes(0.5) == {"red": 6}


def test_volumes_of_arrays():
    values = numpy.zeros((4, 5, 6), dtype=numpy.int64)
    values[1:3, 2:4, 3:5] = 7
    for stored in (values, values.astype(">i2"), values.astype(numpy.float32), numpy.asfortranarray(values)):
        solid = ombre.volume_solid(stored, level=3.5, spacing=(1, 1, 1))
        assert solid.inside(numpy.array([[3.5, 2.5, 1.5], [0, 0, 0]])).tolist() == [True, False]


def test_matrices():
    turn = numpy.array([[0, -1, 0, 5], [1, 0, 0, 0], [0, 0, 1, 0]], dtype=float)
    moved = ombre.sphere(1).translate(numpy.array([2, 0, 0])).matrix(turn)
    assert numpy.allclose(moved.distance([[5, 2, 0], [5, 4, 0]]), [-1, 1])


def test_samplers_of_trees():
    part = pv.Sphere(pv.Vec3(0, 0, 0), 4, 1)
    part.set_attribute("heat", pv.FloatAttribute("x + 2*y"))
    part.set_attribute("pull", pv.Vec3Attribute("z", "x", 1))
    sampler = pv.TreeSampler(part, pv.Vec3(1, 1, 1))
    found = sampler.sample_points(points)
    assert [distance for distance, _ in found] == (far - 4).tolist()
    assert [samples and samples.get_sample("heat") for _, samples in found] == [0, 1, -4, None, None]
    assert found[1][1].get_sample("pull") == pv.Vec3(0, 1, 1)
    assert sampler.evaluate_points(points) == (far - 4).tolist()
    assert sampler.sample_points_to_float_array(points[:3], "heat") == [0, 1, -4]
    assert [d for d, _ in sampler.sample_line((0, 0, 0), (4, 0, 0), 3)] == [-4, -2, 0]
    assert sampler.as_float_array("heat")[5, 4, 4] == pytest.approx(1.5 + 2 * 0.5)

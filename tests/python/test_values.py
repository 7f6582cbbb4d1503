"""Values of nodes, against NumPy and the rules of mixtures."""
import copy
import pickle

import numpy
import pytest

import ombre

POINTS = numpy.random.default_rng(3).uniform(-5, 5, (200, 3))


def test_values_are_expressions():
    t = ombre.noise(size=3)
    values = t(POINTS)
    assert values.min() >= 0 and values.max() <= 1 and values.std() > 0.05
    numpy.testing.assert_allclose((10 + 0.4 * t - t / 2)(POINTS), 10 - 0.1 * values, rtol=1e-14)
    numpy.testing.assert_allclose(numpy.sin(t)(POINTS), numpy.sin(values), rtol=1e-14)
    numpy.testing.assert_allclose(numpy.minimum(t, 0.5)(POINTS), numpy.minimum(values, 0.5))
    numpy.testing.assert_array_equal((t > 0.5)(POINTS), values > 0.5)
    numpy.testing.assert_array_equal(ombre.where(t > 0.5, 1, -t)(POINTS), numpy.where(values > 0.5, 1, -values))


def test_different_values_meet_in_one_expression():
    a, b = ombre.noise(size=3), ombre.noise(size=3, seed=1)
    numpy.testing.assert_allclose((a * b + ombre.x)(POINTS), a(POINTS) * b(POINTS) + POINTS[:, 0], rtol=1e-12, atol=1e-14)


def test_solids_take_values():
    t = ombre.noise(size=3)
    ball = ombre.sphere(4 + t, ombre.mix("red", "blue", t))
    values = t(POINTS)
    distances = numpy.linalg.norm(POINTS, axis=1) - (4 + values)
    numpy.testing.assert_allclose(ball.distance(POINTS), distances, atol=1e-12)
    inside = POINTS[distances < 0]
    numpy.testing.assert_allclose(ball.material(inside)["blue"], values[distances < 0], atol=1e-12)


def test_vectors_have_parts():
    c = ombre.cells((4, 4, 4))
    numpy.testing.assert_array_equal(c.index.y(POINTS), numpy.floor(POINTS[:, 1] / 4 + 0.5))
    numpy.testing.assert_allclose(c.distance(POINTS), (2 - abs(POINTS - 4 * numpy.floor(POINTS / 4 + 0.5))).min(axis=1))
    with pytest.raises(TypeError, match="it gives index, local, distance"):
        c + 1
    with pytest.raises(AttributeError, match="indx"):
        c.indx


def test_values_come_back_from_solids():
    t = ombre.noise(size=3)
    ball = ombre.sphere(4 + t**2, ombre.mix("red", "blue", t))
    radius = ball.parameters["radius"]
    numpy.testing.assert_allclose((radius + t)(POINTS), 4 + t(POINTS)**2 + t(POINTS), rtol=1e-14)
    again = ombre.sphere(radius, ball.parameters["material"])
    assert again.hash == ball.hash
    assert ombre.Design.from_json(ball.to_json()).hash == ball.hash


def test_values_are_pickled():
    t = ombre.noise(size=3)
    for value in (t, 2 + t, copy.deepcopy(t)):
        numpy.testing.assert_array_equal(pickle.loads(pickle.dumps(value))(POINTS), value(POINTS))
    mixture = ombre.mix("red", "blue", t)
    assert ombre.sphere(5, pickle.loads(pickle.dumps(mixture))).hash == ombre.sphere(5, mixture).hash


def test_scripts_and_python_mean_the_same(tmp_path):
    script = tmp_path / "ball.vcad"
    script.write_text("t = noise(size=3); sphere(10 + 0.4*t, mix(white, black, t));")
    t = ombre.noise(size=3)
    assert ombre.load(script).hash == ombre.sphere(10 + 0.4 * t, ombre.mix("white", "black", t)).design().hash


def test_what_is_wrong_is_said():
    with pytest.raises(ombre.DesignError, match="expected a material or a mixture"):
        ombre.sphere(5, ombre.noise())
    with pytest.raises(ombre.DesignError, match="write a constant"):
        ombre.translate(ombre.sphere(5), (ombre.noise(), 0, 0))
    with pytest.raises(TypeError, match="neither true nor false"):
        bool(ombre.noise() > 0.5)
    assert "Number from 0 to 1" in ombre.noise.__doc__

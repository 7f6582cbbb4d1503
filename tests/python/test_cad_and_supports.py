"""CAD files and supports, in both packages."""
import math
import pathlib

import numpy
import pytest

import ombre
import pyvcad as pv

CAD = pathlib.Path(__file__).resolve().parents[1] / "cad"


@pytest.fixture(scope="module", autouse=True)
def needs_open_cascade():
    try:
        ombre.cad(str(CAD / "cylinder.step"))
    except ombre.DesignError as error:
        if "without Open CASCADE" in str(error):
            pytest.skip(str(error))
        raise


def test_cad_distances_are_those_of_a_cylinder():
    """Of radius 5, from z = 0 to 20."""
    points = numpy.array([(8, 0, 24), (0, 0, 10), (3, 0, 19), (0, 9, 5)], float)
    exact = ombre.cad(str(CAD / "cylinder.step"), mode="exact")
    assert exact.distance(points) == pytest.approx([5, -5, -1, 4], abs=1e-6)
    fast = ombre.cad(str(CAD / "cylinder.step"), tolerance=0.01)
    assert fast.distance(points) == pytest.approx([5, -5, -1, 4], abs=0.015)


def test_cad_of_pyvcad():
    """A ball of radius 4 about (1, 2, 3)."""
    for fast in (True, False):
        ball = pv.CAD(str(CAD / "sphere.step"), fast, 2)
        low, high = ball.bounding_box()
        assert tuple(low) == pytest.approx((-3, -2, -1), abs=1e-6)
        assert tuple(high) == pytest.approx((5, 6, 7), abs=1e-6)
        assert ball.evaluate(1, 2, 9) == pytest.approx(2, abs=0.05 if fast else 1e-6)
        assert ball.distribution(1, 2, 3) == {2: 1.0}
        assert ball.material_list() == [2] or set(ball.material_list()) == {2}
    assert pv.CAD(CAD / "sphere.step").evaluate(1, 2, 3) == pytest.approx(-4, abs=0.05)
    with pytest.raises(FileNotFoundError, match="CAD: there is no file"):
        pv.CAD("no_such_part.step")


def table():
    """A plate of 20 x 20 x 2 on a leg of 4 x 4 x 10."""
    return pv.Union(False, [pv.RectPrism(pv.Vec3(0, 0, 11), pv.Vec3(20, 20, 2), 1),
                            pv.RectPrism(pv.Vec3(0, 0, 5), pv.Vec3(4, 4, 10), 1)])


@pytest.mark.parametrize("analyzer", [pv.SupportAnalyzer, pv.SupportAnalyzerParallel])
@pytest.mark.parametrize("size", [0.5, pv.Vec3(0.5, 0.5, 0.25)])
def test_supports_of_a_table_fill_the_box_below(analyzer, size):
    support = analyzer(table(), size, 3).analyze()
    assert isinstance(support, pv.Node)
    assert support.distribution(5, 5, 5) == {3: 1.0}
    assert support.distribution(0, 0, 5) == {}
    assert support.distribution(5, 5, 11) == {}
    ids = support.toRGBAArray(pv.Vec3(0.5, 0.5, 0.5), pv.default_materials)
    assert (ids[..., 3] > 0).sum() * 0.125 == pytest.approx((400 - 16) * 10)


def test_supports_of_python_functions():
    """Its threads ask a function of Python: a ball's lower half and the cylinder around it, less the half."""
    ball = ombre.function(lambda x, y, z: numpy.sqrt(x * x + y * y + z * z) - 4, min=(-5, -5, -5), max=(5, 5, 5))
    support = ombre.support(ball, pitch=(0.1, 0.1, 0.1))
    at = (numpy.indices((80, 80, 40)).reshape(3, -1).T + 0.5) * 0.1 - 4
    assert support.inside(at).sum() * 1e-3 == pytest.approx(math.pi * 64 / 3, rel=0.03)

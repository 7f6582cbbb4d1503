"""Operators of a library of the user, called from Python."""
import inspect
import math

import pytest

import ombre
from ombre._operators import Operators

LIBRARY = """
/// Rings of two materials around the z axis.
/// Category: appearance
/// Returns: mixture
function rings(
  width = 2,     // [0.5:0.1:10] value mm: Width of a ring
  odd = "blue",  // material: Material of every second ring
  even = "white" // material: Material of the others
) = floor(coordinates().rho / width) % 2 == 0 ? odd : even;
/// The place in a grid.
/// Returns: vector
function places(scale = 1) = [scale * coordinates().rho, 3, ["a", "b"]];
/// The same as an object.
/// Returns: rho value mm, count number, names text
function parts(scale = 1) =
  object(rho = scale * coordinates().rho, count = 3, names = ["a", "b"], inner = object(depth = 1));
/// A ball in a box that the children cut.
module cut_ball(
  radius = 3 // [1:5] mm: Radius of the ball
) difference() { sphere(radius, "red"); children(); }
"""


@pytest.fixture
def own(tmp_path, monkeypatch):
    folder = tmp_path / "ombre" / "library" / "shop"
    folder.mkdir(parents=True)
    (folder / "own.vcad").write_text(LIBRARY)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    return Operators("ombre.operators").shop.own


def test_functions_give_mixtures(own):
    ball = ombre.sphere(5, own.rings(2, even="red"))
    assert ball.material([1, 0, 0]) == {"blue": 1} or float(ball.material([1, 0, 0])["blue"]) == 1
    assert float(ball.material([3, 0, 0])["red"]) == 1


def test_functions_take_values(own):
    wide = own.rings(width=2 + 0 * ombre.noise(size=3), odd=ombre.mix("red", "white", 0.25))
    fractions = ombre.sphere(5, wide).material([1, 0, 0])
    assert float(fractions["red"]) == pytest.approx(0.75)


def test_functions_give_lists(own):
    rho, count, names = own.places(2)
    assert count == 3 and names == ["a", "b"]
    assert float(ombre.sphere(rho).distance([3, 0, 0])) < 0


def test_functions_give_objects(own):
    parts = own.parts(2)
    assert parts.count == 3 and parts.names == ["a", "b"] and parts.inner.depth == 1
    assert float(ombre.sphere(parts.rho).distance([3, 0, 0])) < 0


def test_modules_take_children(own):
    whole, cut = own.cut_ball(2), own.cut_ball(ombre.rectprism((4, 4, 4)).translate(0, 0, 2), radius=2)
    assert whole.inside([0, 0, 1]) and not cut.inside([0, 0, 1]) and cut.inside([0, 0, -1])
    ball, half = 4 / 3 * math.pi * 8, 2 / 3 * math.pi * 8
    assert whole.design().volume(0.1) == pytest.approx(ball, rel=0.02)
    assert cut.design().volume(0.1) == pytest.approx(half, rel=0.02)


def test_wrong_arguments_raise(own):
    with pytest.raises(ombre.DesignError, match="cut_ball: radius: expected a number from 1 to 5 .mm., found 7"):
        own.cut_ball(7)
    with pytest.raises(ombre.DesignError, match="rings: odd: expected a material or a mixture, found 3"):
        own.rings(odd=3)
    with pytest.raises(ombre.DesignError, match='"rings" has no parameter "wdith"'):
        own.rings(wdith=3)
    with pytest.raises(AttributeError, match="it has cut_ball, parts, places, rings"):
        own.ring


def test_help_comes_from_the_declaration(own):
    assert own.rings.__doc__.startswith("Rings of two materials around the z axis.")
    assert "width: Width of a ring (value, mm; default 2)" in own.rings.__doc__
    assert list(inspect.signature(own.rings).parameters) == ["width", "odd", "even"]

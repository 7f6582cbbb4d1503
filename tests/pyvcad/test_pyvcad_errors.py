"""What pyvcad says of mistakes, and of what is missing."""
import inspect
import math

import pytest

import ombre
import pyvcad as pv
import pyvcad_compilers as compilers
import pyvcad_rendering
from pyvcad_parts import ball, blue, origin, red


def cycle():
    outer = pv.Union()
    outer.add_child(pv.Translate(1, 0, 0, outer))
    return outer.evaluate(0, 0, 0)


def chain():
    node = ball()
    for _ in range(100_000):
        node = pv.Translate(0, 0, 0, node)
    return node.evaluate(0, 0, 0)


@pytest.mark.parametrize("code, error, text", [
    (lambda: pv.Sphere("a"), TypeError, r"Sphere\(str\).*write Sphere\(\) or Sphere\(center, radius, material=1\)"),
    (lambda: pv.Sphere(origin, -1), ValueError, "Sphere, radius: expected a length above 0"),
    (lambda: pv.Sphere(origin, math.nan), ValueError, "Sphere, radius: expected a finite number"),
    (lambda: pv.RectPrism(origin, pv.Vec3(1, 0, 1)), ValueError, "RectPrism, size: expected lengths above 0"),
    (lambda: pv.Cylinder(origin, 1, 2, "red"), TypeError, r"write materials.id\('red'\)"),
    (lambda: pv.Cylinder(origin, 1, hight=2), TypeError, r"hight=int"),
    (lambda: pv.Union(False, "ball"), TypeError, "expected a list of nodes, found str"),
    (lambda: pv.Union(False, [pv.Sphere]), TypeError, r"write Sphere\(...\)"),
    (lambda: pv.Union().add_child("ball"), TypeError, "expected a node, found str"),
    (lambda: pv.Union(-1.0), ValueError, "expected a radius of 0 or more"),
    (lambda: pv.Scale(1, 0, 1), ValueError, "other than 0"),
    (lambda: pv.FGrade(["1", "0"], [1], True), ValueError, "2 functions and 1 materials"),
    (lambda: pv.FGrade("1", [1], True), TypeError, "functions: expected a list, found str"),
    (lambda: pv.FGrade(["1"], [1], "prob"), TypeError, "prob_mode: expected True or False"),
    (lambda: pv.FGrade(["1 +"], [1], True, ball()).evaluate(0, 0, 0), ombre.DesignError, "the expression ends"),
    (lambda: pv.FGrade(["1"], [1], True).evaluate(0, 0, 0), ombre.DesignError, "FGrade: it has no child; .*set_child"),
    (lambda: pv.Union().evaluate(0, 0, 0), ombre.DesignError, "Union: it has no children; .*add_child"),
    (lambda: pv.Difference().evaluate(0, 0, 0), ombre.DesignError, "no left child"),
    (lambda: pv.Difference(ball(), None), TypeError, "Difference"),
    (lambda: pv.Function(lambda a, b: 0), TypeError, "2 parameters, among them 'a'"),
    (lambda: pv.Function("x", 1, pv.Vec3(1, 1, 1), origin), ValueError, "min below max"),
    (lambda: pv.Mesh("nothing.stl"), FileNotFoundError, "there is no file nothing.stl"),
    (lambda: pv.MaterialDefs("nothing.json"), FileNotFoundError, "nothing.json"),
    (lambda: pv.default_materials.id("unobtainium"), KeyError, "unobtainium"),
    (lambda: pv.Sphere(origin, 1, 99)._ombre_design_(), ombre.DesignError, "from 0 to 15, found the number 99"),
    (lambda: pv.Sphere(origin, 1, 999).evaluate(0, 0, 0), ombre.DesignError, "no material 999"),
    (lambda: pyvcad_rendering.Render(ball(), [1, 2]), TypeError, "Render: expected a MaterialDefs, found list"),
    (cycle, ombre.DesignError, "lies below itself"),
    (chain, ombre.DesignError, "nests deeper than 400 nodes"),
])
def test_errors_say_what_to_write(code, error, text):
    with pytest.raises(error, match=text):
        code()


def test_errors_name_the_line():
    with pytest.raises(ombre.DesignError, match=r"test_pyvcad_errors\.py:\d+: the formula '1 \+' is wrong"):
        pv.FGrade(["1 +"], [1], True, ball())
    with pytest.raises(ombre.DesignError, match=r"test_pyvcad_errors\.py:\d+: Union: "):
        pv.Union().prepare(1)


def test_solids_name_the_line_of_their_node():
    line = inspect.currentframe().f_lineno + 1
    parts = [pv.Translate(1, 0, 0, pv.Sphere(origin, 1)), pv.Sphere(origin, 2), pv.GraphLattice([(origin, (1, 0, 0))], 1)]
    for solid in (part._ombre_solid_() for part in parts):
        assert solid.place == (__file__, line)
        assert all(below.place[0] == __file__ for below in solid.inputs)


def test_warnings_name_the_line():
    implicit = pv.Function("r - 3")
    node = pv.FGrade(["0.5 + d", "0.5 - d"], [red, blue], True, implicit)
    with pytest.warns(ombre.DesignWarning, match=r"test_pyvcad_errors\.py:\d+:\d+: warning: \"d\" needs distances"):
        node.prepare()


def test_cycles_are_found_in_every_traversal():
    outer = pv.Union()
    outer.add_child(pv.Translate(1, 0, 0, outer))
    for question in (outer.clone, outer.material_list, outer.bounding_box):
        with pytest.raises(ombre.DesignError, match="lies below itself"):
            question()


@pytest.mark.parametrize("name", ["Map"])
def test_what_is_missing_says_so(name):
    with pytest.raises(NotImplementedError, match=f"{name}: Ombre does not have this yet"):
        getattr(pv, name)()

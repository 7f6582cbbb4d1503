"""pyvcad's interface: known values, overlaps, Python functions, utilities, grids."""
import math
import os
import re

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_compilers
import pyvcad_rendering
from pyvcad_parts import ball, blue, graded_bar, green, origin, red


# Known values.

def test_sphere():
    assert ball().evaluate(15, 0, 0) == 5
    assert numpy.allclose(tuple(ball().gradient(15, 0, 0)), (1, 0, 0), atol=1e-7)
    assert numpy.allclose(tuple(ball().gradient(pv.Vec3(15, 0, 0))), (1, 0, 0), atol=1e-7)
    assert numpy.allclose(tuple(ball().snap(pv.Vec3(15, 0, 0))), (10, 0, 0), atol=1e-9)
    assert pv.Sphere(0, 0, 0, 2).evaluate(0, 0, 0) == -2
    assert pv.Sphere(1, 2, 3, 2).bounding_box() == ((-1, 0, 1), (3, 4, 5))
    assert ball().distribution(0, 0, 0) == {1: 1}
    assert ball().distribution(11, 0, 0) == {}
    assert ball().type() == "Sphere"


@pytest.mark.parametrize("node, point, distance", [
    (pv.RectPrism(pv.Vec3(1, 0, 0), pv.Vec3(2, 4, 6)), (0, 0, 0), 0),
    (pv.RectPrism(origin, pv.Vec3(2, 2, 2)), (4, 5, 1), 5),
    (pv.Cylinder(origin, 2, 10), (5, 0, 0), 3),
    (pv.Cylinder(origin, 2, 10), (0, 0, 6), 1),
    (pv.Strut(origin, pv.Vec3(10, 0, 0), 1), (12, 0, 0), 1),
    (pv.Strut(origin, pv.Vec3(10, 0, 0), 1, 1), (12, 0, 0), 2),
    (pv.GraphLattice([(origin, pv.Vec3(10, 0, 0))], 1, 1), (12, 0, 0), 1),
    (pv.Translate(5, 0, 0, ball(1)), (0, 0, 0), 4),
    (pv.Scale(2, 2, 2, ball(1)), (5, 0, 0), 3),
    (pv.Difference(ball(5), ball(2)), (0, 0, 0), 2),
    (pv.Intersection(False, [ball(5), ball(3)]), (0, 0, 0), -3),
    (pv.Sum(0, [pv.Sphere(-5, 0, 0, 1), pv.Sphere(5, 0, 0, 1)]), (0, 0, 0), 8),
    (pv.Sum(children=[ball(1), ball(2)]), (5, 0, 0), 7),
    (pv.Function("r - 3"), (0, 0, 0), -3),
    (pv.Function(lambda x, y, z, rho, phic, r, theta, phis: r - 3), (0, 0, 0), -3),
])
def test_distance(node, point, distance):
    assert node.evaluate(*point) == pytest.approx(distance, abs=1e-9)


def test_rotation_turns_about_z_first_and_x_last():
    at_x = pv.Sphere(10, 0, 0, 1)
    assert pv.Rotate(0, 0, 90, origin, at_x).evaluate(0, 10, 0) == pytest.approx(-1)
    assert pv.Rotate(90, 0, 90, origin, at_x).evaluate(0, 0, 10) == pytest.approx(-1)
    assert pv.Rotate(0, 0, 180, pv.Vec3(5, 0, 0), at_x).evaluate(0, 0, 0) == pytest.approx(-1)


def test_struts_of_a_lattice_meet_round():
    corner = pv.GraphLattice([(origin, pv.Vec3(10, 0, 0)), [pv.Vec3(0, 0, 0), pv.Vec3(0, 10, 0)]], 1, 1)
    assert corner.evaluate(-0.5, -0.5, 0) == pytest.approx(math.hypot(0.5, 0.5) - 1)


def test_heterogeneity_is_one_for_pure_materials_and_zero_for_even_mixtures():
    bar = graded_bar()
    assert bar.material_list() == [red, blue]
    assert bar.heterogeneity(0, 0, 0) == pytest.approx(0, abs=1e-12)
    assert bar.heterogeneity(10, 0, 0) == pytest.approx(1)
    # Eq. 1 with n = 2 and fractions 3/4, 1/4: sqrt(2/16) / sqrt(1/2).
    assert bar.heterogeneity(5, 0, 0) == pytest.approx(0.5)
    assert ball().heterogeneity(0, 0, 0) == 1
    three = pv.FGrade(["1", "1", "1"], [1, 2, 3], True, ball())
    assert three.heterogeneity(0, 0, 0) == pytest.approx(0, abs=1e-12)


def test_distribution_gradient():
    slopes = graded_bar().distribution_gradient(0, 0, 0)
    assert numpy.allclose(tuple(slopes[red]), (1 / 20, 0, 0))
    assert numpy.allclose(tuple(slopes[blue]), (-1 / 20, 0, 0))


def test_materials_that_a_design_can_have():
    carved = pv.Difference(ball(5, red), ball(2, blue))
    assert carved.material_list() == [red]
    assert pv.Union(False, [ball(5, red), carved, ball(1, green)]).material_list() == [red, green]


# Overlaps.

@pytest.mark.parametrize("operation", [pv.Union, pv.Intersection])
def test_first_child_wins_unless_mixing_is_requested(operation):
    children = [ball(5, red), ball(5, blue)]
    for node in (operation(False, children), operation(0.0, False, children), operation(0.0, children=children)):
        assert node.distribution(0, 0, 0) == {red: 1}
    assert operation(True, children).distribution(0, 0, 0) == {red: 0.5, blue: 0.5}
    default = operation()
    for child in children:
        default.add_child(child)
    assert default.distribution(0, 0, 0) == {red: 1}


def test_bbox_union_is_the_union():
    children = [pv.Sphere(0, 0, 0, 5, red), pv.Sphere(3, 0, 0, 5, blue)]
    points = numpy.random.default_rng(3).uniform(-8, 8, (50, 3))
    for p in points:
        assert pv.BBoxUnion(children).evaluate(*p) == pv.Union(False, children).evaluate(*p)
        assert pv.BBoxUnion(children).distribution(*p) == pv.Union(False, children).distribution(*p)


# Python functions.

def test_functions_get_one_point():
    def share(x, y, z, rho, phic, r, theta, phis):
        assert type(x) is float and type(phis) is float
        return 1.0 if x < 0 else 0.25
    bar = pv.FGrade([share, lambda x, y, z: 0.0 if x < 0 else 0.75], [red, blue], True, ball())
    assert bar.distribution(-1, 0, 0) == {red: 1}
    assert bar.distribution(1, 0, 0) == {red: 0.25, blue: 0.75}


def test_functions_of_the_depth():
    def skin(a, b, c, e, f, g, h, i, d):
        return 1.0 if d > -1 else 0.0
    node = pv.FGrade([skin, lambda d: 1.0 if d <= -1 else 0.0], [red, blue], False, ball())
    assert node.distribution(9.5, 0, 0) == {red: 1}
    assert node.distribution(5, 0, 0) == {blue: 1}


def test_coordinates_of_functions():
    seen = []
    pv.Function(lambda *c: seen.append(c) or 0.0).evaluate(3, 4, 12)
    x, y, z, rho, phic, r, theta, phis = seen[-1]
    assert (x, y, z, rho, r) == (3, 4, 12, 5, 13)
    assert phic == theta == pytest.approx(math.atan2(4, 3))
    assert phis == pytest.approx(math.acos(12 / 13))


def test_functions_that_fail_say_so():
    node = pv.Function(lambda x, y, z: 1 / 0)
    with pytest.raises(ombre.FunctionError, match="ZeroDivisionError"):
        node.evaluate(0, 0, 0)


# Utilities.

def test_vectors():
    v = pv.Vec3(1, 2, 3)
    v.z = 5
    assert (v.x, v.y, v.z) == (1, 2, 5) and v == pv.Vec3(1, 2, 5) and v != pv.Vec3()
    assert v + pv.Vec3(1, 1, 1) == pv.Vec3(2, 3, 6) and 2 * v - v == v and -v / 2 == (-0.5, -1, -2.5)
    assert pv.Vec2(3, 4).length() == 5
    assert len(pv.Vec4()) == 4
    with pytest.raises(TypeError, match="Vec3 has 3 numbers"):
        pv.Vec3(1, 2)


def test_material_tables():
    table = pv.default_materials
    assert table() is table
    assert table.id("void") == 0 and table.id("red") == 1 and table.name(3) == "blue"
    assert table.color("red") == table.color(1) == (255, 0, 0, 255)
    assert table.contains("gray") and not table.contains("unobtainium")
    assert table.num_materials() == 15 and len(table.palette()) == 16
    for name in ("VeroYellow", "Agilus30Mgn", "Agilus30Blk", "M.Cleanser"):
        assert pv.j750_materials.name(pv.j750_materials.id(name)) == name


def test_changed_colors_show():
    table = pv.MaterialDefs(os.path.join(pv.resources_path(), "materials", "default.json"))
    table.update_color("red", (1, 2, 3, 255))
    assert table.color(1) == (1, 2, 3, 255)
    assert ball().toRGBAArray(5, table)[2, 2, 2].tolist() == [1, 2, 3, 255]
    assert ball().toRGBAArray(5, pv.default_materials)[2, 2, 2].tolist() == [255, 0, 0, 255]


def test_materials_are_those_of_the_job():
    node = ball(5, pv.j750_materials.id("VeroYellow"))
    assert node._ombre_design_(pv.j750_materials).volumes(1).keys() == {"VeroYellow"}
    assert node._ombre_design_(pv.default_materials).volumes(1).keys() == {pv.default_materials.name(6)}


def test_texts_of_the_language():
    node = pv.parse_vcad_text('union() { sphere(5, "blue"); translate(9, 0, 0) { sphere(5, "red"); } }', "")
    assert node.evaluate(0, 0, 0) == -5
    assert node.material_list() == [red, blue]
    mixed = pv.parse_vcad_text('t = formula("x/10"); sphere(5, mix("blue", mix("red", "blue", 0.5), t));', "")
    assert mixed.material_list() == [red, blue]
    for node_with_mixture in (mixed, pv.Union(False, [ball(1, green), mixed])):
        assert node_with_mixture.distribution(4, 0, 0) == pytest.approx({red: 0.2, blue: 0.8})
    joined = pv.Union(False, [ball(1, green), node])
    assert joined.distribution(0, 0, 0) == {green: 1} and joined.distribution(3, 0, 0) == {blue: 1}
    with pytest.raises(ombre.DesignError, match="sphere"):
        pv.parse_vcad_text("spere(5);", "")


def test_version():
    assert re.match(r"\d+\.\d+", pv.version())


# Grids.

def test_grids_have_an_element_for_each_voxel():
    block = pv.RectPrism(pv.Vec3(10, 0, 0), pv.Vec3(4, 6, 8), blue)
    assert block.toSignedDistanceArray(1).shape == (4, 6, 8)
    assert block.toSignedDistanceArray(pv.Vec3(1, 2, 4)).shape == (4, 3, 2)
    shares = []
    for blend in (True, False):
        colors = block.toRGBAArray(pv.Vec3(1, 2, 4), pv.default_materials, blend, shares.append)
        assert colors.shape == (4, 3, 2, 4) and colors.dtype == numpy.uint8
        assert (colors == pv.default_materials.color(blue)).all()
    assert max(shares) == 1


def test_distances_of_a_grid():
    grid = ball(2).toSignedDistanceArray(0.5)
    axis = numpy.arange(8) * 0.5 - 1.75
    x, y, z = numpy.meshgrid(axis, axis, axis, indexing="ij")
    assert numpy.allclose(grid, numpy.sqrt(x * x + y * y + z * z) - 2, atol=1e-6)


def test_colors_of_a_mixture():
    colors = graded_bar().toRGBAArray(2, pv.default_materials)
    a, b = (numpy.array(tuple(pv.default_materials.color(m))) for m in (red, blue))
    share = 0.5 + (numpy.arange(10) * 2 - 9) / 20
    assert numpy.abs(colors[:, 0, 0] - (share[:, None] * a + (1 - share[:, None]) * b)).max() <= 0.5 + 1e-9
    loose = graded_bar().toRGBAArray(2, pv.default_materials, False)
    assert {tuple(c) for c in loose.reshape(-1, 4)} == {tuple(a), tuple(b)}
    assert not ball(2).toRGBAArray(1)[0, 0, 0].any()


# What scripts for pyvcad 3 write.

def test_booleans_take_nodes_one_by_one():
    a, b, c = (pv.Sphere(pv.Vec3(3 * n, 0, 0), 5) for n in (-1, 1, 3))
    for union in (pv.Union(a, b), pv.Union([a, b]), pv.Union(False, a, b), pv.Union(0.0, [a, b]), pv.Union(0.0, a, b),
                  pv.BBoxUnion(a, b), pv.BBoxUnion([a, b])):
        assert union.bounding_box() == (pv.Vec3(-8, -5, -5), pv.Vec3(8, 5, 5)) and union.num_children() == 2
    for shared in (pv.Intersection(a, b), pv.Intersection([a, b]), pv.Intersection(0.0, a, b), pv.BBoxIntersection(a, b)):
        assert shared.bounding_box() == (pv.Vec3(-2, -5, -5), pv.Vec3(2, 5, 5))
    assert pv.Union(a, b, c).num_children() == 3
    for rest in (pv.Difference(a, b), pv.Difference([a, b]), pv.Difference(0.0, a, b), pv.Difference(0.0, [a, b])):
        assert rest.evaluate(-3, 0, 0) == pytest.approx(-1) and rest.evaluate(3, 0, 0) > 0
    most = pv.Difference(pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(30, 4, 4)), a, b, c)
    assert most.evaluate(-14, 0, 0) == pytest.approx(-1) and all(most.evaluate(x, 0, 0) > 0 for x in (-3, 3, 9))
    assert pv.Union(2.0, a, b).evaluate(0, 5, 0) < pv.Union(a, b).evaluate(0, 5, 0)


def test_empty_lists_are_nothing():
    ball = pv.Sphere(pv.Vec3(0, 0, 0), 5)
    nothing = pv.Union(False, [])
    assert nothing.distribution(0, 0, 0) == {} and pv.Difference(nothing, ball).evaluate(0, 0, 0) > 5
    assert pv.Union(nothing, ball).evaluate(0, 0, 0) == -5 and pv.Intersection(nothing, ball).distribution(0, 0, 0) == {}
    with pytest.raises(ombre.DesignError, match="the design is empty"):
        nothing.bounding_box()


def test_attributes_say_of_what_a_node_is():
    m = pv.default_materials
    bar = pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(50, 10, 10))
    mix = pv.VolumeFractionsAttribute([("x/50 + 0.5", m.id("blue")), ("-x/50 + 0.5", m.id("red"))])
    bar.set_attribute(pv.DefaultAttributes.VOLUME_FRACTIONS, mix)
    assert bar.distribution(0, 0, 0) == {m.id("blue"): 0.5, m.id("red"): 0.5}
    assert bar.distribution(15, 0, 0)[m.id("blue")] == pytest.approx(0.8)
    assert bar.material_list() == sorted([m.id("red"), m.id("blue")])
    assert bar.get_attribute("volume_fractions") is mix and bar.attribute_list() == ["volume_fractions"]
    with pytest.raises(RuntimeError, match="already"):
        bar.set_attribute("volume_fractions", mix)
    # Those of a parent stand in the place of its children's.
    whole = pv.Union(bar, pv.Sphere(pv.Vec3(0, 0, 0), 8))
    assert whole.distribution(0, 0, 0) == bar.distribution(0, 0, 0)
    moved, green = pv.Translate(10, 0, 0, bar), pv.VolumeFractionsAttribute()
    assert moved.distribution(10, 0, 0) == {m.id("blue"): 0.5, m.id("red"): 0.5}
    green.add_value(1.0, m.id("green"))
    moved.set_attribute(pv.DefaultAttributes.VOLUME_FRACTIONS, green)
    assert moved.distribution(10, 0, 0) == {m.id("green"): 1} and moved.clone().material_list() == [m.id("green")]


def test_float_attributes():
    ball = pv.Sphere(pv.Vec3(0, 0, 0), 5)
    ball.set_attribute(pv.DefaultAttributes.DENSITY, pv.FloatAttribute("0.2 - d/10"))
    assert float(ombre.union(ball).attribute("density", [0, 0, 3])) == pytest.approx(0.4)
    with pytest.raises(TypeError, match="VolumeFractionsAttribute"):
        ball.set_attribute("volume_fractions", pv.FloatAttribute(1))


def test_newer_nodes():
    block = pv.RectPrism.FromMinAndMax(pv.Vec3(1, 2, 3), pv.Vec3(3, 6, 9))
    assert block.bounding_box() == (pv.Vec3(1, 2, 3), pv.Vec3(3, 6, 9)) and block.volume(0.5) == 48
    assert block.volume(pv.Vec3(1, 1, 1)) == 48 and pv.Identity(block).bounding_box() == block.bounding_box()
    assert pv.Mirror("x", block).bounding_box() == (pv.Vec3(-3, 2, 3), pv.Vec3(-1, 6, 9))
    assert pv.Mirror("x", 4, block).bounding_box() == (pv.Vec3(5, 2, 3), pv.Vec3(7, 6, 9))
    low, high = pv.Mirror(pv.Vec3(4, 0, 0), pv.Vec3(2, 0, 0), block).bounding_box()
    assert numpy.allclose([*low, *high], [5, 2, 3, 7, 6, 9])
    assert pv.Scale(2, block).bounding_box() == (pv.Vec3(2, 4, 6), pv.Vec3(6, 12, 18))
    for turned in (pv.Rotate(0, 0, 90, block), pv.Rotate(pv.Vec3(0, 0, 90), block)):
        low, high = turned.bounding_box()  # about the middle, (2, 4, 6)
        assert numpy.allclose([*low, *high], [0, 3, 3, 4, 5, 9])
    assert pv.Torus(4, 1).evaluate(4, 0, 0) == -1


@pytest.mark.parametrize("make", [
    lambda: pv.FloatGrid(),
    lambda: pyvcad_compilers.GCVFCompiler(pv.Sphere()),
    lambda: pyvcad_rendering.select_mesh_patch(pv.Sphere())])
def test_what_is_missing_says_so(make):
    with pytest.raises(pv.MissingFeature, match="Ombre does not have this yet"):
        make()


@pytest.mark.parametrize("ask, near", [
    (lambda: pv.Spehre, "Sphere"), (lambda: pv.VolumeFractionAttribute, "VolumeFractionsAttribute"),
    (lambda: pv.Sphere().evalute(0, 0, 0), "evaluate"), (lambda: pyvcad_compilers.MeshCompilr, "MeshCompiler"),
    (lambda: pyvcad_rendering.Rendr, "Render")])
def test_misspelt_names_get_a_suggestion(ask, near):
    with pytest.raises(AttributeError, match=f"did you mean '{near}'"):
        ask()

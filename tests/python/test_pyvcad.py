"""pyvcad's interface: known values, the published listings, overlaps, changing trees, errors, the same designs in other
forms, compilers."""
import copy
import doctest
import importlib
import inspect
import math
import os
import pathlib
import pickle
import re
import subprocess
import sys

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_compilers as compilers
import pyvcad_rendering
import pyvcadviz

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
import png  # noqa: E402  beside the other tests

red, green, blue, gray = (pv.default_materials.id(name) for name in ("red", "green", "blue", "gray"))
origin = pv.Vec3(0, 0, 0)


def ball(radius=10.0, material=1):
    return pv.Sphere(origin, radius, material)


def graded_bar():
    """Blue at x = -10, red at x = 10."""
    return pv.FGrade(["0.5 + x/20", "0.5 - x/20"], [red, blue], True, pv.RectPrism(origin, pv.Vec3(20, 4, 4), gray))


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
    (pv.Strut(origin, pv.Vec3(10, 0, 0), 1), (12, 0, 0), 2),
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


# The listings of the 2025 paper.

def listing(number):
    return ombre.load(here / "listings" / f"listing{number}.py")


def test_listing_1():
    design = listing(1)
    assert design.bounds == ((-5, -5, -5), (5, 5, 5))
    assert design.volumes(0.5) == {"red": pytest.approx(1000)}


def test_listing_2():
    design = listing(2)
    volumes = design.volumes(0.25)
    assert sum(volumes.values()) == pytest.approx(750)
    assert volumes["red"] == pytest.approx(375, rel=0.02)
    points = [[-7.5, 0, 0], [-3.75, 1, 1], [0, 0, 0], [7.5, 0, 0]]
    assert numpy.allclose(design.material(points)["red"], [0, 0.25, 0.5, 1])
    assert numpy.allclose(design.material(points)["blue"], [1, 0.75, 0.5, 0])
    assert not design.material(points)["gray"].any()


def swatch(i, j):
    """Fractions of cyan, magenta and white: with three decimals, negative ones as zero, their sum one."""
    shares = [round(s, 3) for s in (i / 11, j / 11, 1 - (i / 11 + j / 11))]
    shares = [max(s, 0) for s in shares]
    return [s / sum(shares) for s in shares]


def test_listing_3():
    design = listing(3)
    assert design.bounds == ((-150, -150, -5), (150, 150, 5))
    assert design.volume(2.5) == pytest.approx(300 * 300 * 10)
    squares = [(i, j) for i in range(12) for j in range(12)]
    found = design.material([[25 * i - 137.5, 25 * j - 137.5, 0] for i, j in squares])
    columns = numpy.stack([found[name] for name in ("cyan", "magenta", "white")], axis=-1)
    assert numpy.allclose(columns, [swatch(i, j) for i, j in squares])


def picture(design, tmp_path, **options):
    path = tmp_path / "picture.png"
    design.render(path, **options)
    return png.Image(path.read_bytes())


def test_pictures_of_the_listings(tmp_path):
    cube, bar, sheet = (picture(listing(n), tmp_path / str(n), slice="z=0", size="240x240")
                        for n in (1, 2, 3) if not (tmp_path / str(n)).mkdir())
    middle = cube.rows[120][120]
    assert middle[:3] == tuple(pv.default_materials.color("red"))[:3]
    shades = [bar.rows[120][column] for column in (20, 120, 220)]
    assert shades[0][2] > shades[1][2] > shades[2][2]  # blue goes down,
    assert shades[0][0] < shades[1][0] < shades[2][0]  # red goes up
    corners = [sheet.rows[row][column][:3] for row, column in ((225, 15), (225, 225), (15, 15))]
    assert corners == [tuple(pv.default_materials.color(name))[:3] for name in ("white", "cyan", "magenta")]


@pytest.mark.parametrize("number", [1, 2, 3])
def test_listings_from_the_command_line(run_program, number, tmp_path):
    run_program("slice", here / "listings" / f"listing{number}.py", "--voxel", 2.5, "-o", "layers")
    assert sorted((tmp_path / "layers").glob("*.png"))


# Overlaps.

@pytest.mark.parametrize("operation", [pv.Union, pv.Intersection])
def test_first_child_wins_unless_told_to_mix(operation):
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


# Trees that change.

def test_changes_count_at_once():
    parts = pv.Union(False, [ball(1)])
    root = pv.Translate(10, 0, 0, parts)
    other = pv.Translate(0, 0, 0, ball(7))
    assert root.evaluate(0, 0, 0) == 9
    assert other.evaluate(0, 0, 0) == -7
    parts.add_child(pv.Sphere(-5, 0, 0, 1))
    assert root.evaluate(0, 0, 0) == 4
    root.set_child(ball(3))
    assert root.evaluate(0, 0, 0) == 7
    parts.add_child(ball(100))  # no longer below
    assert root.evaluate(0, 0, 0) == 7
    assert other.evaluate(0, 0, 0) == -7


def test_many_changes():
    inner = pv.Translate(0, 0, 0, ball(1))
    root = pv.Scale(1, 1, 1, pv.Union(False, [inner]))
    for radius in range(1, 200):
        inner.set_child(ball(radius))
        assert root.evaluate(0, 0, 0) == -radius


def test_changes_below_shared_nodes_count_everywhere():
    shared = pv.Union(False, [ball(1)])
    roots = [pv.Translate(x, 0, 0, shared) for x in (5, 10)]
    assert [root.evaluate(0, 0, 0) for root in roots] == [4, 9]
    shared.add_child(ball(2))
    assert [root.evaluate(0, 0, 0) for root in roots] == [3, 8]


def test_sides_of_a_difference_change():
    node = pv.Difference()
    node.set_left(ball(5))
    node.set_right(ball(2))
    assert node.evaluate(0, 0, 0) == 2
    node.set_right(ball(1))
    assert node.evaluate(0, 0, 0) == 1
    assert node.left().type() == "Sphere"


def test_clones_are_apart():
    inner = pv.Union(False, [ball(1)])
    root = pv.Translate(10, 0, 0, inner)
    twin = root.clone()
    inner.add_child(ball(5))
    assert (root.evaluate(0, 0, 0), twin.evaluate(0, 0, 0)) == (5, 9)
    twin.child().add_child(ball(3))
    assert (root.evaluate(0, 0, 0), twin.evaluate(0, 0, 0)) == (5, 7)


def test_copies_of_python_are_apart_too():
    root = pv.Translate(10, 0, 0, pv.Union(False, [ball(1)]))
    assert root.evaluate(0, 0, 0) == 9
    twins = [copy.deepcopy(root), pickle.loads(pickle.dumps(root))]
    root.child().add_child(ball(5))
    assert [node.evaluate(0, 0, 0) for node in (root, *twins)] == [5, 9, 9]


def test_what_a_node_was_made_with_can_change_afterwards():
    center = pv.Vec3(0, 0, 0)
    node = pv.Sphere(center, 1)
    center.x = 50
    assert node.evaluate(0, 0, 0) == -1


def test_children():
    a, b = ball(1), ball(2)
    union = pv.Union(False, [a])
    union.add_child(b)
    assert union.num_children() == 2
    assert union.child(1) is b
    assert union.children() == [a, b]
    assert pv.Translate().child() is None


def test_a_hundred_thousand_struts():
    corners = numpy.random.default_rng(1).uniform(0, 100, (100_000, 3)).tolist()
    lattice = pv.GraphLattice([(c, [c[0] + 1, c[1], c[2]]) for c in corners], 0.1, 1)
    assert lattice.evaluate(*corners[77_777]) <= -0.1 + 1e-9


# Python functions.

def test_functions_are_asked_about_one_point():
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


# Errors.

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
    (lambda: pv.Union(False, ball()), TypeError, "expected a list of nodes, found Sphere"),
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
    node = pv.FGrade(["1 +"], [1], True, ball())
    with pytest.raises(ombre.DesignError, match=r"test_pyvcad\.py:\d+: FGrade: "):
        node.prepare(1)


def test_solids_name_the_line_of_their_node():
    line = inspect.currentframe().f_lineno + 1
    parts = [pv.Translate(1, 0, 0, ball()), pv.Sphere(1, 0, 0, 2), pv.GraphLattice([(origin, (1, 0, 0))], 1)]
    for solid in (part._ombre_solid_() for part in parts):
        assert solid.place == (__file__, line)
        assert all(below.place[0] == __file__ for below in solid.inputs)


def test_warnings_name_the_line():
    implicit = pv.Function("r - 3")
    node = pv.FGrade(["0.5 + d", "0.5 - d"], [red, blue], True, implicit)
    with pytest.warns(ombre.DesignWarning, match=r"test_pyvcad\.py:\d+:\d+: warning: \"d\" is used"):
        node.prepare()


def test_cycles_are_found_in_every_walk():
    outer = pv.Union()
    outer.add_child(pv.Translate(1, 0, 0, outer))
    for question in (outer.clone, outer.material_list, outer.bounding_box):
        with pytest.raises(ombre.DesignError, match="lies below itself"):
            question()


@pytest.mark.parametrize("name", [
    "Voxels", "SimulationField", "PointMap", "Map", "Blend", "Convolution", "TetrahedralMesh",
    "HexahedralMesh"])
def test_what_is_missing_says_so(name):
    with pytest.raises(NotImplementedError, match=f"{name}: Ombre does not have this yet"):
        getattr(pv, name)()


@pytest.mark.parametrize("code, text", [
    (lambda: pv.TetrahedralMesh.from_tree(ball(), 30, 1, 1, 2, 1), "TetrahedralMesh.from_tree"),
    (lambda: compilers.InpWriter(), "InpWriter"),
    (lambda: compilers.DirectMaterialCompiler(ball(), 1, None, "x", "x", True, 2), "liquid_keep_out"),
])
def test_missing_forms_say_so(code, text):
    with pytest.raises(pv.MissingFeature, match=text):
        code()


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


# The same design in other forms.

def pyvcad_design():
    bar = pv.FGrade(["0.5 + x/20", "0.5 - x/20"], [red, blue], True, pv.RectPrism(origin, pv.Vec3(20, 4, 4)))
    struts = [pv.Strut(pv.Vec3(0, 0, 0), pv.Vec3(0, 0, 6), 1, green), pv.Translate(3, 0, 4, ball(1.5, gray))]
    body = pv.Union(False, [bar, *struts])
    return pv.Rotate(0, 0, 30, origin, pv.Difference(body, pv.Cylinder(pv.Vec3(5, 0, 0), 1, 20)))


def ombre_design():
    bar = ombre.rectprism((20, 4, 4)).fgrade(["0.5 + x/20", "0.5 - x/20"], ["red", "blue"])
    body = ombre.union(bar, ombre.strut((0, 0, 0), (0, 0, 6), 1, "green"),
                       ombre.sphere(1.5, "gray").translate(3, 0, 4), materials="first")
    return (body - ombre.cylinder(1, 20).translate(5, 0, 0)).rotate(0, 0, 30)


vcad_design = """
rotate(0, 0, 30) {
  difference() {
    union(materials="first") {
      fgrade(["0.5 + x/20", "0.5 - x/20"], ["red", "blue"], "prob") { rectprism((20, 4, 4)); }
      strut((0, 0, 0), (0, 0, 6), 1, "green");
      translate(3, 0, 4) { sphere(1.5, "gray"); }
    }
    translate(5, 0, 0) { cylinder(1, 20); }
  }
}
"""


def test_every_form_of_a_design_is_the_same(tmp_path):
    (tmp_path / "part.vcad").write_text(vcad_design)
    native = ombre_design().design()
    native.save(tmp_path / "part.json")
    designs = {"pyvcad": pyvcad_design()._ombre_design_(pv.default_materials), "ombre": native,
               "vcad": ombre.load(tmp_path / "part.vcad"), "json": ombre.load(tmp_path / "part.json"),
               "text": pv.parse_vcad_text(vcad_design, "")._ombre_design_(pv.default_materials)}
    assert len({design.hash for design in designs.values()}) == 1
    stacks = []
    for name, design in designs.items():
        design.slice(tmp_path / name, voxel=0.5)
        stacks.append({path.name: path.read_bytes() for path in (tmp_path / name).glob("*.png")})
    assert len(stacks[0]) == 16  # from z = -2 to 6
    assert all(stack == stacks[0] for stack in stacks)


def test_nodes_go_where_solids_go():
    mixed = ombre.union(ball(2, red), ombre.sphere(5, "blue"), materials="first")
    assert mixed.distance([10, 0, 0]) == 5
    assert pv.Union(False, [ombre.sphere(2, "green"), ball(5, red)]).distribution(0, 0, 0) == {green: 1}


# Render and Export.

def run_script(tmp_path, text, **environment):
    (tmp_path / "part.py").write_text("import pyvcad as pv\nroot = pv.Sphere(pv.Vec3(0, 0, 0), 5)\n" + text)
    kept = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    result = subprocess.run([sys.executable, "part.py"], cwd=tmp_path, text=True, capture_output=True, timeout=120,
                            env={**kept, **environment})
    assert result.returncode == 0, result.stderr
    return result.stderr


def test_render_writes_a_picture_where_there_is_no_display(tmp_path):
    script = "import pyvcad_rendering as viz\nviz.Render(root, pv.default_materials)\n"
    assert "written to ombre.png" in run_script(tmp_path, script)
    assert png.Image((tmp_path / "ombre.png").read_bytes()).width == 800
    assert "written to ball.png" in run_script(tmp_path, script, OMBRE_RENDER="ball.png")
    assert (tmp_path / "ball.png").read_bytes() == (tmp_path / "ombre.png").read_bytes()


def test_export_writes_what_it_is_told(tmp_path):
    plain = "import pyvcadviz as viz\nviz.Export(root, pv.default_materials())\n"
    assert "nothing is written without a path" in run_script(tmp_path, plain)
    assert "written to ball.stl" in run_script(tmp_path, plain, OMBRE_EXPORT="ball.stl")
    assert (tmp_path / "ball.stl").stat().st_size > 1000
    told = "import pyvcadviz as viz\nviz.Export(root, pv.default_materials, path='layers', voxel=1)\n"
    run_script(tmp_path, told)
    assert len(list((tmp_path / "layers").glob("*.png"))) == 10


def test_export_names_unknown_endings():
    with pytest.raises(ombre.DesignError, match="cannot write part.docx; known are a folder"):
        pyvcad_rendering.Export(ball(), path="part.docx")


def test_hosted_scripts_give_what_they_show(tmp_path):
    (tmp_path / "part.py").write_text("import pyvcad as pv\nimport pyvcadviz as viz\n"
                                      "viz.Render(pv.Sphere(pv.Vec3(0, 0, 0), 5, 6), pv.j750_materials)\n")
    design = ombre.load(tmp_path / "part.py")
    assert design.materials.names[6] == "VeroYellow"
    assert design.hash == ombre.load(tmp_path / "part.py").hash
    assert os.listdir(tmp_path) == ["part.py"]


@pytest.mark.parametrize("tail", ["root = part", "import pyvcadviz\npyvcadviz.Render(part, materials)"])
def test_materials_of_the_command_line_are_the_default_ones(tmp_path, tail):
    (tmp_path / "two.json").write_text('{"materials": [{"name": "one", "r": 1, "g": 2, "b": 3},'
                                       ' {"name": "two", "r": 4, "g": 5, "b": 6}]}')
    (tmp_path / "part.py").write_text("import pyvcad as pv\nmaterials = pv.default_materials\n"
                                      "part = pv.Sphere(0, 0, 0, 5, materials.id('two'))\n" + tail)
    assert ombre.load(tmp_path / "part.py", materials=tmp_path / "two.json").volumes(1).keys() == {"two"}


def test_older_and_newer_names_are_one():
    assert pyvcadviz.Render is pyvcad_rendering.Render and pyvcadviz.Export is pyvcad_rendering.Export


def test_the_manual_runs(run_program, tmp_path):
    manual = (here.parents[1] / "docs" / "pyvcad.md").read_text(encoding="utf-8")
    script = re.search(r"```python\n(.*?)```", manual, re.S)[1]
    (tmp_path / "bar.py").write_text(script)
    run_program("slice", "bar.py", "--voxel", 0.5, "-o", "layers")
    run_program("render", "bar.py", "-o", "bar.png")
    assert len(list((tmp_path / "layers").glob("*.png"))) == 10 and (tmp_path / "bar.png").exists()


def test_the_manual_lists_what_is_missing():
    manual = (here.parents[1] / "docs" / "pyvcad.md").read_text(encoding="utf-8")
    missing = manual[manual.index("## What is missing"):manual.index("## What is different")]
    for name in pv.__all__:
        is_missing = getattr(pv, name).__module__ == "pyvcad._missing" if isinstance(getattr(pv, name), type) else False
        assert (f"`{name}`" in missing) == is_missing or name in ("MissingFeature", "GraphLattice", "LatticeType",
                                                                  "Function", "Mesh", "Translate", "Union"), name


@pytest.mark.parametrize("module", ["_tree", "_vectors"])
def test_examples_in_texts(module):
    results = doctest.testmod(importlib.import_module("pyvcad." + module))
    assert results.attempted and not results.failed


def test_import_needs_no_display_and_no_windows(tmp_path):
    assert run_script(tmp_path, "import pyvcad_rendering, pyvcadviz, pyvcad_compilers, sys\n"
                                "assert not {'tkinter', 'vtk', 'IPython'} & set(sys.modules)\n") == ""


# Compilers.

def test_direct_material_compiler_writes_what_slicing_writes(tmp_path):
    shares = []
    compiler = compilers.DirectMaterialCompiler(graded_bar(), pv.Vec3(0.5, 0.5, 1), pv.default_materials,
                                                str(tmp_path / "out"), "bar", False, 0)
    compiler.setProgressCallback(shares.append)
    compiler.compile()
    compiler.compile()  # replaces
    graded_bar()._ombre_design_().slice(tmp_path / "job", voxel=(0.5, 0.5, 1))
    assert shares[-1] == 1 and all(0 <= s <= 1 for s in shares)
    names = sorted(os.listdir(tmp_path / "out"))
    assert names == [f"bar_{i:05}.png" for i in range(4)]
    for i, name in enumerate(names):
        assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "job" / f"slice_{i:05}.png").read_bytes()


def test_grayscale_compiler(tmp_path):
    compiler = compilers.GrayscaleCompiler(graded_bar(), 1, pv.Vec3(40, 20, 30), blue, red, tmp_path, "gray_")
    compiler.compile()
    images = [png.Image(path.read_bytes()) for path in sorted(tmp_path.glob("*.png"))]
    assert [(i.width, i.height) for i in images] == [(40, 20)] * 4
    row = [pixel[0] for pixel in images[0].rows[10]]
    assert row[:10] == row[30:] == [0] * 10
    # Centres of voxels lie at x = -9.5 ... 9.5.
    assert row[10:30] == [round(255 * (0.5 + (i - 9.5) / 20)) for i in range(20)]
    assert not any(pixel[0] for pixel in images[0].rows[7])


def test_grayscale_compiler_refuses_other_materials_and_sizes(tmp_path):
    with pytest.raises(ombre.DesignError, match=f"the material {blue} beside the low one"):
        compilers.GrayscaleCompiler(graded_bar(), 1, pv.Vec3(40, 20, 30), gray, red, tmp_path, "a").compile()
    with pytest.raises(ombre.DesignError, match="20 × 4 × 4 mm, more than the printer's volume of 10 × 10 × 10 mm"):
        compilers.GrayscaleCompiler(graded_bar(), 1, pv.Vec3(10, 10, 10), blue, red, tmp_path, "a").compile()


def test_mesh_compiler(tmp_path):
    for bands in (1, 4):
        compilers.MeshCompiler(graded_bar(), 0.5, tmp_path, f"bar{bands}", bands).compile()
    whole = ombre.mesh(str(tmp_path / "bar1.3mf"))
    assert whole.volume(0.25) == pytest.approx(20 * 4 * 4)
    assert pv.Mesh(str(tmp_path / "bar1.3mf")).evaluate(0, 0, 0) == pytest.approx(-2)
    assert (tmp_path / "bar4.3mf").stat().st_size > (tmp_path / "bar1.3mf").stat().st_size


def area(outline):
    """By the shoelace formula: positive for counterclockwise outlines, mm2."""
    return sum(a.x * b.y - b.x * a.y for a, b in zip(outline, outline[1:] + outline[:1])) / 2


def test_cross_sections():
    ring = pv.Difference(pv.Cylinder(origin, 5, 10), pv.Cylinder(origin, 2, 20))
    slicer = compilers.CrossSectionSlicer(ring, pv.Vec3(-6, -6, -6), pv.Vec3(6, 6, 6), 0.1)
    areas = sorted(area(outline) for outline in slicer.slice_geometry(0))
    assert areas == [pytest.approx(-math.pi * 4, rel=0.01), pytest.approx(math.pi * 25, rel=0.01)]
    assert slicer.slice_geometry(5.5) == []
    half = compilers.CrossSectionSlicer(ring, pv.Vec3(0, -6, -6), pv.Vec3(6, 6, 6), 0.1).slice_geometry(0)
    assert sum(map(area, half)) == pytest.approx(math.pi * 21 / 2, rel=0.01)

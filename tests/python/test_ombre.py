"""The package ombre: values against mathematics, the same designs in other forms, errors."""
import doctest
import fractions
import gc
import importlib
import json
import math
import os
import pathlib
import pickle
import re
import subprocess
import sys
import threading

import numpy
import pytest

import ombre
from ombre import cos, rho, sin, where, x, y, z


def random_points(count=2000, size=8.0):
    return numpy.random.default_rng(7).uniform(-size, size, (count, 3))


# Shapes and materials.

def test_sphere_against_mathematics():
    points = random_points()
    ball = ombre.sphere(5)
    assert numpy.allclose(ball.distance(points), numpy.linalg.norm(points, axis=1) - 5, atol=1e-12)
    assert (ball.inside(points) == (numpy.linalg.norm(points, axis=1) <= 5)).all()
    assert ball.distance([15, 0, 0]) == 10
    assert numpy.allclose(ball.gradient(points), points / numpy.linalg.norm(points, axis=1, keepdims=True), atol=1e-7)
    assert numpy.allclose(ball.nearest([15, 0, 0]), [5, 0, 0], atol=1e-9)
    assert ball.bounds == ((-5, -5, -5), (5, 5, 5))
    assert ball.distance(points.reshape(10, 20, 10, 3)).shape == (10, 20, 10)


def test_volume_and_voxels():
    box = ombre.rectprism((4, 2, 1))
    assert box.volume(0.1) == pytest.approx(8)
    grid = box.voxels(0.5)
    assert grid.values.shape == (2, 4, 8) and grid.spacing == (0.5, 0.5, 0.5)
    assert grid.origin == (-1.75, -0.75, -0.25)
    assert numpy.allclose(grid.centers()[1, 3, 7], [1.75, 0.75, 0.25])
    assert ombre.sphere(5).volume() == pytest.approx(4 / 3 * math.pi * 125, rel=1e-3)
    assert box.voxels(0.5, "distance").values.max() < 0
    half = box.with_material(["red", "blue"], [1, 3])
    assert (half.voxels(0.5, "blue").values == 0.75).all()
    assert half.volumes(0.05)["blue"] == pytest.approx(6, rel=0.03)


def test_nothing_is_a_solid():
    nothing, ball, block = ombre.empty(), ombre.sphere(3), ombre.cube(2)
    points = random_points(size=4.0)
    for solid in (nothing, ombre.union([]), ombre.difference([], ball), nothing - ball, ombre.intersection(ball, []),
                  ball & nothing, ombre.translate([], (1, 2, 3)), nothing.grade({"red": "x", "blue": "y"}),
                  nothing.offset(1), ombre.text(""), ombre.hull([]), ombre.tube([], 1), ombre.sum([nothing])):
        assert solid.type == "empty" and not solid.inside(points).any()
    for solid in (block - nothing, block | nothing, nothing | block, ombre.union(block, []), block & ~nothing,
                  ombre.sum(block, nothing, blend=1)):
        assert (solid.inside(points) == block.inside(points)).all()
    with pytest.raises(ombre.DesignError, match="the design is empty"):
        nothing.bounds
    with pytest.raises(TypeError, match="translate needs a solid"):
        ombre.translate((1, 2, 3))


def test_nothing_in_design_files():
    def design(kind, *inputs):
        nodes = [{"id": "none", "type": "empty"}, {"id": "ball", "type": "sphere", "parameters": {"radius": 3}},
                 {"id": "gone", "type": "union", "inputs": []},
                 {"id": "moved", "type": "translate", "parameters": {"by": [1, 0, 0]}, "inputs": ["none"]},
                 {"id": "top", "type": kind, "inputs": list(inputs)}]
        return ombre.Design.from_json(json.dumps({
            "format": "ombre-design", "version": 1, "materials": [{"name": "red", "r": 255, "g": 0, "b": 0}],
            "nodes": nodes, "parts": [{"name": "part", "node": "top"}]}))
    points = random_points(size=4.0)
    inside = ombre.sphere(3).inside(points)
    for none in ("none", "gone", "moved"):
        assert not design("difference", none, "ball").inside(points).any()
        assert not design("intersection", "ball", none).inside(points).any()
        assert (design("difference", "ball", none).inside(points) == inside).all()
        assert (design("union", none, "ball").inside(points) == inside).all()
        assert ombre.Design.from_json(design("negate", none).to_json()).inside(points).all()


@pytest.mark.parametrize("voxel", [25.4 / 300, numpy.float64(25.4 / 300), numpy.array([25.4 / 300]), "25.4/300", "8.466666666666667e-2",
                                   fractions.Fraction(127, 1500), [25.4 / 300, "25.4/300", 25.4 / 300]])
def test_voxel_sizes_that_a_program_computed(voxel):
    design = ombre.Design(ombre.sphere(2), box=((-2, -2, -2), (2, 2, 2)), voxel=voxel)
    assert json.loads(design.to_json())["sampling"]["voxel"] == ["127/1500"] * 3
    assert ombre.sphere(2).voxels(voxel).values.shape == (48, 48, 48)


def test_voxel_sizes_in_single_precision():
    design = ombre.Design(ombre.sphere(2), box=((-2, -2, -2), (2, 2, 2)), voxel=numpy.float32([0.1, 0.5, 0.027]))
    assert json.loads(design.to_json())["sampling"]["voxel"] == ["0.1", "0.5", "0.027"]


def test_scripts_that_are_links(tmp_path, run_program):
    (tmp_path / "real").mkdir()
    (tmp_path / "real" / "sizes.py").write_text("side = 4\n")
    (tmp_path / "real" / "block.obj").write_text("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    (tmp_path / "real" / "part.py").write_text("import ombre, sizes\nroot = ombre.mesh('block.obj') | ombre.cube(sizes.side)\n")
    (tmp_path / "part.py").symlink_to("real/part.py")
    assert ombre.load(str(tmp_path / "part.py")).bounds == ((-2, -2, -2), (4, 4, 4))
    assert "inside" in run_program("probe", "part.py", "--at", "3,0.1,0.1").stdout


def test_operators_and_chains():
    a, b = ombre.sphere(5), ombre.cube(6).translate(z=3)
    points = random_points()
    da, db = a.distance(points), b.distance(points)
    assert ((a | b).inside(points) == ((da <= 0) | (db <= 0))).all()
    assert ((a & b).inside(points) == ((da <= 0) & (db <= 0))).all()
    assert ((a - b).inside(points) == ((da <= 0) & (db >= 0))).all()
    assert ((~a).inside(points) == (da >= 0)).all()
    assert (a + (1, 2, 3)).distance([1, 2, 3]) == -5
    assert (a - numpy.array([1, 2, 3])).distance([-1, -2, -3]) == -5
    assert ombre.union(a, [b, ombre.cube(2)]).inputs[1] == b
    assert ombre.translate([a, b], (1, 0, 0)).type == "translate"


def test_chains_are_one_node():
    a, b, c = ombre.cube(4, "red"), ombre.cube(4, "blue"), ombre.cube(4, "green")
    assert (a | b | c) == ombre.union(a, b, c) and (a | (b | c)) == ombre.union(a, ombre.union(b, c))
    assert (a & b & c) == ombre.intersection(a, b, c) and (a - b - c) == ombre.difference(a, b, c)
    assert (ombre.union(a, b) | c) == ombre.union(ombre.union(a, b), c)  # as it was written
    assert (a - b | c) == ombre.union(ombre.difference(a, b), c)
    assert (a | b | c).material([0, 0, 0])["red"] == pytest.approx(1 / 3)
    row = ombre.sphere(1)
    for n in range(2000):
        row = row | ombre.sphere(1).translate(x=3 * n)
    assert row.inside([3 * 1999, 0, 0.9]) and len(row.inputs) == 2001


def test_vectors_come_in_many_forms():
    forms = [(1, 2, 3), [1, 2, 3], numpy.array([1, 2, 3]), numpy.array([1, 2, 3], dtype=numpy.float32)]
    assert len({ombre.sphere(1).translate(v).hash for v in forms}) == 1
    assert ombre.sphere(numpy.float32(1.5)).parameters["radius"] == 1.5


# One meaning, many ways to write it.

def test_expressions_strings_and_functions_agree():
    inside = [[0.5, 0.25, 3], [1, 2, -1], [-2, 1, 0.5]]
    text = "0.5 + sin(x)*rho/40 - (y - 1)^2/50"
    written = 0.5 + sin(x) * rho / 40 - (y - 1) ** 2 / 50
    def typed(x, y, rho):
        return 0.5 + numpy.sin(x) * rho / 40 - (y - 1) ** 2 / 50
    parts = [ombre.sphere(9).grade({"red": f, "blue": 0.5}) for f in (text, written, typed)]
    values = [part.material(inside)["red"] for part in parts]
    assert parts[0].hash == parts[1].hash
    assert numpy.array_equal(values[0], values[1])
    assert numpy.allclose(values[0], values[2], rtol=1e-14)
    volumes = [part.volumes(0.25)["red"] for part in parts]
    assert volumes[0] == volumes[1] == pytest.approx(volumes[2], rel=1e-3)


@pytest.mark.parametrize("expression, function", [
    (x - y - z, lambda x, y, z: x - y - z), (x - (y - z), lambda x, y, z: x - (y - z)),
    (x / y / z, lambda x, y, z: x / y / z), (x / (y / z), lambda x, y, z: x / (y / z)),
    (2 ** x ** 2, lambda x, y, z: 2 ** x ** 2), ((2 ** x) ** 2, lambda x, y, z: (2 ** x) ** 2),
    (-x ** 2, lambda x, y, z: -x ** 2), ((-x) ** 2, lambda x, y, z: (-x) ** 2), (3 - -x, lambda x, y, z: 3 + x),
    (x * -2.5, lambda x, y, z: x * -2.5), (abs(x) % 2, lambda x, y, z: abs(x) % 2),
    (where((x < y) & (y < z) | ~(z > 0), x, 1), lambda x, y, z: numpy.where((x < y) & (y < z) | ~(z > 0), x, 1)),
    (numpy.sin(x) + numpy.maximum(y, z), lambda x, y, z: numpy.sin(x) + numpy.maximum(y, z)),
    (numpy.float64(2) * cos(x), lambda x, y, z: 2 * numpy.cos(x)), (1e-20 * x, lambda x, y, z: 1e-20 * x)])
def test_operators_mean_what_python_means(expression, function):
    points = random_points(200, 3)
    assert numpy.allclose(expression(points), function(*points.T), rtol=1e-12)


def test_same_design_in_every_language(tmp_path, run_program):
    (tmp_path / "part.vcad").write_text("""
        difference() {
          fgrade(["0.5 + x/20", "0.5 - x/20"], ["red", "blue"]) { rectprism((20, 5, 5)); }
          translate(0, 0, 1) { cylinder(r=1, h=10); }
        }""")
    (tmp_path / "part.py").write_text(
        "import ombre\nfrom ombre import x\n"
        "bar = ombre.rectprism((20, 5, 5)).grade({'red': 0.5 + x/20, 'blue': 0.5 - x/20})\n"
        "root = bar - ombre.cylinder(r=1, h=10).translate(z=1)\n")
    script, python = ombre.load(tmp_path / "part.vcad"), ombre.load(tmp_path / "part.py")
    python.save(tmp_path / "part.json")
    assert script.hash == python.hash == ombre.load(tmp_path / "part.json").hash
    assert script == python and len({script, python}) == 1
    for ending in ("vcad", "py", "json"):
        run_program("slice", f"part.{ending}", "--voxel", "0.2", "-o", ending)
    python.slice(tmp_path / "memory", voxel=0.2)
    names = sorted(p.name for p in (tmp_path / "vcad").glob("*.png"))
    assert len(names) == 25
    for other in ("py", "json", "memory"):
        assert names == sorted(p.name for p in (tmp_path / other).glob("*.png"))
        for name in names:
            assert (tmp_path / "vcad" / name).read_bytes() == (tmp_path / other / name).read_bytes()


def test_the_knob_of_the_readme_is_the_same_in_both_languages(tmp_path):
    text = (pathlib.Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    script = re.search(r"```openscad\n(.*?)```", text, re.DOTALL)[1]
    python = re.search(r"```python\n(.*?)```", text, re.DOTALL)[1]
    (tmp_path / "knob.vcad").write_text(script)
    (tmp_path / "knob.py").write_text(python.replace("knob.slice", "root = knob\n# "))
    assert ombre.load(tmp_path / "knob.vcad") == ombre.load(tmp_path / "knob.py")


def test_designs_pickle_hash_and_compare(tmp_path):
    part = ombre.sphere(5).grade({"red": 0.5 + x / 20, "blue": 0.5})
    again = pickle.loads(pickle.dumps(part))
    assert again == part and hash(again) == hash(part) and again is not part
    assert part != ombre.sphere(5)
    design = ombre.Design(ombre.cube(2), box=((-1, -1, -1), (1, 1, 1)), voxel="25.4/600")
    assert pickle.loads(pickle.dumps(design)) == design
    design.save(tmp_path / "d.json")
    with pytest.raises(FileExistsError, match="force=True"):
        design.save(tmp_path / "d.json")
    assert ombre.load(tmp_path / "d.json") == design


def test_attributes_and_parts():
    body = ombre.cube(4).with_attribute("infill", 0.2 + z / 10).with_attribute("modulus", 7)
    assert body.attributes == ["infill", "modulus"]
    assert numpy.allclose(body.attribute("infill", [[0, 0, 1], [0, 0, -1]]), [0.3, 0.1])
    case = ombre.Design(lid=ombre.cube(1), body=body)
    assert [name for name, _ in case.parts] == ["lid", "body"]


def test_materials_of_ones_own(tmp_path):
    (tmp_path / "mine.json").write_text(json.dumps({"materials": [{"name": "soft", "r": 1, "g": 2, "b": 3, "a": 255},
                                                                  {"name": "hard", "r": 9, "g": 9, "b": 9, "a": 255}]}))
    with ombre.Materials(tmp_path / "mine.json") as mine:
        part = ombre.sphere(5, "hard")
        assert mine.names == ["void", "soft", "hard"] and mine.colour("soft") == (1, 2, 3, 255)
    assert part.volumes(0.5)["hard"] > 0 and "hard" in part.materials
    with pytest.raises(ValueError, match="other materials"):
        part | ombre.cube(2)
    with pytest.raises(KeyError, match="there are void, soft, hard"):
        mine["medium"]


def test_meshes_keep_the_materials_of_their_file(tmp_path):
    box = ombre.cube(4, "red") | ombre.cube(4, "blue").translate(x=4)
    box.mesh(tmp_path / "two.3mf", by="materials")
    kept = ombre.mesh(tmp_path / "two.3mf", materials="names")
    assert kept.volumes(0.1) == pytest.approx({"red": 64, "blue": 64}, rel=1e-3)
    mapped = ombre.mesh(tmp_path / "two.3mf", materials="names", material_map={"red": "white"})
    assert mapped.volumes(0.1) == pytest.approx({"white": 64, "blue": 64}, rel=1e-3)


# Functions of Python.

def test_functions_of_all_kinds():
    ball = ombre.function(ombre.pointwise(lambda x, y, z: math.sqrt(x * x + y * y + z * z) - 3),
                          min=(-4, -4, -4), max=(4, 4, 4))
    assert ball.volume(0.2) == pytest.approx(36 * math.pi, rel=0.02)
    shell = ombre.sphere(5).grade({"red": lambda d: (d > -1) * 1.0, "blue": lambda d: (d <= -1) * 1.0})
    assert shell.material([[0, 0, 0], [4.5, 0, 0]])["red"].tolist() == [0, 1]
    assert ombre.sphere(lambda x, y, z: 4.0).inside([3.9, 0, 0])


def test_functions_are_neither_saved_nor_resumed(tmp_path):
    part = ombre.cube(2).grade({"red": lambda x: x * 0 + 1})
    with pytest.raises(ombre.DesignError, match="neither saved, copied to another process nor resumed"):
        part.save(tmp_path / "part.json")
    with pytest.raises(ombre.DesignError):
        pickle.dumps(part)
    part.slice(tmp_path / "layers", voxel=0.5)
    with pytest.raises(ombre.DesignError, match="resumed"):
        part.slice(tmp_path / "layers", voxel=0.5, resume=True)


@pytest.mark.parametrize("function, cause", [
    (lambda x, y, z: 1 / 0, ZeroDivisionError), (lambda x, y, z: numpy.zeros(3), ValueError),
    (lambda x, y, z: "red", ValueError), (lambda x, y, z: None, (TypeError, ValueError)),
    (lambda x, y, z: math.sqrt(x), TypeError)])
def test_functions_that_fail(function, cause):
    part = ombre.function(function, min=(0, 0, 0), max=(1, 1, 1))
    for attempt in (lambda: part.distance(random_points(50)), lambda: part.volume(0.1)):
        with pytest.raises(ombre.FunctionError) as failure:
            attempt()
        if not isinstance(failure.value.__cause__, cause):
            raise AssertionError(repr(failure.value.__cause__))
        assert len(failure.value.point) == 3
        assert failure.value.path == "part > function" and failure.value.place[0] == __file__
    assert part.bounds == ((0, 0, 0), (1, 1, 1))  # what failed can still be used, and others go on
    assert ombre.cube(1).distance([0, 0, 0]) == -0.5


def test_functions_may_end_the_program():
    def leave(x):
        raise SystemExit(3)
    with pytest.raises(SystemExit):
        ombre.function(leave, min=(-1, -1, -1), max=(1, 1, 1)).volume(0.5)


def test_what_is_no_number_is_outside():
    points = [[math.nan, 0, 0], [math.inf, 0, 0], [0, 0, 0]]
    part = ombre.sphere(5) | ombre.cube(3, "blue")
    assert part.inside(points).tolist() == [False, False, True]
    assert part.material(points)["red"].tolist() == [0, 0, 0.5]


# Errors.

@pytest.mark.parametrize("wrong, kind, part", [
    (lambda: ombre.sphere(radus=3), ombre.DesignError, 'did you mean "radius"'),
    (lambda: ombre.sphere(-3), ombre.DesignError, "greater than 0"),
    (lambda: ombre.sphere(1, 2, 3, 4), ombre.DesignError, "at most 2 arguments"),
    (lambda: ombre.sphere("rad"), ombre.DesignError, 'no variable "rad"'),
    (lambda: ombre.sphere(3, "rod"), ombre.DesignError, 'did you mean "red"'),
    (lambda: ombre.sphere(object()), TypeError, "expected a number"),
    (lambda: ombre.rectprism((1, 2)), ombre.DesignError, "three numbers"),
    (lambda: ombre.translate((1, 2, 3)), TypeError, "needs a solid"),
    (lambda: ombre.sphere(ombre.cube(1)), TypeError, "takes no solids"),
    (lambda: ombre.cube(1).trnslate(z=3), AttributeError, "did you mean 'translate'"),
    (lambda: ombre.cube(1) | 3, TypeError, "unsupported operand"),
    (lambda: bool(x), TypeError, "where"),
    (lambda: ombre.sphere(x + math.inf), ValueError, "cannot hold inf"),
    (lambda: ombre.cube(1).grade({"red": lambda q: q}), TypeError, "known are x, y, z"),
    (lambda: ombre.sphere(lambda d: d), TypeError, "takes d"),
    (lambda: ombre.cube(1).distance([1, 2]), ValueError, r"shape \(..., 3\)"),
    (lambda: ombre.cube(1).attribute("infill", [0, 0, 0]), ombre.DesignError, 'no attribute "infill"'),
    (lambda: ombre.cube(1).voxels(0.5, "steel"), ombre.DesignError, "'steel' is neither"),
    (lambda: ombre.cube(1).mesh("x.xyz"), ombre.DesignError, "let it end in"),
    (lambda: ombre.cube(1).slice("x", prnter="j750"), TypeError, "did you mean 'printer'"),
    (lambda: ombre.cube(1).slice("x", printer="j75"), ombre.DesignError, "j750"),
    (lambda: ombre.half_space((0, 0, 1)).volume(), ombre.DesignError, "unbounded along"),
    (lambda: ombre.Design(), ValueError, "at least one part"),
    (lambda: ombre.Design(3), TypeError, "expected a solid"),
    (lambda: ombre.Design(ombre.cube(1), part=ombre.cube(1)), ValueError, "two parts"),
    (lambda: ombre.sphere(10 ** 400), OverflowError, "too large"),
    (lambda: ombre.sphere(3, "\ud800"), UnicodeEncodeError, "surrogates"),
    (lambda: ombre.load("nowhere.vcad"), ombre.MachineError, "nowhere.vcad"),
    (lambda: ombre.load("nowhere.py"), ombre.DesignError, "nowhere.py"),
    (lambda: ombre.mesh("nowhere.stl"), (ombre.MachineError, ombre.DesignError), "nowhere.stl"),
    (lambda: ombre.Solid(), TypeError, "ombre.sphere"),
    (lambda: ombre.Design.from_json("{"), ombre.DesignError, "design.json")])
def test_wrong_input_is_explained(wrong, kind, part, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(kind, match=part):
        wrong()


def test_errors_name_the_line():
    with pytest.raises(ombre.DesignError) as error:
        ombre.sphere(radus=3)
    diagnostic = error.value.diagnostics[0]
    assert diagnostic["file"] == __file__ and "ombre.sphere(radus=3)" in str(error.value)


def test_failed_checks_name_the_node_and_the_point(tmp_path):
    part = ombre.cube(2).grade({"red": "x > 0", "blue": 0})  # no material where x is 0 or less
    with pytest.raises(ombre.CheckError, match="fgrade are all zero") as error:
        part.slice(tmp_path / "strict", voxel=0.5, strict=True)
    assert error.value.point == (-0.75, -0.75, -0.75)
    assert error.value.checks[0]["voxels"] > 0 and pathlib.Path(__file__).name in error.value.checks[0]["text"]
    with pytest.warns(ombre.DesignWarning, match="fgrade are all zero"):
        report = part.slice(tmp_path / "layers", voxel=0.5)
    assert report["voxels"] == [4, 4, 4]


def test_deep_chains_are_refused():
    part = ombre.cube(1)
    with pytest.raises(ombre.DesignError, match="deeper than 400"):
        for _ in range(500):
            part = part.translate(z=1)


def test_threads_may_sample_at_once():
    part = ombre.union([ombre.sphere(1).translate(p) for p in random_points(100)])
    points = random_points(20000)
    wanted = part.distance(points)
    results = [None] * 4

    def sample(n):
        results[n] = part.distance(points, threads=1)
    threads = [threading.Thread(target=sample, args=(n,)) for n in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(numpy.array_equal(result, wanted) for result in results)


def memory_kb():
    return int(next(line for line in open("/proc/self/status") if line.startswith("VmRSS")).split()[1])


def test_nodes_do_not_leak():
    def many(count):
        for n in range(count):
            ombre.sphere(1 + n % 7, "red").translate(z=n).grade({"red": 0.5 + x / 20, "blue": 0.5})
    many(5000)
    gc.collect()
    before = memory_kb()
    many(34000)  # three nodes each
    gc.collect()
    assert memory_kb() - before < 10_000


def test_import_needs_no_display():
    without = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    subprocess.run([sys.executable, "-W", "error", "-c", "import ombre, pyvcad, pyvcadviz, pyvcad_compilers, pyvcad_metamaterials"],
                   env=without, check=True)


def test_scripts_on_the_command_line(tmp_path, run_program):
    (tmp_path / "part.py").write_text("import ombre\nroot = ombre.sphere(ombre.option('radius', 2))\n")
    (tmp_path / "none.py").write_text("a = 1\n")
    (tmp_path / "raises.py").write_text("def f():\n    return 1/0\nf()\n")
    (tmp_path / "asks.py").write_text("import ombre\nroot = ombre.function(lambda x: 1/0, min=(0,0,0), max=(1,1,1))\n")
    assert "inside" in run_program("probe", "part.py", "--at", "0,0,1.9").stdout
    assert "outside" in run_program("probe", "part.py", "-D", "radius=1", "--at", "0,0,1.9").stdout
    assert "give the solid the name root" in run_program("probe", "none.py", "--at", "0,0,0", status=1).stderr
    assert "ZeroDivisionError" in run_program("probe", "raises.py", "--at", "0,0,0", status=1).stderr
    assert "ZeroDivisionError" in run_program("slice", "asks.py", status=1).stderr
    run_program("run", "part.py", "--", "-o", "part.stl")
    run_program("run", "part.py", "--", "slice", "--voxel", "0.5", "-o", "layers")
    assert (tmp_path / "part.stl").exists() and (tmp_path / "layers" / "job.json").exists()
    assert "write -- before" in run_program("run", "part.py", "-o", "x", status=1).stderr


def test_the_program_becomes_python(tmp_path):
    program = os.environ.get("OMBRE_PROGRAM")
    if not program:
        pytest.skip("OMBRE_PROGRAM does not name the program")
    (tmp_path / "part.py").write_text("import ombre\nroot = ombre.sphere(2)\n")

    def run(*arguments, **environment):
        return subprocess.run([program, *arguments], cwd=tmp_path, capture_output=True, text=True,
                              env={**os.environ, "OMBRE_PYTHON": sys.executable, **environment})
    assert "inside" in run("probe", "part.py", "--at", "0,0,1.9").stdout
    assert run("slice", "part.py", "--voxel", "0.5", "-o", "layers").returncode == 0
    assert run("slice", "part.py", OMBRE_PYTHON="/nowhere/python").returncode == 2
    lost = run("probe", "part.py", "--at", "0,0,0", OMBRE_PYTHON="/nowhere/python").stderr
    assert "cannot run /nowhere/python" in lost


# Texts.

@pytest.mark.parametrize("name", ["_design", "_expressions", "_functions", "_materials", "_script", "_solid", "_values"])
def test_examples_in_docstrings(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    failures, count = doctest.testmod(importlib.import_module("ombre." + name))
    assert failures == 0


def test_prints_of_a_design_stay_out_of_stdout(tmp_path):
    (tmp_path / "loud.py").write_text("import ombre\nprint('loud')\nroot = ombre.sphere(3, 'blue')\n")
    made = subprocess.run([sys.executable, "-m", "ombre", "slice", "loud.py", "--emit", "json"], cwd=tmp_path,
                          capture_output=True, text=True, check=True)
    assert json.loads(made.stdout)["format"] == "ombre-design"
    assert made.stderr == "loud\n"


def test_every_node_has_a_class_with_its_text():
    listed = subprocess.run([sys.executable, "-m", "ombre", "nodes", "--json"], capture_output=True, text=True,
                            check=True)
    for line in listed.stdout.splitlines():
        node = json.loads(line)
        if node["event"] != "node":
            continue  # an operator of a library
        kind = getattr(ombre, node["name"])
        assert issubclass(kind, ombre.Solid if node["gives"] == "solid" else ombre.Value) and node["sentence"] in kind.__doc__
        for parameter in node["parameters"]:
            assert parameter["doc"] in kind.__doc__


# Designs that are texts; files that are loaded again.

TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n{0} 0 0\n0 {0} 0\n0 0 {0}\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"


def test_load_text_reads_files_beside_it(tmp_path):
    (tmp_path / "a.off").write_text(TETRAHEDRON.format(6))
    design = ombre.load_text('n = 1; scale(n) mesh("a.off", "red");', folder=tmp_path, n=2)
    assert design.volume(0.1) == pytest.approx(12 ** 3 / 6, rel=0.01)
    again = ombre.load_text(design.to_json(), name="design.json")
    assert again.hash == design.hash
    with pytest.raises(ombre.DesignError, match="here.vcad:1"):
        ombre.load_text("sphere(", name="here.vcad")
    with pytest.raises(ValueError, match="end it with .vcad or .json"):
        ombre.load_text("sphere(1);", name="design.py")


def test_files_are_read_again_only_when_they_change(tmp_path):
    mesh, script = tmp_path / "a.off", tmp_path / "a.vcad"
    script.write_text('mesh("a.off", "red");')
    mesh.write_text(TETRAHEDRON.format(6))
    for file in (mesh, script):
        os.utime(file, (1e9, 1e9))
    assert ombre.load(script).bounds[1] == (6, 6, 6)
    reads = ombre.source_memory()["file_reads"]
    assert ombre.load(script).bounds[1] == (6, 6, 6)
    assert ombre.source_memory()["file_reads"] == reads
    mesh.write_text(TETRAHEDRON.format(7))
    assert ombre.load(script).bounds[1] == (7, 7, 7)
    limit = ombre.source_memory()["most_bytes"]
    assert ombre.source_memory(0)["bytes"] == 0
    assert ombre.source_memory(limit)["most_bytes"] == limit

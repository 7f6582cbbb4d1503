"""The published listings, the same designs in other forms, pictures, and compilers of pyvcad."""
import doctest
import importlib
import math
import os
import pathlib
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
from pyvcad_parts import ball, blue, graded_bar, gray, green, origin, red

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
import png  # noqa: E402  beside the other tests


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
    result = subprocess.run([sys.executable, "part.py"], cwd=tmp_path, text=True, capture_output=True,
                            env={**kept, **environment})
    assert result.returncode == 0, result.stderr
    return result.stderr


def test_render_writes_a_picture_where_there_is_no_display(tmp_path):
    script = "import pyvcad_rendering as viz\nviz.Render(root, pv.default_materials)\n"
    assert "written to ombre.png" in run_script(tmp_path, script)
    assert png.Image((tmp_path / "ombre.png").read_bytes()).width == 800
    assert "written to ball.png" in run_script(tmp_path, script, OMBRE_RENDER="ball.png")
    assert (tmp_path / "ball.png").read_bytes() == (tmp_path / "ombre.png").read_bytes()


def test_export_writes_what_it_is_reported(tmp_path):
    plain = "import pyvcadviz as viz\nviz.Export(root, pv.default_materials())\n"
    assert "nothing is written without a path" in run_script(tmp_path, plain)
    assert "written to ball.stl" in run_script(tmp_path, plain, OMBRE_EXPORT="ball.stl")
    assert (tmp_path / "ball.stl").stat().st_size > 1000
    reported = "import pyvcadviz as viz\nviz.Export(root, pv.default_materials, path='layers', voxel=1)\n"
    run_script(tmp_path, reported)
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
    manual = (here.parents[1] / "docs" / "user" / "pyvcad.md").read_text(encoding="utf-8")
    script = re.search(r"```python\n(.*?)```", manual, re.S)[1]
    (tmp_path / "bar.py").write_text(script)
    run_program("slice", "bar.py", "--voxel", 0.5, "-o", "layers")
    run_program("render", "bar.py", "-o", "bar.png")
    assert len(list((tmp_path / "layers").glob("*.png"))) == 10 and (tmp_path / "bar.png").exists()


def test_the_manual_lists_what_is_missing():
    manual = (here.parents[1] / "docs" / "user" / "pyvcad.md").read_text(encoding="utf-8")
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

"""Forms of arguments and small methods that scripts of pyvcad 3 use."""
import math
import xml.etree.ElementTree as ElementTree

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_compilers as pvc
import pyvcad_rendering as viz

origin = pv.Vec3(0, 0, 0)


def graded_ball():
    ball = pv.Sphere(origin, 5)
    ball.set_attribute("modulus", pv.FloatAttribute("100 + 10*x"))
    return ball


def test_solids_without_materials():
    cube = pv.Function("max(abs(x), abs(y), abs(z)) - 1", pv.Vec3(-2, -2, -2), pv.Vec3(2, 2, 2))
    assert cube.volume(0.1) == pytest.approx(8, rel=0.01) and cube.bounding_box()[1].x <= 2
    text = pv.Text("I", 10, 2, pv.FontAspect.Bold, "DejaVu Sans Mono", pv.HorizontalAlignment.Left, pv.VerticalAlignment.Bottom)
    assert text.evaluate(*text.bounding_box()[1]) > -1e-6 and text.bounding_box()[0].z == -1


def test_unit_cells_are_cut_at_their_box():
    cell = pv.GraphLattice(pv.LatticeType.Cubic, pv.Vec3(4, 4, 4), 0.5)
    assert cell.bounding_box() == (pv.Vec3(-2, -2, -2), pv.Vec3(2, 2, 2))
    assert cell.evaluate(2.1, 2, 0) > 0 > cell.evaluate(1.9, 1.9, 0) and pv.Tile(cell).evaluate(2.1, 2, 0) < 0


def test_vectors_have_names_of_colours():
    colour = pv.Vec4(0.1, 0.2, 0.3, 0.4)
    assert (colour.r, colour.g, colour.b, colour.a) == (0.1, 0.2, 0.3, 0.4)
    colour.g = 1
    assert colour.y == 1


def test_resolvers_have_their_modes_and_serve_box_unions():
    a, b = pv.Sphere(origin, 5), pv.Sphere(origin, 5)
    a.set_attribute("density", pv.FloatAttribute(2))
    b.set_attribute("density", pv.FloatAttribute(5))
    for both in (pv.BBoxUnion([a, b]), pv.BBoxIntersection([a, b])):
        both.set_attribute_conflict_resolver("density", pv.resolvers.CustomFloatConflictResolver(lambda l, r: 10 * l + r))
        assert both.sample(0, 0, 0)[1].get_sample("density") == pytest.approx(25)
    assert pv.resolvers.MaxConflictResolver(pv.resolvers.Vec4Mode.Magnitude)


def test_materials_by_colour_and_by_other_names():
    red = pv.default_materials.id("red")
    assert pv.default_materials.id(pv.default_materials.color(red)) == red
    assert pv.j750_materials.id("VeroYL-V") == pv.j750_materials.id("VeroYellow")
    with pytest.raises(KeyError, match="no material of the colour"):
        pv.default_materials.id(pv.Vec4(1, 2, 3, 4))


def test_wrong_formulas_are_refused_where_they_are_written():
    with pytest.raises(ombre.DesignError, match=r"test_pyvcad_forms\.py:\d+: the formula '2 \+\* x' is wrong"):
        pv.FloatAttribute("2 +* x")
    with pytest.raises(ombre.DesignError, match="is wrong"):
        pv.Vec3Attribute("x", "nothing_known", 0)


def test_trees_become_diagrams(tmp_path):
    ball = graded_ball()
    tree = pv.Union(ball, pv.Translate(1, 0, 0, ball))
    viz.Render_Tree_Diagram(tree, tmp_path / "tree.mmd")
    lines = (tmp_path / "tree.mmd").read_text().splitlines()
    assert lines[0] == "flowchart TD" and sum("-->" in line for line in lines) == 3
    assert sum('["' in line for line in lines) == 3 and any("modulus" in line for line in lines)
    assert tree.to_diagram() == (tmp_path / "tree.mmd").read_text()
    viz.Render_Tree_Legend(tmp_path / "legend.mmd")


def test_pictures_have_the_colours_of_the_first_attribute(tmp_path):
    ball = graded_ball()
    ball.set_attribute("age", pv.FloatAttribute(7))  # the same everywhere
    assert viz.first_scaled_attribute(ball) == "modulus"
    colour = pv.RectPrism()
    colour.set_attribute("density", pv.FloatAttribute("x"))
    colour.set_attribute("color_rgb", pv.Vec3Attribute(0, 1, 0))
    assert viz.shown_attribute(colour) == "color_rgb"
    whole = pv.Union(ball, colour)
    whole.set_attribute("color_rgba", pv.Vec4Attribute(0, 1, 0, 1))
    assert viz.shown_attribute(whole) == "color_rgba"
    viz.Render_Image(ball, tmp_path / "a.png", width=64, height=48)
    viz.Render_Image(ball, tmp_path / "b.png", {"visualized_attribute": "none"}, 64, 48)
    settings = viz.RenderSettings(clipping_plane=True, clipping_plane_normal=(0, 0, 1), camera_position=(0, -9, 9), quality="low")
    viz.render_image(ball, tmp_path / "c.png", settings, 64, 48)
    pictures = [(tmp_path / name).read_bytes() for name in ("a.png", "b.png", "c.png")]
    assert len(set(pictures)) == 3 and all(p[16:24] == bytes((0, 0, 0, 64, 0, 0, 0, 48)) for p in pictures)
    slanted = {"clipping_plane": True, "clipping_plane_normal": (1, -1, 0), "clipping_plane_origin": (2, -2, 0)}
    viz.Render_Image(ball, tmp_path / "d.png", slanted, 64, 48)
    assert (tmp_path / "d.png").read_bytes() not in pictures
    # The picture leaves out everything before the plane x - y = 4.
    half = viz._pictures._clipped(ball, slanted)
    assert half.evaluate(2, -2, 0) == pytest.approx(0, abs=1e-9) and half.evaluate(1.9, -1.9, 0) < 0 < half.evaluate(2.1, -2.1, 0)
    with pytest.raises(ValueError, match="expected a direction"):
        viz.Render_Image(ball, tmp_path / "d.png", {"clipping_plane": True, "clipping_plane_normal": (0, 0, 0)}, 64, 48)


def test_parts_turn_and_are_cut_in_moving_pictures(tmp_path):
    Image = pytest.importorskip("PIL.Image")
    viz.Render_Turntable_Animation(graded_ball(), tmp_path, duration=0.4, fps=10, width=48, height=36, keep_frames=True)
    viz.Render_Sweep_Animation(graded_ball(), tmp_path, axis="x", duration=0.4, fps=10, pause_seconds=0.1, width=48, height=36)
    assert Image.open(tmp_path / "turntable.gif").n_frames >= 2 and len(list(tmp_path.glob("turntable_*.png"))) == 4
    assert Image.open(tmp_path / "sweep.gif").n_frames >= 4


def test_surfaces_and_grids_of_vtk(tmp_path):
    shares = []
    viz.export_iso_surface_vtk(graded_ball(), tmp_path / "ball.vtp", quality="low", progress_callback=shares.append)
    piece = ElementTree.parse(tmp_path / "ball.vtp").getroot().find("PolyData/Piece")
    points = numpy.array(piece.find("Points/DataArray").text.split(), dtype=float).reshape(-1, 3)
    modulus = numpy.array(piece.find("PointData/DataArray[@Name='modulus']").text.split(), dtype=float)
    assert numpy.abs(numpy.linalg.norm(points, axis=1) - 5).max() < 0.1
    assert numpy.allclose(modulus, 100 + 10 * points[:, 0]) and shares[0] == 0 and shares[-1] == 100
    viz.export_volume_vtk(graded_ball(), tmp_path / "ball.vti", quality="low")
    assert b"modulus" in (tmp_path / "ball.vti").read_bytes()


def test_compilers_tell_progress_and_figures(tmp_path, capsys):
    compiler = pvc.MeshCompiler(pv.Sphere(origin, 3), 0.5, tmp_path, "ball")
    shares = []
    compiler.set_progress_callback(shares.append)
    compiler.compile()
    assert shares[-1] == 1.0 and compiler.supported_attributes() == []
    compiler.report_stats()
    assert "voxel: (0.5, 0.5, 0.5)" in capsys.readouterr().out


def test_volumes_of_cones():
    assert pv.Cone(math.pi / 4, 2).volume(0.05) == pytest.approx(math.pi * 8 / 3, rel=0.01)

"""Forms, values and errors of the interface of pyvcad 3 that scripts rely on."""
import gc
import json
import math
import pathlib
import shutil
import sys
import types

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_compilers as pvc
import pyvcad_medical as med
import pyvcad_metamaterials as mm
import pyvcad_rendering as viz

from pyvcad_parts import ball, blue, origin, red

V = pv.Vec3


def box(name=None, attribute=None, center=origin, size=V(4, 4, 4)):
    part = pv.RectPrism(center, size)
    if name:
        part.set_attribute(name, attribute)
    return part


# Solids.

def test_solids_without_arguments_have_the_sizes_of_pyvcad_3():
    assert pv.Sphere().evaluate(0, 0, 0) == pytest.approx(-1)
    assert pv.RectPrism().bounding_box()[1] == V(0.5, 0.5, 0.5)
    assert pv.Cylinder().evaluate(0, 0, 0.25) == pytest.approx(-0.25)


def test_struts_without_a_material_are_capsules():
    # 10 mm long, 1 mm thick, with a ball's volume at the ends.
    assert pv.Strut(origin, V(10, 0, 0), 1).volume(0.1) == pytest.approx(math.pi * (10 + 4 / 3), rel=0.01)
    assert pv.Strut(origin, V(10, 0, 0), 1, 1).volume(0.1) == pytest.approx(math.pi * 10, rel=0.01)


def test_meshes_are_centred_and_mirrored(tmp_path):
    surface = pv.SurfaceMesh([(0, 0, 0), (4, 0, 0), (0, 6, 0), (0, 0, 8)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    assert pv.Mesh(surface, center=True).bounding_box() == (V(-2, -3, -4), V(2, 3, 4))
    assert pv.Mesh(surface, compensate_slicer_ras=True).bounding_box() == (V(0, -6, 0), V(4, 0, 8))
    path = tmp_path / "wedge.stl"
    surface.write_stl(path)
    # center, disable_validation, override_voxel_size, compensate_slicer_ras
    assert pv.Mesh(str(path), True, False, V(1, 1, 1), True).bounding_box() == (V(-2, -3, -4), V(2, 3, 4))
    assert pv.Mesh(str(path), V(1, 1, 1), center=True).volume(0.2) == pytest.approx(4 * 6 * 8 / 6, rel=0.02)


def test_beams_are_cones_with_balls():
    points = [origin, V(10, 0, 0), V(10, 0, 0.05)]
    lattice = pv.BeamLattice(points, [(0, 1), pv.Beam(1, 2)], 1.0, min_length=0.1, cap=pv.CapMode.Butt)
    assert (lattice.active_beam_count, lattice.active_ball_count) == (1, 0)
    assert lattice.volume(0.1) == pytest.approx(math.pi * 10, rel=0.01)
    cone = pv.BeamLattice(points, [pv.Beam(0, 1, 2, 1, pv.CapMode.Butt, pv.CapMode.Butt)], 1.0)
    assert cone.volume(0.1) == pytest.approx(math.pi * 10 * (4 + 2 + 1) / 3, rel=0.01)
    balls = pv.BeamLattice(points, [(0, 1)], 1.0, ball_mode=pv.BallMode.All, ball_radius=2.0)
    assert balls.active_ball_count == 2
    assert balls.evaluate(0, 0, 2.5) == pytest.approx(0.5)
    mixed = pv.BeamLattice(points, [(0, 1)], 1.0, ball_mode=pv.BallMode.Mixed, ball_radius=2.0, balls=[pv.Ball(1, 3)])
    assert mixed.active_ball_count == 1
    assert mixed.evaluate(10, 0, 4) == pytest.approx(1)
    with pytest.raises(RuntimeError, match="one of the 3 vertices"):
        pv.BeamLattice(points, [(0, 3)], 1.0)
    with pytest.raises(RuntimeError, match="no beam is long enough"):
        pv.BeamLattice(points, [(1, 2)], 1.0, min_length=1)


def test_textured_meshes_have_their_colours_near_the_surface(tmp_path):
    path = tmp_path / "cube.ply"
    corners = [(x, y, z) for z in (0, 10) for y in (0, 10) for x in (0, 10)]
    faces = ["0 2 3 1", "4 5 7 6", "0 1 5 4", "2 6 7 3", "0 4 6 2", "1 3 7 5"]
    header = ["ply", "format ascii 1.0", "element vertex 8", *(f"property float {axis}" for axis in "xyz"),
              *(f"property uchar {colour}" for colour in ("red", "green", "blue")), "element face 6",
              "property list uchar int vertex_indices", "end_header"]
    rows = [f"{x} {y} {z} 0 255 0" for x, y, z in corners] + [f"4 {face}" for face in faces]
    path.write_text("\n".join([*header, *rows]) + "\n")
    part = pv.TexturedMesh(str(path), color_depth=2.0, core_color=V(1, 0, 0), center=True)
    assert part.bounding_box() == (V(-5, -5, -5), V(5, 5, 5))
    assert "color_rgba" in part.attribute_list()
    near, deep = (part.sample(x, 0, 0)[1].get_sample("color_rgba") for x in (4, 2))
    assert tuple(near) == pytest.approx((0, 1, 0, 1)) and tuple(deep) == pytest.approx((1, 0, 0, 1))
    plain = tmp_path / "plain.stl"
    pv.SurfaceMesh(ball(3), 1.0).write_stl(plain)
    with pytest.raises(ValueError):
        pv.TexturedMesh(str(plain)).bounding_box()
    grey = pv.TexturedMesh(str(plain), fallback_color=V(0.5, 0.5, 0.5))
    assert grey.sample(2.5, 0, 0)[1].get_sample("color_rgba").r == pytest.approx(0.5)


# Errors are RuntimeErrors, as scripts catch them.

@pytest.mark.parametrize("wrong, words", [
    (lambda: pv.Scale(0.0, ball()), "above 0"), (lambda: pv.Scale(-1.0, ball()), "Mirror"),
    (lambda: pv.Scale(math.inf, ball()), "finite"), (lambda: ball().volume(0), "above 0"),
    (lambda: ball().volume(math.nan), "finite"), (lambda: pv.PolygonExtrude([origin, V(4, 0, 0)], 3), "at least 3"),
    (lambda: pv.PolygonExtrude([origin, V(4, 0, 0), V(8, 0, 0)], 3).bounding_box(), "line"),
    (lambda: pv.Shell(0.0, ball()), "above 0")])
def test_wrong_values_are_runtime_errors(wrong, words):
    with pytest.raises(RuntimeError, match=words):
        wrong()
    with pytest.raises(ValueError):
        wrong()


# Attributes.

def test_attributes_say_their_types():
    kinds = pv.Attribute.ReturnType
    assert pv.FloatAttribute(1).return_type() == kinds.dbl == "dbl"
    assert pv.Vec3Attribute().return_type() is kinds.vec3
    assert pv.VolumeFractionsAttribute().return_type() is kinds.vfm_ptr
    names = pv.DefaultAttributes
    assert names.COLOR_RGBA_TYPE is kinds.vec4 and names.TOUGHNSS_TYPE is kinds.dbl
    assert names.get_return_type_by_name("volume_fractions") is kinds.vfm_ptr
    assert names.get_return_type_by_name("nothing") is kinds.none
    assert box("density", pv.FloatAttribute(1)).sample(0, 0, 0)[1].get_type("density") == kinds.dbl


def test_fractions_are_sampled():
    fractions = pv.VolumeFractionsAttribute([("x", red), ("1 - x", blue)])
    assert fractions.sample(0.25, 0, 0, 0) == {red: pytest.approx(0.25), blue: pytest.approx(0.75)}
    assert fractions.get_value(box("volume_fractions", fractions).sample(0.25, 0, 0)[1]) == {
        red: pytest.approx(0.25), blue: pytest.approx(0.75)}


def test_copies_of_attributes_stay_as_they_are():
    first = pv.FloatAttribute("x")
    second = first.clone()
    first.set_expression("2*x")
    assert (first.sample(3, 0, 0), second.sample(3, 0, 0)) == (6, 3)
    vector = pv.Vec3Attribute()
    vector.set_expression("x", "y", "2*z")
    assert vector.sample(1, 2, 3) == V(1, 2, 6)
    assert vector.dot(V(1, 1, 1)).sample(1, 2, 3) == pytest.approx(9)
    with pytest.raises(TypeError, match="expected 3"):
        vector.set_value(1, 2)


def test_arithmetic_takes_no_texts():
    for wrong in (lambda: pv.FloatAttribute("x") + "y", lambda: pv.DerivedFloatAttribute("a", {"a": "x"})):
        with pytest.raises(TypeError):
            wrong()


def test_there_is_no_sample_where_an_attribute_is_not_given():
    whole = pv.Union(box("density", pv.FloatAttribute(3)), box(center=V(10, 0, 0)))
    assert whole.sample(0, 0, 0)[1].get_sample("density") == 3
    samples = whole.sample(10, 0, 0)[1]
    assert not samples.has_sample("density")
    with pytest.raises(RuntimeError, match="no sample"):
        samples.get_sample("density")
    # Outputs of a converter exist where all of its inputs do.
    computed = pv.AttributeModifier(pv.ExpressionConverter(["density"], ["modulus"], ["10*density"]), whole)
    beside = pv.Union(computed, box(center=V(20, 0, 0)))
    assert beside.sample(0, 0, 0)[1].get_sample("modulus") == 30
    assert [beside.sample(x, 0, 0)[1].has_sample("modulus") for x in (0, 10, 20)] == [True, False, False]
    whole.child(1).set_attribute("density", pv.FloatAttribute(5))
    assert whole.sample(10, 0, 0)[1].get_sample("density") == 5
    fractions = box("volume_fractions", pv.VolumeFractionsAttribute([(1, red)]))
    beside = pv.Union(fractions, box("density", pv.FloatAttribute(1), V(10, 0, 0)))
    assert [beside.sample(x, 0, 0)[1].has_sample("volume_fractions") for x in (0, 10)] == [True, False]


def test_computed_attributes_are_attributes_of_compilers(tmp_path):
    gray = pv.AttributeModifier(pv.ExpressionConverter(["density"], ["intensity"], ["density"]),
                                box("density", pv.FloatAttribute(1)))
    two = pv.Union(gray, pv.Translate(4, 0, 0, gray))
    assert two.attribute_list() == ["density", "intensity"]
    compiler = pvc.VatCompiler(two, V(1, 1, 1), tmp_path, "s_")
    compiler.set_strict_mode(True)
    compiler.compile()
    assert compiler.resolution() == (8, 4, 4)
    lacking = pvc.VatCompiler(pv.Union(two, box(center=V(0, 10, 0))), V(1, 1, 1), tmp_path, "s_")
    lacking.set_strict_mode(True)
    with pytest.raises(RuntimeError, match=r"nothing gives intensity at \(.*; set it on a node above"):
        lacking.compile()


def test_differences_keep_resolvers():
    part = pv.Difference(ball(5), ball(2))
    part.set_attribute_conflict_resolver("density", pv.resolvers.AverageConflictResolver())
    twin = part.clone()
    twin.set_attribute_conflict_resolver("modulus", pv.resolvers.AverageConflictResolver())
    assert list(part.attribute_conflict_resolvers()) == ["density"]
    assert sorted(twin.attribute_conflict_resolvers()) == ["density", "modulus"]
    assert pv.Union().add_child(ball()) is True


# Queries.

def test_gradients_are_differences_over_their_step():
    # |x| has the slope 0.5 over a step that reaches from -1 to 3.
    part = pv.Function("abs(x) - 5", V(-9, -9, -9), V(9, 9, 9))
    assert part.get_gradient_epsilon() == pytest.approx(1e-4)
    part.set_gradient_epsilon(2)
    assert part.gradient(1, 0, 0).x == pytest.approx(0.5)
    assert part.clone().get_gradient_epsilon() == 2
    with pytest.raises(ValueError, match="above 0"):
        part.set_gradient_epsilon(0)


def test_probes_find_the_surface():
    part = pv.Union(ball(2), pv.Sphere(V(6, 0, 0), 1))
    hit = pv.probe_ray(part, V(20, 0.6, 0), V(-3, 0, 0))
    assert hit.hit and hit.position.x == pytest.approx(6.8) and hit.position.y == pytest.approx(0.6)
    assert (hit.normal.x, hit.normal.y) == pytest.approx((0.8, 0.6), abs=1e-6)
    assert pv.probe_ray(part, origin, V(0, 0, 1)).position.z == pytest.approx(2)  # from inside
    missed = pv.probe_ray(part, V(20, 3, 0), V(-1, 0, 0))
    assert (missed.hit, missed.position, missed.normal) == (False, None, None)
    assert not pv.probe_ray(part, V(20, 0, 0), V(1, 0, 0)).hit  # it looks away
    near = pv.probe_point(part, V(0, 5, 0))
    assert near.position.y == pytest.approx(2) and near.normal.y == pytest.approx(1)
    with pytest.raises(RuntimeError, match="direction"):
        pv.probe_ray(part, origin, origin)


def test_angles_turn_parts_to_a_normal():
    tips = pv.Union(0.0, [pv.Sphere(V(0, 0, 10), 0.1), pv.Sphere(V(0, 0, -10), 0.1), pv.Sphere(V(0, 10, 0), 0.2),
                          pv.Sphere(V(0, -10, 0), 0.2), pv.Sphere(V(0, 0, 5), 0.3), pv.Sphere(V(0, 5, 0), 0.4)])
    for normal, up in (((1, 2, 3), (3, 0, 1)), ((0, 0, -1), (0, 1, 0)), ((1, 0, 0), (0, 0, 1)), ((-1, 0, 0), (0, 1, 1)),
                       ((0.2, -0.9, 0.1), (1, 1, 1))):
        z = numpy.array(normal) / numpy.linalg.norm(normal)
        y = numpy.array(up) - numpy.dot(up, z) * z
        y /= numpy.linalg.norm(y)
        turned = pv.Rotate(pv.alignment_angles(V(*normal), V(*up)), tips)
        assert turned.evaluate(*(5 * z)) == pytest.approx(-0.3, abs=1e-6)
        assert turned.evaluate(*(5 * y)) == pytest.approx(-0.4, abs=1e-6)
    with pytest.raises(RuntimeError, match="along the normal"):
        pv.alignment_angles(V(0, 0, 1), V(0, 0, -2))


# Sampling.

def test_colours_of_numbers():
    colours = pv.ColorMap()
    colours.add_color(1, V(1, 0, 0))
    colours.add_color(0, V(0, 0, 1))
    assert colours.get_color(0.25) == V(0.25, 0, 0.75)
    assert colours.get_color(9) == V(1, 0, 0)
    whole = pv.Union(box("density", pv.FloatAttribute("x")), box(center=V(10, 0, 0)))
    sampler = pv.TreeSampler(whole, V(1, 1, 1))
    with pytest.raises(RuntimeError, match="as_rgba_array"):
        sampler.get_double_attribute_min_max()
    nx, ny, nz, bytes_ = sampler.as_rgba_array("density", colours)
    image = bytes_.reshape(nz, ny, nx, 4)[0, 0]
    assert (nx, ny, nz) == (14, 4, 4) and bytes_.dtype == numpy.uint8
    # Voxels at -1.5, -0.5, 0.5 and 1.5 share the range from -1.5 to 1.5.
    assert image[:4, 0].tolist() == [0, 85, 170, 255] and image[:4, 2].tolist() == [255, 170, 85, 0]
    assert image[6].tolist() == [0, 0, 0, 0]
    assert image[12].tolist() == [128, 128, 128, 255]
    assert sampler.get_double_attribute_min_max() == (-1.5, 1.5)
    sampler.set_undefined_attribute_pattern_enabled(False)
    sampler.set_double_attribute_range_override(0, 2)
    assert [tuple(c) for c in sampler.sample_points_to_colors([V(1, 0, 0), V(10, 0, 0)], "density", colours)] == [
        pytest.approx((0.5, 0, 0.5, 1), abs=0.01), (0, 0, 0, 0)]
    with pytest.raises(RuntimeError, match="it has density"):
        sampler.as_rgba_array("modulus", colours)
    with pytest.raises(RuntimeError, match="add_color"):
        pv.ColorMap().get_color(1)
    # The first and the last colour of viridis are #440154 and #FDE725.
    viridis = pv.ColorMap.create_viridis()
    assert [round(255 * c) for c in viridis.get_color(0)] == [0x44, 0x01, 0x54]
    assert [round(255 * c) for c in viridis.get_color(1)] == [0xFD, 0xE7, 0x25]


def test_colours_of_materials():
    table = pv.default_materials
    part = box("volume_fractions", pv.VolumeFractionsAttribute([(0.25, red), (0.75, blue)]))
    sampler = pv.TreeSampler(part, V(1, 1, 1), table)
    mean = [0.25 * a + 0.75 * b for a, b in zip(table.color(red), table.color(blue))]
    assert list(sampler.as_rgba_array("volume_fractions", None)[3][:4]) == [round(c) for c in mean]
    assert list(sampler.as_rgba_array("volume_fractions", None, blend=False)[3][:4]) == list(table.color(blue))
    assert table.prescaled_color_list()[red] == table.color(red)


def test_grids_have_an_occupancy(tmp_path):
    part = box("density", pv.FloatAttribute(2), size=V(4, 4, 4))
    pvc.VdbCompiler(part, V(1, 1, 1), tmp_path / "a.vdb", None, True).compile()
    pv.TreeSampler(part, V(1, 1, 1)).save_openvdb_occupancy_grid(tmp_path / "b.vdb")
    for name in ("a.vdb", "b.vdb"):
        grid = pv.vdb_loader.load_float_volume(str(tmp_path / name), "occupancy")
        assert grid.sample(0.5, 0.5, 0.5) == pytest.approx(1)


# Models of CAD programs.

fixtures = pathlib.Path(__file__).resolve().parents[1] / "cases" / "other_programs" / "fixtures"


def test_files_of_open_cascade_are_models(tmp_path):
    path = fixtures / "cadquery.brep"
    for model in (pv.CADModel.from_brep(path), pv.CADModel.from_brep_bytes(path.read_bytes())):
        # A block of 20 x 10 x 6 mm with a hole of 4 x 4 mm through it: six sides and four of the hole.
        assert len(model.faces) == 10
        assert sum(face.area for face in model.faces) == pytest.approx(2 * (200 + 120 + 60) - 2 * 16 + 4 * 24)
        assert model.to_node().volume(0.2) == pytest.approx(20 * 10 * 6 - 4 * 4 * 6, rel=1e-6)
    node = pv.CADModel.from_brep_bytes(path.read_bytes()).to_node()  # holds the file of the model
    gc.collect()
    assert node.clone().bounding_box() == pv.CAD(str(path)).bounding_box()
    for wrong in (b"", path.read_bytes()[:500], bytes(range(256)) * 20):
        with pytest.raises(RuntimeError, match="cannot read"):
            pv.CADModel.from_brep_bytes(wrong)


def test_parts_of_build123d_are_models(tmp_path, monkeypatch):
    """A module that stands for build123d, whose parts are written as STEP files by a function of its own."""
    module = types.ModuleType("build123d")
    written = []

    class Solid:
        pass

    class Builder:
        part = Solid()

    class Compound:
        def __init__(self, children):
            self.children = children

    def export_step(shape, path):
        written.append(shape)
        shutil.copyfile(fixtures / "freecad.step", path)
    Solid.__module__ = Builder.__module__ = Compound.__module__ = "build123d.topology"
    module.Compound, module.export_step = Compound, export_step
    monkeypatch.setitem(sys.modules, "build123d", module)
    one, two = Solid(), Solid()
    for given in (one, Builder(), [one, two]):
        assert len(pv.CADModel.from_cadquery(given).faces) == 10
    assert written[0] is one and written[1] is Builder.part and written[2].children == [one, two]
    with pytest.raises(TypeError, match="from_step reads"):
        pv.CADModel.from_cadquery(object())


# Selections.

def test_selections_are_kept_in_files(tmp_path):
    surface = viz.resolve_selection_mesh(ball(3), voxel_size=V(1, 1, 1))
    assert viz.resolve_selection_mesh(surface) is surface
    chosen = surface.select_by_geodesic_radius(0, 2)
    viz.save_mesh_selection(chosen, tmp_path / "patch.json")
    assert viz.load_mesh_selection(tmp_path / "patch.json", surface).triangle_ids == chosen.triangle_ids
    moved = pv.SurfaceMesh(surface.vertices + [1e-6, 0, 0], surface.triangles)
    with pytest.raises(RuntimeError, match="select again"):
        viz.load_mesh_selection(tmp_path / "patch.json", moved)
    for text in ("{", "[]", json.dumps({"version": 99, "triangles": []})):
        (tmp_path / "wrong.json").write_text(text)
        with pytest.raises(RuntimeError, match="no selection"):
            viz.load_mesh_selection(tmp_path / "wrong.json", surface)


# Names that are missing say what to write instead.

@pytest.mark.parametrize("use", [
    lambda: pv.ThreeMFBeamLattice("a.3mf"), lambda: pv.Mix(), lambda: pv.Polygon2(), lambda: pv.FloatGrid(),
    lambda: viz.select_mesh_patch(ball()), lambda: viz.replay_mesh_selection(), lambda: pvc.GCVFCompiler(),
    lambda: ball().segment_info(origin), lambda: ball().component_parameter, lambda: ball().voronoi_cells(),
    lambda: ball().save_openvdb_sdf_grid("a.vdb")])
def test_what_is_missing_says_what_to_write(use):
    with pytest.raises(pv.MissingFeature, match="; .*[a-z]"):
        use()


def test_attributes_of_nodes_of_ombre_are_sampled():
    part = pv.Identity(ombre.attribute(ombre.cube(4), "density", 2.0))
    assert part.sample(1, 1, 1)[1].get_sample("density") == 2


# Compilers.

def test_compilers_report_what_they_did(tmp_path, capsys):
    gray = box("intensity", pv.FloatAttribute(1))
    infill = box("infill_density", pv.FloatAttribute("20 + x"))
    settings = pvc.SimulationCompilerSettings()
    settings.backend = pvc.SimulationBackend.GENERIC
    for compiler in (pvc.VatCompiler(gray, V(1, 1, 1), tmp_path / "v", "s_"), pvc.VdbCompiler(gray, V(1, 1, 1), tmp_path / "a.vdb"),
                     pvc.PrusaSlicerProjectCompiler(infill, V(1, 1, 1), tmp_path / "a.3mf", 2),
                     pvc.SimulationCompiler(gray, settings)):
        compiler.report_stats()
        assert "has not ended yet" in capsys.readouterr().out
        compiler.compile()
        compiler.report_stats()
        lines = capsys.readouterr().out
        assert "box: Vec3(-2, -2, -2) Vec3(2, 2, 2)" in lines and "seconds: " in lines and "threads: " in lines


def test_materials_of_parts_of_lattices_are_compiled(tmp_path):
    cells = mm.rectangular_cell_map((origin, V(12, 12, 12)), cells=(2, 2, 2))

    def counts(lattice):
        compiler = pvc.MaterialInkjetCompiler(lattice, V(0.5, 0.5, 0.5), tmp_path / "images", "s_", pv.default_materials)
        compiler.compile()
        return compiler.material_voxel_counts()
    # Two struts across opposite corners of each cell, whose lengths are sqrt(3) and sqrt(2) times its side.
    cell = pv.GraphUnitCell([V(0, 0, 0), V(1, 1, 1), V(1, 0, 0.5), V(0, 1, 0.5)], [(0, 1), (2, 3)], edge_tags=[1, 2],
                            material_tags=[red, blue])
    tagged = counts(mm.graph_lattice(cells, cell, beam_radius=0.5))
    assert set(tagged) == {red, blue} and tagged[red] > tagged[blue] > 0
    skin = mm.gyroid(cells, wall_thickness=1.5)
    assert skin.attribute_list() == []
    skin.shell.set_attribute("volume_fractions", pv.VolumeFractionsAttribute(["x/12", "1 - x/12"], [red, blue]))
    assert skin.attribute_list() == ["volume_fractions"]
    # The wall is its own image through the middle of the box, where both have half.
    graded = counts(skin)
    assert graded[red] / (graded[red] + graded[blue]) == pytest.approx(0.5, abs=0.03)


def test_struts_alone_have_samples():
    cells = mm.rectangular_cell_map((origin, V(12, 12, 12)), cells=(2, 2, 2))
    lattice = mm.cubic(cells, beam_radius=0.5)
    upright = lattice.struts.where(lambda strut: abs(strut.direction.z) > 0.9)
    upright.set_attribute("modulus", pv.FloatAttribute(7))
    assert lattice.attribute_list() == ["modulus"]
    assert lattice.sample(6, 6, 3)[1].get_sample("modulus") == 7
    assert not lattice.sample(3, 6, 6)[1].has_sample("modulus")


def test_packages_have_their_other_names():
    from libvcad import pyvcad
    assert pyvcad is pv
    assert med.raw_color_palettes["jet"] is med.color_maps.raw_color_palettes["jet"]


@pytest.mark.parametrize("name", ["r", "t", "d", "x"])
def test_inputs_of_converters_go_before_coordinates(name):
    part = box(name, pv.FloatAttribute("y + 10"))
    entry = pv.LookupTableEntry
    for converter in (pv.ExpressionConverter([name], ["q"], [f"2*{name} + 1"]),
                      pv.LookupTableConverter([name], ["q"], [entry(0, 5, 1.0), entry(5, 50, 23.0)]),
                      pv.LookupTableConverter([name], ["q"], [entry(10, 21.0), entry(12, 25.0)], pv.InterpolationMode.LINEAR)):
        assert pv.AttributeModifier(converter, part).sample(0.5, 1, 0)[1].get_sample("q") == pytest.approx(23)
    fractions = pv.VolumeFractionsExpressionConverter([name], [red, blue], [f"{name}/20", f"1 - {name}/20"])
    shares = pv.AttributeModifier(fractions, part).sample(0.5, 1, 0)[1].get_sample("volume_fractions")
    assert shares == {red: pytest.approx(0.55), blue: pytest.approx(0.45)}


def test_formulas_have_the_words_of_pyvcad():
    for text, value in (("mand(x > 1, y > 1, 3)", 1), ("mor(x > 9, y < 1)", 0), ("x > 1 nand y > 1", 0), ("x <> 2", 0),
                        ("avg(x, y, 6)", 4), ("clamp(0, x, 1)", 1), ("rad2deg(pi)", 180)):
        assert pv.FloatAttribute(text).sample(2, 4, 0) == pytest.approx(value), text


def box_with(**attributes):
    box = pv.RectPrism(origin, V(4, 4, 4))
    for name, attribute in attributes.items():
        box.set_attribute(name, attribute)
    return box


def values_at(node, names, *point):
    samples = node.sample(*point)[1]
    return [samples.get_sample(name) for name in names]


def test_converters_read_what_the_child_has():
    number = pv.FloatAttribute
    both = pv.ExpressionConverter(["density"], ["density", "temperature"], ["density*2", "density*100"])
    assert values_at(pv.AttributeModifier(both, box_with(density=number(1))), ["density", "temperature"], 0, 0, 0) == [2, 100]
    rows = [pv.LookupTableEntry(key, [10 * key, 100 * key]) for key in (0.0, 2.0)]
    table = pv.LookupTableConverter(["q"], ["q", "p"], rows, pv.InterpolationMode.LINEAR)
    assert values_at(pv.AttributeModifier(table, box_with(q=number("x"))), ["q", "p"], 1, 0, 0) == [10, 100]
    parts = pv.AttributeModifier(pv.Vec3ToScalarsConverter("v", "z", "y", "x"), box_with(v=pv.Vec3Attribute("x", 2, 3)))
    assert values_at(parts, ["z", "y", "x"], 1, 0, 0) == [1, 2, 3]
    mixed = pv.AttributeModifier(both, box_with(density=number(1), v=pv.Vec3Attribute("x", 2, 3)))
    mixed = pv.AttributeModifier(pv.Vec3ToScalarsConverter("v", "z", "y", "x"), mixed)
    assert values_at(mixed, ["density", "z", "y"], 1, 0, 0) == [2, 1, 2]
    twice = pv.AttributeModifier(both, pv.AttributeModifier(both, box_with(density=number(1))))
    assert values_at(twice, ["density", "temperature"], 0, 0, 0) == [4, 200]


@pytest.mark.parametrize("name", ["e", "pi", "E", "d", "t", "x", "min", "density"])
def test_inputs_may_have_any_name(name):
    converter = pv.ExpressionConverter([name], ["out"], [f"{name}*2 + e"])
    wanted = 0.5 if name in ("e", "E") else 0
    found = values_at(pv.AttributeModifier(converter, box_with(**{name: pv.FloatAttribute(0.25)})), ["out"], 1, 0, 0)[0]
    assert found == pytest.approx(0.75 if wanted else 0.5 + math.e)
    table = pv.LookupTableConverter([name], ["out"], [pv.LookupTableEntry(0, 0.3, 7)])
    assert values_at(pv.AttributeModifier(table, box_with(**{name: pv.FloatAttribute(0.25)})), ["out"], 1, 0, 0) == [7]


def test_names_that_differ_in_case_are_two():
    assert pv.DerivedFloatAttribute("A - a", {"A": pv.FloatAttribute("x"), "a": pv.FloatAttribute("y")}).sample(5, 3, 0) == 2
    assert pv.DerivedFloatAttribute("B + 1", {"b": pv.FloatAttribute("x")}).sample(5, 3, 0) == 6
    with pytest.raises(ValueError, match="names 'c', which is none of its inputs"):
        pv.DerivedFloatAttribute("c", {"b": pv.FloatAttribute("x")})


def test_values_that_are_not_finite_are_errors():
    part = box_with(q=pv.FloatAttribute("1/x"))
    assert values_at(part, ["q"], 0.5, 0, 0) == [2]
    with pytest.raises(RuntimeError, match=r"'q' has no finite value at \(0, 0, 0\)"):
        part.sample(0, 0, 0)
    assert part.sample(9, 0, 0)[1] is None
    rows = [pv.LookupTableEntry(float(key), float(key)) for key in range(3)]
    rows[2].is_valid = False
    table = pv.AttributeModifier(pv.LookupTableConverter(["a"], ["b"], rows, pv.InterpolationMode.LINEAR),
                                 box_with(a=pv.FloatAttribute("x")))
    assert values_at(table, ["b"], 0.5, 0, 0) == [0.5] and values_at(table, ["b"], 1, 0, 0) == [1]
    with pytest.raises(RuntimeError, match="valid entry"):
        table.sample(1.5, 0, 0)


def test_attributes_may_change_after_a_question():
    number, vector = pv.FloatAttribute(1), pv.Vec3Attribute(1, 2, 3)
    part = pv.Union(0.0, [pv.Translate(1, 0, 0, box_with(q=number, v=vector))])
    assert values_at(part, ["q", "v"], 0, 0, 0) == [1, V(1, 2, 3)]
    number.set_value("x")  # of the box, which is moved by 1
    vector.set_value(4, 5, 6)
    assert values_at(part, ["q", "v"], 2.5, 0, 0) == [1.5, V(4, 5, 6)]


def test_turns_are_about_the_middle():
    block = pv.RectPrism(V(5, 0, 0), V(4, 2, 1))
    later = pv.Rotate(0, 0, 90)
    later.set_child(block)
    for turned in (later, pv.Rotate(0, 0, 90, child=block), pv.Rotate(pitch=0, yaw=0, roll=90, child=block)):
        assert numpy.allclose([*turned.bounding_box()[0], *turned.bounding_box()[1]], [4, -2, -0.5, 6, 2, 0.5])
    low, high = pv.Rotate(0, 0, 90, around=origin, child=block).bounding_box()
    assert numpy.allclose([*low, *high], [-1, 3, -0.5, 1, 7, 0.5])


def test_settings_of_pictures_are_known(tmp_path):
    ball, file = pv.Sphere(origin, 5), tmp_path / "ball.png"
    with pytest.raises(TypeError, match="'visualised_attribute'; did you mean 'visualized_attribute'"):
        viz.Render_Image(ball, file, {"visualised_attribute": "q"}, 40, 30)
    for wrong in ({"render_mode": "nonsense"}, {"scalar_range_mode": "nonsense"}):
        with pytest.raises(ValueError, match="found 'nonsense'"):
            viz.RenderSettings(**wrong)
    assert not file.exists()
    with pytest.warns(UserWarning, match="without effect: show_bbox, use_blending"):
        viz.Render_Image(ball, file, {"show_bbox": True, "use_blending": False, "show_origin": False}, 40, 30)
    assert file.exists()


def test_unit_square_and_versions():
    low, high = pv.PolygonExtrude().bounding_box()
    assert numpy.allclose([*low, *high], [0, 0, 0, 1, 1, 1]) and pv.PolygonExtrude().volume(0.25) == 1
    assert pvc.version() == pv.version()
    assert (2 * pv.Vec3Attribute(1, 2, 3)).sample(0, 0, 0) == V(2, 4, 6)
    rows = [pv.LookupTableEntry(numpy.int64(0), numpy.int64(1), numpy.float32(0.5))]
    table = pv.AttributeModifier(pv.LookupTableConverter(["a"], ["b"], rows), box_with(a=pv.FloatAttribute(0.5)))
    assert values_at(table, ["b"], 0, 0, 0) == [0.5]

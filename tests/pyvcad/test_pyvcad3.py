"""Attributes, converters, samplers and compilers of pyvcad 3."""
import math
import pathlib
import re
import struct
import subprocess
import sys
import zipfile
import zlib

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_compilers as pvc
import run_ink
from pyvcad_compilers._png import write_gray

origin = pv.Vec3(0, 0, 0)


def ball(radius=5):
    return pv.Sphere(origin, radius)


def test_arithmetic_of_attributes():
    x, z = pv.FloatAttribute("x"), pv.FloatAttribute("z")
    w = z.normalize(0, 8)
    r = (0.2 + w ** 2).clamp(0.2, 0.9)
    assert r.sample(0, 0, 4) == pytest.approx(0.45) and r.sample(0, 0, 20) == pytest.approx(0.9)
    assert (2 - x / 4).sample(2, 0, 0) == 1.5 and abs(-x).sample(3, 0, 0) == 3
    assert x.map_range(0, 2, 10, 20).sample(0.5, 0, 0) == pytest.approx(12.5)
    assert pv.FloatAttribute("d + y").sample(0, 1, 0, -0.5) == pytest.approx(0.5)
    derived = pv.DerivedFloatAttribute("a + 2*b", {"a": x, "b": 3})
    assert derived.sample(1, 0, 0) == 7
    v = pv.Vec3Attribute("x", 3, 4)
    assert v.magnitude().sample(0, 0, 0) == pytest.approx(5) and v.y.sample(0, 0, 0) == 3
    assert v.normalized().sample(0, 0, 0) == pytest.approx([0, 0.6, 0.8]) and (v * 2).dot(v).sample(1, 0, 0) == pytest.approx(52)
    with pytest.raises(TypeError, match="arithmetic of attributes"):
        x + "a".encode()
    with pytest.raises(ValueError, match="names 'c'"):
        pv.DerivedFloatAttribute("a + c", {"a": x})


def test_attributes_of_all_types_are_sampled():
    part = ball()
    part.set_attribute(pv.DefaultAttributes.MODULUS, pv.FloatAttribute("100 + x"))
    part.set_attribute(pv.DefaultAttributes.COLOR_RGBA, pv.Vec4Attribute(1, "0.5 + z/10", 0, 1))
    part.set_attribute("fibre", pv.Vec3Attribute("y", 0, 1))
    distance, samples = part.sample(1, 2, 0)
    assert distance == pytest.approx(math.sqrt(5) - 5)
    assert samples.get_sample("modulus") == 101 and samples.get_sample("fibre") == pv.Vec3(2, 0, 1)
    assert samples.get_type("color_rgba") == "vec4" and list(samples.get_sample("color_rgba")) == [1, 0.5, 0, 1]
    assert part.sample(9, 0, 0) == (4, None)
    with pytest.raises(RuntimeError, match="no sample of 'density'"):
        samples.get_sample("density")
    sampler = pv.TreeSampler(part, pv.Vec3(1, 1, 1))
    assert sampler.sample_dimensions() == (10, 10, 10) and sampler.as_vec3_array("fibre").shape == (10, 10, 10, 3)
    assert sampler.as_float_array("modulus")[7, 4, 4] == pytest.approx(102.5)
    assert sampler.evaluate_points([(0, 0, 0), (7, 0, 0)]) == [-5, 2]
    assert sampler.sample_points_to_float_array([(2, 0, 0)], "modulus") == [102]
    with pytest.raises(RuntimeError, match="3 numbers, not 1"):
        sampler.as_float_array("fibre")


def test_converters_compute_attributes():
    part = ball()
    part.set_attribute("hu", pv.FloatAttribute("100*x"))
    dense = pv.AttributeModifier(pv.ExpressionConverter(["hu"], ["density"], ["1 + hu/1000"]), part)
    assert dense.sample(2, 0, 0)[1].get_sample("density") == pytest.approx(1.2)
    entries = [pv.LookupTableEntry(0, 10), pv.LookupTableEntry(200, 30)]
    line = pv.AttributeModifier(pv.LookupTableConverter(["hu"], ["heat"], entries, pv.InterpolationMode.LINEAR), part)
    assert [line.sample(x, 0, 0)[1].get_sample("heat") for x in (-1, 0.5, 1, 3)] == pytest.approx([10, 15, 20, 30])
    steps = [pv.LookupTableEntry(-500, 0, 1), pv.LookupTableEntry(0, 500, 2)]
    step = pv.AttributeModifier(pv.LookupTableConverter(["hu"], ["zone"], steps), part)
    assert [step.sample(x, 0, 0)[1].get_sample("zone") for x in (-1, 0, 1)] == [1, 1, 2]
    red, blue = pv.default_materials.id("red"), pv.default_materials.id("blue")
    mixed = pv.AttributeModifier(
        pv.VolumeFractionsExpressionConverter(["hu"], [red, blue], ["0.5 + hu/1000", "0.5 - hu/1000"]), part)
    assert mixed.distribution(1, 0, 0) == pytest.approx({red: 0.6, blue: 0.4})
    assert set(mixed.material_list()) == {red, blue}
    with pytest.raises(RuntimeError, match="AttributeModifier"):
        dense.set_attribute("a", pv.FloatAttribute(1))
    with pytest.raises(ValueError, match="3 keys"):
        pv.LookupTableConverter(["a", "b", "c"], ["d"], entries, pv.InterpolationMode.LINEAR)


@pytest.mark.parametrize("resolver, expected", [
    (None, 1), (pv.resolvers.AverageConflictResolver(), 2), (pv.resolvers.MinConflictResolver(), 1),
    (pv.resolvers.MaxConflictResolver(), 3)])
def test_resolvers_decide_where_children_overlap(resolver, expected):
    a, b = ball(), ball()
    a.set_attribute("density", pv.FloatAttribute(1))
    b.set_attribute("density", pv.FloatAttribute(3))
    both = pv.Union(a, b)
    if resolver:
        both.set_attribute_conflict_resolver("density", resolver)
        assert both.attribute_conflict_resolvers() == {"density": resolver}
    assert both.sample(0, 0, 0)[1].get_sample("density") == expected


def test_vat_compiler_writes_gray_layers(tmp_path):
    part = pv.RectPrism(origin, pv.Vec3(4, 2, 2))
    part.set_attribute("intensity", pv.FloatAttribute("0.5 + x/4"))
    compiler = pvc.VatCompiler(part, pv.Vec3(1, 1, 1), str(tmp_path), "layer_")
    compiler.compile()
    assert compiler.resolution() == (4, 2, 2)
    data = (tmp_path / "layer_0.bmp").read_bytes()
    offset, width, height = struct.unpack_from("<I", data, 10)[0], *struct.unpack_from("<ii", data, 18)
    assert (width, height) == (4, 2) and list(data[offset:offset + 4]) == [32, 96, 159, 223]


def test_inkjet_and_vdb_need_their_attributes(tmp_path):
    with pytest.raises(RuntimeError, match="no node of the tree has the attribute volume_fractions"):
        pvc.MaterialInkjetCompiler(ball(), pv.Vec3(1, 1, 1), tmp_path, "a", pv.default_materials).compile()
    part, m = ball(), pv.default_materials
    part.set_attribute("volume_fractions", pv.VolumeFractionsAttribute([("0.5 + x/10", m.id("red")), ("0.5 - x/10", m.id("blue"))]))
    compiler = pvc.MaterialInkjetCompiler(part, pv.Vec3(0.5, 0.5, 0.5), tmp_path / "out", "a_", m)
    shares = []
    compiler.set_progress_callback(shares.append)
    compiler.compile()
    assert compiler.resolution()[2] == len(list((tmp_path / "out").glob("a_*.png"))) and shares[-1] == 1.0
    assert set(compiler.material_voxel_counts()) == {m.id("red"), m.id("blue")}
    with pytest.raises(RuntimeError, match="attribute nothing"):
        pvc.VdbCompiler(part, 1.0, tmp_path / "a.vdb", ["nothing"]).compile()


def test_solids_are_arguments_of_values():
    t = ombre.distance_to(ombre.sphere(3).translate(x=1)).distance
    assert t([[5, 0, 0]]) == pytest.approx([1])
    part = ombre.sphere(5).with_attribute("fibre", ["x", "y", 0]).with_attribute("tint", "#ff0000")
    assert part.attribute("fibre", [[1, 2, 3]]).tolist() == [[1, 2, 0]]
    assert part.attribute("tint", [0, 0, 0]).tolist() == [1, 0, 0, 1]
    copy = ombre.Design.from_json(part.with_attribute("far", ombre.mask(ombre.cube(2))).to_json())
    assert numpy.allclose(copy.attribute("far", [[0, 0, 0], [2, 0, 0]]), [1, 0])


def test_cones_and_bars():
    cone = pv.Cone(math.atan(0.5), 4)  # 2 mm wide below, a point on top
    assert cone.volume(0.05) == pytest.approx(math.pi * 4 * 4 / 3, rel=0.01)
    assert cone.evaluate(0, 0, 1.9) < 0 < cone.evaluate(0, 0, 2.1) and cone.evaluate(1.9, 0, -1.99) < 0
    with pytest.raises(ValueError, match="radians"):
        pv.Cone(2, 4)
    bar = pv.Strut(pv.Vec3(0, 0, 0), pv.Vec3(3, 4, 0), 1, 0.5, pv.CapMode.HemiSphere, pv.CapMode.Butt)
    frustum = math.pi * 5 / 3 * (1 + 0.5 + 0.25)
    assert bar.volume(0.05) == pytest.approx(frustum + 2 / 3 * math.pi, rel=0.01)
    assert bar.evaluate(-0.59, -0.79, 0) < 0 < bar.evaluate(3.1, 4.1, 0)
    whole = pv.Strut(pv.Vec3(0, 0, 0), pv.Vec3(0, 0, 5), 0.5, 1, pv.CapMode.Butt, pv.CapMode.Sphere)
    assert whole.evaluate(0, 0, 5.99) < 0 < whole.evaluate(0, 0, -0.01)


def test_polygons_turn_about_any_axis():
    square = [(1, 2, 0), (1, 3, 0), (1, 3, 2), (1, 2, 2)]  # about the line x = 1, y = 0 along z
    ring = pv.PolygonRevolve([pv.Vec3(*p) for p in square], pv.Vec3(1, 0, 0), pv.Vec3(1, 0, 1), 360)
    assert ring.volume(0.1) == pytest.approx(math.pi * (9 - 4) * 2, rel=0.01)
    assert ring.evaluate(1 + 2.5, 0, 1) < 0 < ring.evaluate(1, 0, 1)
    quarter = pv.PolygonRevolve([pv.Vec3(*p) for p in square], pv.Vec3(1, 0, 0), pv.Vec3(1, 0, 1), 90)
    assert quarter.evaluate(0, 2.3, 1) < 0 < quarter.evaluate(2, 2.3, 1)  # right-handed from +y is to -x
    with pytest.raises(RuntimeError, match="both sides"):
        pv.PolygonRevolve([pv.Vec3(0, -1, 0), pv.Vec3(0, 1, 0), pv.Vec3(0, 1, 2)], pv.Vec3(0, 0, 0), pv.Vec3(0, 0, 1), 360)


def test_surfaces_of_triangles(tmp_path):
    corners = [(0, 0, 0), (3, 0, 0), (0, 3, 0), (0, 0, 3)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    surface = pv.SurfaceMesh([pv.Vec3(*c) for c in corners], faces)
    assert surface.triangles.shape == (4, 3)
    part = pv.Mesh(surface)
    assert part.volume(0.05) == pytest.approx(4.5, rel=0.02) and part.evaluate(0.5, 0.5, 0.5) < 0
    surface.write_stl(tmp_path / "a.stl")
    again = pv.SurfaceMesh(str(tmp_path / "a.stl"))
    assert sorted(map(tuple, again.vertices)) == sorted(map(tuple, surface.vertices))
    of_ball = pv.SurfaceMesh(ball(2), 0.4)
    assert numpy.linalg.norm(of_ball.vertices, axis=1) == pytest.approx(2, abs=0.06)
    with pytest.raises(RuntimeError, match="not closed"):
        pv.SurfaceMesh(corners, faces[:3])
    with pytest.raises(RuntimeError, match="vertex that is not there"):
        pv.SurfaceMesh(corners, [(0, 1, 9)])


def test_projects_of_slicers_have_a_body_for_each_band(tmp_path):
    part = pv.RectPrism(origin, pv.Vec3(20, 10, 10))
    part.set_attribute(pv.DefaultAttributes.INFILL_DENSITY, pv.FloatAttribute("50 + 2*x"))
    pvc.PrusaSlicerProjectCompiler(part, pv.Vec3(1, 1, 1), tmp_path / "a.3mf", num_regions=4).compile()
    with zipfile.ZipFile(tmp_path / "a.3mf") as archive:
        config = archive.read("Metadata/Slic3r_PE_model.config").decode()
    densities = sorted(float(value.rstrip("%")) for value in re.findall(r'key="fill_density" value="([^"]*)"', config))
    assert densities == pytest.approx([35, 45, 55, 65], abs=1)
    with pytest.raises(RuntimeError, match="infill_density"):
        pvc.PrusaSlicerProjectCompiler(ball(), pv.Vec3(1, 1, 1), tmp_path / "b.3mf").compile()
    with pytest.raises(TypeError, match="enable_colour_mix"):
        pvc.PrusaSlicerProjectCompiler(part, pv.Vec3(1, 1, 1), tmp_path / "b.3mf", enable_colour_mix=True)


def test_temperatures_become_tools_with_the_profiles_settings(tmp_path):
    part = pv.RectPrism(origin, pv.Vec3(20, 10, 10))
    part.set_attribute(pv.DefaultAttributes.TEMPERATURE, pv.FloatAttribute("220 + x"))
    with pytest.raises(RuntimeError, match="temperature of tools need printer_profile_path"):
        pvc.PrusaSlicerProjectCompiler(part, pv.Vec3(1, 1, 1), tmp_path / "a.3mf", num_regions=2).compile()
    printer, filament = tmp_path / "printer.ini", tmp_path / "filament.ini"
    printer.write_text("# generated\n[printer:mine]\nmax_print_height = 210\nretract_length = 0.8\n")
    filament.write_text("filament_cost = 25\nfilament_type = PETG\n")
    pvc.PrusaSlicerProjectCompiler(part, pv.Vec3(1, 1, 1), tmp_path / "a.3mf", 2, printer, filament).compile()
    with zipfile.ZipFile(tmp_path / "a.3mf") as archive:
        assert archive.testzip() is None
        config = archive.read("Metadata/Slic3r_PE.config").decode()
    assert "; max_print_height = 210" in config and "; filament_cost = 25" in config
    assert "; temperature = 215,225" in config  # the middles of both halves
    assert config.count("; filament_type = ") == 1  # the project's own comes first
    empty = tmp_path / "empty.ini"
    empty.write_text("# nothing\n")
    with pytest.raises(ValueError, match="no settings"):
        pvc.PrusaSlicerProjectCompiler(part, pv.Vec3(1, 1, 1), tmp_path / "a.3mf", 2, printer, empty)


def gray(path):
    """The pixels of an image that write_gray has made."""
    data = pathlib.Path(path).read_bytes()
    columns, rows = struct.unpack(">II", data[16:24])
    length, = struct.unpack(">I", data[33:37])
    return numpy.frombuffer(zlib.decompress(data[41:41 + length]), dtype=numpy.uint8).reshape(rows, columns + 1)[:, 1:]


def test_vats_of_two_materials(tmp_path):
    table = pv.default_materials
    red, blue = table.id("red"), table.id("blue")
    part = pv.RectPrism(pv.Vec3(3, -2, 8), pv.Vec3(10, 6, 1))
    part.set_attribute("volume_fractions", pv.VolumeFractionsAttribute([(0.75, red), (0.25, blue)]))
    part.set_attribute("blue_intensity", pv.FloatAttribute(0.5))

    def made(name, mode="directory", seed=0):
        compiler = pvc.MultiMaterialVatCompiler(part, tmp_path / name, table, ["red", "blue"], layer_thickness=0.5,
                                                output_mode=pvc.MultiMaterialVatOutputMode(mode), random_seed=seed)
        compiler.compile()
        return compiler
    compiler = made("a")
    assert tuple(compiler.printer_volume()) == (55.01, 34.38, 150) and compiler.archive_path() == ""
    assert sorted(p.name for p in (tmp_path / "a").rglob("*.png")) == [
        f"vat{v}_layer_000{n}.png" for v in "ab" for n in (0, 1)]
    a, b = (gray(tmp_path / "a" / f"vat_{v}" / f"vat{v}_layer_0001.png") for v in "ab")
    assert a.shape == (800, 1280) and set(numpy.unique(a)) == {0, 255} and set(numpy.unique(b)) == {0, 128}
    filled = (a > 0) | (b > 0)
    assert not ((a > 0) & (b > 0)).any()
    # The box lies in the middle: 10 of 55.01 mm and 6 of 34.38 mm, all of it filled.
    rows, columns = numpy.flatnonzero(filled.any(axis=1)), numpy.flatnonzero(filled.any(axis=0))
    assert len(columns) == pytest.approx(10 / 55.01 * 1280, abs=1) and len(rows) == pytest.approx(6 / 34.38 * 800, abs=1)
    assert columns[0] + columns[-1] == 1279 and rows[0] + rows[-1] == 799
    count = int(filled.sum())
    assert count == len(rows) * len(columns)
    assert abs((a > 0).sum() / count - 0.75) < 4 * math.sqrt(0.75 * 0.25 / count)
    made("b"), made("c", seed=1)
    same, other = (gray(tmp_path / name / "vat_a" / "vata_layer_0001.png") for name in "bc")
    assert (same == a).all() and (other != a).any()
    archive = made("d", "zip").archive_path()
    assert not (tmp_path / "d").exists()
    with zipfile.ZipFile(archive) as file:
        assert sorted(file.namelist())[0] == "vat_a/vata_layer_0000.png" and len(file.namelist()) == 4


def test_layers_of_one_bit_for_each_material(tmp_path):
    table = pv.default_materials
    left, right = (pv.RectPrism(pv.Vec3(x, 0, 0), pv.Vec3(10, 8, 1)) for x in (-5, 5))
    for part, name in ((left, "red"), (right, "blue")):
        part.set_attribute("volume_fractions", pv.VolumeFractionsAttribute([(1, table.id(name))]))
    whole = pv.Union(left, right)
    pvc.MyersonCompiler(0.5, 25.4, 50.8, 0, 0, tmp_path, whole, table).compile()
    assert sorted(p.name for p in tmp_path.iterdir()) == [f"{name}_0000{n}.bmp" for name in ("blue", "red") for n in (0, 1)]
    data = (tmp_path / "red_00001.bmp").read_bytes()
    offset, columns, rows = *struct.unpack("<I", data[10:14]), *struct.unpack("<ii", data[18:26])
    assert (columns, rows) == (20, 16) and struct.unpack("<H", data[28:30]) == (1,)  # pixels of 1 x 0.5 mm
    bits = numpy.unpackbits(numpy.frombuffer(data[offset:], dtype=numpy.uint8).reshape(16, 4), axis=1)[:, :20]
    assert (bits[:, :10] == 0).all() and (bits[:, 10:] == 1).all() and data[54:58] == bytes(4)  # 0 is black
    with pytest.raises(pv.MissingFeature, match="taper"):
        pvc.MyersonCompiler(0.5, 25.4, 50.8, 2, 0, tmp_path, whole, table)


def test_what_no_printer_of_vats_can_make(tmp_path):
    table, make = pv.default_materials, pvc.MultiMaterialVatCompiler
    part = pv.RectPrism(origin, pv.Vec3(10, 6, 1))
    with pytest.raises(RuntimeError, match="volume_fractions"):
        make(part, tmp_path / "a", table, ["red"]).compile()
    part.set_attribute("volume_fractions", pv.VolumeFractionsAttribute([("x", table.id("red")), ("1 - x", table.id("blue"))]))
    with pytest.raises(RuntimeError, match="no vat has the material blue"):
        make(part, tmp_path / "a", table, ["red"], 0.5).compile()
    with pytest.raises(ValueError, match="1 to 2 materials for DUAL"):
        make(part, tmp_path / "a", table, ["red", "blue", "green"])
    make(part, tmp_path / "a", table, ["red", "blue", "green"], system=pvc.MultiMaterialVatSystem.QUAD)
    with pytest.raises(ValueError, match="0.01 mm or more"):
        make(part, tmp_path / "a", table, ["red", "blue"], 0.001)
    large = pv.RectPrism(origin, pv.Vec3(56, 6, 1))
    large.set_attribute("volume_fractions", pv.VolumeFractionsAttribute([(1, table.id("red"))]))
    with pytest.raises(RuntimeError, match="56 x 6 x 1 mm"):
        make(large, tmp_path / "a", table, ["red"]).compile()
    assert not (tmp_path / "a").exists()


# The bottom of tests/cad/cylinder.step is a disc of radius 5 at the lower end; its outer side is below.
def test_reliefs_lie_on_faces(tmp_path):
    model = pv.CADModel.from_step(pathlib.Path(__file__).parents[1] / "cad" / "cylinder.step")
    (lower,) = model.select_faces(normal=(0, 0, -1), min_dot=0.9)
    z = lower.centroid.z
    heights = pv.FunctionalHeightField(pv.FloatAttribute("0.5"), amplitude_mm=2)
    relief = pv.SurfaceReliefVolume(lower, heights, embed_mm=0.5, edge_falloff_mm=1)
    for below, inside in ((-0.45, True), (-0.55, False), (0.95, True), (1.05, False)):
        assert (relief.evaluate(0.3, 0.2, z - below) <= 0) == inside, below
    # Half way through the band along the border it is half as high.
    assert relief.evaluate(4.5, 0, z - 0.4) < 0 < relief.evaluate(4.5, 0, z - 0.6)
    assert relief.evaluate(5.2, 0, z - 0.1) > 0
    # An image whose upper half is white: (0, 0) is the lower left.
    pixels = numpy.zeros((8, 4), dtype=numpy.uint8)
    pixels[:4] = 255
    write_gray(tmp_path / "half.png", pixels)
    printed = pv.SurfaceReliefVolume(lower, pv.ImageHeightField(tmp_path / "half.png", 1.0))
    u, v, _ = printed._above.place
    for x, y in ((0, 2), (0, -2), (2, 0.5), (-2, -0.5), (1, 1), (-1, 1)):
        share = float(v([[x, y, z - 0.5]])[0])
        if abs(share - 0.5) > 0.1:
            assert (printed.evaluate(x, y, z - 0.5) < 0) == (share > 0.5)
    with pytest.raises(TypeError, match="CADFace or a TriangleMeshSurface"):
        pv.SurfaceReliefVolume(ball(), heights)
    with pytest.raises(ValueError, match="luminance"):
        pv.ImageHeightField(tmp_path / "half.png", 1.0, channel="alpha")
    with pytest.raises(ValueError):
        pv.FunctionalHeightField(pv.FloatAttribute(1), amplitude_mm=0)


def test_tables_of_several_inputs():
    part = pv.RectPrism(origin, pv.Vec3(20, 20, 2))
    part.set_attribute("a", pv.FloatAttribute("x"))
    part.set_attribute("b", pv.FloatAttribute("y"))
    entry, lines = pv.LookupTableEntry, pv.InterpolationMode.LINEAR
    grid = [entry([p, q], 10 * p + p * q) for q in (-4, 0, 5) for p in (-2, 3)]  # bilinear itself
    between = pv.AttributeModifier(pv.LookupTableConverter(["a", "b"], ["c"], grid, lines), part)
    for x, y in [(0, 0), (1.5, -3), (2.9, 4), (-2, 5)]:
        assert between.sample(x, y, 0)[1].get_sample("c") == pytest.approx(10 * x + x * y)
    assert between.sample(9, 9, 0)[1].get_sample("c") == pytest.approx(10 * 3 + 3 * 5)  # the ends
    steps = [entry([(-10, 0), (-10, 5)], [1, 7]), entry([(0, 10), (5, 10)], [2, 8])]
    each = pv.AttributeModifier(pv.LookupTableConverter(["a", "b"], ["c", "e"], steps), part).sample(4, -3, 0)[1]
    assert each.get_sample("c") == 2 and each.get_sample("e") == 7
    with pytest.raises(ValueError, match="each combination of keys"):
        pv.LookupTableConverter(["a", "b"], ["c"], grid[:-1], lines)
    cube = [entry([p, q, r], p * q * r + r) for p in (0, 2) for q in (-4, 5) for r in (1, 3)]  # trilinear itself
    box = ball()
    for name, formula in zip("abc", ("x", "y", "z + 2")):
        box.set_attribute(name, pv.FloatAttribute(formula))
    between = pv.AttributeModifier(pv.LookupTableConverter(["a", "b", "c"], ["d"], cube, lines), box)
    assert between.sample(1.5, -3, 0.25)[1].get_sample("d") == pytest.approx(1.5 * -3 * 2.25 + 2.25)
    with pytest.raises(ValueError, match="2 ranges"):
        pv.LookupTableConverter(["a", "b"], ["c", "e"], [entry(0, 1, [1, 2])])
    grid[0].is_valid = False
    holed = pv.AttributeModifier(pv.LookupTableConverter(["a", "b"], ["c"], grid, lines), part)
    with pytest.raises(RuntimeError, match=r"'c' has no finite value at \(-1, -3, 0\)"):
        holed.sample(-1, -3, 0)
    assert holed.sample(1, 2, 0)[1].get_sample("c") == pytest.approx(12)


class Product(pv.AttributeConverterBase):
    def required_attributes(self):
        return ["a", "b"]

    def output_attributes(self):
        return ["c", "e"]

    def convert(self, samples):
        samples.set_sample("c", samples.get_sample("a") * samples.get_sample("b"))
        samples.set_sample("e", samples.get_sample("a") - samples.get_sample("b"))
        return samples


def test_converters_of_ones_own():
    part = ball()
    part.set_attribute("a", pv.FloatAttribute("x"))
    part.set_attribute("b", pv.FloatAttribute("y + 1"))
    samples = pv.AttributeModifier(Product(), part).sample(2, 1, 0)[1]
    assert samples.get_sample("c") == pytest.approx(2 * 2) and samples.get_sample("e") == pytest.approx(0)
    with pytest.raises(NotImplementedError, match="convert"):
        pv.AttributeConverterBase().convert(samples)


def two_balls():
    left, right = pv.Sphere(pv.Vec3(-2, 0, 0), 3), pv.Sphere(pv.Vec3(2, 0, 0), 3)
    left.set_attribute("a", pv.FloatAttribute("1 + x"))
    right.set_attribute("a", pv.FloatAttribute(10))
    return left, right


def test_conflicts_are_resolved_by_functions():
    both = pv.Union(0.0, [*two_balls(), pv.Sphere(pv.Vec3(0, 0, 0), 0.5)])  # the third has no such attribute
    both.set_attribute_conflict_resolver("a", pv.resolvers.CustomFloatConflictResolver(lambda left, right: 2 * left + right))
    assert both.sample(0.5, 0, 0)[1].get_sample("a") == pytest.approx(2 * 1.5 + 10)
    assert both.sample(-3, 0, 0)[1].get_sample("a") == pytest.approx(-2)
    assert both.sample(3, 0, 0)[1].get_sample("a") == pytest.approx(10)
    four = pv.Intersection(0.0, [ball() for _ in range(4)])
    for node in four.children():
        node.set_attribute("n", pv.FloatAttribute(1))
    four.set_attribute_conflict_resolver("n", pv.resolvers.CustomFloatConflictResolver(lambda a, b: a + b))
    assert four.sample(0, 0, 0)[1].get_sample("n") == pytest.approx(4)
    with pytest.raises(TypeError, match="1 function"):
        pv.resolvers.CustomFloatConflictResolver("a + b")


def test_vectors_are_compared_as_a_whole():
    colours = [pv.Vec4Attribute(1, 0, 0, 1), pv.Vec4Attribute(0.6, 0.6, 0.6, 0.5)]
    for resolver, wanted in [(pv.resolvers.MaxConflictResolver(pv.Vec4Mode.Magnitude), (1, 0, 0, 1)),
                             (pv.resolvers.MinConflictResolver(pv.Vec4Mode.Magnitude), (0.6, 0.6, 0.6, 0.5)),
                             (pv.resolvers.MaxConflictResolver(), (1, 0.6, 0.6, 1))]:
        nodes = [ball(), ball()]
        for node, colour in zip(nodes, colours):
            node.set_attribute("color_rgba", colour)
        both = pv.Union(0.0, nodes)
        both.set_attribute_conflict_resolver("color_rgba", resolver)
        assert list(both.sample(1, 0, 0)[1].get_sample("color_rgba")) == pytest.approx(wanted)


def inkjet(tmp_path, root, **options):
    return pvc.MaterialInkjetCompiler(root, pv.Vec3(0.5, 0.5, 0.5), tmp_path / "layers", "p", pv.j750_materials, **options)


def test_inkjet_keeps_liquid_from_the_surface(tmp_path):
    table = pv.j750_materials
    part = pv.RectPrism(origin, pv.Vec3(8, 8, 8))
    part.set_attribute("volume_fractions", pv.VolumeFractionsAttribute(
        [(0.5, table.id("M.Cleanser")), (0.5, table.id("VeroClear"))]))
    compiler = inkjet(tmp_path, part, liquid_keep_out_distance=2)
    compiler.compile()
    counts = compiler.material_voxel_counts()
    inner = 8 ** 3  # voxels deeper than 2 mm: 4 mm of 0.5 mm each way
    assert counts[table.id("M.Cleanser")] == pytest.approx(inner / 2, rel=0.15)
    assert sum(counts.values()) == 16 ** 3 and compiler.resolution() == (16, 16, 16)
    (tmp_path / "dry.json").write_text('{"materials": [{"name": "a", "r": 9, "g": 9, "b": 9}]}')
    with pytest.raises(RuntimeError, match="no liquid"):
        pvc.DirectMaterialCompiler(ball(), pv.Vec3(1, 1, 1), pv.MaterialDefs(str(tmp_path / "dry.json")), tmp_path, "p", True, 2)


def test_inkjet_of_what_nothing_is_said_of(tmp_path, capsys):
    said, unsaid = pv.RectPrism(origin, pv.Vec3(4, 4, 4)), pv.RectPrism(pv.Vec3(0, 0, 8), pv.Vec3(4, 4, 4))
    said.set_attribute("volume_fractions", pv.VolumeFractionsAttribute([(1, 2)]))
    root = pv.Union(0.0, [said, unsaid])
    compiler = inkjet(tmp_path, root)
    compiler.compile()
    assert compiler.material_voxel_counts() == {2: 512} and compiler.resolution()[2] == 8  # the rest is void
    compiler.report_stats()
    assert "voxels: 512" in capsys.readouterr().out
    compiler.set_fallback_material_id(3)
    compiler.compile()
    assert compiler.material_voxel_counts() == {2: 512, 3: 512} and compiler.resolution()[2] == 24
    compiler.set_strict_mode(True)
    with pytest.raises(RuntimeError, match=r"nothing gives volume_fractions at \(-1.75, -1.75, 6.25\)"):
        compiler.compile()


def test_inkjet_can_be_cancelled(tmp_path):
    part = ball()
    part.set_attribute("volume_fractions", pv.VolumeFractionsAttribute([(1, 2)]))
    compiler = inkjet(tmp_path, part)
    compiler.set_progress_callback(lambda share: compiler.cancel())
    with pytest.raises(RuntimeError, match="cancelled"):
        compiler.compile()
    assert list((tmp_path / "layers").iterdir()) == []


def test_vat_in_strict_mode(tmp_path):
    said, unsaid = pv.RectPrism(origin, pv.Vec3(4, 4, 4)), pv.RectPrism(pv.Vec3(0, 0, 8), pv.Vec3(4, 4, 4))
    said.set_attribute("intensity", pv.FloatAttribute(1))
    compiler = pvc.VatCompiler(pv.Union(0.0, [said, unsaid]), pv.Vec3(1, 1, 1), tmp_path / "vat", "p")
    compiler.set_strict_mode(True)
    with pytest.raises(RuntimeError, match=r"VatCompiler: nothing gives intensity at \(-1.5, -1.5, 6.5\)"):
        compiler.compile()
    unsaid.set_attribute("intensity", pv.FloatAttribute(0.5))
    compiler.compile()
    assert compiler.resolution() == (4, 4, 12)  # 2 mm of air in the middle
    compiler.set_progress_callback(lambda share: compiler.cancel())
    with pytest.raises(RuntimeError, match="cancelled"):
        compiler.compile()


def test_colour_inkjet(tmp_path):
    table = pv.j750_materials
    gray = pv.RectPrism(origin, pv.Vec3(20, 20, 20))
    gray.set_attribute("color_rgba", pv.Vec4Attribute(0.5, 0.5, 0.5, 0.75))
    unsaid = pv.RectPrism(pv.Vec3(0, 0, 20), pv.Vec3(20, 20, 20))
    compiler = pvc.ColorInkjetCompiler(pv.Union(0.0, [gray, unsaid]), pv.Vec3(1, 1, 1), tmp_path, "c")
    compiler.compile()
    counts = compiler.material_voxel_counts()
    # A quarter of the gray is clear, and all of what has no colour. The mean light of the other voxels is that of the gray.
    assert counts.pop(table.id("VeroClear")) == pytest.approx(2000 + 8000, rel=0.02)
    assert sum(counts.values()) == pytest.approx(6000, rel=0.02)
    for channel in range(3):
        values = {id: table.color(id)[channel] / 255 for id in counts}
        light = {id: v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for id, v in values.items()}
        mean = sum(count * light[id] for id, count in counts.items()) / sum(counts.values())
        assert mean == pytest.approx(((0.5 + 0.055) / 1.055) ** 2.4, rel=0.05)
    assert compiler.resolution() == (20, 20, 40) and (tmp_path / "c39.png").exists()
    compiler.set_fallback_color((0, 0, 0, 1))
    compiler.compile()
    assert compiler.material_voxel_counts()[table.id("VeroClear")] == pytest.approx(2000, rel=0.06)
    compiler.set_strict_mode(True)
    with pytest.raises(RuntimeError, match="nothing gives color_rgba"):
        compiler.compile()
    with pytest.raises(ValueError, match="there is no ICC profile 'fogra39'"):
        pvc.ColorInkjetCompiler(gray, pv.Vec3(1, 1, 1), tmp_path, "c", "fogra39")
    with pytest.raises(RuntimeError, match="color_rgba"):
        pvc.ColorInkjetCompiler(ball(), pv.Vec3(1, 1, 1), tmp_path, "c").compile()


def test_colour_inkjet_with_a_profile(tmp_path):
    """The profile is made of patches whose light adds up, so that the droplets' light is that of the colour."""
    (tmp_path / "patches.csv").write_text(run_ink.patches())
    subprocess.run([sys.executable, "-m", "ombre", "calibrations", "--measured", "patches.csv", "-o", "vero.json"],
                   cwd=tmp_path, check=True)
    block = pv.RectPrism(origin, pv.Vec3(20, 20, 20))
    block.set_attribute("color_rgba", pv.Vec4Attribute(0.6, 0.5, 0.4, 1))
    pvc.ColorPipeline.set_icc_resource_path(tmp_path)
    assert pvc.ColorPipeline.get_icc_profiles() == ["default", "vero"]
    voxel = pv.Vec3(0.5, 0.5, 0.5)
    compiler = pvc.ColorInkjetCompiler(block, voxel, tmp_path / "out", "c", "vero")
    compiler.compile()
    counts = compiler.material_voxel_counts()
    assert sum(counts.values()) == 64000
    inks = dict(zip(("VeroCyan", "VeroMagenta", "VeroYellow", "VeroBlack", "VeroPureWht"), run_ink.LIGHTS.values()))
    shares = {pv.j750_materials.name(id): count / 64000 for id, count in counts.items()}
    light = [sum(share * inks[name][part] for name, share in shares.items()) for part in range(3)]
    shown = run_ink.lab_of_light([own / white for own, white in zip(light, run_ink.LIGHTS["white"])])
    # Of sRGB (153, 128, 102), whose XYZ is compressed to between the light of the black ink, 1/45 of white's, and white.
    assert shown == pytest.approx((57.020, 6.796, 16.302), abs=1)
    options = pvc.ColorPipelineOptions()
    options.icc_profile_enabled = False
    plain = pvc.ColorInkjetCompiler(block, voxel, tmp_path / "plain", "c", "vero", color_pipeline_options=options)
    plain.compile()
    assert plain.material_voxel_counts() != counts
    with pytest.raises(NotADirectoryError, match="there is no folder"):
        pvc.ColorPipeline.set_icc_resource_path(tmp_path / "none")

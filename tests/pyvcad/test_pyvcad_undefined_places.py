"""Places of a part that nothing gives an attribute: what compilers, resolvers and samplers make of them."""
import math
import pathlib
import sys
import warnings
import xml.etree.ElementTree as ElementTree
import zipfile

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_compilers as pvc
import pyvcad_metamaterials as mm

from pyvcad_parts import blue, green, origin, red

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import png  # noqa: E402  beside the other tests

V = pv.Vec3


def box(attributes=None, center=origin, size=V(4, 4, 4)):
    part = pv.RectPrism(center, size)
    for name, attribute in (attributes or {}).items():
        part.set_attribute(name, attribute)
    return part


def of(material):
    return {"volume_fractions": pv.VolumeFractionsAttribute([(1.0, material)])}


def beside(part, attributes):
    """The part and a box with attributes, 10 mm apart from each other and more."""
    return pv.Union(0.0, [box(attributes, V(-40, 0, 0)), part])


# Materials.

def printed(part, folder, **settings):
    """How many voxels of 0.5 mm have each material; the fallback is green."""
    compiler = pvc.MaterialInkjetCompiler(part, V(0.5, 0.5, 0.5), folder, "p", pv.default_materials)
    compiler.set_fallback_material_id(green)
    compiler.set_strict_mode(settings.get("strict", False))
    compiler.compile()
    return compiler.material_voxel_counts()


def unit_map():
    return mm.rectangular_cell_map((V(0, 0, 0), V(4, 4, 4)), cells=(1, 1, 1))


def partly_graded_lattice():
    """Struts along x are blue; nothing is said of the others."""
    lattice = mm.cubic(unit_map(), beam_radius=0.5)
    lattice.struts.where(lambda strut: abs(strut.direction.x) > 0.5).set_attribute("volume_fractions", of(blue)["volume_fractions"])
    return lattice


solids_without_material = {
    "corners": lambda: pv.RectPrism.FromMinAndMax(V(0, 0, 0), V(2, 2, 2)),
    "beams": lambda: pv.BeamLattice([V(0, 0, 0), V(4, 0, 0)], [(0, 1)], 1.0),
    "beams and balls": lambda: pv.BeamLattice([V(0, 0, 0), V(4, 0, 0)], [(0, 1)], 1.0, ball_mode=pv.BallMode.All, ball_radius=2.0),
    "supports": lambda: pv.SupportAnalyzer(pv.Sphere(V(0, 0, 5), 2), 0.5).analyze(),
    "struts": lambda: mm.cubic(unit_map(), beam_radius=0.5)}


@pytest.mark.parametrize("name", solids_without_material)
def test_solids_without_a_material_are_printed_as_the_fallback(name, tmp_path):
    part = beside(solids_without_material[name](), of(blue))
    counts = printed(part, tmp_path)
    assert counts.pop(blue) == 8 ** 3 and list(counts) == [green]
    with pytest.raises(RuntimeError, match="nothing gives volume_fractions"):
        printed(part, tmp_path, strict=True)


solids_with_material = {
    "corners": lambda: pv.RectPrism.FromMinAndMax(V(0, 0, 0), V(2, 2, 2), red),
    "graded": lambda: pv.FGrade([1.0], [red], True, pv.RectPrism(origin, V(4, 4, 4))),
    "supports": lambda: pv.SupportAnalyzer(pv.Sphere(V(0, 0, 5), 2), 0.5, red).analyze(),
    "of ombre": lambda: pv.Identity(ombre.cube(4, "red")),
    "tagged struts": lambda: pv.MappedGraphLattice(unit_map(), pv.GraphUnitCell([V(0, 0, 0), V(1, 1, 1)], [(0, 1)],
                                                                               material_tags=[red]), 0.5)}


@pytest.mark.parametrize("name", solids_with_material)
def test_a_given_material_is_no_undefined_place(name, tmp_path):
    counts = printed(beside(solids_with_material[name](), of(blue)), tmp_path, strict=True)
    assert counts.pop(blue) == 8 ** 3 and list(counts) == [red]


def test_struts_without_a_material_beside_some_that_have_one(tmp_path):
    counts = printed(partly_graded_lattice(), tmp_path)
    assert set(counts) == {blue, green} and counts[green] > counts[blue] > 0
    assert not partly_graded_lattice().sample(0, 0, 2)[1].has_sample("volume_fractions")
    with pytest.raises(RuntimeError, match="nothing gives volume_fractions"):
        printed(partly_graded_lattice(), tmp_path, strict=True)


def test_the_fallback_changes_no_solid(tmp_path):
    strut, balls = pv.Strut(V(0, 0, 0), V(0, 0, 6), 1.5), solids_without_material["beams and balls"]()
    for part in (strut, balls):
        sampler = pv.TreeSampler(part, 0.5)
        inside = int((sampler.as_signed_distance_array()[3] <= 0).sum())
        assert printed(beside(part, of(blue)), tmp_path) == {blue: 8 ** 3, green: inside}


def test_seams_have_the_materials_of_both_sides(tmp_path):
    for part in (box(None, V(4, 1, 0)), pv.BeamLattice([V(2, 2, 0), V(8, 2, 0)], [(0, 1)], 2.0)):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            counts = printed(pv.Union(3.0, [box(of(blue)), part]), tmp_path)
        assert set(counts) == {blue, green}


def by_q():
    """A table from q to a material, and two boxes of which one has q."""
    rows = [pv.LookupTableEntry(0, {red: 1.0}), pv.LookupTableEntry(1, {blue: 1.0})]
    table = pv.LookupTableConverter(["q"], ["volume_fractions"], rows, pv.InterpolationMode.LINEAR)
    return pv.AttributeModifier(table, beside(box(), {"q": pv.FloatAttribute(1)}))


def test_a_table_says_nothing_where_its_input_is_missing(tmp_path):
    assert not by_q().sample(0, 0, 0)[1].has_sample("volume_fractions")
    assert printed(by_q(), tmp_path) == {blue: 8 ** 3, green: 8 ** 3}
    with pytest.raises(RuntimeError, match=r"nothing gives volume_fractions at \(-1.75, -1.75, -1.75\)"):
        printed(by_q(), tmp_path, strict=True)


def test_a_converter_takes_attributes_of_solids_of_ombre(tmp_path):
    formula = pv.VolumeFractionsExpressionConverter(["q"], [red, blue], ["1 - q", "q"])
    part = pv.AttributeModifier(formula, ombre.attribute(ombre.cube(4), "q", 1))
    assert part.sample(0, 0, 0)[1].get_sample("volume_fractions") == {blue: 1}
    assert printed(part, tmp_path, strict=True) == {blue: 8 ** 3}


def test_compilers_that_need_materials_refuse_places_without(tmp_path):
    part = beside(pv.RectPrism.FromMinAndMax(V(0, 0, 0), V(2, 2, 2)), of(blue))
    slots = {"red": 1, "blue": 2}
    mixed = pvc.FullSpectrumSlicerProjectCompiler(part, 0.5, tmp_path / "a.3mf", volume_fraction_materials=slots)
    vats = pvc.MultiMaterialVatCompiler(part, tmp_path / "vats", pv.default_materials, ["red", "blue"], 0.5)
    for compiler in (mixed, vats):
        with pytest.raises(RuntimeError, match="nothing gives volume_fractions at"):
            compiler.compile()


def test_layers_in_black_and_white_leave_places_without_a_material_out(tmp_path):
    part = beside(box(), of(blue))
    compiler = pvc.MyersonCompiler(0.5, 50.8, 50.8, 0, 0, tmp_path, part, pv.default_materials)
    compiler.compile()
    black = {name: sum(bits_of(path) for path in tmp_path.glob(f"{name}_*.bmp")) for name in ("red", "blue")}
    assert black == {"red": 0, "blue": 8 ** 3}
    compiler.set_strict_mode(True)
    with pytest.raises(RuntimeError, match="MyersonCompiler: nothing gives volume_fractions at"):
        compiler.compile()


def bits_of(path):
    """The count of black pixels of a BMP of one bit, whose width it takes from the header."""
    data = path.read_bytes()
    start, width, height = (int.from_bytes(data[n:n + 4], "little") for n in (10, 18, 22))
    stride = (width + 31) // 32 * 4
    return sum(not data[start + row * stride + n // 8] & 128 >> n % 8 for row in range(height) for n in range(width))


# The following tests are of places where children overlap.

def averaged(children, rule=pv.resolvers.AverageConflictResolver, kind=pv.Union):
    whole = kind(children)
    whole.set_attribute_conflict_resolver("volume_fractions", rule())
    return whole


kinds_of_overlap = [pv.Union, pv.Intersection, pv.BBoxUnion, pv.BBoxIntersection]


@pytest.mark.parametrize("kind", kinds_of_overlap)
def test_means_of_fractions_are_those_of_the_children_that_have_some(kind):
    both, alone = averaged([box(), box(of(blue))], kind=kind), averaged([box(of(blue)), box()], kind=kind)
    assert both.distribution(0, 0, 0) == alone.distribution(0, 0, 0) == {blue: 1}
    three = averaged([box(of(blue)), box(), box(of(red))], kind=kind)
    assert three.distribution(0, 0, 0) == {blue: 0.5, red: 0.5}
    assert three.sample(0, 0, 0)[1].get_sample("volume_fractions") == {blue: 0.5, red: 0.5}


def test_means_of_given_materials_count_all_children():
    half = averaged([pv.RectPrism(origin, V(4, 4, 4), green), box(of(blue))])
    assert half.distribution(0, 0, 0) == {blue: 0.5, green: 0.5}
    mixed = pv.Union(True, [box(), pv.RectPrism(origin, V(4, 4, 4), blue)])  # of pyvcad 2, where the material is 1
    assert mixed.distribution(0, 0, 0) == {red: 0.5, blue: 0.5}


@pytest.mark.parametrize("kind", kinds_of_overlap)
def test_fractions_of_an_overlap_are_those_of_the_first_child_that_has_some(kind, tmp_path):
    whole = kind([box(), box(of(blue)), box(of(red))])
    assert whole.sample(0, 0, 0)[1].get_sample("volume_fractions") == whole.distribution(0, 0, 0) == {blue: 1}
    assert printed(whole, tmp_path, strict=True) == {blue: 8 ** 3}


def test_a_child_without_fractions_keeps_what_is_its_own_without_a_warning(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        whole = pv.Union([box(size=V(6, 6, 6)), box(of(blue), V(2, 0, 0))])
        assert printed(whole, tmp_path) == {blue: 8 ** 3, green: 12 ** 3 - 6 * 8 * 8}
        pvc.DirectMaterialCompiler(whole, V(0.5, 0.5, 0.5), pv.default_materials, tmp_path, "d").compile()


def test_seams_are_as_round_whichever_child_has_fractions():
    children = [box(), box(of(blue), V(5, 1, 0)), box(None, V(2, 4, 0))]
    plain = pv.Union(2.0, [box(), box(None, V(5, 1, 0)), box(None, V(2, 4, 0))])
    for whole in (pv.Union(2.0, children), averaged(children, kind=lambda nodes: pv.Union(2.0, nodes))):
        for point in [(2.2, 1.9, 0), (2.5, 2.5, 0), (4, -1, 0), (0.5, 2.3, 0)]:
            assert whole.evaluate(*point) == pytest.approx(plain.evaluate(*point), abs=1e-12)


@pytest.mark.parametrize("rule", [pv.resolvers.MinConflictResolver, pv.resolvers.MaxConflictResolver,
                                  lambda: pv.resolvers.CustomFloatConflictResolver(max)])
def test_fractions_have_a_mean_and_no_least_or_greatest(rule):
    with pytest.raises(RuntimeError, match=r"volume_fractions have a mean .* write resolvers.AverageConflictResolver\(\)"):
        averaged([box(of(red)), box(of(blue))], rule)


# Colours.

in_red = {"color_rgba": pv.Vec4Attribute(1, 0, 0, 1)}


def sprayed(part, folder, **settings):
    """How many voxels of 0.5 mm have each ink."""
    compiler = pvc.ColorInkjetCompiler(part, V(0.5, 0.5, 0.5), folder, "p")
    compiler.set_strict_mode(settings.get("strict", False))
    if "fallback" in settings:
        compiler.set_fallback_color(settings["fallback"])
    compiler.compile()
    return {pv.j750_materials.name(id): count for id, count in compiler.material_voxel_counts().items()}


def textured(folder):
    """A box whose file is red, down to its middle."""
    corners = [V(x, y, z) for z in (-2, 2) for y in (-2, 2) for x in (-2, 2)]
    faces = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2),
             (1, 3, 7), (1, 7, 5)]
    pv.SurfaceMesh(corners, faces).write_stl(folder / "box.stl")
    return pv.TexturedMesh(str(folder / "box.stl"), fallback_color=V(1, 0, 0), color_depth=10)


def struts_in_red():
    part = mm.cubic(unit_map(), beam_radius=0.5)
    part.struts.set_attribute("color_rgba", in_red["color_rgba"])
    return part


def test_computed_colours_are_printed(tmp_path):
    red_box = sprayed(box(in_red), tmp_path)
    assert set(red_box) == {"VeroMagenta", "VeroYellow"} and sum(red_box.values()) == 8 ** 3
    assert sprayed(textured(tmp_path), tmp_path, strict=True) == red_box
    assert "VeroClear" not in sprayed(struts_in_red(), tmp_path, strict=True)


@pytest.mark.parametrize("kind", kinds_of_overlap)
def test_a_fallback_colour_takes_no_part_where_a_colour_is_given(kind, tmp_path):
    red_box = sprayed(box(in_red), tmp_path)
    for children in ([box(), box(in_red)], [box(in_red), box()]):
        assert sprayed(kind(children), tmp_path) == red_box
        mean = kind(children)
        mean.set_attribute_conflict_resolver("color_rgba", pv.resolvers.AverageConflictResolver())
        assert sprayed(mean, tmp_path, strict=True) == red_box


def test_places_without_a_colour_are_the_fallback(tmp_path):
    rows = [pv.LookupTableEntry(0, pv.Vec4(1, 0, 0, 1)), pv.LookupTableEntry(1, pv.Vec4(0, 0, 0, 1))]
    table = pv.LookupTableConverter(["q"], ["color_rgba"], rows, pv.InterpolationMode.LINEAR)
    by_table = pv.AttributeModifier(table, beside(box(), {"q": pv.FloatAttribute(1)}))
    for part in (beside(box(), {"color_rgba": pv.Vec4Attribute(0, 0, 0, 1)}), by_table):
        black_and_clear = sprayed(part, tmp_path)
        assert black_and_clear.pop("VeroClear") == 8 ** 3 and sum(black_and_clear.values()) == 8 ** 3
        assert "VeroClear" not in sprayed(part, tmp_path, fallback=(0, 0, 0, 1))
        with pytest.raises(RuntimeError, match="nothing gives color_rgba at"):
            sprayed(part, tmp_path, strict=True)


def test_what_is_cut_away_leaves_no_colour_and_no_material(tmp_path):
    cut = pv.Difference(box(), box(in_red | of(blue), size=V(2, 2, 2)))
    assert sprayed(cut, tmp_path, fallback=(0, 0, 0, 0)) == {"VeroClear": 8 ** 3 - 4 ** 3}
    assert printed(cut, tmp_path) == {green: 8 ** 3 - 4 ** 3}


# Lattices of points.

lattices_of_points = {
    "open": lambda host, points: mm.voronoi_graph_lattice(host, points, 1.0, node_radius=0.8),
    "closed": lambda host, points: mm.voronoi_graph_lattice(host, points, 1.0, boundary="closed"),
    "closed with balls": lambda host, points: mm.voronoi_graph_lattice(host, points, 1.0, node_radius=0.8, boundary="closed"),
    "blended": lambda host, points: mm.voronoi_graph_lattice(host, points, 1.0, member_blend_radius=0.3),
    "closed between neighbours": lambda host, points: mm.delaunay_graph_lattice(host, points, 1.0, boundary="closed"),
    "walls": lambda host, points: mm.voronoi_plate_lattice(host, points, 0.5),
    "walls and a skin": lambda host, points: mm.voronoi_plate_lattice(host, points, 0.5, boundary="closed"),
    "walls between neighbours": lambda host, points: mm.delaunay_plate_lattice(host, points, 0.5)}


@pytest.mark.parametrize("name", lattices_of_points)
def test_lattices_of_points_are_of_what_their_body_is(name):
    host = box({"q": pv.FloatAttribute("x")} | of(blue), V(5, 5, 5), V(10, 10, 10))
    plain = box(None, V(5, 5, 5), V(10, 10, 10))
    points = mm.sample_points_in_host(host, spacing=2.5, seed=3)
    lattice, bare = (lattices_of_points[name](body, points) for body in (host, plain))
    places = numpy.random.default_rng(0).uniform(0, 10, (500, 3))
    found = [(place, sample) for place, (_, sample) in zip(places, pv.TreeSampler(lattice, 0.5).sample_points(places)) if sample]
    assert len(found) > 20
    for place, sample in found:
        assert sample.get_sample("q") == pytest.approx(place[0])
        assert sample.get_sample("volume_fractions") == lattice.distribution(*place) == {blue: 1}
    distances = [numpy.array(pv.TreeSampler(part, 0.5).evaluate_points(places)) for part in (lattice, bare)]
    assert numpy.allclose(*distances)
    without = [sample for _, sample in pv.TreeSampler(bare, 0.5).sample_points(places) if sample]
    assert not any(sample.has_sample("volume_fractions") for sample in without)


# Attributes that solids bring along.

def test_attributes_of_solids_of_ombre_end_with_these(tmp_path):
    part = pv.Union(box(None, V(5, 0, 0), V(2, 2, 2)), ombre.attribute(ombre.cube(2), "q", 3))
    assert part.sample(0, 0, 0)[1].get_sample("q") == 3
    assert not part.sample(5, 0, 0)[1].has_sample("q")
    of_both = pv.Union(part, box({"q": pv.FloatAttribute(4)}, V(0, 9, 0)))
    assert [of_both.sample(*place)[1].has_sample("q") for place in ((0, 0, 0), (5, 0, 0), (0, 9, 0))] == [True, False, True]


# Strict mode.

def half_with(name):
    """A box with the attribute, and one without it around the origin."""
    return beside(box(), of(blue) if name == "volume_fractions" else {name: pv.FloatAttribute("50 + x/10")})


def simulation(kind, name):
    def made(part, folder):
        settings = pvc.SimulationCompilerSettings()
        settings.backend, settings.mesh_kind = pvc.SimulationBackend.GENERIC, kind
        settings.direct_attributes = [] if name == "volume_fractions" else [name]
        return pvc.SimulationCompiler(part, settings)
    return made


strict_compilers = {
    "prusa": ("infill_density", lambda part, folder: pvc.PrusaSlicerProjectCompiler(part, 0.5, folder / "a.3mf", num_regions=2)),
    "vdb, all": ("q", lambda part, folder: pvc.VdbCompiler(part, 0.5, folder / "a.vdb")),
    "vdb, named": ("q", lambda part, folder: pvc.VdbCompiler(part, 0.5, folder / "a.vdb", ["q"], True)),
    "bricks": ("modulus", simulation(pvc.SimulationMeshKind.HEX, "modulus")),
    "tetrahedra": ("modulus", simulation(pvc.SimulationMeshKind.TET, "modulus")),
    "materials of bricks": ("volume_fractions", simulation(pvc.SimulationMeshKind.HEX, "volume_fractions"))}


@pytest.mark.parametrize("name", strict_compilers)
def test_strict_mode_refuses_places_without_the_attribute(name, tmp_path):
    attribute, make = strict_compilers[name]
    whole = half_with(attribute)
    lax = make(whole, tmp_path)
    lax.compile()
    for file in tmp_path.iterdir():
        file.unlink()
    strict = make(whole, tmp_path)
    strict.set_strict_mode(True)
    with pytest.raises(RuntimeError, match=rf"{type(strict).__name__}: nothing gives {attribute} at \(-?[012]"):
        strict.compile()
    assert not list(tmp_path.iterdir())
    good = make(whole.child(0), tmp_path)
    good.set_strict_mode(True)
    good.compile()


def test_strict_simulations_of_one_material_need_no_fractions():
    compiler = simulation(pvc.SimulationMeshKind.HEX, "modulus")(box({"modulus": pv.FloatAttribute(5)}), None)
    compiler.set_strict_mode(True)
    compiler.compile()
    assert set(compiler.model().scalar_fields["modulus"]) == {5}


# Gray images.

def grays(part, folder, **settings):
    """How many pixels have each gray, in all layers."""
    for file in folder.glob("*.bmp"):
        file.unlink()
    compiler = pvc.VatCompiler(part, 0.5, folder, "p")
    if "fallback" in settings:
        compiler.set_fallback_intensity(settings["fallback"])
    compiler.compile()
    assert len(list(folder.glob("*.bmp"))) == compiler.resolution()[2]
    pixels = b"".join(path.read_bytes()[14 + 40 + 4 * 256:] for path in folder.glob("*.bmp"))
    return {shade: pixels.count(shade) for shade in set(pixels) - {0}}


def intensity(value):
    return {"intensity": pv.FloatAttribute(value)}


def test_the_fallback_intensity_is_where_nothing_gives_one(tmp_path):
    rows = [pv.LookupTableEntry(0, 0.25), pv.LookupTableEntry(1, 0.5)]
    table = pv.LookupTableConverter(["q"], ["intensity"], rows, pv.InterpolationMode.LINEAR)
    for part in (beside(box(), intensity(0.5)), pv.AttributeModifier(table, beside(box(), {"q": pv.FloatAttribute(1)}))):
        assert grays(part, tmp_path, fallback=0.25) == {128: 8 ** 3, 64: 8 ** 3}
        assert grays(part, tmp_path) == {128: 8 ** 3, 255: 8 ** 3}
        assert grays(part, tmp_path, fallback=0) == {128: 8 ** 3}
    assert grays(box(), tmp_path, fallback=0.25) == {64: 8 ** 3}
    assert grays(pv.Union(box(), box(intensity(0.5))), tmp_path) == {128: 8 ** 3}
    assert grays(ombre.attribute(ombre.cube(4), "intensity", 0.5), tmp_path) == {128: 8 ** 3}


@pytest.mark.parametrize("formula", ["0/0", "1/0", "if(x > 1, 0/0, 1)"])
def test_an_intensity_that_is_no_number_is_an_error(formula, tmp_path):
    place = r"\(1.25, -1.75, -1.75\)" if "if" in formula else r"\(-1.75, -1.75, -1.75\)"
    with pytest.raises(RuntimeError, match=rf"VatCompiler: intensity is not finite at {place}"):
        grays(box(intensity(formula)), tmp_path)
    assert not list(tmp_path.iterdir())


def test_vats_are_fully_lit_where_nothing_gives_an_intensity(tmp_path):
    def lit(attributes):
        part = pv.Union(box(of(blue), V(5, 0, 0), V(4, 4, 0.5)), box(of(blue) | attributes, size=V(4, 4, 0.5)))
        pvc.MultiMaterialVatCompiler(part, tmp_path / "vats", pv.default_materials, ["blue"], 0.5).compile()
        image = png.Image((tmp_path / "vats" / "vat_a" / "vata_layer_0000.png").read_bytes())
        return {gray for row in image.rows for gray, *_ in row}
    assert lit({"blue_intensity": pv.FloatAttribute(0.5)}) == {0, 128, 255}
    with pytest.raises(RuntimeError, match=r"MultiMaterialVatCompiler: blue_intensity is not finite at \("):
        lit({"blue_intensity": pv.FloatAttribute("0/0")})


# Projects of slicers.

def bodies(part, folder, regions=2):
    """The settings of each body of PrusaSlicer's project by its name, and its volume in mm3."""
    path = folder / "a.3mf"
    pvc.PrusaSlicerProjectCompiler(part, 0.5, path, num_regions=regions).compile()
    with zipfile.ZipFile(path) as archive:
        model = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
        config = ElementTree.fromstring(archive.read("Metadata/Slic3r_PE_model.config"))
    core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    corners = numpy.array([[float(vertex.get(axis)) for axis in "xyz"] for vertex in model.iter(f"{core}vertex")])
    triangles = [corners[[int(triangle.get(f"v{n}")) for n in (1, 2, 3)]] for triangle in model.iter(f"{core}triangle")]
    made = {}
    for body in config.iter("volume"):
        settings = {item.get("key"): item.get("value") for item in body.iter("metadata")}
        own = triangles[int(body.get("firstid")):int(body.get("lastid")) + 1]
        made[settings.pop("name")] = settings, float(sum(numpy.linalg.det(triangle) for triangle in own)) / 6
        assert settings.pop("volume_type") == "ModelPart" and settings.pop("extruder") == "1"
    names = {base.get("name") for base in model.iter(f"{core}base")}
    assert not names or names == set(made)
    return made


def bar(**attributes):
    return box({name: pv.FloatAttribute(value) for name, value in attributes.items()}, size=V(8, 4, 2))


def test_bands_are_those_of_the_places_that_have_the_attribute(tmp_path):
    for rest in (box(None, V(6, 0, 0), V(4, 4, 2)), box(None, V(4, 0, 0), V(8, 4, 2))):  # beside the bar, and half in it
        made = bodies(pv.Union(0.0, [bar(infill_density="50 + 5*x"), rest]), tmp_path)
        assert [settings for settings, _ in made.values()] == [{"fill_density": "40%"}, {"fill_density": "60%"}, {}]
        assert list(made)[-1] == "without infill_density"
        assert [volume for _, volume in made.values()] == pytest.approx([32, 32, 32], rel=0.02)


def test_each_setting_is_missing_where_its_attribute_is(tmp_path):
    names = ["external_perimeter_speed", "perimeter_speed", "fuzzy_skin_point_distance"]
    part = pv.Union(0.0, [bar(**dict.fromkeys(names, 20)), pv.Translate(20, 0, 0, bar(perimeter_speed=20)),
                          pv.Translate(40, 0, 0, bar(external_perimeter_speed=20)), pv.Translate(60, 0, 0, bar())])
    keys = [{*settings} for settings, _ in bodies(part, tmp_path).values()]
    assert len(keys) == 4
    for expected in ({"external_perimeter_speed", "perimeter_speed", "fuzzy_skin_point_dist"}, {"perimeter_speed"},
                     {"external_perimeter_speed"}, set()):
        assert expected in keys
    assert all(value == "20" for settings, _ in bodies(part, tmp_path).values() for value in settings.values())


def test_computed_settings_are_missing_where_their_inputs_are(tmp_path):
    formula = pv.ExpressionConverter(["q"], ["infill_density"], ["50 + 10*q"])
    part = pv.AttributeModifier(formula, pv.Union(0.0, [bar(q="x/4"), pv.Translate(20, 0, 0, pv.Cylinder(origin, 4, 4))]))
    made = bodies(part, tmp_path, regions=10)
    assert len(made) == 11 and made["without infill_density"][0] == {}
    assert made["without infill_density"][1] == pytest.approx(64 * math.pi, rel=0.02)
    densities = [float(settings["fill_density"].rstrip("%")) for settings, _ in made.values() if settings]
    assert densities == pytest.approx([41, 43, 45, 47, 49, 51, 53, 55, 57, 59], abs=1)  # by few samples, since the part is long


def test_tools_need_a_value_everywhere(tmp_path):
    printer = tmp_path / "printer.ini"
    printer.write_text("nozzle_diameter = 0.4\n")
    part = pv.Union(0.0, [bar(temperature=200), pv.Translate(20, 0, 0, bar())])
    compiler = pvc.PrusaSlicerProjectCompiler(part, 0.5, tmp_path / "a.3mf", 2, printer, printer)
    with pytest.raises(RuntimeError, match=r"PrusaSlicerProjectCompiler: nothing gives temperature at \(1[67]"):
        compiler.compile()
    assert not (tmp_path / "a.3mf").exists()


# Arrays of samplers.

@pytest.mark.parametrize("is_alone", [True, False])
def test_arrays_of_numbers_are_0_where_nothing_is(is_alone):
    ball = pv.Sphere(origin, 4)
    ball.set_attribute("q", pv.FloatAttribute("x + 10"))
    ball.set_attribute("v", pv.Vec3Attribute("x + 10", 1, "0/0"))
    ball.set_attribute("c", pv.Vec4Attribute(0.5, 1, 1, 1))
    sampler = pv.TreeSampler(ball if is_alone else pv.Union(0.0, [ball, box(None, V(0, 8, 0))]), 0.5)
    arrays = [sampler.as_float_array("q"), sampler.as_vec3_array("v"), sampler.as_vec4_array("c")]
    counts = sampler.sample_dimensions()
    assert [array.shape for array in arrays] == [counts, (*counts, 3), (*counts, 4)] and arrays[0].dtype == numpy.float32
    x, y, z = numpy.meshgrid(*(numpy.arange(count) * 0.5 - 3.75 for count in counts), indexing="ij")
    has = x ** 2 + y ** 2 + z ** 2 <= 16
    assert numpy.array_equal(arrays[0], numpy.where(has, x + 10, 0).astype(numpy.float32))
    assert (arrays[1][~has] == 0).all() and numpy.isnan(arrays[1][has][:, 2]).all()
    assert (arrays[2][~has] == 0).all() and (arrays[2][has] == (0.5, 1, 1, 1)).all()
    places = [V(9, 0, 0), V(0, 8, 0), V(1, 0, 0)]
    assert sampler.sample_points_to_float_array(places, "q") == [0, 0, 11]
    assert [tuple(v)[:2] for v in sampler.sample_points_to_vec3_array(places, "v")] == [(0, 0), (0, 0), (11, 1)]
    assert [tuple(c) for c in sampler.sample_points_to_vec4_array(places, "c")] == [(0,) * 4, (0,) * 4, (0.5, 1, 1, 1)]


def test_arrays_of_fractions_are_0_where_nothing_gives_some():
    def fractions(part, *places):
        sampler = pv.TreeSampler(part, 0.5, pv.default_materials)
        whole = sampler.as_material_fraction_array()
        assert whole.shape == (math.prod(sampler.sample_dimensions()), pv.default_materials.num_materials() + 1)
        return whole.sum(axis=0), sampler.sample_points_to_material_fraction_array(places)
    sums, at = fractions(beside(box(), of(blue)), V(0, 0, 0), V(-40, 0, 0), V(-20, 0, 0))
    assert sums[blue] == 8 ** 3 == sums.sum()
    assert at[1][blue] == 1 == at.sum()
    assert fractions(box(), V(0, 0, 0))[1].sum() == 0
    assert fractions(pv.RectPrism(origin, V(4, 4, 4), green), V(0, 0, 0))[1][0][green] == 1
    sampler = pv.TreeSampler(box(of(blue)), 0.5, pv.default_materials)
    words = "fractions are those of the attribute 'volume_fractions', found 'nonsense'"
    with pytest.raises(RuntimeError, match=words):
        sampler.as_material_fraction_array("nonsense")
    with pytest.raises(RuntimeError, match=words):
        sampler.sample_points_to_material_fraction_array([origin], "nonsense")


def test_arrays_tell_their_progress(monkeypatch):
    monkeypatch.setattr("pyvcad._grids._points_at_once", 100)
    part = box({"q": pv.FloatAttribute("x"), "v": pv.Vec3Attribute("x", "y", "z"), "c": pv.Vec4Attribute(1, 0, 0, 1)} | of(blue),
               size=V(9, 9, 9))
    sampler = pv.TreeSampler(part, 1, pv.default_materials)
    arrays = {"signed distance": sampler.as_signed_distance_array,
              "float": lambda **tell: sampler.as_float_array("q", **tell),
              "vec3": lambda **tell: sampler.as_vec3_array("v", **tell),
              "vec4": lambda **tell: sampler.as_vec4_array("c", **tell),
              "fractions": lambda **tell: sampler.as_material_fraction_array("volume_fractions", **tell),
              "rgba": lambda **tell: sampler.as_rgba_array("q", pv.ColorMap.create_viridis(), **tell),
              "colours of fractions": lambda **tell: sampler.as_rgba_array("volume_fractions", None, **tell)}
    for name, make in arrays.items():
        shares = []
        with_progress, plain = make(progress=shares.append), make()
        assert len(shares) > 1 and shares == sorted(shares) and 0 < shares[0] < shares[-1] == 1, name
        assert numpy.array_equal(with_progress[-1], plain[-1])


def test_arrays_have_the_order_of_their_axes():
    part = box({"q": pv.FloatAttribute("x + 10*y + 100*z"), "v": pv.Vec3Attribute("x", "y", "z")}, V(1, 2, 3), V(2, 4, 6))
    part.set_attribute("c", pv.Vec4Attribute("x/2", "y/4", "z/6", 1))
    sampler = pv.TreeSampler(part, 1, pv.default_materials)
    assert sampler.as_float_array("q")[1, 2, 3] == 1.5 + 25 + 350
    assert tuple(sampler.as_vec3_array("v")[0, 3, 5]) == (0.5, 3.5, 5.5)
    assert numpy.allclose(sampler.as_vec4_array("c")[0, 3, 5], (0.25, 0.875, 5.5 / 6, 1))
    nx, ny, nz, colours = sampler.as_rgba_array("c", None)
    assert (nx, ny, nz) == (2, 4, 6)
    assert tuple(colours.reshape(nz, ny, nx, 4)[5, 3, 0]) == tuple(numpy.rint(255 * numpy.array([0.25, 0.875, 5.5 / 6, 1])))

"""Attributes, converters, samplers and compilers of pyvcad 3."""
import math
import struct

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_compilers as pvc

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
    with pytest.raises(pv.MissingFeature):
        pv.LookupTableConverter(["a", "b"], ["c"], entries)


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

"""The resolver of attributes: shortest paths of conversions, and those by calibrations."""
import math

import pytest

import pyvcad as pv
import pyvcad_attribute_resolver as resolver


@pytest.fixture(autouse=True)
def no_conversions():
    resolver.clear_conversions()
    yield
    resolver.clear_conversions()


def ball(**attributes):
    part = pv.Sphere(pv.Vec3(0, 0, 0), 5)
    for name, value in attributes.items():
        part.set_attribute(name, pv.FloatAttribute(value))
    return part


def by(source, target, formula, **options):
    return resolver.register_conversion(source, target, lambda: pv.ExpressionConverter([source], [target], [formula]), **options)


def at_centre(part, name):
    return part.sample(0, 0, 0)[1].get_sample(name)


def test_paths_are_the_shortest():
    assert by("density", "temperature", "200 + 10*density") == "density_to_temperature"
    by("temperature", "flow_rate", "temperature/200")
    adapted = resolver.adapt(ball(density=2), ["temperature", "flow_rate"])
    assert at_centre(adapted, "flow_rate") == pytest.approx(1.1)
    by("density", "flow_rate", "density", name="direct")
    assert at_centre(resolver.adapt(ball(density=2), ["flow_rate"]), "flow_rate") == pytest.approx(2)
    part = ball(flow_rate=3)
    assert resolver.adapt(part, ["flow_rate"]) is part


def test_paths_may_be_missing_or_ambiguous():
    with pytest.raises(resolver.NoPathError, match="no conversions lead to 'flow_rate' from density"):
        resolver.adapt(ball(density=1), ["flow_rate"])
    by("density", "flow_rate", "1", name="one")
    by("density", "flow_rate", "2", name="two")
    with pytest.raises(resolver.AmbiguousPathError, match="one; two") as error:
        resolver.adapt(ball(density=1), ["flow_rate"])
    assert error.value.paths == [["one"], ["two"]]
    assert at_centre(resolver.adapt(ball(density=1), ["flow_rate"], allowed_conversions=["two"]), "flow_rate") == 2
    by("density", "flow_rate", "3", name="two", priority=1, tags=["foam"])
    assert at_centre(resolver.adapt(ball(density=1), ["flow_rate"]), "flow_rate") == 3
    assert at_centre(resolver.adapt(ball(density=1), ["flow_rate"], tags=["foam"]), "flow_rate") == 3
    with pytest.raises(resolver.NoPathError):
        resolver.adapt(ball(density=1), ["flow_rate"], tags=["other"])
    assert resolver.list_modules() == ["foam"] and [c.name for c in resolver.list_conversions()] == ["one", "two"]
    resolver.unregister_conversion("one")
    with pytest.raises(KeyError, match="there is no conversion 'one'"):
        resolver.unregister_conversion("one")


def test_depth_is_limited():
    for n in range(4):
        by(f"a{n}", f"a{n + 1}", f"a{n} + 1")
    assert at_centre(resolver.adapt(ball(a0=0), ["a4"]), "a4") == 4
    with pytest.raises(resolver.NoPathError):
        resolver.adapt(ball(a0=0), ["a4"], max_depth=3)


def test_vectors_and_colours_are_taken_apart():
    resolver.register_vector_component_conversions("fibre", "fx", "fy", "fz")
    part = pv.Sphere(pv.Vec3(0, 0, 0), 5)
    part.set_attribute("fibre", pv.Vec3Attribute(1, 2, 3))
    assert at_centre(resolver.adapt(part, ["fy"]), "fy") == 2
    assert at_centre(resolver.adapt(ball(fx=4, fy=5, fz=6), ["fibre"]), "fibre") == pv.Vec3(4, 5, 6)
    resolver.register_generic_color_conversions(alpha=0.5)
    shaded = pv.Sphere(pv.Vec3(0, 0, 0), 5)
    shaded.set_attribute("color_rgb", pv.Vec3Attribute(1, 0.25, 0))
    assert list(at_centre(resolver.adapt(shaded, ["color_rgba"]), "color_rgba")) == [1, 0.25, 0, 0.5]


def test_calibrations_are_conversions():
    materials = pv.j750_materials
    names = resolver.register_calibration("agilus-vero-modulus", materials)
    assert names == ["modulus_to_volume_fractions_by_agilus-vero-modulus"]
    mixed = resolver.adapt(ball(modulus=100), ["volume_fractions"])
    share = math.log(100 / 0.383) / math.log(2850 / 0.383)
    assert mixed.distribution(0, 0, 0) == pytest.approx(
        {materials.id("VeroClear"): share, materials.id("Agilus30Clr"): 1 - share})
    # A modulus that no mixture reaches, here a negative one, gets the nearest mixture: all of the soft material.
    softest = resolver.adapt(ball(modulus=-4000), ["volume_fractions"])
    assert softest.distribution(0, 0, 0)[materials.id("Agilus30Clr")] == pytest.approx(1)
    resolver.register_calibration("foaming-pla-flow")
    hot = resolver.adapt(ball(temperature=238), ["flow_rate"])
    assert at_centre(hot, "flow_rate") == pytest.approx(1.04)
    assert at_centre(resolver.adapt(ball(flow_rate=1.04), ["temperature"]), "temperature") == pytest.approx(238)
    with pytest.raises(ValueError, match="needs one of the materials VeroClear"):
        resolver.register_calibration("agilus-vero-modulus")


def test_measured_tables_of_others_are_missing():
    with pytest.raises(NotImplementedError, match="register_calibration"):
        resolver.register_pla_conversions()

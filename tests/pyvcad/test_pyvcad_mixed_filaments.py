"""Projects of slicers with mixed filaments, by colours and by fractions."""
import json
import math
import re
import zipfile

import numpy
import pytest

import pyvcad as pv
import pyvcad_compilers as pvc
from pyvcad_compilers._filaments import RecipeRules, filaments_of, lab_of, light_of, palette_of

from pyvcad_parts import blue, origin, red

red_and_blue = [{"color_hex": "#FF0000", "slot": 3, "filament_settings_id": "PLA red"}, {"color_hex": "#0000FF", "slot": 1}]


def bar(length=12.0):
    return pv.RectPrism(origin, pv.Vec3(length, 4, 4))


def by_fractions():
    """Red rises from 0 to 1 along 12 mm."""
    part = bar()
    part.set_attribute("volume_fractions", pv.VolumeFractionsAttribute([("x/12 + 0.5", red), ("0.5 - x/12", blue)]))
    return part


def by_colours(*boxes):
    """Boxes of one colour each, side by side along x from 0 on, 4 mm long."""
    parts = []
    for n, colour in enumerate(boxes):
        part = pv.RectPrism(pv.Vec3(4 * n + 2, 0, 0), pv.Vec3(4, 4, 4))
        part.set_attribute("color_rgb", pv.Vec3Attribute(*colour))
        parts.append(part)
    return pv.Union(0.0, parts)


def entry(path, name):
    with zipfile.ZipFile(path) as archive:
        return archive.read(name).decode()


def spectrum(path):
    return json.loads(entry(path, "Metadata/Prusa_Slicer_full_spectrum.json"))


def test_the_colours_of_light_are_those_of_the_standards():
    # Mid gray of sRGB is 0.2140 of the light (IEC 61966-2-1); red is L* 53.24, a* 80.09, b* 67.20 (B. Lindbloom).
    assert light_of([0.5])[0] == pytest.approx(0.21404, abs=1e-5)
    assert [float(c) for c in lab_of([1.0, 0.0, 0.0])] == pytest.approx([53.24, 80.09, 67.20], abs=0.01)
    assert [float(c) for c in lab_of([1.0, 1.0, 1.0])] == pytest.approx([100, 0, 0], abs=0.01)


def recipes(count, preset="expanded", least=15, parts=3):
    return RecipeRules("test", preset, 32, least, parts, 1.0)


def test_recipes_are_as_many_as_can_be_counted():
    # Five filaments: 5, 10 pairs of three shares each, 10 triples with the half in one of three places.
    assert len(recipes(5).by_preset(5)) == 5 + 10 * 3 + 10 * 3
    assert len(recipes(5, "conservative").by_preset(5)) == 5 + 10 * 3
    assert len(recipes(5, parts=5).by_preset(5)) == 65  # more than three cannot be mixed
    assert len(recipes(5, parts=1).by_preset(5)) == 5
    assert len(recipes(2, least=30).by_preset(2)) == 3  # a quarter is less than 30 %
    # Shares of pairs in cycles of up to six layers are the fractions a/b with b up to 6: phi(2) + ... + phi(6) = 11.
    assert len(recipes(2).by_shares(2)) == 2 + 11
    assert len(recipes(2, least=20).by_shares(2)) == 2 + 9  # without 1/6 and 5/6


def test_fractions_become_the_nearest_cycles(tmp_path):
    path = tmp_path / "bar.3mf"
    compiler = pvc.PrusaSlicerProjectCompiler(by_fractions(), pv.Vec3(0.4, 0.4, 0.4), path, color_mix_filaments=red_and_blue,
                                              volume_fraction_materials={"red": 3, "blue": 1})
    seen = []
    compiler.set_progress_callback(seen.append)
    compiler.compile()
    assert seen[-1] == 1 and all(0 <= share <= 1 for share in seen)
    mixed = spectrum(path)
    assert [e["id"] for e in mixed["physical_extruders"]] == [1, 2, 3, 4, 5]
    shares = sorted(next(p["ratio"] for p in e["components"] if p["extruder"] == 3) / sum(p["ratio"] for p in e["components"])
                    for e in mixed["virtual_extruders"])
    cycles = sorted({a / b for b in range(2, 7) for a in range(1, b)})
    assert shares == pytest.approx(cycles)
    assert [e["id"] for e in mixed["virtual_extruders"]] == list(range(6, 17))
    # Borders lie half way between the shares, 12 mm times these; shares below 15 % are dropped.
    all_shares = [0, *cycles, 1]
    borders = [min(max((a + b) / 2, 0.15), 0.85) for a, b in zip(all_shares, all_shares[1:])]
    wanted = sorted({-6, 6, *(12 * share - 6 for share in borders)})
    found = sorted({round(float(x), 3) for x in re.findall(r'<vertex x="([^"]+)"', entry(path, "3D/3dmodel.model"))})
    assert found == pytest.approx(wanted, abs=2e-3)
    report = json.loads(entry(path, "Metadata/ombre_recipes.json"))["recipes"]
    assert report == compiler.recipes()
    assert sum(recipe["share_of_part"] for recipe in report) == pytest.approx(1, abs=1e-4)
    assert '"PLA red"' in entry(path, "Metadata/Slic3r_PE.config")


def test_the_least_used_mixtures_go(tmp_path):
    path = tmp_path / "bar.3mf"
    pvc.FullSpectrumSlicerProjectCompiler(by_fractions(), pv.Vec3(0.4, 0.4, 0.4), path, red_and_blue, max_palette_size=3,
                                          volume_fraction_materials={"red": 3, "blue": 1}).compile()
    project = json.loads(entry(path, "Metadata/project_settings.config"))
    assert project["filament_colour"] == ["#0000FF", "#808080", "#FF0000"]
    rows = project["mixed_filament_definitions"].split(";")
    assert 2 <= len(rows) <= 4  # the last one is deleted
    assert all(row.startswith("1,3,") for row in rows)
    # Each value has its nearest candidate, and the candidate that stands for least of them is left out.
    values, candidates = numpy.array([[0.0], [0.4], [1.0]]), numpy.array([[0.0], [0.5], [1.0]])
    palette = palette_of(values, numpy.array([5.0, 1.0, 4.0]), candidates, 2)
    assert palette.chosen == [0, 2]
    assert palette.shares == pytest.approx([0.6, 0.4])
    assert palette.differences == pytest.approx([0.4 / 6, 0])


def test_colours_become_the_nearest_mixture(tmp_path):
    # Half of the light of red and half of blue is sRGB 188 (0.5 of the light) in both.
    half = (1.055 * 0.5 ** (1 / 2.4) - 0.055)
    part = by_colours((1, 0, 0), (half, 0, half), (0, 0, 1))
    path = tmp_path / "boxes.3mf"
    compiler = pvc.FullSpectrumSlicerProjectCompiler(part, 0.5, path, red_and_blue)
    assert compiler.supported_attributes() == ["color_rgb", "volume_fractions"]
    compiler.compile()
    found = {tuple(sorted(zip(recipe["slots"], recipe["layers"]))): recipe for recipe in compiler.recipes()}
    assert set(found) == {((1, 1),), ((3, 1),), ((1, 1), (3, 1))}
    for recipe in found.values():
        assert recipe["share_of_part"] == pytest.approx(1 / 3, abs=0.01)
        assert recipe["mean_delta_e"] < 0.01
    assert found[(1, 1), (3, 1)]["color_hex"] == "#BC00BC"
    settings = entry(path, "Metadata/model_settings.config")
    assert {int(n) for n in re.findall(r'key="extruder" value="(\d+)"', settings)} >= {1, 3, 4}


def test_three_filaments_are_mixed(tmp_path):
    # A quarter of cyan's light, a quarter of magenta's and half of white's.
    light = [0.25 * 0 + 0.25 * 1 + 0.5, 0.25 * 1 + 0.25 * 0 + 0.5, 0.25 + 0.25 + 0.5]
    srgb = [1.055 * c ** (1 / 2.4) - 0.055 for c in light]
    path = tmp_path / "box.3mf"
    compiler = pvc.FullSpectrumSlicerProjectCompiler(by_colours(srgb), 1.0, path)
    compiler.compile()
    assert [(recipe["layers"], recipe["slots"]) for recipe in compiler.recipes()] == [([1, 1, 2], [1, 2, 5])]
    row = json.loads(entry(path, "Metadata/project_settings.config"))["mixed_filament_definitions"].split(";")[0].split(",")
    assert sorted(row[-1]) == ["1", "2", "5", "5"]
    conservative = pvc.FullSpectrumSlicerProjectCompiler(by_colours(srgb), 1.0, path, color_mix_recipe_preset="conservative")
    conservative.compile()
    assert all(len(recipe["slots"]) <= 2 for recipe in conservative.recipes())


def test_equal_colours_are_filaments(tmp_path):
    # Two filaments of one colour: a mixture of them shows nothing else.
    same = [{"color_hex": "#FF0000"}, {"color_hex": "#FF0000"}]
    compiler = pvc.FullSpectrumSlicerProjectCompiler(by_colours((1, 0, 0)), 1.0, tmp_path / "a.3mf", same)
    compiler.compile()
    assert [recipe["slots"] for recipe in compiler.recipes()] == [[1]]


def test_equal_parts_are_equal_bytes(tmp_path):
    for name in ("a.3mf", "b.3mf"):
        pvc.FullSpectrumSlicerProjectCompiler(by_colours((1, 0, 0), (0, 0, 1)), 1.0, tmp_path / name, red_and_blue).compile()
    assert (tmp_path / "a.3mf").read_bytes() == (tmp_path / "b.3mf").read_bytes()


def test_nozzles_and_ids_are_the_filaments_own(tmp_path):
    own = [{**red_and_blue[0], "nozzle_diameter_mm": 0.6, "filament_id": "GFL99"}, red_and_blue[1]]
    pvc.FullSpectrumSlicerProjectCompiler(by_colours((1, 0, 0)), 1.0, tmp_path / "a.3mf", own).compile()
    project = json.loads(entry(tmp_path / "a.3mf", "Metadata/project_settings.config"))
    assert project["nozzle_diameter"] == ["0.4", "0.4", "0.6"]
    assert project["filament_ids"] == ["", "", "GFL99"]
    pvc.PrusaSlicerProjectCompiler(by_colours((1, 0, 0)), 1.0, tmp_path / "b.3mf", color_mix_filaments=own,
                                   total_physical_extruders=3).compile()
    assert "; nozzle_diameter = 0.4,0.4,0.6\n" in entry(tmp_path / "b.3mf", "Metadata/Slic3r_PE.config")


def test_filaments_may_have_one_profile(tmp_path):
    name = 'PLA "matte" \\ é; 2'
    same = [{**filament, "filament_settings_id": name} for filament in red_and_blue]
    compiler = pvc.FullSpectrumSlicerProjectCompiler(by_colours((1, 0, 0), (0, 0, 1)), 1.0, tmp_path / "a.3mf", same)
    compiler.compile()
    project = json.loads(entry(tmp_path / "a.3mf", "Metadata/project_settings.config"))
    assert project["filament_settings_id"] == [name, "filament 2", name]
    assert [recipe["slots"] for recipe in compiler.recipes()] == [[1], [3]]
    pvc.PrusaSlicerProjectCompiler(by_colours((1, 0, 0)), 1.0, tmp_path / "b.3mf", color_mix_filaments=same,
                                   total_physical_extruders=3).compile()
    quoted = '"PLA \\"matte\\" \\\\ é; 2"'
    assert f'; filament_settings_id = {quoted};"filament 2";{quoted}\n' in entry(tmp_path / "b.3mf", "Metadata/Slic3r_PE.config")


def test_colours_alone_are_mixed_in_projects_of_prusa_slicer(tmp_path):
    pvc.PrusaSlicerProjectCompiler(by_colours((0, 1, 1)), 1.0, tmp_path / "a.3mf").compile()
    config = entry(tmp_path / "a.3mf", "Metadata/Slic3r_PE_model.config")
    assert set(re.findall(r'key="extruder" value="(\d+)"', config)) == {"1"}  # cyan alone, without a mixture
    both = by_colours((0, 1, 1))
    both.set_attribute("infill_density", pv.FloatAttribute(20))
    with pytest.raises(RuntimeError, match="two projects"):
        pvc.PrusaSlicerProjectCompiler(both, 1.0, tmp_path / "b.3mf").compile()
    with pytest.raises(RuntimeError, match="two projects"):
        pvc.PrusaSlicerProjectCompiler(both, 1.0, tmp_path / "b.3mf", enable_color_mix=True).compile()
    assert not (tmp_path / "b.3mf").exists()


@pytest.mark.parametrize("arguments, words", [
    ({"filaments": []}, "at least one filament"), ({"filaments": [{"slot": 1}]}, "six digits"),
    ({"filaments": ["#FF0000"]}, "expected a dict"), ({"filaments": [{"color_hex": "#FF0000", "slot": 17}]}, "1 to 16"),
    ({"filaments": [{"color_hex": "red"}]}, "six digits"),
    ({"filaments": [{"color_hex": "#FF0000", "colour": 1}]}, "no member 'colour'"),
    ({"filaments": [{"color_hex": "#FF0000", "slot": 1}, {"color_hex": "#00FF00", "slot": 1}]}, "one slot"),
    ({"filaments": [{"color_hex": "#FF0000", "nozzle_diameter_mm": -1}]}, "above 0"),
    ({"filaments": [{"color_hex": "#FF0000", "filament_profile_path": "a.json"}]}, "choose the profile in the slicer"),
    ({"max_palette_size": 0}, "1 or more"), ({"max_recipe_components": 1.5}, "whole number"),
    ({"min_component_percent": 101}, "0 to 100"), ({"direct_physical_delta_e": -1}, "0 or more"),
    ({"direct_physical_delta_e": math.nan}, "finite"), ({"region_overlap_mm": -0.1}, "0 or more"),
    ({"color_mix_recipe_preset": "bold"}, "'conservative' or 'expanded'"),
    ({"orca_machine_profile_path": "u1.json"}, "choose the printer"), ({"filament": []}, "no argument 'filament'"),
    ({"volume_fraction_materials": {"gold": 1}}, "no material 'gold'"),
    ({"volume_fraction_materials": {"red": 9}}, "no filament has the slot 9")])
def test_wrong_arguments_say_what_to_write(arguments, words, tmp_path):
    with pytest.raises((ValueError, TypeError, KeyError), match=re.escape(words)):
        pvc.FullSpectrumSlicerProjectCompiler(bar(), 1.0, tmp_path / "a.3mf", **arguments)


def test_parts_that_cannot_be_mixed_are_refused(tmp_path):
    def compiled(part, **arguments):
        pvc.FullSpectrumSlicerProjectCompiler(part, 1.0, tmp_path / "a.3mf", **arguments).compile()
    with pytest.raises(RuntimeError, match="color_rgb or volume_fractions"):
        compiled(bar())
    with pytest.raises(RuntimeError, match="volume_fraction_materials="):
        compiled(by_fractions())
    with pytest.raises(RuntimeError, match="no node of the tree has volume_fractions"):
        compiled(by_colours((1, 0, 0)), volume_fraction_materials={"red": 1})
    half = pv.Union(0.0, [by_colours((1, 0, 0)), pv.RectPrism(pv.Vec3(20, 0, 0), pv.Vec3(4, 4, 4))])
    with pytest.raises(RuntimeError, match=r"nothing gives color_rgb at \(1[89]"):
        compiled(half)
    with pytest.raises(RuntimeError, match="no filament's material"):
        compiled(by_fractions(), volume_fraction_materials={"green": 2})
    with pytest.raises(ValueError, match="found 2"):
        pvc.PrusaSlicerProjectCompiler(bar(), 1.0, tmp_path / "a.3mf", color_mix_filaments=red_and_blue,
                                       total_physical_extruders=2)
    assert not (tmp_path / "a.3mf").exists()


def test_cancelling_leaves_no_file(tmp_path):
    compiler = pvc.FullSpectrumSlicerProjectCompiler(by_colours((1, 0, 0)), 0.5, tmp_path / "a.3mf")
    compiler.set_progress_callback(lambda share: compiler.cancel())
    with pytest.raises(RuntimeError, match="cancelled"):
        compiler.compile()
    assert not (tmp_path / "a.3mf").exists()


def test_filaments_have_slots_in_the_order_of_the_list():
    assert [f.slot for f in filaments_of("test", None)] == [1, 2, 3, 4, 5]
    assert [f.name for f in filaments_of("test", red_and_blue)] == ["filament 1", "PLA red"]


@pytest.mark.parametrize("shares, mixture", [((0.9, 0.1, 0), {1: 1}), ((0.45, 0.45, 0.1), {1: 1, 2: 1}),
                                             ((0.5, 0.34, 0.16), {1: 3, 2: 2, 3: 1})])
def test_small_parts_are_dropped_and_the_rest_is_the_whole(tmp_path, shares, mixture):
    names = ("red", "blue", "white")
    part = pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(4, 4, 4))
    part.set_attribute("volume_fractions", pv.VolumeFractionsAttribute(list(zip(shares, map(pv.default_materials.id, names)))))
    filaments = [{"color_hex": colour, "slot": slot} for slot, colour in enumerate(("#ff0000", "#0000ff", "#ffffff"), 1)]
    compiler = pvc.FullSpectrumSlicerProjectCompiler(part, pv.Vec3(1, 1, 1), tmp_path / "f.3mf", filaments=filaments,
                                                     volume_fraction_materials=dict(zip(names, (1, 2, 3))))
    compiler.compile()
    [recipe] = compiler.recipes()
    assert dict(zip(recipe["slots"], recipe["layers"])) == mixture


def test_projects_are_3mf_files():
    part = pv.Sphere(pv.Vec3(0, 0, 0), 2)
    for kind in (pvc.FullSpectrumSlicerProjectCompiler, pvc.PrusaSlicerProjectCompiler):
        with pytest.raises(ValueError, match=f"{kind.__name__}, output_file_path: expected a name that ends in .3mf, found 'i.stl'"):
            kind(part, pv.Vec3(1, 1, 1), "i.stl")
        with pytest.raises(ValueError, match=f"{kind.__name__}, region_overlap_mm: expected 0 or more"):
            kind(part, pv.Vec3(1, 1, 1), "i.3mf", region_overlap_mm=-1)


def test_profiles_say_the_nozzle_and_the_filament(tmp_path):
    printer, filament, path = tmp_path / "printer.ini", tmp_path / "filament.ini", tmp_path / "bar.3mf"
    printer.write_text("nozzle_diameter = 0.6\nbed_temperature = 60\n")
    filament.write_text("filament_type = LW\ntemperature = 230\n")
    for name, formula, count in (("infill_density", "50+4*x", 1), ("temperature", "200+4*x", 2)):
        part = pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(10, 10, 10))
        part.set_attribute(name, pv.FloatAttribute(formula))
        pvc.PrusaSlicerProjectCompiler(part, pv.Vec3(1, 1, 1), path, num_regions=2, printer_profile_path=printer,
                                       filament_profile_path=filament).compile()
        lines = entry(path, "Metadata/Slic3r_PE.config").splitlines()
        assert {f"; nozzle_diameter = {','.join(['0.6'] * count)}", f"; filament_type = {';'.join(['LW'] * count)}",
                "; bed_temperature = 60"} <= set(lines)
        assert ("; temperature = 230" in lines) == (count == 1) and ("; temperature = 190,210" in lines) == (count == 2)

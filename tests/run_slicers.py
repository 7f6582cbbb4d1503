#!/usr/bin/env python3
"""Projects for slicers: what PrusaSlicer makes of them, and what Bambu Studio and OrcaSlicer find in them.

    python3 tests/run_slicers.py build/dev/apps/ombre/ombre

What PrusaSlicer makes of a project is tested where prusa-slicer is installed; ./dev test installs it.
"""
import json
import re
import shutil
import xml.etree.ElementTree as ElementTree
import zipfile

import program
from program import expect, near, near_share

# Bars of 40 x 10 x 8 mm.
GRADED = """fgrade(["1 - x/40", "x/40"], [red, blue]) translate(20, 0, 4) rectprism((40, 10, 8), red);
"""
HALVES = """attribute("temperature", "200 + 40*(x > 20)") attribute("flow_rate", "1 - 0.2*(x > 20)")
translate(20, 0, 4) rectprism((40, 10, 8), red);
"""
HEIGHTS = """attribute("infill_density", "20 + 40*(z > 3)") attribute("layer_height", "0.3 - 0.1*(z > 3)")
translate(20, 0, 4) rectprism((40, 10, 8), red);
"""
# A box whose lower half is red, and whose upper half has a blue surface.
PAINTED = """union(materials="first") {
  translate(0, 0, 2) rectprism((20, 20, 4), red);
  translate(0, 0, 6) rectprism((20, 20, 4), blue);
}
"""
CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


class Designs(program.Folder):
    FILES = {"graded.vcad": GRADED, "halves.vcad": HALVES, "heights.vcad": HEIGHTS, "painted.vcad": PAINTED}

    def mesh(self, design, *options, status=0):
        """Writes a project; what the program says."""
        name = "out.3mf"
        result = program.run([self.ombre, "mesh", design, "-o", name, "--force", *options], cwd=self.path)
        expect(result.returncode == status, f"{design} {options}: {result.stderr}")
        return result.stderr

    def entry(self, name):
        with zipfile.ZipFile(self.path / "out.3mf") as archive:
            return archive.read(name).decode("utf-8")

    def has(self, name):
        with zipfile.ZipFile(self.path / "out.3mf") as archive:
            return name in archive.namelist()

    def project(self):
        return json.loads(self.entry("Metadata/project_settings.config"))

    def sliced(self, *options):
        result = program.run(["prusa-slicer", "--export-gcode", "out.3mf", "-o", "out.gcode", "--dont-arrange", *options],
                             cwd=self.path)
        expect(result.returncode == 0, result.stderr[-1000:])
        return Gcode((self.path / "out.gcode").read_text(encoding="utf-8"))


class Gcode:
    """The moves that extrude, with the tool, temperature, flow and place of each."""

    def __init__(self, text):
        self.text, self.moves = text, []
        tool, temperature, flow, x, z, before, relative = 0, None, 100, 0, 0, 0, False
        for line in text.splitlines():
            words = line.split(";")[0].split()
            if not words:
                continue
            values = {word[0]: float(word[1:]) for word in words[1:] if re.fullmatch(r"[SXYZEF]-?[\d.]+", word)}
            if re.fullmatch(r"T\d+", words[0]):
                tool = int(words[0][1:])
            relative = {"M82": False, "M83": True}.get(words[0], relative)
            if words[0] in ("M104", "M109"):
                temperature = values["S"]
            if words[0] == "M221":
                flow = values["S"]
            if words[0] == "G92":
                before = values.get("E", before)
            if words[0] not in ("G0", "G1"):
                continue
            z = values.get("Z", z)
            if "E" in values:
                amount = values["E"] if relative else values["E"] - before
                before = values["E"]
                if amount > 0 and "X" in values:
                    self.moves.append({"tool": tool, "temperature": temperature, "flow": flow, "z": z,
                                       "x": (x + values["X"]) / 2, "mm": amount})
            x = values.get("X", x)

    def tools(self):
        return sorted({move["tool"] for move in self.moves})

    def of(self, tool, key):
        return {move[key] for move in self.moves if move["tool"] == tool}

    def span(self, tool):
        places = [move["x"] for move in self.moves if move["tool"] == tool]
        return min(places), max(places)

    def length(self, chosen):
        return sum(move["mm"] for move in self.moves if chosen(move))


def with_slicer():
    return bool(shutil.which("prusa-slicer"))


def materials_are_filaments(designs):
    for flavour in ("bambu", "orca"):
        designs.mesh("painted.vcad", "--flavour", flavour)
        project = designs.project()
        expect(project["filament_colour"] == ["#FF0000", "#0050FF"], str(project["filament_colour"]))
        expect(project["filament_settings_id"] == ["red", "blue"], str(project))
    reported = designs.mesh("painted.vcad", "--by", "whole", "--flavour", "orca")
    expect("one filament for red and blue" in reported, reported)
    expect(designs.project()["filament_settings_id"] == ["red and blue"], str(designs.project()))
    designs.mesh("painted.vcad", "--flavour", "prusa")
    if not with_slicer():
        return "skipped: no prusa-slicer"
    gcode = designs.sliced("--skirts", "0")
    expect(gcode.tools() == [0, 1], f"tools {gcode.tools()}")
    expect(max(gcode.of(0, "z")) < 4.01 and min(gcode.of(1, "z")) > 4.01, "the tools print other heights")
    expect("; filament_colour = #FF0000;#0050FF" in gcode.text, "colours of filaments")
    return ""


def mixtures_are_layer_cycles(designs):
    reported = designs.mesh("graded.vcad", "--flavour", "prusa", "--mix-layers", "4")
    mixed = json.loads(designs.entry("Metadata/Prusa_Slicer_full_spectrum.json"))
    expect(mixed["version"] == 1 and [e["id"] for e in mixed["physical_extruders"]] == [1, 2], str(mixed))
    parts = [[(p["extruder"], p["ratio"]) for p in e["components"]] for e in mixed["virtual_extruders"]]
    # The middles of four bands are 1/8, 3/8, 5/8 and 7/8; cycles of up to 4 layers have 0, 1/3, 2/3 and 1 nearest.
    expect(parts == [[(1, 1), (2, 2)], [(1, 2), (2, 1)]], str(parts))
    expect([e["id"] for e in mixed["virtual_extruders"]] == [3, 4], str(mixed))
    expect("off by up to 12.5 %" in reported, reported)
    extruders = re.findall(r'key="extruder" value="(\d+)"', designs.entry("Metadata/Slic3r_PE_model.config"))
    expect(sorted(extruders) == ["1", "2", "3", "4"], str(extruders))
    for flavour in ("bambu", "orca"):
        designs.mesh("graded.vcad", "--flavour", flavour, "--mix-layers", "6")
        project = designs.project()
        expect(project["filament_is_mixed"] == ["0", "0", "1", "1", "1", "1"], str(project))
        expect(set(project["filament_mixed_components"][2:]) == {"1,2"}, str(project))
        for ratios in project["filament_mixed_sublayer_ratios"][2:]:
            near(sum(float(r) for r in ratios.split(",")), 1, 1e-9, "the sum of the ratios")
    reported = designs.mesh("graded.vcad", "--flavour", "snapmaker", "--mix-layers", "6")
    expect("off by up to 4.17 %" in reported, reported)  # 1/6 for 1/8
    rows = [row.split(",") for row in designs.project()["mixed_filament_definitions"].split(";")]
    expect([row[4] for row in rows] == ["83", "60", "40", "17", "50"], str(rows))
    expect([len(row) for row in rows] == [16, 16, 16, 16, 15], str(rows))
    expect(len(designs.project()["filament_colour"]) == 2, str(designs.project()))
    extruders = re.findall(r'key="extruder" value="(\d+)"', designs.entry("Metadata/model_settings.config"))
    expect({"3", "4", "5", "6"} <= set(extruders), str(extruders))
    return ""


def mixed(name, **layers):
    return {"name": name, "r": 90, "g": 90, "b": 90, "mix_layers": layers}


def colour(name, *extruder):
    return {"name": name, "r": 200, "g": 0, "b": 0, **({"extruder": extruder[0]} if extruder else {})}


def materials_are_mixed_of_filaments(designs):
    def write(*materials):
        (designs.path / "mixed.json").write_text(json.dumps({"materials": list(materials)}))

    boxes = "".join(f"translate({10 * n}, 0, 4) rectprism((10, 10, 8), {name});\n"
                    for n, name in enumerate(["purple", "brown", "red"]))
    (designs.path / "three.vcad").write_text("union() {\n" + boxes + "}\n")
    use = ["--materials", "mixed.json"]
    inks = [colour("blue", 4), colour("red"), colour("yellow", 2)]
    write(mixed("purple", blue=1, red=2), *inks, mixed("brown", yellow=1, red=2, blue=1))
    said = designs.mesh("three.vcad", "--flavour", "prusa", *use)
    expect("brown: layers 2 of red, 1 of yellow, 1 of blue" in said, said)
    # Blue and yellow have the extruders of the file, red the first that is free; mixtures follow the last filament.
    spectrum = json.loads(designs.entry("Metadata/Prusa_Slicer_full_spectrum.json"))
    parts = {e["id"]: [(p["extruder"], p["ratio"]) for p in e["components"]] for e in spectrum["virtual_extruders"]}
    expect(parts == {5: [(1, 2), (4, 1)], 6: [(1, 2), (2, 1), (4, 1)]}, str(parts))
    expect(len(spectrum["physical_extruders"]) == 4, str(spectrum))
    config = designs.entry("Metadata/Slic3r_PE_model.config")
    names = re.findall(r'<metadata type="volume" key="name" value="(\w+)"', config)
    extruder_of = dict(zip(names, re.findall(r'key="extruder" value="(\d+)"', config)))
    expect(extruder_of == {"purple": "5", "brown": "6", "red": "1"}, str(extruder_of))
    expect('"red";"yellow";"filament 3";"blue"' in designs.entry("Metadata/Slic3r_PE.config"), "names of filaments")
    designs.mesh("three.vcad", "--flavour", "snapmaker", *use)
    rows = [row.split(",") for row in designs.project()["mixed_filament_definitions"].split(";")]
    expect([row[:2] for row in rows[:2]] == [["1", "4"], ["1", "2"]], str(rows))
    expect(sorted(rows[1][-1]) == ["1", "1", "2", "4"], str(rows))
    designs.mesh("three.vcad", *use)  # a file for any program has the materials as they are

    (designs.path / "one.vcad").write_text("rectprism((10, 10, 8), purple);\n")
    said = designs.mesh("one.vcad", "--flavour", "prusa", *use)
    expect("purple: layers 2 of red, 1 of blue" in said and "not used" not in said, said)
    expect('key="extruder" value="5"' in designs.entry("Metadata/Slic3r_PE_model.config"), "the extruder of one material")
    said = designs.mesh("three.vcad", "--flavour", "prusa", "--by", "whole", *use)
    expect('"mix_layers" of materials are for bodies of materials' in said, said)
    said = designs.mesh("three.vcad", "--flavour", "prusa", "--setting", "extruder=1", *use, status=1)
    expect("leave one of the two out" in said, said)
    for wrong, words in [
            (mixed("brown", red=1), "mixed of 2 or 3 filaments"), (mixed("brown", red=4, blue=3), "at most 6 layers"),
            (mixed("brown", red=1, Red=1), "twice"), (mixed("brown", red=1, green=1), '"green", which is no material'),
            (mixed("brown", red=1, purple=1), '"purple", which is no filament'), (mixed("brown", red=0, blue=1), "1 to 5"),
            (mixed("brown", red=1, void=1), '"void", which is no filament'), (colour("brown", 4), "have one extruder"),
            (colour("brown", 17), "16"), ({**colour("brown"), "mix_layers": "red"}, "mixed of 2 or 3 filaments"),
            ({**mixed("brown", red=1, blue=1), "extruder": 5}, "no extruder of its own")]:
        write(mixed("purple", blue=1, red=2), *inks, wrong)
        said = designs.mesh("three.vcad", "--flavour", "prusa", *use, status=1)
        expect("mixed.json:1:" in said and words in said, f"{wrong}: {said}")
    return ""


def numbers_of_filaments_have_limits(designs):
    """Snapmaker Orca's patterns name a third filament by one digit; PrusaSlicer has 16 filaments, Bambu Studio 16 in all."""
    def message(materials, flavour, design="rectprism((10, 10, 10), mixed);\n"):
        (designs.path / "many.json").write_text(json.dumps({"materials": materials}))
        (designs.path / "many.vcad").write_text(design)
        return designs.mesh("many.vcad", "--materials", "many.json", "--flavour", flavour, status=1)

    nine, three = [colour(f"f{n}", n) for n in range(1, 10)], [colour(name) for name in "abc"]
    said = message([*nine, *three, mixed("mixed", a=1, b=1, c=2)], "snapmaker")
    expect('"mixed" has three filaments, one of them on extruder 12' in said and 'give "c" an "extruder" from 1 to 9' in said, said)
    said = message([colour("a", 16), colour("b"), mixed("mixed", a=1, b=1)], "bambu")
    expect('mixtures are numbered after the last filament, which has number 16' in said and 'smaller numbers by "extruder"' in said, said)
    many = [colour("m1", 1), *(colour(f"m{n}") for n in range(2, 18))]
    boxes = "".join(f"translate({10 * n}, 0, 0) cube(5, m{n});\n" for n in range(1, 18))
    said = message(many, "prusa", "union() {\n" + boxes + "}\n")
    expect("17 bodies have a filament each" in said and "use fewer materials" in said and "--setting" not in said, said)
    return ""


def tools_set_temperature_and_flow(designs):
    reported = designs.mesh("halves.vcad", "--by", "temperature,flow_rate", "--bands", "2", "--flavour", "prusa", "--virtual-tools")
    expect("tool 1: 210 C, flow 95 %" in reported and "tool 2: 230 C, flow 85 %" in reported, reported)
    designs.mesh("halves.vcad", "--by", "temperature,flow_rate", "--bands", "2", "--flavour", "orca", "--virtual-tools")
    project = designs.project()
    expect(project["nozzle_temperature"] == ["210", "230"], str(project))
    expect(project["filament_start_gcode"] == ["M221 S95", "M221 S85"], str(project))
    if not with_slicer():
        return "skipped: no prusa-slicer"
    designs.mesh("halves.vcad", "--by", "temperature,flow_rate", "--bands", "2", "--flavour", "prusa", "--virtual-tools")
    gcode = designs.sliced("--skirts", "0", "--fill-density", "100%", "--fill-pattern", "rectilinear")
    expect(gcode.tools() == [0, 1], f"tools {gcode.tools()}")
    expect(gcode.of(0, "temperature") == {210} and gcode.of(1, "temperature") == {230}, "temperatures")
    expect(gcode.of(0, "flow") == {95} and gcode.of(1, "flow") == {85}, "flows")
    first, second = gcode.span(0), gcode.span(1)
    expect(first[1] <= 100.1 and second[0] >= 99.9, f"the tools print from {first} and {second}")
    # The halves are equal, so their lengths are, before the printer scales them.
    near_share(gcode.length(lambda m: m["tool"] == 0), gcode.length(lambda m: m["tool"] == 1), 0.03, "filament of the first tool")
    return ""


def heights_have_settings(designs):
    options = ["--by", "infill_density,layer_height", "--bands", "2", "--height-ranges"]
    for flavour, path, density in (("prusa", "Prusa_Slicer_layer_config_ranges", "fill_density"),
                                   ("bambu", "layer_config_ranges", "sparse_infill_density")):
        designs.mesh("heights.vcad", *options, "--flavour", flavour)
        ranges = list(ElementTree.fromstring(designs.entry(f"Metadata/{path}.xml").encode()).iter("range"))
        expect(len(ranges) == 2, f"{len(ranges)} ranges")
        near(float(ranges[0].get("max_z")), 3, 0.03, "the border of the ranges")
        expect(ranges[1].get("min_z") == ranges[0].get("max_z") and ranges[1].get("max_z") == "8", str(ranges[1].attrib))
        found = [{o.get("opt_key"): o.text for o in r} for r in ranges]
        expect([f[density] for f in found] == ["30%", "50%"], str(found))
        expect([f["layer_height"] for f in found] == ["0.275", "0.225"], str(found))
    reported = designs.mesh("halves.vcad", "--by", "temperature", "--height-ranges", "--flavour", "prusa", status=1)
    expect("have no setting" in reported, reported)
    designs.write("slanted.vcad", 'attribute("infill_density", "20 + x") translate(20, 0, 4) rectprism((40, 10, 8), red);')
    reported = designs.mesh("slanted.vcad", "--by", "infill_density", "--height-ranges", "--flavour", "prusa", status=1)
    expect("does not vary by height alone" in reported, reported)
    if not with_slicer():
        return "skipped: no prusa-slicer"
    designs.mesh("heights.vcad", *options, "--flavour", "prusa")
    gcode = designs.sliced("--skirts", "0", "--perimeters", "0", "--top-solid-layers", "0", "--bottom-solid-layers", "0")
    low = gcode.length(lambda m: 0.5 < m["z"] < 2.5) / 2
    high = gcode.length(lambda m: 3.5 < m["z"] < 7.5) / 4
    near_share(high / low, 50 / 30, 0.15, "the infill above, in those below")
    return ""


def bands_are_as_few_as_their_distance_takes(designs):
    designs.write("slanted.vcad", 'attribute("infill_density", "20 + x") translate(20, 0, 4) rectprism((40, 10, 8), red);')
    # Values go from 20 to 60, which takes 4 bands of 10, and 8 of 5.
    for within, bands in (("5", 4), ("2.5", 8), ("20", 1)):
        designs.mesh("slanted.vcad", "--by", "infill_density", "--within", within, "--flavour", "prusa")
        densities = re.findall(r'key="fill_density" value="(\d+)%"', designs.entry("Metadata/Slic3r_PE_model.config"))
        expect(len(densities) == bands, f"{densities} within {within}")
        for n, density in enumerate(densities):
            near(int(density), 20 + 40 * (n + 0.5) / bands, 1, "the middle of a band")
    reported = designs.mesh("slanted.vcad", "--by", "infill_density", "--within", "0", status=1)
    expect("not positive numbers" in reported, reported)


def surfaces_are_painted(designs):
    options = ["--by", "whole", "--colour-by", "materials", "--keep-all", "--cell", "0.5"]
    designs.mesh("painted.vcad", *options, "--flavour", "bambu")
    codes = re.findall(r'paint_color="(\w+)"', designs.entry("3D/Objects/object_1.model"))
    expect(set(codes) == {"4", "8"}, str(set(codes)))
    expect(sorted(designs.project()["filament_colour"]) == ["#0050FF", "#FF0000"], str(designs.project()))
    reported = program.run([designs.ombre, "info", "out.3mf"], cwd=designs.path).stdout
    expect("not read" not in reported, reported)
    designs.mesh("painted.vcad", *options, "--flavour", "prusa")
    expect("slic3rpe:MmPaintingVersion" in designs.entry("3D/3dmodel.model"), "no version of the painting")
    coarse = designs.mesh("painted.vcad", "--by", "whole", "--colour-by", "materials", "--flavour", "prusa")
    expect("several of these filaments" in coarse, coarse)
    if not with_slicer():
        return "skipped: no prusa-slicer"
    designs.mesh("painted.vcad", *options, "--flavour", "prusa")
    gcode = designs.sliced("--skirts", "0")
    expect(gcode.tools() == [0, 1], f"tools {gcode.tools()}")
    expect(len([z for z in gcode.of(1, "z") if z > 4.6]) > 5 or len([z for z in gcode.of(0, "z") if z > 4.6]) > 5, "painted layers")
    return ""


def slips_get_remedies(designs):
    for options, message in [
            (["--setting", "fil_density=10%"], 'did you mean "fill_density"?'),
            (["--setting", "temperature=200"], "has no such setting for a body"),
            (["--flavour", "bambu", "--setting", "gyroid_optimized=1"], "Bambu Studio has no such setting"),
            (["--by", "red", "--bands", "2", "--setting", "brim_width=1,2"], "one for all bodies of a part"),
            (["--setting", "extruder=20"], "numbered from 1 to 16"),
            (["--setting", "perimeters=two"], "a whole number, 0 or more; write for example --setting perimeters=3"),
            (["--setting", "perimeters=-3"], "a whole number, 0 or more"),
            (["--by", "red", "--bands", "2", "--setting", "perimeters=2,2.5"], "a whole number, 0 or more"),
            (["--setting", "layer_height=abc"], "a number above 0"),
            (["--setting", "infill_speed=fast"], "a number, 0 or more"),
            (["--setting", "fill_density=900%"], "a share from 0% to 100%"),
            (["--by", "red", "--bands", "2", "--setting", "fill_density=10%..120%"], "fill_density=120%"),
            (["--mix-layers", "4"], "--flavour prusa, bambu, orca or snapmaker"),
            (["--flavour", "prusa", "--mix-layers", "9"], "6"),
            (["--flavour", "bambu", "--virtual-tools"], "--flavour prusa, orca or snapmaker"),
            (["--flavour", "prusa", "--virtual-tools"], "for bands of temperature or flow_rate"),
            (["--flavour", "prusa", "--height-ranges"], "--by infill_density")]:
        reported = designs.mesh("graded.vcad", *options, status=1)
        expect(message in reported, f"{options}: {reported}")
    reported = designs.mesh("halves.vcad", "--by", "temperature", "--bands", "2", "--flavour", "prusa")
    expect("temperature is no setting of a body in PrusaSlicer" in reported and "--virtual-tools" in reported, reported)
    designs.write("walls.vcad", 'attribute("perimeters", "3 + z/10") cube(10);')
    reported = designs.mesh("walls.vcad", "--by", "perimeters", "--bands", "2", "--flavour", "prusa")
    expect(re.search(r"perimeters below [\d.]+:", reported), reported)
    for low, words in (("0.25 + z/100", "have fill_density=0%"), ("25 + z", "")):
        designs.write("dense.vcad", f'attribute("infill_density", "{low}") cube(10);')  # 0.2 to 0.3, and 20 to 30
        reported = designs.mesh("dense.vcad", "--by", "infill_density", "--bands", "2", "--flavour", "prusa")
        expect(words in reported and reported.count("become the same setting") == bool(words), reported)
    # No slicer takes what these values become.
    for attribute, values, options, words in (
            ("infill_density", "250 + x", [], "fill_density=246%, and this setting is a share from 0% to 100%"),
            ("layer_height", "-0.1 + z/100", ["--height-ranges"], "and this setting is a number above 0")):
        designs.write("wrong.vcad", f'attribute("{attribute}", "{values}") translate(0, 0, 5) cube(10);')
        reported = designs.mesh("wrong.vcad", "--by", attribute, "--flavour", "prusa", *options, status=1)
        expect(words in reported and f"a band of the attribute {attribute}" in reported, reported)
    designs.mesh("halves.vcad", "--flavour", "orca", "--setting", "brim_width=3", "--setting", "sparse_infill_pattern=gyroid")
    config = designs.entry("Metadata/model_settings.config")
    expect(config.index('key="brim_width"') < config.index("<part") < config.index('key="sparse_infill_pattern"'), config)


def files_without_settings_refuse_them(designs):
    for options in (["--setting", "perimeters=3"], ["--flavour", "prusa"], ["--setting", "perimeters=3", "--flavour", "prusa"]):
        result = program.run([designs.ombre, "mesh", "halves.vcad", "-o", "out.stl", *options], cwd=designs.path)
        expect(result.returncode == 1 and "out.stl holds no settings of slicers; write .3mf or .amf" in result.stderr,
               f"{options}: {result.stderr}")
        expect(not (designs.path / "out.stl").exists(), f"{options} were lost")


def commands_of_the_page_work(designs):
    page = (program.SOURCE / "docs" / "user" / "fff-projects.md").read_text(encoding="utf-8")
    designs.write("handle.vcad", re.search(r"```openscad\n(.*?)```", page, re.DOTALL)[1])
    commands = [line.split("#")[0].split()[1:] for line in re.search(r"```sh\n(.*?)```", page, re.DOTALL)[1].splitlines()]
    expect(len(commands) == 3, str(commands))
    for command in commands:
        result = program.run([designs.ombre, *command], cwd=designs.path)
        expect(result.returncode == 0 and "warning" not in result.stderr, f"{command}: {result.stderr}")


CHECKS = program.named([materials_are_filaments, mixtures_are_layer_cycles, materials_are_mixed_of_filaments, numbers_of_filaments_have_limits, tools_set_temperature_and_flow,
                        heights_have_settings, bands_are_as_few_as_their_distance_takes, surfaces_are_painted,
                        slips_get_remedies, files_without_settings_refuse_them, commands_of_the_page_work])

if __name__ == "__main__":
    raise SystemExit(program.main(Designs, CHECKS))

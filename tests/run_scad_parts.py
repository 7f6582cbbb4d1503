#!/usr/bin/env python3
"""The parts of OpenSCAD scripts: their names, materials and colours in files for slicers, in meshes and in designs.

    python3 tests/run_scad_parts.py build/dev/apps/ombre/ombre
"""
import argparse
import json
import pathlib
import re
import shutil
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile

import program
from program import expect, near

# A box with a pocket of 10 x 10 x 4 mm, which an inlay fills.
INLAY = """part("body") material("PLA white") color("white")
  difference() { cube([30, 30, 10]); translate([10, 10, 6]) cube([10, 10, 5]); }
part("inlay") material("PLA red") color("red") translate([10, 10, 6]) cube([10, 10, 4]);
"""
# Two boxes side by side, of which one has a colour that has no name.
TWO = """color("red") cube([20, 20, 2]);
color("#1234ab") translate([20, 0, 0]) cube([20, 20, 2]);
"""
CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


class Scripts(program.Folder):
    FILES = {"inlay.scad": INLAY, "two.scad": TWO}

    def run(self, *arguments, status=0):
        result = program.run([self.ombre, *arguments], cwd=self.path)
        expect(result.returncode == status, f"{arguments} ended with {result.returncode}: {result.stderr}")
        return result.stderr

    def bodies(self, *arguments):
        """What `ombre mesh` tells of its bodies: names with triangles and volumes."""
        result = program.run([self.ombre, "mesh", *arguments, "--json"], cwd=self.path)
        expect(result.returncode == 0, result.stderr)
        events = [json.loads(line) for line in result.stdout.splitlines() if line.startswith("{")]
        (reported,) = [event for event in events if event["event"] == "bodies"]
        return {body["name"]: (body["triangles"], round(body["volume_mm3"], 6)) for body in reported["bodies"]}


def volume(corners, triangles):
    def six(a, b, c):
        return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return sum(six(*(corners[n] for n in triangle)) for triangle in triangles) / 6


class Package:
    """A 3MF file: its meshes, with names and colours, and the settings of its slicer."""

    def __init__(self, path):
        with zipfile.ZipFile(path) as package:
            self.files = {name: package.read(name).decode("utf-8") for name in package.namelist()}
        models = [ElementTree.fromstring(text) for name, text in self.files.items() if name.endswith(".model")]
        self.colours, self.materials, self.meshes, self.items = {}, [], [], 0
        for model in models:
            for group in model.iter(CORE + "basematerials"):
                self.colours[group.get("id")] = [base.get("displaycolor") for base in group]
            self.materials += [base.get("name") for base in model.iter(CORE + "base")]
            self.items += len(list(model.iter(CORE + "item")))
            for item in model.iter(CORE + "object"):
                corners = [tuple(float(v.get(axis)) for axis in "xyz") for v in item.iter(CORE + "vertex")]
                triangles = [tuple(int(t.get(key)) for key in ("v1", "v2", "v3")) for t in item.iter(CORE + "triangle")]
                colour = self.colours[item.get("pid")][int(item.get("pindex"))] if item.get("pid") else None
                if triangles:
                    self.meshes.append((item.get("name"), colour or self.filament(len(self.meshes)), corners, triangles))

    def filament(self, body):
        """The colour of the filament of a body, in projects of Bambu Studio."""
        project = self.files.get("Metadata/project_settings.config")
        extruders = self.settings("extruder")
        return json.loads(project)["filament_colour"][int(extruders[body]) - 1] + "FF" if project and extruders else None

    def bodies(self):
        return [(name, colour, len(triangles), round(volume(corners, triangles), 6))
                for name, colour, corners, triangles in self.meshes]

    def settings(self, key):
        text = "".join(text for name, text in sorted(self.files.items()) if name.endswith(".config"))
        return re.findall(rf'key="{key}" value="([^"]*)"', text)

    def ranges(self):
        """PrusaSlicer's volumes: the volume that each range of triangles encloses."""
        (_, _, corners, triangles), = self.meshes
        found = re.findall(r'firstid="(\d+)" lastid="(\d+)"', self.files["Metadata/Slic3r_PE_model.config"])
        return [round(volume(corners, triangles[int(first):int(last) + 1]), 6) for first, last in found]


BODY, INSET = 30 * 30 * 10 - 10 * 10 * 4, 10 * 10 * 4
FEW = 36  # triangles of a box with a pocket


def each_slicer_gets_one_object_of_two_volumes(scripts):
    for flavour in ("generic", "prusa", "bambu", "orca", "snapmaker"):
        reported = scripts.run("scad", "inlay.scad", "-o", f"{flavour}.3mf", "--flavour", flavour)
        expect("warning" not in reported, reported)
    for flavour in ("generic", "bambu", "orca"):
        package = Package(scripts.path / f"{flavour}.3mf")
        body, inset = package.bodies()
        expect(body[:2] == ("body", "#FFFFFFFF") and inset[:2] == ("inlay", "#FF0000FF"), f"{flavour}: {body} {inset}")
        expect(body[2] <= FEW and body[3] == BODY and inset[2:] == (12, INSET), f"{flavour}: {body} {inset}")
        expect(package.items == 1, f"{flavour} has {package.items} items")
        expect(package.settings("extruder")[-2:] == ["1", "2"], f"{flavour}: {package.settings('extruder')}")
        expect(package.settings("name")[-2:] == ["body", "inlay"], f"{flavour}: {package.settings('name')}")
    package = Package(scripts.path / "prusa.3mf")
    expect(package.ranges() == [BODY, INSET], f"ranges of {package.ranges()}")
    expect(package.settings("extruder") == ["1", "2"] and package.settings("name")[1:] == ["body", "inlay"],
           package.files["Metadata/Slic3r_PE_model.config"])
    expect(package.materials == ["PLA white", "PLA red"], str(package.materials))


def bodies_with_a_colour_alone_are_named_by_it(scripts):
    for flavour in ("generic", "bambu", "orca"):
        scripts.run("scad", "two.scad", "-o", "two.3mf", "--flavour", flavour)
        bodies = Package(scripts.path / "two.3mf").bodies()
        expect(bodies == [("red", "#FF0000FF", 12, 800), ("#1234ab", "#1234ABFF", 12, 800)], f"{flavour}: {bodies}")
    scripts.run("scad", "two.scad", "-o", "two.3mf", "--flavour", "prusa")
    expect(Package(scripts.path / "two.3mf").settings("name")[1:] == ["red", "#1234ab"], "names in PrusaSlicer")
    result = program.run([scripts.ombre, "info", "two.3mf"], cwd=scripts.path)
    expect("red, #1234ab" in result.stdout, result.stdout)
    scripts.write("over.scad", 'color("red") cube(2); color("lime") cube(1);')
    reported = scripts.run("scad", "over.scad", "-o", "over.3mf")
    expect("a solid in red and a solid in lime overlap" in reported, reported)


MAP = ["--material-map", "PLA white=white", "--material-map", "PLA red=red"]


def meshes_are_the_polyhedra_themselves(scripts):
    found = scripts.bodies("inlay.scad", *MAP, "--by", "parts", "-o", "parts.3mf")
    expect(list(found) == ["body", "inlay"], str(found))
    expect(found["body"][0] <= FEW and found["body"][1] == BODY and found["inlay"] == (12, INSET), str(found))
    found = scripts.bodies("inlay.scad", *MAP, "-o", "materials.3mf")
    expect(found["white"][1] == BODY and found["red"] == (12, INSET), str(found))
    expect(scripts.bodies("two.scad", "--by", "parts", "-o", "two.3mf") == {"red": (12, 800), "#1234ab": (12, 800)},
           "bodies of two colours")
    (whole,) = scripts.bodies("inlay.scad", *MAP, "--by", "whole", "-o", "whole.stl").values()
    expect(whole[0] <= FEW and whole[1] == BODY + INSET, f"the whole: {whole}")
    # The first of solids that overlap has the space; cells are used where they are asked for.
    scripts.write("over.scad", 'part("a") cube(2); part("b") translate([1, 0, 0]) cube(2); part("c") translate([9, 0, 0]) cube(1);')
    found = scripts.bodies("over.scad", "--by", "parts", "-o", "over.3mf")
    expect({name: size for name, (_, size) in found.items()} == {"a": 8, "b": 4, "c": 1}, str(found))
    near(sum(size for _, size in scripts.bodies("over.scad", "--by", "parts", "--cell", "0.05", "-o", "cells.3mf").values()), 13, 0.01,
         "the volume by cells")


def designs_keep_the_parts_of_scripts(scripts):
    scripts.write("two.vcad", 'scad("two.scad"); translate(0, 0, 10) scad("inlay.scad", '
                              'material_map=[["PLA white", white], ["#ff0000", red]]);')
    found = scripts.bodies("two.vcad", "--by", "parts", "--tolerance", "0.2", "-o", "two.3mf")
    sizes = {"red": 800, "#1234ab": 800, "body": BODY, "inlay": INSET}
    expect(sorted(found) == sorted(sizes), str(found))
    for name, size in sizes.items():
        near(found[name][1], size, 0.02 * size, name)
    scripts.write("alone.vcad", 'scad("two.scad");')
    expect(scripts.bodies("alone.vcad", "--by", "parts", "-o", "alone.3mf") == {"red": (12, 800), "#1234ab": (12, 800)},
           "a script in a design by itself")
    scripts.write("named.vcad", 'part("all") scad("two.scad");')
    (name,) = scripts.bodies("named.vcad", "--by", "parts", "-o", "named.3mf")
    expect(name == "all", "the outer name counts")


def materials_come_from_a_map(scripts):
    def volumes(*arguments):
        result = program.run([scripts.ombre, "slice", *arguments, "--voxel", "0.5", "-o", "out", "--force", "--json"], cwd=scripts.path)
        expect(result.returncode == 0, result.stderr)
        (done,) = [event for event in map(json.loads, result.stdout.splitlines()) if event["event"] == "done"]
        return {material["name"]: round(material["volume_mm3"], 3) for material in done["materials"]}

    wanted = {"white": BODY, "red": INSET}
    expect(volumes("inlay.scad", *MAP) == wanted, str(volumes("inlay.scad", *MAP)))
    scripts.write("map.json", {"PLA white": "white", "PLA red": "red"})
    expect(volumes("inlay.scad", "--material-map", "map.json") == wanted, "a map in a file")
    by_colour = ["--material-map", "PLA white=black", "--material-map", "#f00=cyan"]
    expect(volumes("inlay.scad", *by_colour) == {"black": BODY, "cyan": INSET}, "a map of a colour")
    expect(volumes("two.scad", "--material-map", "red=green", "--material-map", "#1234AB=clear") == {"green": 800, "clear": 800},
           "a map of colours alone")
    # Names of materials count before colours.
    expect(volumes("inlay.scad", *MAP, "--material-map", "red=green") == wanted, "names before colours")


def wrong_maps_get_remedies(scripts):
    scripts.write("list.json", ["PLA"])
    scripts.write("ball.vcad", 'sphere(5, "red");')
    scripts.write("words.scad", 'use <ombre>\nmaterial("red") ombre_sphere(4);')
    cases = [
        (["inlay.scad"], ['has the material "PLA white" (of "body")', '--material-map "PLA white=red"']),
        (["inlay.scad", *MAP, "--material-map", "PLA rde=red"], ['no material or colour "PLA rde"', 'did you mean "PLA red"?']),
        (["inlay.scad", *MAP, "--material-map", "gold=red"],
         ['no material or colour "gold"', '"PLA white", "PLA red", "white", "red"']),
        (["inlay.scad", *MAP, "--material-map", "white=whiet"], ['no material "whiet" for "white"', 'did you mean "white"?']),
        (["inlay.scad", *MAP, "--material-map", "PLA red=blue"], ['"PLA red" gets two materials']),
        (["inlay.scad", "--material-map", "=red"], ["a name and a material are expected", "PLA white=white"]),
        (["inlay.scad", "--material-map", "list.json"], ["list.json:1:1", "an object of names and materials"]),
        (["ball.vcad", "--material-map", "a=red"], ["--material-map is for OpenSCAD scripts"]),
        (["words.scad", "--material-map", "a=red"], ["--material-map is for OpenSCAD scripts"]),
    ]
    for arguments, messages in cases:
        reported = scripts.run("mesh", *arguments, "-o", "wrong.3mf", status=1)
        for message in messages:
            expect(message in reported, f"{arguments}: {reported}")
    reported = scripts.run("mesh", "inlay.scad", "--material-map", "none.json", "-o", "wrong.3mf", status=2)
    expect("none.json" in reported, reported)


def extruded_places(code):
    """The x of all moves that extrude, by tool."""
    tool, relative, before, places = 0, False, 0.0, {}
    for line in code.splitlines():
        words = line.split(";")[0].split()
        if not words:
            continue
        if re.fullmatch(r"T\d+", words[0]):
            tool = int(words[0][1:])
        relative = {"M82": False, "M83": True}.get(words[0], relative)
        values = {word[0]: float(word[1:]) for word in words[1:] if re.fullmatch(r"[XYZEF]-?[\d.]+", word)}
        if words[0] == "G92":
            before = values.get("E", before)
        if words[0] not in ("G0", "G1") or "E" not in values:
            continue
        amount = values["E"] if relative else values["E"] - before
        before = values["E"]
        if amount > 0 and "X" in values:
            places.setdefault(tool, []).append(values["X"])
    return places


def a_slicer_prints_each_part_with_its_tool(scripts):
    if not shutil.which("prusa-slicer"):
        return "skipped: no prusa-slicer"
    for flavour in ("prusa", "generic"):
        scripts.run("scad", "two.scad", "-o", "two.3mf", "--flavour", flavour)
        sliced = program.run(["prusa-slicer", "--export-gcode", "two.3mf", "-o", "two.gcode", "--nozzle-diameter", "0.4,0.4",
                              "--center", "100,100", "--dont-arrange", "--skirts", "0"], cwd=scripts.path)
        expect(sliced.returncode == 0, sliced.stderr)
        places = extruded_places((scripts.path / "two.gcode").read_text(encoding="utf-8"))
        expect(sorted(places) == [0, 1], f"{flavour}: the tools are {sorted(places)}")
        # The boxes reach from 80 to 100 and from 100 to 120; lines lie half their width inside.
        expect(79.9 < min(places[0]) < 80.6 and 99.3 < max(places[0]) < 100.1,
               f"{flavour}: T0 prints from {min(places[0])} to {max(places[0])}")
        expect(99.9 < min(places[1]) < 100.7 and 119.3 < max(places[1]) < 120.1,
               f"{flavour}: T1 prints from {min(places[1])} to {max(places[1])}")
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ombre")
    ombre = pathlib.Path(parser.parse_args().ombre).resolve()

    def run(check):
        with tempfile.TemporaryDirectory() as scratch:
            return check(Scripts(ombre, scratch))

    checks = [each_slicer_gets_one_object_of_two_volumes, bodies_with_a_colour_alone_are_named_by_it,
              meshes_are_the_polyhedra_themselves, designs_keep_the_parts_of_scripts, materials_come_from_a_map,
              wrong_maps_get_remedies, a_slicer_prints_each_part_with_its_tool]
    return program.check_all([(check.__name__, lambda check=check: run(check)) for check in checks])


if __name__ == "__main__":
    raise SystemExit(main())

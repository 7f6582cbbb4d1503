#!/usr/bin/env python3
"""Mesh files, read by programs that are not ours.

    python3 tests/run_mesh_files.py build/dev/tests/mesh_samples

What slicers make of them is tested where prusa-slicer is installed; ./dev test installs it.
"""
import argparse
import functools
import json
import pathlib
import re
import shutil
import struct
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile

import program
from program import expect

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
MATERIAL = "{http://schemas.microsoft.com/3dmanufacturing/material/2015/02}"
NO_ZIP = "without libzip"


def entry(path, name):
    """An XML file of an archive."""
    with zipfile.ZipFile(path) as archive:
        expect(archive.testzip() is None, f"{path.name}: damaged")
        return ElementTree.fromstring(archive.read(name))


def volume(mesh):
    """Of a <mesh> element of 3MF."""
    points = [tuple(float(v.get(axis)) for axis in "xyz") for v in mesh.iter(CORE + "vertex")]
    total = 0
    for triangle in mesh.iter(CORE + "triangle"):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (points[int(triangle.get(v))] for v in ("v1", "v2", "v3"))
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6


def archives_are_packages(folder):
    for path in folder.glob("*.3mf"):
        with zipfile.ZipFile(path) as archive:
            expect({i.date_time for i in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}, f"{path.name} tells the time")
            names = archive.namelist()
        types = {t.get("Extension") for t in entry(path, "[Content_Types].xml")}
        expect({n.rpartition(".")[2] for n in names[1:]} <= types, f"{path.name}: {names}, {types}")
        (model,) = entry(path, "_rels/.rels")
        expect(model.get("Target")[1:] in names, f"{path.name} points to {model.get('Target')}")


def regions_are_objects_of_one_part(folder):
    model = entry(folder / "two_boxes.3mf", "3D/3dmodel.model")
    expect(model.get("unit") == "millimeter", "wrong unit")
    bases = [(b.get("name"), b.get("displaycolor")) for b in model.iter(CORE + "base")]
    expect(bases == [("hard", "#FF0000FF"), ("soft & <clear>", "#0080FF80")], str(bases))
    objects = {o.get("id"): o for o in model.iter(CORE + "object")}
    (item,) = model.iter(CORE + "item")
    parts = [objects[c.get("objectid")] for c in objects[item.get("objectid")].iter(CORE + "component")]
    found = [(p.get("name"), p.get("pindex"), volume(p.find(CORE + "mesh"))) for p in parts]
    expect(found == [("small", "0", 1000), ("large", "1", 3000)], str(found))


def prusa_gets_ranges_of_triangles(folder):
    path = folder / "two_boxes_prusa.3mf"
    (body,) = entry(path, "3D/3dmodel.model").iter(CORE + "object")
    triangles = [[int(t.get(v)) for v in ("v1", "v2", "v3")] for t in body.iter(CORE + "triangle")]
    expect(len(triangles) == 24 and volume(body) == 4000, f"{len(triangles)} triangles, {volume(body)} mm3")
    (config,) = entry(path, "Metadata/Slic3r_PE_model.config")
    expect(config.get("id") == body.get("id"), "the settings are of another object")
    first_vertex = 0
    for volume_of, extruder in zip(config.iter("volume"), "12"):
        settings = {m.get("key"): m.get("value") for m in volume_of}
        expect(settings["extruder"] == extruder, str(settings))
        own = triangles[int(volume_of.get("firstid")):int(volume_of.get("lastid")) + 1]
        corners = {corner for triangle in own for corner in triangle}
        expect(corners == set(range(first_vertex, first_vertex + 8)), f"vertices are not together: {corners}")
        first_vertex += 8


def bambu_gets_a_project(folder):
    for flavour in ("bambu", "orca", "snapmaker"):
        path = folder / f"four_fills_{flavour}.3mf"
        model = entry(path, "3D/3dmodel.model")
        reported = {m.get("name"): m.text for m in model.iter(CORE + "metadata")}
        expect(re.fullmatch(r"BambuStudio-\d\d(\.\d\d){3}", reported["Application"]), str(reported))
        with zipfile.ZipFile(path) as archive:
            project = json.loads(archive.read("Metadata/project_settings.config"))
        expect(project["filament_colour"] == ["#FF0000"] and project["filament_settings_id"] == ["hard"], str(project))
        (item,) = model.iter(CORE + "item")
        (config,) = entry(path, "Metadata/model_settings.config").iter("object")
        expect(config.get("id") == item.get("objectid"), "the settings are of another object")
        parts = {o.get("id"): volume(o) for o in entry(path, "3D/Objects/object_1.model").iter(CORE + "object")}
        placed = [c.get("objectid") for c in model.iter(CORE + "component")]
        expect(placed == [part.get("id") for part in config.iter("part")] == list(parts), f"{placed}, {list(parts)}")
        expect(all(abs(mm3 - 4000) < 1e-6 for mm3 in parts.values()), str(parts))
        fills = [{m.get("key"): m.get("value") for m in part} for part in config.iter("part")]
        expect([f["sparse_infill_density"] for f in fills] == ["10%", "20%", "40%", "80%"], str(fills))


def vertices_have_colours(folder):
    model = entry(folder / "coloured.3mf", "3D/3dmodel.model")
    (group,) = model.iter(MATERIAL + "colorgroup")
    expect([c.get("color") for c in group] == [f"#{30 * i:02X}00FFFF" for i in range(8)], "wrong colours")
    for t in model.iter(CORE + "triangle"):
        expect(t.get("pid") == group.get("id"), "no colours")
        expect([t.get(v) for v in ("v1", "v2", "v3")] == [t.get(p) for p in ("p1", "p2", "p3")], "others' colours")


def amf_is_one_object(folder):
    amf = ElementTree.parse(folder / "four_fills.amf").getroot()
    volumes = amf.findall("object/mesh/volume")
    settings = [{m.get("type"): m.text for m in v.iter("metadata")} for v in volumes]
    expect([s["name"] for s in settings] == ["fill 10", "fill 20", "fill 40", "fill 80"], str(settings))
    expect([s["slic3r.fill_density"] for s in settings] == ["10%", "20%", "40%", "80%"], str(settings))
    expect([m.get("id") for m in amf.findall("material")] == ["1", "2"], "material 0 is void")


def glb_is_in_metres(folder):
    data = (folder / "two_boxes.glb").read_bytes()
    magic, version, size, json_size, json_type = struct.unpack_from("<4sIII4s", data)
    expect((magic, version, size, json_type) == (b"glTF", 2, len(data), b"JSON"), "wrong header")
    scene = json.loads(data[20:20 + json_size])
    numbers = data[20 + json_size + 8:]
    expect(len(numbers) == scene["buffers"][0]["byteLength"] and json_size % 4 == 0, "wrong sizes")
    # The corner (20, 20, 10) mm of the second box, by the matrix (column by column) of the node that holds it.
    m = scene["nodes"][2]["matrix"]
    x, y, z = scene["accessors"][2]["max"]
    world = [m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row] for row in range(3)]
    expect(world == [0.02, 0.01, -0.02], str(world))
    view = scene["bufferViews"][scene["accessors"][2]["bufferView"]]
    expect(struct.unpack_from("<3f", numbers, view["byteOffset"]) == (5, 0, 0), "wrong first corner")
    colour = scene["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"]
    expect(abs(colour[1] - 0.21586) < 1e-5 and scene["materials"][1]["alphaMode"] == "BLEND", str(colour))


class Gcode:
    """What a slicer made of a file."""

    def __init__(self, folder, name, *options):
        out = folder / (name + ".gcode")
        result = program.run(["prusa-slicer", "--export-gcode", folder / name, "-o", out, "--nozzle-diameter",
                              "0.4,0.4", "--skirts", "0", "--dont-arrange", *options])
        expect(result.returncode == 0, f"{name}: {result.stderr[-1000:]}")
        self.text = out.read_text(encoding="utf-8")

    def tools(self):
        return set(re.findall(r"^T(\d)", self.text, re.MULTILINE))

    def filament_mm(self):
        return [float(v) for v in re.search(r"; filament used \[mm\] = (.*)", self.text)[1].split(",")]

    def filament_along_x(self, bins):
        """Its lengths in equal parts of the range of x."""
        moves, x, e = [], 0, 0
        for line in self.text.splitlines():
            words = {w[0]: float(w[1:]) for w in line.split(";")[0].split()[1:] if re.fullmatch(r"[XYE]-?[\d.]+", w)}
            if line.startswith("G92"):
                e = words.get("E", e)
            elif line.startswith("G1 "):
                if "E" in words and words["E"] > e and ("X" in words or "Y" in words):
                    moves.append(((x + words.get("X", x)) / 2, words["E"] - e))
                x, e = words.get("X", x), words.get("E", e)
        least, greatest = min(m[0] for m in moves), max(m[0] for m in moves)
        sums = [0] * bins
        for place, length in moves:
            sums[min(int(bins * (place - least) / (greatest - least)), bins - 1)] += length
        return sums


def with_slicer(check):
    @functools.wraps(check)
    def guarded(folder):
        if not shutil.which("prusa-slicer"):
            return "skipped: no prusa-slicer"
        return check(folder)
    return guarded


@with_slicer
def slicers_change_tools(folder):
    for name in ["two_boxes_prusa.3mf", "two_boxes.3mf", "two_boxes.amf"]:
        gcode = Gcode(folder, name, "--fill-density", "100%", "--fill-pattern", "rectilinear", "--perimeters", "1")
        expect(gcode.tools() == {"0", "1"}, f"{name}: tools {gcode.tools()}")
        small, large = gcode.filament_mm()
        expect(abs(large / small - 3) < 0.1, f"{name}: {small} and {large} mm, the volumes are 1 to 3")


@with_slicer
def slicers_fill_less(folder):
    for name in ["four_fills_prusa.3mf", "four_fills.3mf", "four_fills.amf"]:
        lengths = Gcode(folder, name, "--perimeters", "0", "--top-solid-layers", "0", "--bottom-solid-layers",
                        "0").filament_along_x(4)
        shares = [length / lengths[0] for length in lengths]
        expect(all(abs(s / f - 1) < 0.2 for s, f in zip(shares, [1, 2, 4, 8])), f"{name}: {lengths}")


CHECKS = [archives_are_packages, regions_are_objects_of_one_part, prusa_gets_ranges_of_triangles,
          bambu_gets_a_project, vertices_have_colours, amf_is_one_object, glb_is_in_metres,
          slicers_change_tools, slicers_fill_less]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("samples", type=pathlib.Path, help="the program that writes them")
    samples = parser.parse_args().samples.resolve()
    with tempfile.TemporaryDirectory() as scratch:
        made = program.run([samples, scratch])
        if NO_ZIP in made.stderr:
            print("skipped: no 3MF in this build")
            return 0
        expect(made.returncode == 0, made.stderr)
        folder = pathlib.Path(scratch)
        return program.check_all([(check.__name__, functools.partial(check, folder)) for check in CHECKS])


if __name__ == "__main__":
    raise SystemExit(main())

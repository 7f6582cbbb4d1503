#!/usr/bin/env python3
"""Outlines of layers, run as a user would and read by programs that are not ours.

    python3 tests/run_contours.py build/dev/apps/ombre/ombre
"""
import json
import math
import os
import re
import shutil
import signal
import struct
import subprocess
import xml.etree.ElementTree as ElementTree

import processes
import program
from program import expect

SVG = "{http://www.w3.org/2000/svg}"
HALVES = 'fgrade(["x/20 + 0.5", "0.5 - x/20"], ["red", "blue"]) rectprism(20, 10, 2);'
RING = "difference() { cylinder(10, 4); cylinder(5, 6); }"


class Drawing(program.Folder):
    """A folder with designs in it."""

    FILES = {"halves.vcad": HALVES, "ring.vcad": RING}

    def contours(self, design, out, *arguments, **options):
        return self.run("contours", design, "-o", out, *arguments, **options)

    def names(self):
        return [name for name in super().names() if not name.endswith(".vcad")]


def area(polygon):
    """Positive when counter-clockwise; the first point may be repeated."""
    return sum(x * v - u * y for (x, y), (u, v) in zip(polygon, polygon[1:] + polygon[:1])) / 2


def length(polygon):
    return sum(math.dist(p, q) for p, q in zip(polygon, polygon[1:] + polygon[:1]))


def svg_regions(path):
    """Polygons by region, y up, and the root element."""
    root = ElementTree.parse(path).getroot()
    regions = {}
    for element in root.iter(SVG + "path"):
        rings = [ring.replace("M", "").replace("Z", "").split("L")
                 for ring in re.findall("M[^Z]*Z", element.get("d"))]
        regions[element.find(SVG + "title").text] = [[(float(x), -float(y)) for x, y in map(str.split, ring)]
                                                     for ring in rings]
    return regions, root


def cli(path):
    """Labels, header fields, and layers as (z, [(id, direction, points)])."""
    labels, fields, layers = {}, {}, []
    for line in path.read_text(encoding="ascii").splitlines():
        command, _, values = line.removeprefix("$$").partition("/")
        if command == "LABEL":
            number, name = values.split(",")
            labels[int(number)] = name
        elif command == "LAYER":
            layers.append((float(values), []))
        elif command == "POLYLINE":
            number, direction, count, *rest = values.split(",")
            points = list(zip(map(float, rest[::2]), map(float, rest[1::2])))
            expect(len(points) == int(count) and points[0] == points[-1], f"not closed: {line[:100]}")
            layers[-1][1].append((int(number), int(direction), points))
        else:
            fields[command] = values
    return labels, fields, layers


def rings_are_in_millimetres(drawing):
    drawing.contours("ring.vcad", "ring.svg", "--z", "0", "--tolerance", "0.01")
    regions, root = svg_regions(drawing.path / "ring.svg")
    expect((root.get("width"), root.get("height")) == ("20mm", "20mm"), str(root.attrib))
    expect(root.get("viewBox") == "-10 -10 20 20", str(root.attrib))
    ((outer, inner),) = regions.values()
    expect(abs(area(outer) - math.pi * 100) < 0.63 and abs(area(inner) + math.pi * 25) < 0.32, "wrong areas")


def commands_are_those_of_the_interface(drawing):
    drawing.contours("ring.vcad", "ring.cli", "--layer-height", "0.5")
    lines = (drawing.path / "ring.cli").read_text().splitlines()
    expect(lines[:4] == ["$$HEADERSTART", "$$ASCII", "$$UNITS/1", "$$VERSION/200"], str(lines[:4]))
    expect(lines[-1] == "$$GEOMETRYEND" and lines.index("$$HEADEREND") + 1 == lines.index("$$GEOMETRYSTART"), "order")
    labels, fields, layers = cli(drawing.path / "ring.cli")
    expect(fields["LAYERS"] == "9" and fields["DIMENSION"] == "-10,-10,-2,10,10,2", str(fields))
    expect([z for z, _ in layers] == [-2 + 0.5 * n for n in range(9)], "wrong heights")
    expect(layers[0][1] == [], "the lowest face has no polygons")
    for _, polylines in layers[1:]:
        expect([(n, direction) for n, direction, _ in polylines] == [(1, 1), (1, 0)], "wrong directions")
        expect([area(points) > 0 for _, _, points in polylines] == [True, False], "wrong ways around")
    expect(list(labels) == [1], str(labels))


def halves_share_points(drawing):
    drawing.contours("halves.vcad", "halves", "--by", "materials", "--layer-height", "0.5")
    files = sorted(path.name for path in (drawing.path / "halves").iterdir())
    expect(files == [f"layer_{n:04}.svg" for n in range(4)], str(files))
    regions, root = svg_regions(drawing.path / "halves/layer_0000.svg")
    expect({p.get("fill") for p in root.iter(SVG + "path")} != {None} and set(regions) == {"red", "blue"}, str(regions))
    (red,), (blue,) = regions["red"], regions["blue"]
    expect(abs(area(red) - 100) < 1e-9 and abs(area(blue) - 100) < 1e-9, f"{area(red)} {area(blue)}")
    expect(len(set(red) & set(blue)) == 2, "the halves share two points")


def expect_areas_of_voxels(drawing, example, by):
    """Layer by layer; a voxel at the border is wrong by at most half of itself, on average by less."""
    drawing.contours(example, "probe.cli", "--layer-height", "1000")
    lo_x, lo_y, lo_z, hi_x, hi_y, hi_z = map(float, cli(drawing.path / "probe.cli")[1]["DIMENSION"].split(","))
    pitch, height = max(hi_x - lo_x, hi_y - lo_y) / 200, (hi_z - lo_z) / 7.7
    pitch, height = f"{pitch:.4f}", f"{height:.4f}"
    drawing.contours(example, "part.cli", "--layer-height", height, "--force", *by)
    drawing.run("voxels", example, "-o", "part.raw", "--voxel", f"{pitch},{pitch},{height}")
    nx, ny, nz = json.loads((drawing.path / "part.raw.json").read_text())["dimensions"]
    data = (drawing.path / "part.raw").read_bytes()
    layers = cli(drawing.path / "part.cli")[2][1:]
    expect(len(layers) == nz, f"{len(layers)} layers, voxels have {nz}")
    for n, (_, polylines) in enumerate(layers):
        found = sum(area(points) for _, _, points in polylines)
        around = sum(length(points) for _, _, points in polylines)
        counted = nx * ny - data[n * nx * ny:(n + 1) * nx * ny].count(0)
        wanted, slack = counted * float(pitch) ** 2, 0.5 * around * float(pitch) + 4 * float(pitch) ** 2
        expect(abs(found - wanted) <= slack, f"{example} layer {n}: {found} mm2, voxels {wanted}, slack {slack}")


def examples_have_the_areas_of_their_voxels(drawing):
    shutil.copytree(program.SOURCE / "examples", drawing.path / "examples")
    for path in program.examples(drawing.ombre):
        expect_areas_of_voxels(drawing, f"examples/{path.name}", [])
        for name in ["probe.cli", "part.cli", "part.raw", "part.raw.json"]:
            (drawing.path / name).unlink()


def threads_change_no_byte(drawing):
    made = set()
    for threads in ["1", "2"]:
        drawing.contours("halves.vcad", "h.cli", "--bands", "3", "--threads", threads, "--force")
        made.add((drawing.path / "h.cli").read_bytes())
    expect(len(made) == 1, "bytes depend on threads")


def slips_get_remedies(drawing):
    for arguments, message in [(["r.svg"], "say which with --z"),
                               (["r", "--z", "high"], "write for example --z 3.2"),
                               (["r", "--z", "9"], "is beside the part, which lies from z -2 to 2 mm"),
                               (["r", "--layer-height", "thin"], "write for example --layer-height"),
                               (["r", "--cell", "0.00000001"], "too small"),
                               (["r", "--by", "materials", "--bands", "3"], "--by materials has no bands"),
                               (["r", "--hatch", "0.1"], "--hatch is for .cli files"),
                               (["r.cli", "--hatch", "0.00001"], "are too many"),
                               (["r.cli", "--hatch-turn", "3"], "--hatch")]:
        error = drawing.contours("ring.vcad", *arguments, status=1).stderr
        expect(message in error, f"{arguments}: {error}")
    expect(drawing.names() == [], str(drawing.names()))


def files_are_kept(drawing):
    drawing.contours("ring.vcad", "ring.cli", "--layer-height", "1")
    error = drawing.contours("ring.vcad", "ring.cli", status=2).stderr
    expect("ring.cli exists already" in error, error)
    drawing.contours("ring.vcad", "ring.cli", "--layer-height", "1", "--force")
    drawing.contours("ring.vcad", "ring", "--layer-height", "0.5")
    (drawing.path / "ring/mine.svg").write_text("mine")
    error = drawing.contours("ring.vcad", "ring", status=2).stderr
    expect("has layers already" in error and "--force" in error, error)
    drawing.contours("ring.vcad", "ring", "--layer-height", "2", "--force")
    names = sorted(path.name for path in (drawing.path / "ring").iterdir())
    expect(names == ["layer_0000.svg", "layer_0001.svg", "mine.svg"], str(names))
    error = drawing.contours("ring.vcad", "missing/ring.cli", status=2).stderr
    expect("the folder is missing" in error, error)
    error = drawing.contours("ring.vcad", "ring.vcad", status=2).stderr
    expect("is no folder" in error, error)


def unwritable_folders_are_reported(drawing):
    if os.geteuid() == 0:
        return "skipped: root may write everywhere"
    locked = drawing.path / "locked"
    locked.mkdir(mode=0o500)
    for out in ["locked/ring.cli", "locked/ring"]:
        error = drawing.contours("ring.vcad", out, status=2).stderr
        expect("Permission denied" in error and "choose a folder that you may write to" in error, error)
    return ""


def full_disks_leave_nothing(drawing):
    if not os.access("/dev/full", os.W_OK):
        return "skipped: no /dev/full"
    for out, part in [("r.cli", "r.cli.part"), ("rings", "rings/layer_0000.svg.part")]:
        (drawing.path / part).parent.mkdir(exist_ok=True)
        (drawing.path / part).symlink_to("/dev/full")
        error = drawing.contours("ring.vcad", out, status=2).stderr
        expect("No space left on device" in error and "free some space" in error, error)
    expect(drawing.names() == ["rings"] and not list((drawing.path / "rings").iterdir()), str(drawing.names()))
    return ""


def interrupts_leave_nothing(drawing):
    for out, part in [("ring.cli", "ring.cli.part"), ("rings", "rings/layer_0000.svg.part")]:
        job = subprocess.Popen(drawing.command("contours", "ring.vcad", "-o", out, "--tolerance", "0.001",
                                               "--layer-height", "0.0005", "--threads", "1"),
                               cwd=drawing.path, env=program.environment(), stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        processes.wait_until(lambda: job.poll() is not None or (drawing.path / part).exists(), f"{out} is begun")
        job.send_signal(signal.SIGINT)
        error = job.communicate(timeout=program.PATIENCE_S)[1]
        expect(job.returncode == 130, f"status {job.returncode}: {error}")
        expect(drawing.names() == [], str(drawing.names()))


def hatches_of(text):
    """The layers of a .cli file: for each the lines by region, and the area of its outlines by region."""
    layers = []
    for line in text.splitlines():
        command, _, numbers = line.partition("/")
        values = [float(n) for n in numbers.split(",")] if command in ("$$LAYER", "$$HATCHES", "$$POLYLINE") else []
        if command == "$$LAYER":
            layers.append(({}, {}))
        elif command == "$$HATCHES":
            ends = values[2:]
            expect(len(ends) == 4 * values[1], line[:80])
            layers[-1][0][values[0]] = [((a, b), (c, d)) for a, b, c, d in zip(*[iter(ends)] * 4)]
        elif command == "$$POLYLINE":
            points = list(zip(values[3::2], values[4::2]))
            layers[-1][1][values[0]] = layers[-1][1].get(values[0], 0) + area(points)
    return layers


def hatches_fill_bands_of_a_value(drawing):
    """Lines times their distance have the area of their band, and a turn of 90 degrees turns them."""
    drawing.write("melt.vcad", 'attribute("laser_power", "200 + 10*x") difference() { cylinder(10, 2); cylinder(3, 3); }')
    drawing.contours("melt.vcad", "melt.cli", "--layer-height", "1", "--by", "laser_power", "--bands", "4", "--hatch",
                     "0.05", "--hatch-angle", "30", "--hatch-turn", "90")
    text = (drawing.path / "melt.cli").read_text()
    labels = dict(line[8:].split(",", 1) for line in text.splitlines() if line.startswith("$$LABEL/"))
    expect(len(labels) == 4 and all("laser_power" in name for name in labels.values()), f"{labels}")
    first, *layers = hatches_of(text)
    expect(first == ({}, {}) and len(layers) == 2, f"{len(layers)} layers")
    for n, (lines, areas) in enumerate(layers):
        expect(set(lines) == set(areas) == {1, 2, 3, 4}, f"{set(lines)}")
        for region, its in lines.items():
            covered = 0.05 * sum(math.dist(a, b) for a, b in its)
            expect(abs(covered - areas[region]) < 0.02 * areas[region] + 0.1, f"{covered} of {areas[region]} mm2")
            angle = math.radians(30 + 90 * n)
            for (a, b), (c, d) in its:
                across = abs((c - a) * math.sin(angle) - (d - b) * math.cos(angle))
                expect(across < 1e-5, f"a line of layer {n} has another angle")
        expect(abs(sum(areas.values()) - math.pi * 91) < 0.5, f"{areas}")
    drawing.contours("melt.vcad", "melt.cli", "--layer-height", "1", "--by", "laser_power", "--bands", "4", "--hatch",
                     "0.05", "--hatch-angle", "30", "--hatch-turn", "90", "--binary", "--force")
    binary = (drawing.path / "melt.cli").read_bytes()
    header, _, body = binary.partition(b"$$HEADEREND")
    expect(b"$$BINARY" in header, "the header does not say that numbers are binary")
    at, heights, numbers = 0, [], []
    while at < len(body):
        command, = struct.unpack_from("<H", body, at)
        at += 2
        if command == 127:
            heights.append(struct.unpack_from("<f", body, at)[0])
            at += 4
        elif command in (130, 132):
            head = struct.unpack_from("<iii" if command == 130 else "<ii", body, at)
            at += 4 * len(head)
            count = head[-1] * (2 if command == 130 else 4)
            numbers += struct.unpack_from(f"<{count}f", body, at)
            at += 4 * count
        else:
            raise AssertionError(f"command {command} at {at}")
    expect(heights == [-1, 0, 1], f"{heights}")
    texts = [float(n) for line in text.splitlines() if line.startswith(("$$POLYLINE", "$$HATCHES"))
             for n in line.partition("/")[2].split(",")[3 if "POLY" in line else 2:]]
    expect(len(texts) == len(numbers) and max(abs(a - b) for a, b in zip(texts, numbers)) < 2e-6, "other numbers")


CHECKS = [rings_are_in_millimetres, commands_are_those_of_the_interface, halves_share_points,
          examples_have_the_areas_of_their_voxels, threads_change_no_byte, slips_get_remedies, files_are_kept,
          hatches_fill_bands_of_a_value,
          unwritable_folders_are_reported, full_disks_leave_nothing, interrupts_leave_nothing]


if __name__ == "__main__":
    raise SystemExit(program.main(Drawing, program.named(CHECKS)))

#!/usr/bin/env python3
"""Checks masks for vat printers: how much of a pixel is inside, and .sl1 archives beside PrusaSlicer's own."""
import json
import math
import shutil
import zipfile

import png
import program
from program import expect, near

# A bar with two posts, which looks different from all sides.
BARS = """translate(0, -4, 1) rectprism((20, 4, 2), "red");
translate(-8.5, 4, 1) rectprism((3, 12, 2), "red");
translate(5, 0, 1) rectprism((2, 4, 2), "red");
"""
PIXEL = 0.04725
PRUSA = ["--export-sla", "--pad-enable=0", "--supports-enable=0", "--printer-technology", "SLA", "--display-mirror-x=0",
         "--display-mirror-y=1", "--display-orientation", "landscape", "--display-pixels-x", "1440", "--display-pixels-y",
         "2560", "--display-width", "68.04", "--display-height", "120.96", "--bed-shape",
         "0x0,68.04x0,68.04x120.96,0x120.96", "--center", "34.02,60.48", "--layer-height", "0.05",
         "--initial-layer-height", "0.05", "--slice-closing-radius", "0", "--elefant-foot-compensation=0"]


def layers_of(path):
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def settings_of(text):
    return dict(line.split(" = ", 1) for line in text.decode().splitlines())


def shades_of(bytes_of_png):
    """Rows of shades from 0 to 255."""
    image = png.Image(bytes_of_png)
    expect(image.colour_type == png.GRAY and image.depth == 8, "the image is no gray one of 8 bits")
    return [bytes(pixel[0] for pixel in row) for row in image.rows]


def box_of(rows):
    """The least box with all pixels of at least half a shade: left, top, right, bottom."""
    ys = [y for y, row in enumerate(rows) if max(row) > 127]
    xs = [x for y in ys for x, shade in enumerate(rows[y]) if shade > 127]
    return min(xs), ys[0], max(xs) + 1, ys[-1] + 1


def an_archive_has_settings_and_layers(folder):
    folder.write("bars.vcad", BARS)
    folder.run("slice", "bars.vcad", "--printer", "prusa-sl1", "-o", "bars.sl1")
    files = layers_of(folder.path / "bars.sl1")
    expect([name for name in sorted(files) if name.startswith("layer")] == [f"layer{n:05}.png" for n in range(40)],
           f"{sorted(files)}")
    job, slicer = settings_of(files["config.ini"]), settings_of(files["prusaslicer.ini"])
    expect(job["jobDir"] == "layer" and job["numFast"] == "40" and job["layerHeight"] == "0.05", f"{job}")
    near(float(job["usedMaterial"]), (20 * 4 + 3 * 12 + 2 * 4) * 2 / 1000, 1e-4, "the resin in ml")
    expect(slicer["display_pixels_x"] == "1440" and slicer["display_pixels_y"] == "2560", f"{slicer}")
    rows = shades_of(files["layer00020.png"])
    area = sum(map(sum, rows)) / 255 * PIXEL ** 2
    near(area, 20 * 4 + 3 * 12 + 2 * 4, 0.1, "the area of a layer")
    said = folder.run("verify", "bars.sl1", "--design", "bars.vcad", "--all").stdout
    expect("everything that was checked holds" in said, said)


def the_images_are_those_of_prusaslicer(folder):
    if not shutil.which("prusa-slicer"):
        return "skipped: no prusa-slicer"
    folder.write("bars.vcad", BARS)
    folder.run("slice", "bars.vcad", "--printer", "prusa-sl1", "-o", "bars.sl1", "--antialias", 8)
    folder.run("mesh", "bars.vcad", "-o", "bars.stl")
    result = program.run(["prusa-slicer", *PRUSA, "bars.stl", "-o", "theirs.sl1"], cwd=folder.path)
    expect(result.returncode == 0, result.stdout + result.stderr)
    ours, theirs = layers_of(folder.path / "bars.sl1"), layers_of(folder.path / "theirs.sl1")
    images = [name for name in sorted(theirs) if name.endswith(".png") and "thumbnail" not in name]
    expect(len(images) == 40, f"{len(images)} images")
    one, other = shades_of(ours["layer00020.png"]), shades_of(theirs[images[20]])
    boxes = box_of(one), box_of(other)
    expect(all(abs(a - b) <= 1 for a, b in zip(*boxes)), f"{boxes}")
    dx, dy = boxes[0][0] - boxes[1][0], boxes[0][1] - boxes[1][1]
    differing = sum(abs(row[x + dx] - other[y][x]) > 127 for y, row in enumerate(one[dy:] if dy >= 0 else one)
                    for x in range(boxes[1][0], boxes[1][2]) if y < len(other) and x + dx < len(row))
    perimeter = 2 * (20 + 4 + 12 + 3 + 12 + 4 + 4) / PIXEL
    expect(differing < perimeter, f"{differing} pixels differ beside the edges of {perimeter:.0f}")
    known = settings_of(theirs["config.ini"])
    expect(set(settings_of(ours["config.ini"])) <= set(known), f"{sorted(known)}")


def soft_edges_have_the_area_of_a_disc(folder):
    folder.write("disc.vcad", 'cylinder(5, 1, "red");\n')
    folder.run("slice", "disc.vcad", "--voxel", 0.1, "--antialias", 8, "--format", "gray", "-o", "soft")
    rows = shades_of((folder.path / "soft" / "slice_00005.png").read_bytes())
    near(sum(map(sum, rows)) / 255 * 0.01, math.pi * 25, 0.05, "the area of the disc")
    expect(len({shade for row in rows for shade in row}) > 20, "the edge has few shades")


def what_cannot_be_is_said(folder):
    folder.write("two.vcad", 'cube(2, "red"); translate(4, 0, 0) cube(2, "blue");\n')
    said = folder.run("slice", "two.vcad", "--voxel", 0.5, "--antialias", 2, "-o", "two").stderr
    expect("show red and blue alike" in said, said)
    wrong = folder.run("slice", "two.vcad", "--voxel", 0.5, "-o", "two.sl1", status=1).stderr
    expect("has no exposure" in wrong or "has no tray size" in wrong, wrong)
    wrong = folder.run("slice", "two.vcad", "--antialias", 2, "--by", "red", "-o", "other", status=1).stderr
    expect("--antialias" in wrong and "--by" in wrong, wrong)
    wrong = folder.run("slice", "two.vcad", "--printer", "prusa-sl1", "--box", "0,0,0,1,1,1", "-o", "two.sl1", status=1).stderr
    expect("leave out --box" in wrong, wrong)


# A resin that was made up for the test: 0.1 mm deep, light falls to 1/e, and 8 mJ/cm2 gel it.
DEPTH, GEL = 0.1, 8
RESIN = {"name": "resin", "title": "resin", "property": "cure_depth", "unit": "mm", "citation": "made up", "licence": "free",
         "inputs": [{"attribute": "dose", "unit": "mJ/cm2", "valid": [GEL, 400]}], "interpolant": "working-curve",
         "constants": {"penetration": DEPTH, "critical": GEL}}
MACHINE = {"name": "grey", "title": "grey vat", "source": "made up", "pitch": {"x": "0.2", "y": "0.2", "z": "0.05"},
           "image": "gray", "background": [0, 0, 0, 255], "files": "layer{index:05}.png", "vat": True, "needs": ["dose"],
           "build_mm": [8, 8, 10], "origin": "center",
           "exposure": {"seconds": 8, "first_seconds": 35, "fade_layers": 0, "irradiance": 2.5},
           "calibrations": ["./resin.json"]}


def resolved(folder, *arguments):
    return next(e for e in folder.events("resolve", *arguments) if e["event"] == "resolved")


def grey_vat(folder):
    folder.write("resin.json", RESIN)
    folder.write("grey.json", MACHINE)


def doses_follow_the_working_curve(folder):
    """Jacobs: E = Ec exp(Cd / Dp)."""
    grey_vat(folder)
    folder.write("part.vcad", 'attribute("cure_depth", "0.1 + 0.01*x") cube(4);')
    folder.run("slice", "part.vcad", "--printer", "./grey.json", "--by", "dose", "--range", "0,50", "-o", "part.sl1")
    files = layers_of(folder.path / "part.sl1")
    row = shades_of(files["layer00040.png"])[20][10:30]  # the part is in the middle of 40 pixels
    for i, shade in enumerate(row):
        depth = 0.1 + 0.01 * (-2 + 0.2 * (i + 0.5))
        near(shade, 255 * GEL * math.exp(depth / DEPTH) / 50, 0.51, f"the shade of pixel {i}")
    settings = settings_of(files["config.ini"])
    near(float(settings["expTime"]), 50 / 2.5, 1e-9, "the time in which white gets 50 mJ/cm2")
    expect(settings["expTimeFirst"] == "35", f"{settings}")
    arguments = ["slice", "part.vcad", "--printer", "./grey.json", "--by", "dose", "-o", "other.sl1"]
    wrong = folder.run(*arguments, status=1).stderr
    expect("black gets no light" in wrong and "--range 0," in wrong, wrong)
    said = folder.run(*arguments[:-1], "clipped.sl1", "--range", "0,20").stderr
    # 8 exp(1 + x/10) is above 20 from x = -0.84 on.
    columns = sum(GEL * math.exp((0.1 + 0.01 * (-2 + 0.2 * (i + 0.5))) / DEPTH) > 20 for i in range(20))
    layers = sum(name.startswith("layer") for name in layers_of(folder.path / "clipped.sl1"))
    expect(f"dose is above the range of the images, which ends at 20 mJ/cm2 ({columns * 20 * layers:,} voxels" in said, said)
    expect("below the range" not in said, said)
    folder.write("deep.vcad", 'attribute("cure_depth", "0.3 + 0.1*x") cube(4);')
    wrong = folder.run("slice", "deep.vcad", *arguments[2:], "--range", "0,400", status=1).stderr
    expect("cure_depth is out of reach at" in wrong, wrong)


def light_is_added_up(folder):
    """A plate on a post: what lies below the plate is cured, too; and doses that do not reach through a layer are found."""
    grey_vat(folder)
    folder.write("table.vcad", 'attribute("dose", 20) union() { translate(0, 0, 1.5) rectprism((4, 4, 1)); '
                               'translate(0, 0, 0.5) rectprism((0.8, 0.8, 1)); }')
    part, = resolved(folder, "table.vcad", "--printer", "./grey.json")["printers"]
    cure = part["cure"]
    fall = math.exp(-0.05 / DEPTH)
    below = 20 * sum(fall ** n for n in range(1, 21))  # of 20 layers of the plate
    deep = DEPTH * math.log(below / GEL)
    near(cure["deepest_mm"], deep, 1e-6, "the depth below the plate")
    near(cure["over_mm3"], deep * (16 - 0.64), 1e-4, "what is cured below it")
    expect(cure["under_mm3"] == 0, f"{cure}")
    folder.write("weak.vcad", 'attribute("dose", 10) cube(1);')
    part, = resolved(folder, "weak.vcad", "--printer", "./grey.json")["printers"]
    cure = part["cure"]
    # The top layer is cured to Dp ln(10 / 8) = 0.0223 mm alone; the one below it gets light through it, too.
    near(cure["least_depth_mm"], DEPTH * math.log(10 / GEL), 1e-9, "the top layer")
    near(cure["under_mm3"], 0.05 - DEPTH * math.log(10 / GEL), 1e-6, "what is not cured")
    text = folder.run("resolve", "weak.vcad", "--printer", "./grey.json").stdout
    expect("stay below the critical dose" in text, text)


def vats_share_no_pixel(folder):
    folder.write("two.vcad", 'fgrade(["x/4 + 0.5", "0.5 - x/4"], ["StiffResin", "TougherResin"]) cube(4);')
    materials = ["--materials", program.SOURCE / "materials" / "processes.json"]
    folder.run("slice", "two.vcad", "--printer", "vat-two-resins", *materials, "--voxel", "0.2", "-o", "two")
    job = json.loads(folder.read("two/job.json"))
    expect(job["images"]["vats"] == {"wash_seconds": 30}, f"{job['images']}")
    for layer in (0, 7, 19):
        images = [png.Image((folder.path / "two" / f"slice_{layer:05}_{vat}.png").read_bytes())
                  for vat in ("StiffResin", "TougherResin")]
        lit = [[pixel[0] > 0 for row in image.rows for pixel in row] for image in images]
        expect(all(a + b == 1 for a, b in zip(*lit)), f"layer {layer} has pixels of both vats, or of none")
        expect(any(lit[0]) and any(lit[1]), "a vat is not used")
    folder.run("verify", "two", "--design", "two.vcad", *materials)


CHECKS = program.named((an_archive_has_settings_and_layers, the_images_are_those_of_prusaslicer,
                        soft_edges_have_the_area_of_a_disc, doses_follow_the_working_curve, light_is_added_up, vats_share_no_pixel,
                        what_cannot_be_is_said))

if __name__ == "__main__":
    raise SystemExit(program.main(program.Folder, CHECKS))

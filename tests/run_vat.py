#!/usr/bin/env python3
"""Checks masks for vat printers: how much of a pixel is inside, and .sl1 archives beside PrusaSlicer's own."""
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


CHECKS = program.named((an_archive_has_settings_and_layers, the_images_are_those_of_prusaslicer,
                        soft_edges_have_the_area_of_a_disc, what_cannot_be_is_said))

if __name__ == "__main__":
    raise SystemExit(program.main(program.Folder, CHECKS))

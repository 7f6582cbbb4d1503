#!/usr/bin/env python3
"""Whole jobs, run as a user would: which files they make, from examples, nodes and designs.

    python3 tests/run_files.py build/dev/apps/ombre/ombre [NAME...]
"""
import functools
import json
import math
import re
import shlex
import subprocess

import png
import program
from slice_jobs import SMALL, Job, expect, expect_same, files, layers, ombre_layer

EXAMPLES = program.SOURCE / "examples"


# ---- the same input gives the same bytes


def threads_do_not_change_bytes(job):
    job.slice("one", *SMALL, "--threads", "1")
    job.slice("two", *SMALL, "--threads", "2")
    expect_same(job.path / "one", job.path / "two")


def memory_does_not_change_bytes(job):
    job.slice("plenty", *SMALL)
    job.slice("little", *SMALL, "--memory", "1M")
    expect_same(job.path / "plenty", job.path / "little")


def pieces_make_the_whole(job):
    job.slice("whole", *SMALL)
    job.slice("pieces", *SMALL, "--layers", "41:90")
    job.slice("pieces", *SMALL, "--layers", ":17", "--resume")
    job.slice("pieces", *SMALL, "--layers=-10:", "--resume")
    job.slice("pieces", *SMALL, "--resume")
    expect_same(job.path / "whole", job.path / "pieces")


def a_piece_has_the_names_and_bytes_of_the_whole(job):
    job.slice("whole", *SMALL)
    job.slice("piece", *SMALL, "--layers", "30:33")
    names = [p.name for p in layers(job.path / "piece")]
    expect(names == ["slice_00030.png", "slice_00031.png", "slice_00032.png"], str(names))
    expect_same(job.path / "whole", job.path / "piece", lambda name: name in names)


def seeds_change_the_mixture_only(job):
    job.slice("a", *SMALL, "--seed", "1")
    job.slice("b", *SMALL, "--seed", "2")
    expect(files(job.path / "a") != files(job.path / "b"), "the same files for two seeds")
    inside = [[[pixel[3] > 0 for row in image.rows for pixel in row] for image in job.images(out)[40:44]]
              for out in "ab"]
    expect(inside[0] == inside[1], "the seed moved the surface")


def printed_designs_are_the_same_job(job):
    """A script, and what --emit json makes of it."""
    text = ('union() { sphere(2, "red"); translate(1, 0, 0) { rotate(10, 20, 30) { cube("3 + 0.1*sin(x)", "blue"); } } }\n'
            'part("lid") { translate(0, 0, 3) { cylinder(1, 2, "green"); } }')
    design = job.write("parts.vcad", text)
    for name, script in (("ball", job.design), ("parts", design)):
        printed = program.run([job.ombre, "slice", script, "--emit", "json"]).stdout
        job.slice(name, *SMALL, design=script)
        job.slice(name + "_json", *SMALL, design=job.write(name + ".json", printed))
        hashes = [json.loads((job.path / out / "job.json").read_text())["design_hash"] for out in (name, name + "_json")]
        expect(hashes[0] == hashes[1], f"{name}: design hashes {hashes}")
        expect_same(job.path / name, job.path / (name + "_json"), lambda file: file.startswith("slice_"))
    expect_same(job.path / "parts", job.path / "parts_json")


def roundabout_rotations_keep_the_voxels(job):
    """OpenVCAD (2023), Fig. 12: turned by 33.3 degrees and back, but for rounding at the boundary."""
    body = """difference() { union(materials="first") { cube(7.34, "red"); translate(3, 1, 2) { sphere(2.7, "blue"); } }
              cylinder(1.9, 12); }"""
    root = "root((-6, -6, -6), (6, 6, 6), (0.1, 0.1, 0.1)) { %s }"
    turned = "rotate((-33.3, -33.3, -33.3), order=\"xyz\") { rotate(33.3, 33.3, 33.3) { %s } }"
    job.slice("plain", design=job.write("plain.vcad", root % body))
    job.slice("turned", design=job.write("turned.vcad", root % turned % body))
    different = inside = 0
    for a, b in zip(job.images("plain"), job.images("turned")):
        for row_a, row_b in zip(a.rows, b.rows):
            inside += sum(pixel[3] > 0 for pixel in row_a)
            if row_a != row_b:
                different += sum(p != q for p, q in zip(row_a, row_b))
    expect(inside > 300_000 and different <= 5, f"{different} of {inside} voxels differ")


# ---- images


def images_lie_as_the_design_does(job):
    """x to the right, y up, file 0 the lowest layer; void is transparent; colours are the materials'."""
    cells = {(3, 0, 0): "red", (0, 2, 0): "green", (0, 0, 1): "blue"}
    colours = {"red": (255, 0, 0, 255), "green": (0, 160, 70, 255), "blue": (0, 80, 255, 255)}
    cubes = "".join(f'translate({x + 0.5}, {y + 0.5}, {z + 0.5}) {{ cube(1, "{m}"); }}' for (x, y, z), m in cells.items())
    design = job.write("cells.vcad", f"root((0, 0, 0), (4, 3, 2), (1, 1, 1)) {{ {cubes} }}")
    for form, colour_type in (("indexed", png.INDEXED), ("rgba", png.RGBA)):
        job.slice(form, "--format", form, design=design)
        images = job.images(form)
        expect(len(images) == 2, f"{len(images)} layers")
        for z, image in enumerate(images):
            expect(image.colour_type == colour_type, f"colour type {image.colour_type}")
            expect((image.width, image.height) == (4, 3), f"{image.width} x {image.height}")
            expect(image.pixels_per_metre == (1000, 1000), f"pHYs {image.pixels_per_metre}")
            for y in range(3):
                for x in range(4):
                    wanted = colours.get(cells.get((x, y, z)), (0, 0, 0, 0))
                    found = image.rows[2 - y][x]
                    expect(found == wanted, f"{form} voxel {(x, y, z)}: {found}, expected {wanted}")


def images_tell_their_resolution(job):
    job.slice("dpi", "--dpi", "600,300", "--layer-height", "0.027", "--layers", "50")
    found = job.images("dpi")[0].pixels_per_metre
    wanted = (round(600 / 0.0254), round(300 / 0.0254))
    expect(found == wanted, f"pHYs {found}, expected {wanted}")


def palettes_of_any_size(job):
    """A row of n materials: 1, 2, 4 or 8 bits a pixel, each with its exact colour."""
    for count, depth in ((1, 1), (3, 2), (4, 4), (15, 4), (16, 8), (100, 8)):
        colours = [(7 * i % 256, 255 - i, (31 * i + 5) % 256, 255 - i % 2) for i in range(count)]
        entries = [dict(zip("rgba", colour), name=f"m{i}") for i, colour in enumerate(colours)]
        materials = job.write("materials.json", json.dumps({"materials": entries}))
        design = job.write(f"row{count}.vcad", f"root((0, 0, 0), ({count + 1}, 1, 1), (1, 1, 1)) "
                           f"for (i = [0:{count - 1}]) translate(i + 0.5, 0.5, 0.5) {{ cube(1, i + 1); }}")
        for form in ("indexed", "rgba"):
            out = f"{form}{count}"
            job.slice(out, "--format", form, "--materials", materials, design=design)
            image = job.images(out)[0]
            expect(form == "rgba" or image.depth == depth, f"{count} materials with {image.depth} bits")
            wanted = colours + [(0, 0, 0, 0)]
            expect(image.rows[0] == wanted, f"{count} materials, {form}: {image.rows[0][:4]}..., expected {wanted[:4]}...")


def bright(colour):
    return (299 * colour[0] + 587 * colour[1] + 114 * colour[2] + 500) // 1000


def materials_have_masks_of_their_own(job):
    """The vat profile: one image for each material, white where rgba images show its colour."""
    job.slice("rgba", *SMALL, "--format", "rgba", "--layers", "40:44")
    job.slice("vat", "--printer", "vat-50um", *SMALL, "--layers", "40:44")
    names = sorted(p.name for p in layers(job.path / "vat"))
    expect(names == [f"slice_{n:05}_{m}.png" for n in range(40, 44) for m in ("blue", "red")], str(names))
    for n, whole in zip(range(40, 44), job.images("rgba")):
        for name, colour in (("red", (255, 0, 0, 255)), ("blue", (0, 80, 255, 255))):
            mask = png.read(job.path / "vat" / f"slice_{n:05}_{name}.png")
            expect(mask.depth == 1, f"{mask.depth} bits")
            wanted = [[255 if pixel == colour else 0 for pixel in row] for row in whole.rows]
            expect([[bright(pixel) for pixel in row] for row in mask.rows] == wanted, f"layer {n}: the mask of {name}")


def gray_images_show_brightness(job):
    job.slice("rgba", *SMALL, "--format", "rgba", "--layers", "50")
    job.slice("gray", *SMALL, "--format", "gray", "--layers", "50")
    wanted = [[bright(pixel) for pixel in row] for row in job.images("rgba")[0].rows]
    found = [[bright(pixel) for pixel in row] for row in job.images("gray")[0].rows]
    expect(found == wanted, "other brightness than in colour")
    alike = job.write("alike.json", json.dumps({"materials": [
        {"name": "red", "r": 100, "g": 100, "b": 100}, {"name": "blue", "r": 100, "g": 100, "b": 100}]}))
    reported = job.slice("alike", *SMALL, "--format", "gray", "--layers", "50", "--materials", alike).stderr
    expect("both gray 100" in reported, f"no word about two materials of one gray: {reported}")


def images_of_values_have_channels(job):
    """Of a ball whose dose is 50 below z = 0 and 150 above it: half of its voxels are 102, half of them 255."""
    design = job.write("dosed.vcad", 'attribute("dose", "z < 0 ? 50 : 150", unit="J") sphere(4);')
    by = ["--by", "dose", "--range", "0,125", "--voxel", "0.25", "--json"]
    for bits, shades in (("8", {0, 102, 255}), ("16", None), ("1", {0, 255})):  # png reads no images of 16 bits
        result = job.slice(f"dose{bits}", *by, "--bits", bits, design=design)
        events = {event["event"]: event for event in map(json.loads, result.stdout.splitlines())}
        done, beyond = events["done"], events.get("check")
        about = json.loads((job.path / f"dose{bits}" / "job.json").read_text(encoding="utf-8"))
        expect("materials" not in done and "materials" not in about, f"materials of {bits} bits")
        kind = {"8": "dose8", "16": "dose16", "1": "mask"}[bits]
        expect(about["channels"] == [{"name": "dose", "type": kind, "unit": "J", "range": [0, 125]}], str(about))
        volume = 4 / 3 * math.pi * 64
        counted = done["channels"][0]
        expect(about["totals"]["channels"] == [counted], str(about["totals"]))
        expect(abs(counted["volume_mm3"] / (volume if bits != "1" else volume / 2) - 1) < 0.01, str(counted))
        expect((beyond["voxels"] if beyond else 0) == (0 if bits == "1" else counted["voxels"] / 2), f"{beyond}")  # 150 > 125
        expect(counted.get("mean") == (None if bits == "1" else 87.5), str(counted))  # of 50 and 125, which is white
        job.slice(f"dose{bits}", *by, "--bits", bits, "--resume", design=design)
        if shades:
            seen = {pixel[0] for image in job.images(f"dose{bits}") for row in image.rows for pixel in row}
            expect(seen == shades, f"{bits} bits: {sorted(seen)[:9]}")
    result = job.slice("wrong", *by, "--format", "indexed", design=design, status=1)
    expect("hold materials, but the layers hold doses of 8 bits" in result.stdout, result.stdout)


def masks_resume_and_are_replaced(job):
    job.slice("whole", *SMALL, "--format", "mask")
    job.slice("out", *SMALL, "--format", "mask", "--layers", "0:60")
    layers(job.path / "out")[33].unlink()
    job.slice("out", *SMALL, "--format", "mask", "--resume")
    expect_same(job.path / "whole", job.path / "out")
    job.slice("out", *SMALL, "--force")
    job.slice("fresh", *SMALL)
    expect_same(job.path / "out", job.path / "fresh")


# ---- single layers


def layers_are_those_of_the_job(job):
    """ombre layer writes what slice writes for that layer, by number or by height."""
    for form in ("indexed", "rgba"):
        options = [*SMALL, "--format", form, "--seed", "3", "--printer", "connex"]
        job.slice(form, *options)
        for number, arguments in ((0, ["--index", "0"]), (57, ["--index=57"]), (99, ["--index=-1"]), (57, ["--z", "0.7"]),
                                  (56, ["--z", "0.69999"]), (99, ["--z", "5"]), (0, ["--z=-5"])):
            ombre_layer(job, *options, *arguments, "-o", "one.png", "--force")
            expect((job.path / "one.png").read_bytes() == layers(job.path / form)[number].read_bytes(),
                   f"{form}, {arguments}: other bytes than layer {number}")


def layers_of_masks_have_several_files(job):
    options = ["--printer", "vat-50um", *SMALL]
    job.slice("out", *options, "--layers", "40")
    ombre_layer(job, *options, "--index", "40")
    ombre_layer(job, *options, "--index", "40", "-o", "mine.png")
    for name in ("red", "blue"):
        wanted = (job.path / "out" / f"slice_00040_{name}.png").read_bytes()
        for found in (f"ball_slice_00040_{name}.png", f"mine_{name}.png"):
            expect((job.path / found).read_bytes() == wanted, f"{found}: other bytes")
    result = ombre_layer(job, *options, "--index", "40", "-o", "-", status=1)
    expect("each material has an image" in result.stderr, result.stderr)


def boxes_cut_layers(job):
    ombre_layer(job, *SMALL, "--z", "0.25", "-o", "whole.png")
    whole = png.read(job.path / "whole.png")
    for form, colour_type in (("indexed", png.INDEXED), ("rgba", png.RGBA)):
        # x from -1 to 2.5 mm and y from -3 to 4 mm of a part that begins at -5 mm
        ombre_layer(job, *SMALL, "--z", "0.25", "--box=-1,-3,2.5,4", "-o", form + ".png", "--format", form)
        part = png.read(job.path / (form + ".png"))
        expect(part.colour_type == colour_type, f"colour type {part.colour_type}")
        wanted = [row[40:75] for row in whole.rows[10:80]]
        expect(part.rows == wanted, f"{form}: {part.width} x {part.height} other pixels")


def boxes_cut_jobs(job):
    """slice --box: the pixels, names and checks of the whole job, in whatever way mixtures become voxels."""
    # x from -1 to 2.5 mm, y from -3 to 4 mm and z from 0.95 to 1.2 mm of a part that begins at -5 mm
    box = "--box=-1,-3,0.95,2.5,4,1.2"
    for dither in ("stochastic", "blue-noise", "diffusion"):
        options = [*SMALL, "--dither", dither, "--seed", "2"]
        job.slice("whole " + dither, *options, "--layers", "59:62")
        job.slice(dither, *options, box)
        names = [p.name for p in layers(job.path / dither)]
        expect(names == ["slice_00059.png", "slice_00060.png", "slice_00061.png"], f"{dither}: {names}")
        for name in names:
            whole, part = (png.read(job.path / folder / name) for folder in ("whole " + dither, dither))
            expect(part.rows == [row[40:75] for row in whole.rows[10:80]], f"{dither}: other pixels in {name}")
    about = json.loads((job.path / "stochastic" / "job.json").read_text(encoding="utf-8"))
    sampling = about["sampling"]
    expect(sampling["voxels"] == [35, 70, 3] and sampling["part_of"] == {"first_voxel": [40, 20, 59],
                                                                         "voxels": [100, 100, 100]}, str(sampling))
    expect([round(c, 9) for c in sampling["origin_mm"]] == [-1, -3, 0.9], str(sampling))
    expect(about["status"] == "complete" and about["images"]["first_index"] == 59, str(about))
    before = files(job.path / "stochastic")
    job.slice("stochastic", *SMALL, "--seed", "2", box, "--resume")
    expect(files(job.path / "stochastic") == before, "--resume changed it")
    result = job.slice("stochastic", *SMALL, "--seed", "2", "--box=-1,-3,0.95,2.5,4,1.3", "--resume", status=2)
    expect("another job" in result.stderr, result.stderr)
    for arguments, part in (([box, "--layers", "0:3"], "--layers"), (["--box", "1,2,3"], "x0,y0,z0,x1,y1,z1"),
                            (["--box", "5,5,5,6,6,6"], "from -5,-5,-5 to 5,5,5 mm")):
        result = job.slice("wrong", *SMALL, *arguments, status=1)
        expect(part in result.stderr, f"{arguments}: {result.stderr}")
    design = job.write("failing.vcad", 'fgrade(["x > 1 && z > 1 ? 0 : 1"], [red]) cube(10, red);')
    checked = job.slice("checked", "--voxel", "1", "--box", "0,0,0,4,4,4", "--json", design=design)
    check = next(e for e in map(json.loads, checked.stdout.splitlines()) if e["event"] == "check")
    expect(check["voxels"] == 3 * 4 * 3 and check["first_mm"] == [1.5, 0.5, 1.5], str(check))


def layers_have_names_and_are_not_overwritten(job):
    ombre_layer(job, *SMALL, "--index", "7")
    name = job.path / "ball_slice_00007.png"
    before = name.read_bytes()
    result = ombre_layer(job, "--voxel", "0.5", "--index", "7", status=2)
    expect("--force" in result.stderr and name.read_bytes() == before, f"it wrote, or does not say how: {result.stderr}")
    command = [str(a) for a in (job.ombre, "layer", job.design, *SMALL, "--index", "7", "-o", "-")]
    piped = subprocess.run(command, cwd=job.path, env=program.environment(), capture_output=True, check=True).stdout
    expect(piped == before, "other bytes on stdout")
    reported = json.loads(ombre_layer(job, *SMALL, "--index", "7", "--force", "--json").stdout.splitlines()[-1])
    expect(reported["event"] == "done" and reported["files"] == [name.name] and reported["layer"] == 7, str(reported))
    expect([round(z, 9) for z in reported["z_mm"]] == [-4.3, -4.2], str(reported))


def wrong_layers_are_explained(job):
    for arguments, part in ((["--z", "5.1"], "from -5 to 5 mm"), (["--z", "top"], "--z 3.2"), ([], "--index"),
                            (["--index", "100"], "0 to 99"), (["--index", "1:3"], "0 to 99"),
                            (["--z", "0", "--box", "1,2,3"], "x0,y0,x1,y1"), (["--z", "0", "--box", "2,0,1,1"], "x0,y0,x1,y1"),
                            (["--z", "0", "--box", "5,5,6,6"], "from -5,-5 to 5,5 mm"),
                            (["--z", "0", "--index", "0"], "do not go together")):
        result = ombre_layer(job, *SMALL, *arguments, status=1)
        expect(part in result.stderr, f"{arguments}: {result.stderr}")
    expect(not list(job.path.glob("*.png")), "it wrote all the same")


# ---- what the repository promises


def example_slices(job, example):
    # Such voxels are too coarse for some patterns, which --unchecked takes as it is.
    command = [job.ombre, "slice", example, "-o", job.path / "out", "--voxel", "0.5", "--unchecked", "--json"]
    result = program.run(command, cwd=job.path)
    reported = [e["message"] for e in map(json.loads, result.stdout.splitlines())
                if e["event"] == "message" and e["severity"] != "note"]
    expect(result.returncode == 0, f"status {result.returncode}: {reported} {result.stderr}")
    expect(not reported, f"it warned: {reported}")
    expect((EXAMPLES / "pictures" / (example.stem + ".png")).exists(), "it has no picture in examples/pictures")


def suggestions_of_examples_work(job):
    """What stands behind "Try:" at their heads, as far as it is options."""
    option = r"-D (?:'[^']+'|\w+=\w+(?:\.\d+)?)"
    for example in program.examples(job.ombre):
        head = " ".join(line[2:].strip() for line in example.read_text().splitlines() if line.startswith("//"))
        for group in re.findall(f"{option}(?: {option})*", head.partition("Try:")[2]):
            result = program.run(job.slicing("tried", "--dry-run", "--voxel", "0.5", "--unchecked", *shlex.split(group), design=example))
            good = result.returncode == 0 and "warning: " not in result.stderr
            expect(good, f"{example.name} {group}: {result.stderr}")


def designs_of_openscad_are_explained(job):
    """What its users write first: the message names the node that they mean, and that one works."""
    instead = {
        'color("red") cube(5);': 'material("red") { cube(5); }',
        "cube([30, 20, 10]);": "rectprism([30, 20, 10]);",
        "cube(size=[30, 20, 10]);": "rectprism([30, 20, 10]);",
        "cube(10, center=true);": "translate([5, 5, 5]) cube(10);",
        "cylinder(h=10, r1=5, r2=2);": "cone(r1=5, r2=2, h=10);",
        "rotate(a=45, v=[0, 0, 1]) cube(5);": "rotate(axis=[0, 0, 1], deg=45) cube(5);",
        "linear_extrude(5) square([20, 10]);": "polygon_extrude([[0, 0], [20, 0], [0, 10]], 5);",
        "rotate_extrude() circle(2);": "revolve([[2, 0], [5, 0], [5, 10]]);",
        "square(5);": "rectprism((20, 10, 5));",
        "circle(5);": "cylinder(5, 10);",
        "polygon([[0, 0], [20, 0], [0, 10]]);": "polygon_extrude([[0, 0], [20, 0], [0, 10]], 5);",
        "polyhedron([], []);": "hull([[0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]]);",
        'import("part.stl");': 'mesh("part.stl");',
        'surface("picture.png");': 'relief("picture.png");',
        "multmatrix([]) cube(5);": "matrix([[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { cube(5); }",
        "minkowski() { cube(5); sphere(1); }": "offset(1) { cube(5); }",
        "resize([10, 5, 5]) sphere(5);": "scale([2, 1, 1]) { sphere(5); }",
        "intersection_for(i = [0:2]) cube(5);": "intersection() { for (i = [0:2]) cube(5 + i); }",
    }
    ball = job.write("ball.vcad", "sphere(5);")
    for command, made in (("mesh", "part.stl"), ("render", "picture.png")):
        program.run([job.ombre, command, ball, "-o", job.path / made, "-q"])
    for theirs, ours in instead.items():
        reported = program.run(job.slicing("told", "--dry-run", design=job.write("theirs.vcad", theirs)))
        expect(reported.returncode == 1 and ours.partition("(")[0] in reported.stderr, f"{theirs}: {reported.stderr}")
        made = program.run(job.slicing("made", "--dry-run", "--voxel", "0.5", design=job.write("ours.vcad", ours)))
        expect(made.returncode == 0, f"{ours}: {made.stderr}")


def links_lead_to_what_lies_beside_them(job):
    """Files are looked for beside a link first, then beside what it links to, in one step or more."""
    for folder in ("real", "mid", "near"):
        (job.path / folder).mkdir()
    job.write("real/part.vcad", "include <sizes.vcad>\nuse <bump.vcad>\nrectprism((side, 1, 1), red);\nbump();\n")
    job.write("real/sizes.vcad", "side = 10;\n")
    job.write("real/bump.vcad", "module bump() translate(0, 5, 0) cube(1, red);\n")
    job.write("mid/sizes.vcad", "side = 6;\n")
    job.write("near/sizes.vcad", "side = 3;\n")
    (job.path / "far.vcad").symlink_to("real/part.vcad")
    (job.path / "mid/part.vcad").symlink_to("../real/part.vcad")
    (job.path / "near/part.vcad").symlink_to(job.path / "mid/part.vcad")
    (job.path / "two_steps.vcad").symlink_to("mid/part.vcad")
    for name, side in (("far", 10), ("mid/part", 6), ("near/part", 3), ("two_steps", 6)):
        reported = job.slice("out", "--voxel", "1", "--dry-run", design=job.path / f"{name}.vcad")
        expect(f"box {side} x " in reported.stderr + reported.stdout, f"{name}: {reported.stderr}")
    (job.path / "real/lost.vcad").write_text("include <lost_sizes.vcad>\n")
    (job.path / "lost.vcad").symlink_to("real/lost.vcad")
    reported = job.slice("out", "--dry-run", design="lost.vcad", status=1).stderr
    expect("looked for lost_sizes.vcad and real/lost_sizes.vcad" in reported, reported)


def bundles_slice_as_their_designs_do(job):
    """A mesh in a folder beside the design goes with it, and is found from anywhere; turned, both are turned."""
    options = ["--voxel", "0.5", "--rotate", "90,0,0"]
    made = program.run([job.ombre, "bundle", EXAMPLES / "gear.vcad"], cwd=job.path)
    if "OMBRE_3MF" in made.stderr:
        return "skipped: built without zip archives"
    expect(made.returncode == 0, made.stderr[-1500:])
    job.slice("design", *options, design=EXAMPLES / "gear.vcad")
    job.slice("bundle", *options, design=job.path / "gear.ombre")
    expect_same(job.path / "design", job.path / "bundle")
    written = job.write("turned.vcad", f'rotate((90, 0, 0), order="xyz") mesh("{EXAMPLES}/models/gear.stl", green);')
    plain = job.write("plain.vcad", f'mesh("{EXAMPLES}/models/gear.stl", green);')
    job.slice("written", "--voxel", "0.5", design=written)
    job.slice("turned", *options, design=plain)
    expect_same(job.path / "written", job.path / "turned")
    job.write("broken.ombre", "no archive")
    expect("this is no bundle" in job.slice("broken", design=job.path / "broken.ombre", status=1).stderr, "broken")
    expect(not (job.path / "broken").exists(), "a folder of a broken bundle")
    return ""


def reference_is_up_to_date(job):
    for command in ("nodes", "operators", "codes", "commands", "formats", "printers"):
        printed = program.run([job.ombre, command, "--markdown"]).stdout
        reference = program.SOURCE / "docs" / "reference" / f"{command}.md"
        found = reference.read_text(encoding="utf-8") if reference.exists() else ""
        expect(found == printed, f"docs/reference/{command}.md is not what the program prints; write it anew with\n"
                                 f"{job.ombre} {command} --markdown > docs/reference/{command}.md")


def listings_of_pages_are_up_to_date(job):
    page = (program.SOURCE / "docs/user/materials-and-printers.md").read_text(encoding="utf-8")
    listing = program.run([job.ombre, "printers"]).stdout
    expect(f"$ ombre printers\n{listing}```" in page, "docs/user/materials-and-printers.md lists other printers than the program")


def headings(text):
    """The names of a page's headings as links have them."""
    return {re.sub(r" ", "-", re.sub(r"[^\w\- ]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading)).lower())
            for heading in re.findall(r"^#+ +(.*)$", text, re.MULTILINE)}


def links_of_pages_lead_to_headings(job):
    pages = [*program.SOURCE.resolve().glob("*.md"), *(program.SOURCE.resolve() / "docs").rglob("*.md")]
    texts = {page: re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL) for page in pages}
    for page, text in texts.items():
        for name, heading in re.findall(r"\]\(([^):#\s]*)#([^)\s]+)\)", text):
            target = (page.parent / name).resolve() if name else page
            expect(target not in texts or heading in headings(texts[target]), f"{page} links to {name}#{heading}")


def rows_of_tables_have_the_cells_of_their_heads(job):
    for page in sorted((program.SOURCE / "docs").rglob("*.md")):
        cells = None
        for line in page.read_text(encoding="utf-8").splitlines():
            count = len(re.findall(r"(?<!\\)\|", line)) if line.startswith("|") else None
            expect(cells is None or count is None or count == cells, f"{page}: {line}")
            cells = count


def examples_of_nodes_slice(job):
    listed = program.run([job.ombre, "nodes", "--json"]).stdout
    for node in map(json.loads, listed.splitlines()):
        if node["event"] != "node":
            continue
        design = job.write(node["name"] + ".vcad", node["example"])
        result = program.run(job.slicing(node["name"], "--voxel", "0.5", design=design), cwd=EXAMPLES)
        if program.WITHOUT_CAD in result.stderr:
            continue
        expect(result.returncode == 0, f"{node['name']}: {node['example']}\n{result.stderr}")
        expect(": warning: " not in result.stderr, f"{node['name']}: {result.stderr}")


CHECKS = [threads_do_not_change_bytes, memory_does_not_change_bytes, pieces_make_the_whole,
          a_piece_has_the_names_and_bytes_of_the_whole, seeds_change_the_mixture_only,
          printed_designs_are_the_same_job, roundabout_rotations_keep_the_voxels, images_lie_as_the_design_does,
          images_tell_their_resolution, palettes_of_any_size, materials_have_masks_of_their_own,
          gray_images_show_brightness, images_of_values_have_channels, masks_resume_and_are_replaced, layers_of_masks_have_several_files,
          layers_are_those_of_the_job, boxes_cut_layers, boxes_cut_jobs, layers_have_names_and_are_not_overwritten,
          wrong_layers_are_explained, links_lead_to_what_lies_beside_them, bundles_slice_as_their_designs_do, reference_is_up_to_date,
          rows_of_tables_have_the_cells_of_their_heads, listings_of_pages_are_up_to_date, links_of_pages_lead_to_headings,
          examples_of_nodes_slice, suggestions_of_examples_work, designs_of_openscad_are_explained]

if __name__ == "__main__":
    EXAMPLE_CHECKS = {f"example {example.stem}": functools.partial(example_slices, example=example)
                      for example in sorted(EXAMPLES.glob("*.vcad"))}
    raise SystemExit(program.main(Job, {**program.named(CHECKS), **EXAMPLE_CHECKS}))

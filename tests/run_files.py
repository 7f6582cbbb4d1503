#!/usr/bin/env python3
"""Whole jobs, run as a user would: what lies in the folder, and what becomes of it when things go wrong.

    python3 tests/run_files.py build/dev/apps/ombre/ombre [NAME...]
"""
import argparse
import functools
import json
import os
import pathlib
import random
import re
import shlex
import signal
import subprocess
import tempfile
import time

import png
import program

EXAMPLES = program.SOURCE / "examples"
NOBODY = 65534

# Something to do for some seconds at small voxels: a graded gyroid in a ball.
BALL = """
fgrade(["0.5 + z/10", "0.5 - z/10"], ["red", "blue"]) {
  intersection(materials="first") {
    sphere(5);
    function("sin(4*x)*cos(4*y) + sin(4*y)*cos(4*z) + sin(4*z)*cos(4*x)");
  }
}
"""
SMALL = ["--voxel", "0.1"]
LONG = ["--voxel", "0.012"]


class Job:
    """A folder for one check, with a design in it."""

    def __init__(self, ombre, scratch):
        self.ombre, self.folder = ombre, pathlib.Path(scratch)
        self.design = self.write("ball.vcad", BALL)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def command(self, out, *arguments, design=None):
        return [self.ombre, "slice", design or self.design, "-o", self.folder / out, *arguments]

    def slice(self, out, *arguments, design=None, status=0, **options):
        result = program.run(self.command(out, *arguments, design=design), cwd=self.folder, **options)
        expect(result.returncode == status, f"status {result.returncode}, expected {status}: {result.stderr[-1500:]}")
        return result

    def start(self, out, *arguments):
        command = [str(a) for a in self.command(out, *arguments)]
        return subprocess.Popen(command, cwd=self.folder, env=program.environment(), stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def images(self, out):
        return [png.read(path) for path in layers(self.folder / out)]


def expect(good, message):
    if not good:
        raise AssertionError(message)


def layers(folder):
    return sorted(folder.glob("slice_*.png"))


def files(folder):
    return {p.name: p.read_bytes() for p in sorted(folder.iterdir())}


def expect_same(one, other, names=None):
    """The same files with the same bytes; of these names alone, if they are given."""
    a, b = files(one), files(other)
    if names:
        a, b = ({n: c for n, c in f.items() if names(n)} for f in (a, b))
    expect(a.keys() == b.keys(), f"other files: {sorted(a.keys() ^ b.keys())[:8]}")
    different = [name for name in a if a[name] != b[name]]
    expect(not different, f"other bytes: {different[:8]}")


# ---- the same input gives the same bytes


def threads_do_not_change_bytes(job):
    job.slice("one", *SMALL, "--threads", "1")
    job.slice("two", *SMALL, "--threads", "2")
    expect_same(job.folder / "one", job.folder / "two")


def memory_does_not_change_bytes(job):
    job.slice("plenty", *SMALL)
    job.slice("little", *SMALL, "--memory", "1M")
    expect_same(job.folder / "plenty", job.folder / "little")


def pieces_make_the_whole(job):
    job.slice("whole", *SMALL)
    job.slice("pieces", *SMALL, "--layers", "41:90")
    job.slice("pieces", *SMALL, "--layers", ":17", "--resume")
    job.slice("pieces", *SMALL, "--layers=-10:", "--resume")
    job.slice("pieces", *SMALL, "--resume")
    expect_same(job.folder / "whole", job.folder / "pieces")


def a_piece_has_the_names_and_bytes_of_the_whole(job):
    job.slice("whole", *SMALL)
    job.slice("piece", *SMALL, "--layers", "30:33")
    names = [p.name for p in layers(job.folder / "piece")]
    expect(names == ["slice_00030.png", "slice_00031.png", "slice_00032.png"], str(names))
    expect_same(job.folder / "whole", job.folder / "piece", lambda name: name in names)


def seeds_change_the_mixture_only(job):
    job.slice("a", *SMALL, "--seed", "1")
    job.slice("b", *SMALL, "--seed", "2")
    expect(files(job.folder / "a") != files(job.folder / "b"), "the same files for two seeds")
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
        hashes = [json.loads((job.folder / out / "job.json").read_text())["design_hash"] for out in (name, name + "_json")]
        expect(hashes[0] == hashes[1], f"{name}: design hashes {hashes}")
        expect_same(job.folder / name, job.folder / (name + "_json"), lambda file: file.startswith("slice_"))
    expect_same(job.folder / "parts", job.folder / "parts_json")


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
    names = sorted(p.name for p in layers(job.folder / "vat"))
    expect(names == [f"slice_{n:05}_{m}.png" for n in range(40, 44) for m in ("blue", "red")], str(names))
    for n, whole in zip(range(40, 44), job.images("rgba")):
        for name, colour in (("red", (255, 0, 0, 255)), ("blue", (0, 80, 255, 255))):
            mask = png.read(job.folder / "vat" / f"slice_{n:05}_{name}.png")
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
    told = job.slice("alike", *SMALL, "--format", "gray", "--layers", "50", "--materials", alike).stderr
    expect("both gray 100" in told, f"no word about two materials of one gray: {told}")


def masks_resume_and_are_replaced(job):
    job.slice("whole", *SMALL, "--format", "mask")
    job.slice("out", *SMALL, "--format", "mask", "--layers", "0:60")
    layers(job.folder / "out")[33].unlink()
    job.slice("out", *SMALL, "--format", "mask", "--resume")
    expect_same(job.folder / "whole", job.folder / "out")
    job.slice("out", *SMALL, "--force")
    job.slice("fresh", *SMALL)
    expect_same(job.folder / "out", job.folder / "fresh")


# ---- single layers


def ombre_layer(job, *arguments, status=0):
    result = program.run([job.ombre, "layer", job.design, *arguments], cwd=job.folder)
    expect(result.returncode == status, f"status {result.returncode}, expected {status}: {result.stderr[-1500:]}")
    return result


def layers_are_those_of_the_job(job):
    """ombre layer writes what slice writes for that layer, by number or by height."""
    for form in ("indexed", "rgba"):
        options = [*SMALL, "--format", form, "--seed", "3", "--printer", "connex"]
        job.slice(form, *options)
        for number, arguments in ((0, ["--index", "0"]), (57, ["--index=57"]), (99, ["--index=-1"]), (57, ["--z", "0.7"]),
                                  (56, ["--z", "0.69999"]), (99, ["--z", "5"]), (0, ["--z=-5"])):
            ombre_layer(job, *options, *arguments, "-o", "one.png", "--force")
            expect((job.folder / "one.png").read_bytes() == layers(job.folder / form)[number].read_bytes(),
                   f"{form}, {arguments}: other bytes than layer {number}")


def layers_of_masks_have_several_files(job):
    options = ["--printer", "vat-50um", *SMALL]
    job.slice("out", *options, "--layers", "40")
    ombre_layer(job, *options, "--index", "40")
    ombre_layer(job, *options, "--index", "40", "-o", "mine.png")
    for name in ("red", "blue"):
        wanted = (job.folder / "out" / f"slice_00040_{name}.png").read_bytes()
        for found in (f"ball_slice_00040_{name}.png", f"mine_{name}.png"):
            expect((job.folder / found).read_bytes() == wanted, f"{found}: other bytes")
    result = ombre_layer(job, *options, "--index", "40", "-o", "-", status=1)
    expect("each material has an image" in result.stderr, result.stderr)


def boxes_cut_layers(job):
    ombre_layer(job, *SMALL, "--z", "0.25", "-o", "whole.png")
    whole = png.read(job.folder / "whole.png")
    for form, colour_type in (("indexed", png.INDEXED), ("rgba", png.RGBA)):
        # x from -1 to 2.5 mm and y from -3 to 4 mm of a part that begins at -5 mm
        ombre_layer(job, *SMALL, "--z", "0.25", "--box=-1,-3,2.5,4", "-o", form + ".png", "--format", form)
        part = png.read(job.folder / (form + ".png"))
        expect(part.colour_type == colour_type, f"colour type {part.colour_type}")
        wanted = [row[40:75] for row in whole.rows[10:80]]
        expect(part.rows == wanted, f"{form}: {part.width} x {part.height} other pixels")


def layers_have_names_and_are_not_overwritten(job):
    ombre_layer(job, *SMALL, "--index", "7")
    name = job.folder / "ball_slice_00007.png"
    before = name.read_bytes()
    result = ombre_layer(job, "--voxel", "0.5", "--index", "7", status=2)
    expect("--force" in result.stderr and name.read_bytes() == before, f"it wrote, or does not say how: {result.stderr}")
    command = [str(a) for a in (job.ombre, "layer", job.design, *SMALL, "--index", "7", "-o", "-")]
    piped = subprocess.run(command, cwd=job.folder, env=program.environment(), capture_output=True, check=True).stdout
    expect(piped == before, "other bytes on stdout")
    told = json.loads(ombre_layer(job, *SMALL, "--index", "7", "--force", "--json").stdout.splitlines()[-1])
    expect(told["event"] == "done" and told["files"] == [name.name] and told["layer"] == 7, str(told))
    expect([round(z, 9) for z in told["z_mm"]] == [-4.3, -4.2], str(told))


def wrong_layers_are_explained(job):
    for arguments, part in ((["--z", "5.1"], "from -5 to 5 mm"), (["--z", "top"], "--z 3.2"), ([], "--index"),
                            (["--index", "100"], "0 to 99"), (["--index", "1:3"], "0 to 99"),
                            (["--z", "0", "--box", "1,2,3"], "x0,y0,x1,y1"), (["--z", "0", "--box", "2,0,1,1"], "x0,y0,x1,y1"),
                            (["--z", "0", "--box", "5,5,6,6"], "from -5,-5 to 5,5 mm"),
                            (["--z", "0", "--index", "0"], "do not go together")):
        result = ombre_layer(job, *SMALL, *arguments, status=1)
        expect(part in result.stderr, f"{arguments}: {result.stderr}")
    expect(not list(job.folder.glob("*.png")), "it wrote all the same")


# ---- interruptions


def whole_long_job(job):
    began = time.monotonic()
    job.slice("whole", *LONG)
    return time.monotonic() - began


def resume_and_compare(job, out, parts_may_lie=True):
    parts = [p.name for p in (job.folder / out).glob("*.part")]
    expect(parts_may_lie or not parts, f"unfinished files: {parts}")
    kept = job.slice(out, *LONG, "--resume", "--json")
    done = [json.loads(line) for line in kept.stdout.splitlines()][-1]
    expect_same(job.folder / "whole", job.folder / out)
    return done["layers_kept"]


def killed_jobs_resume(job):
    """kill -9 at any moment, then --resume: the bytes of a job that was left alone."""
    seconds, kept = whole_long_job(job), []
    chance = random.Random(time.time_ns())
    for attempt in range(4):
        out = f"killed{attempt}"
        process = job.start(out, *LONG)
        time.sleep(chance.uniform(0.02, 0.95) * seconds)
        process.send_signal(signal.SIGKILL)
        process.wait()
        kept.append(resume_and_compare(job, out))
    expect(any(kept), f"no layer of {kept} was kept in any attempt")


def killed_twice_resumes(job):
    seconds = whole_long_job(job)
    for arguments in ([], ["--resume"]):
        process = job.start("killed", *LONG, *arguments)
        time.sleep(0.35 * seconds)
        process.send_signal(signal.SIGKILL)
        process.wait()
    resume_and_compare(job, "killed")


def wait_until_under_way(job, process, out):
    while not (job.folder / out / "journal.jsonl").exists() and process.poll() is None:
        time.sleep(0.01)


def interrupted_jobs_resume(job):
    job.slice("whole", *LONG)
    process = job.start("interrupted", *LONG)
    wait_until_under_way(job, process, "interrupted")
    process.send_signal(signal.SIGINT)
    status = process.wait(timeout=20)
    expect(status == 130, f"status {status} after an interrupt, expected 130")
    resume_and_compare(job, "interrupted", parts_may_lie=False)


def large_layers_stop_and_resume(job):
    """A whole tray in one piece. Stopped within its first layers; those that are made later are the same."""
    job.design = job.write("tray.vcad", """fgrade(["0.5 + x/480", "0.5 - x/480"], ["red", "blue"]) {
                           ellipsoid((240, 190, 97), "red"); }""")
    tray = ["--printer", "j750", "--format", "indexed"]
    process = job.start("out", *tray)
    wait_until_under_way(job, process, "out")
    process.send_signal(signal.SIGINT)
    status = process.wait(timeout=60)
    expect(status == 130, f"status {status} after an interrupt, expected 130")
    names = sorted(p.name for p in (job.folder / "out").iterdir())
    expect(not [name for name in names if name.endswith(".part")], f"unfinished files: {names}")
    job.slice("out", *tray, "--layers", "30:32", "--memory", "200M", "--resume")
    ombre_layer(job, *tray, "--index", "31", "-o", "one.png")
    expect((job.folder / "out" / "slice_00031.png").read_bytes() == (job.folder / "one.png").read_bytes(), "other bytes")


def resume_refuses_another_job(job):
    job.slice("out", *SMALL, "--layers", "0:5")
    result = job.slice("out", *SMALL, "--resume", "--seed", "7", status=2)
    expect("seed" in result.stderr, f"it does not say what differs: {result.stderr}")


def damaged_layers_are_made_again(job):
    job.slice("whole", *SMALL)
    job.slice("out", *SMALL)
    first, second, *_ = layers(job.folder / "out")
    first.write_bytes(first.read_bytes()[:-7])
    second.unlink()
    job.slice("out", *SMALL, "--resume")
    expect_same(job.folder / "whole", job.folder / "out")


# ---- supports, which are found before the first layer

# Very many overhangs, each of which asks for the surface's slope.
HOLES = """module block() {
  difference() {
    rectprism((60, 60, 60), white);
    for (i = [0:7]) for (j = [0:7]) translate(i*7 - 25, j*7 - 25, 0) sphere(3);
  }
}
block();
support(angle=45) block();
"""


def watch(process, seconds):
    """The greatest number of threads that the process has within this time."""
    most, end = 0, time.monotonic() + seconds
    while time.monotonic() < end and process.poll() is None:
        most = max(most, len(os.listdir(f"/proc/{process.pid}/task")))
        time.sleep(0.01)
    return most


def supports_take_the_threads_given_and_stop_at_once(job):
    job.design = job.write("holes.vcad", HOLES)
    process = job.start("out", "--voxel", "0.03", "--threads", "1")
    most = watch(process, 2)
    expect(process.poll() is None, "it has ended too early to tell")
    expect(most == 1, f"{most} threads with --threads 1")
    begin = time.monotonic()
    process.send_signal(signal.SIGINT)
    status = process.wait(timeout=20)
    seconds = time.monotonic() - begin
    expect(status == 130, f"status {status} after an interrupt, expected 130")
    expect(seconds < 1.5, f"it took {seconds:.2f} s to stop; 0.3 s on an idle machine")
    expect(not layers(job.folder / "out"), "layers were written before the supports were known")


def supports_are_the_same_in_pieces(job):
    job.design = job.write("holes.vcad", HOLES)
    coarse = ["--voxel", "0.5"]
    job.slice("whole", *coarse, "--threads", "1")
    job.slice("pieces", *coarse, "--layers", "41:90")
    job.slice("pieces", *coarse, "--layers", ":17", "--resume", "--memory", "2M")
    job.slice("pieces", *coarse, "--resume")
    expect_same(job.folder / "whole", job.folder / "pieces")


def supports_are_told_of(job):
    design = job.write("holes.vcad", HOLES)
    result = job.slice("out", "--voxel", "0.02", "--memory", "5M", design=design, status=2)
    expect("supports: computing them takes about" in result.stderr and "--memory" in result.stderr, result.stderr)
    expect(not (job.folder / "out").exists(), "a folder was made")
    begin = time.monotonic()
    result = job.slice("out", "--voxel", "0.03", "--dry-run", "--json", design=design)
    expect(time.monotonic() - begin < 15, "a dry run goes through all of the supports")
    estimate = [json.loads(line) for line in result.stdout.splitlines()][-1]
    expect(estimate["event"] == "estimate" and estimate["seconds"] > 5, str(estimate))


# ---- folders


def foreign_files_are_left_alone(job):
    out = job.folder / "out"
    out.mkdir()
    (out / "notes.txt").write_text("mine")
    result = job.slice("out", *SMALL, status=2)
    expect("notes.txt" in result.stderr or str(out) in result.stderr, f"it does not say where: {result.stderr}")
    expect([p.name for p in out.iterdir()] == ["notes.txt"], "it wrote all the same")
    job.slice("out", *SMALL, "--force")
    job.slice("out", *SMALL, "--force")
    expect((out / "notes.txt").read_text() == "mine", "it changed a file of others")
    expect(len(layers(out)) == 100, f"{len(layers(out))} layers")


def finished_jobs_are_not_overwritten(job):
    job.slice("out", *SMALL)
    before = files(job.folder / "out")
    job.slice("out", *SMALL, status=2)
    expect(files(job.folder / "out") == before, "it changed the job")


def force_removes_the_old_layers(job):
    job.slice("out", "--voxel", "0.1")
    job.slice("out", "--voxel", "0.5", "--force")
    job.slice("fresh", "--voxel", "0.5")
    expect_same(job.folder / "out", job.folder / "fresh")


def output_that_is_a_file(job):
    job.write("out", "not a folder")
    result = job.slice("out", *SMALL, status=2)
    expect(str(job.folder / "out") in result.stderr, f"it does not name the path: {result.stderr}")
    expect((job.folder / "out").read_text() == "not a folder", "it changed the file")


def become_nobody():
    os.setgroups([])
    os.setgid(NOBODY)
    os.setuid(NOBODY)


def folder_that_may_not_be_written(job):
    closed = job.folder / "closed"
    closed.mkdir()
    closed.chmod(0o555)
    job.folder.chmod(0o755)
    options = {"preexec_fn": become_nobody} if os.getuid() == 0 else {}
    try:
        able = program.run([job.ombre, "--version"], **options).returncode == 0
    except (PermissionError, subprocess.SubprocessError):
        able = False
    if not able:
        return "skipped: no user without rights to run as"
    result = job.slice("closed/out", *SMALL, status=2, **options)
    expect(str(closed / "out") in result.stderr, f"it does not name the path: {result.stderr}")
    expect("ermission" in result.stderr, f"it does not say why: {result.stderr}")
    return ""


def full_disk(job):
    """Status 2 and a message with the path; nothing half-written; --resume once there is space."""
    disk = job.folder / "disk"
    disk.mkdir()
    mounted = program.run(["mount", "-t", "tmpfs", "-o", "size=1m", "none", disk])
    if mounted.returncode != 0:
        return "skipped: mounting a small file system needs root's rights: " + mounted.stderr.strip()
    try:
        job.slice("whole", *SMALL)
        (disk / "filler").write_bytes(bytes((1 << 20) - 64 * 1024))
        told = job.slice("disk/out", *SMALL, "--dry-run").stderr
        expect("KiB left" in told and not (disk / "out").exists(), f"no word about the disk: {told}")
        result = job.slice("disk/out", *SMALL, status=2)
        expect(str(disk / "out") in result.stderr, f"it does not name the path: {result.stderr}")
        for path in layers(disk / "out"):
            expect(path.read_bytes() == (job.folder / "whole" / path.name).read_bytes(), f"{path.name} is not whole")
        (disk / "filler").unlink()
        job.slice("disk/out", *SMALL, "--resume")
        expect_same(job.folder / "whole", disk / "out")
    finally:
        program.run(["umount", disk])
    return ""


# ---- what the repository promises


def example_slices(job, example):
    command = [job.ombre, "slice", example, "-o", job.folder / "out", "--voxel", "0.5", "--json"]
    result = program.run(command, cwd=job.folder)
    told = [e["message"] for e in map(json.loads, result.stdout.splitlines()) if e["event"] == "message"]
    expect(result.returncode == 0, f"status {result.returncode}: {told} {result.stderr}")
    expect(not told, f"it warned: {told}")
    expect((EXAMPLES / "pictures" / (example.stem + ".png")).exists(), "it has no picture in examples/pictures")


def suggestions_of_examples_work(job):
    """What stands behind "Try:" at their heads, as far as it is options."""
    option = r"-D (?:'[^']+'|\w+=\w+(?:\.\d+)?)"
    for example in program.examples(job.ombre):
        head = " ".join(line[2:].strip() for line in example.read_text().splitlines() if line.startswith("//"))
        for group in re.findall(f"{option}(?: {option})*", head.partition("Try:")[2]):
            result = program.run(job.command("tried", "--dry-run", "--voxel", "0.5", *shlex.split(group), design=example))
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
        program.run([job.ombre, command, ball, "-o", job.folder / made, "-q"])
    for theirs, ours in instead.items():
        told = program.run(job.command("told", "--dry-run", design=job.write("theirs.vcad", theirs)))
        expect(told.returncode == 1 and ours.partition("(")[0] in told.stderr, f"{theirs}: {told.stderr}")
        made = program.run(job.command("made", "--dry-run", "--voxel", "0.5", design=job.write("ours.vcad", ours)))
        expect(made.returncode == 0, f"{ours}: {made.stderr}")


def links_lead_to_what_lies_beside_them(job):
    """Files are looked for beside a link first, then beside what it links to, in one step or more."""
    for folder in ("real", "mid", "near"):
        (job.folder / folder).mkdir()
    job.write("real/part.vcad", "include <sizes.vcad>\nuse <bump.vcad>\nrectprism((side, 1, 1), red);\nbump();\n")
    job.write("real/sizes.vcad", "side = 10;\n")
    job.write("real/bump.vcad", "module bump() translate(0, 5, 0) cube(1, red);\n")
    job.write("mid/sizes.vcad", "side = 6;\n")
    job.write("near/sizes.vcad", "side = 3;\n")
    (job.folder / "far.vcad").symlink_to("real/part.vcad")
    (job.folder / "mid/part.vcad").symlink_to("../real/part.vcad")
    (job.folder / "near/part.vcad").symlink_to(job.folder / "mid/part.vcad")
    (job.folder / "two_steps.vcad").symlink_to("mid/part.vcad")
    for name, side in (("far", 10), ("mid/part", 6), ("near/part", 3), ("two_steps", 6)):
        told = job.slice("out", "--voxel", "1", "--dry-run", design=job.folder / f"{name}.vcad")
        expect(f"box {side} x " in told.stderr + told.stdout, f"{name}: {told.stderr}")
    (job.folder / "real/lost.vcad").write_text("include <lost_sizes.vcad>\n")
    (job.folder / "lost.vcad").symlink_to("real/lost.vcad")
    told = job.slice("out", "--dry-run", design="lost.vcad", status=1).stderr
    expect("looked for lost_sizes.vcad and real/lost_sizes.vcad" in told, told)


def reference_is_up_to_date(job):
    printed = program.run([job.ombre, "nodes", "--markdown"]).stdout
    reference = program.SOURCE / "docs" / "nodes.md"
    found = reference.read_text(encoding="utf-8") if reference.exists() else ""
    expect(found == printed, "docs/nodes.md is not what the program prints; write it anew with\n"
                             f"{job.ombre} nodes --markdown > docs/nodes.md")


def examples_of_nodes_slice(job):
    listed = program.run([job.ombre, "nodes", "--json"]).stdout
    for node in map(json.loads, listed.splitlines()):
        design = job.write(node["name"] + ".vcad", node["example"])
        result = program.run(job.command(node["name"], "--voxel", "0.5", design=design), cwd=EXAMPLES)
        if program.WITHOUT_CAD in result.stderr:
            continue
        expect(result.returncode == 0, f"{node['name']}: {node['example']}\n{result.stderr}")
        expect(": warning: " not in result.stderr, f"{node['name']}: {result.stderr}")


QUICK = [threads_do_not_change_bytes, memory_does_not_change_bytes, pieces_make_the_whole,
         a_piece_has_the_names_and_bytes_of_the_whole, seeds_change_the_mixture_only, printed_designs_are_the_same_job,
         roundabout_rotations_keep_the_voxels, images_lie_as_the_design_does, images_tell_their_resolution,
         palettes_of_any_size, materials_have_masks_of_their_own, gray_images_show_brightness,
         masks_resume_and_are_replaced, layers_of_masks_have_several_files, layers_are_those_of_the_job, boxes_cut_layers, layers_have_names_and_are_not_overwritten,
         wrong_layers_are_explained, resume_refuses_another_job, damaged_layers_are_made_again, foreign_files_are_left_alone,
         finished_jobs_are_not_overwritten, force_removes_the_old_layers, output_that_is_a_file,
         folder_that_may_not_be_written, full_disk, links_lead_to_what_lies_beside_them, reference_is_up_to_date, examples_of_nodes_slice,
         suggestions_of_examples_work, designs_of_openscad_are_explained]
SLOW = [supports_take_the_threads_given_and_stop_at_once, supports_are_the_same_in_pieces, supports_are_told_of,
        killed_jobs_resume, killed_twice_resumes, interrupted_jobs_resume, large_layers_stop_and_resume]


def in_scratch(function, ombre):
    with tempfile.TemporaryDirectory() as scratch:
        return function(Job(ombre, scratch))


def main():
    parser = argparse.ArgumentParser(description="Checks whole slice jobs.")
    parser.add_argument("ombre", type=pathlib.Path, help="the program")
    parser.add_argument("names", nargs="*", help="only these")
    a = parser.parse_args()
    functions = {f.__name__: f for f in SLOW + QUICK}
    for example in sorted(EXAMPLES.glob("*.vcad")):
        functions[f"example {example.stem}"] = functools.partial(example_slices, example=example)
    if a.names:
        functions = {name: f for name, f in functions.items() if name in a.names or name.removeprefix("example ") in a.names}
    ombre = a.ombre.resolve()
    return program.check_all([(name, lambda f=f: in_scratch(f, ombre)) for name, f in functions.items()])


if __name__ == "__main__":
    raise SystemExit(main())

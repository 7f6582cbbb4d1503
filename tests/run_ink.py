#!/usr/bin/env python3
"""Colours become shares of inks by ICC profiles, which are compared with Little CMS as Pillow calls it.

    python3 tests/run_ink.py build/dev/apps/ombre/ombre [NAME...]
"""
import hashlib
import itertools
import json
import struct
import threading
import zlib

import program
from program import expect, near

# The colours of made-up inks and of the white around them: X, Y and Z relative to D50. The light of droplets adds up.
LIGHTS = {"cyan": (0.20, 0.28, 0.75), "magenta": (0.35, 0.20, 0.30), "yellow": (0.72, 0.78, 0.10),
          "black": (0.02, 0.02, 0.02), "white": (0.90, 0.90, 0.88)}
RAMP = 'attribute("color_rgb", ["0.2 + 0.06*(x + 5)", "0.3 + 0.05*(y + 5)", "0.25 + 0.05*(z + 5)"]) cube(10);\n'
POINTS = [(-4, -4, -4), (0, 0, 0), (4, -3, 2), (-2, 4, 3), (3, 3, 3), (1, -2, -4)]


def lab_of_light(light):
    x, y, z = (t ** (1 / 3) if t > (6 / 29) ** 3 else t / (3 * (6 / 29) ** 2) + 4 / 29 for t in light)
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def patches(steps=2):
    lines = [",".join([*LIGHTS, "L", "a", "b"])]
    for counts in itertools.product(range(steps + 1), repeat=len(LIGHTS) - 1):
        if sum(counts) <= steps:
            shares = [count / steps for count in (*counts, steps - sum(counts))]
            light = [sum(s * own[part] for s, own in zip(shares, LIGHTS.values())) for part in range(3)]
            lines.append(",".join(f"{value:.6f}" for value in (*shares, *lab_of_light(light))))
    return "\n".join(lines) + "\n"


class Folder(program.Folder):
    """A folder with a calibration of made-up inks, and its profile."""
    FILES = {"patches.csv": patches(), "ramp.vcad": RAMP}
    made: tuple = ()  # the calibration and its profile, which are the same for all checks
    lock = threading.Lock()

    def calibrated(self, **members):
        """Makes the calibration; its members may be changed."""
        with Folder.lock:
            if not Folder.made:
                self.run("calibrations", "--measured", "patches.csv", "-o", "inks.json")
                Folder.made = (self.read("inks.json"), (self.path / "inks.icc").read_bytes())
        self.write("inks.json", Folder.made[0])
        (self.path / "inks.icc").write_bytes(Folder.made[1])
        if members:
            self.write("inks.json", json.loads(self.read("inks.json")) | members)
        return ["--calibration", "inks.json"]

    def compositions(self, design, points):
        at = [f"--at={','.join(map(str, point))}" for point in points]
        return [event["composition"] for event in self.events("probe", design, *at) if event["event"] == "point"]

    def colours(self, design, *at):
        return [[event["attributes"][f"color_rgb.{axis}"] for axis in "xyz"]
                for event in self.events("probe", design, *at) if event["event"] == "point"]

    def resolved(self, design, *arguments, **options):
        return next(e for e in self.events("resolve", design, *arguments, **options) if e["event"] == "resolved")


def srgb_at(x, y, z):
    return 0.2 + 0.06 * (x + 5), 0.3 + 0.05 * (y + 5), 0.25 + 0.05 * (z + 5)


def shares_are_those_of_little_cms(folder):
    try:
        from PIL import Image, ImageCms
    except ImportError:
        return "skipped: Pillow has no Little CMS"
    for intent, number, compensation in [("relative", 1, True), ("relative", 1, False), ("absolute", 3, False)]:
        chosen = folder.calibrated(intent=intent, black_point=compensation)
        folder.run("resolve", "ramp.vcad", *chosen, "--voxel", "1", "-o", "resolved.json", "--force")
        flags = 0x2000 if compensation else 0  # cmsFLAGS_BLACKPOINTCOMPENSATION
        transform = ImageCms.buildTransform(ImageCms.createProfile("sRGB"), str(folder.path / "inks.icc"), "RGB", "CMYK",
                                            renderingIntent=number, flags=flags)
        for point, found in zip(POINTS, folder.compositions("resolved.json", POINTS)):
            pixel = Image.new("RGB", (1, 1), tuple(round(255 * part) for part in srgb_at(*point)))
            wanted = [byte / 255 for byte in ImageCms.applyTransform(pixel, transform).getpixel((0, 0))]
            total = max(1, sum(wanted))
            for ink, share in zip(LIGHTS, wanted):
                # Bytes round the colour by 1/510, and the program interpolates between 33 colours along each axis.
                near(found.get(ink, 0), share / total, 0.02, f"{intent}: the share of {ink} at {point}")
            near(sum(found.values()), 1, 1e-9, "the sum of the shares")
    return ""


def droplets_have_the_shares(folder):
    """The light of all droplets of a layer is that of its colour, with any number of threads."""
    folder.write("flat.vcad", 'attribute("color_rgb", [0.6, 0.5, 0.4]) cube(10);')
    chosen = folder.calibrated(black_point=False)
    found = {}
    for threads in (1, 4):
        folder.run("slice", "flat.vcad", *chosen, "--voxel", "0.2", "-o", f"out{threads}", "--threads", threads)
        layers = sorted((folder.path / f"out{threads}").rglob("*.png"))
        found[threads] = hashlib.sha256(b"".join(layer.read_bytes() for layer in layers)).hexdigest()
    expect(found[1] == found[4], "the bytes depend on the threads")
    job = json.loads(folder.read("out1/job.json"))
    step, = job["resolved"]
    expect(step["from"] == ["color_rgb"] and step["to"] == "fractions", f"{step}")
    expect(step["inks"] == {"profile": "inks.icc", "intent": "relative", "black_point": False,
                            "channels": ["cyan", "magenta", "yellow", "black"]}, f"{step}")
    counts = {m["name"]: m["voxels"] for m in job["totals"]["materials"] if m["name"] in LIGHTS}
    light = [sum(counts[name] * LIGHTS[name][part] for name in counts) / sum(counts.values()) for part in range(3)]
    shown = lab_of_light([own / white for own, white in zip(light, LIGHTS["white"])])
    for got, wanted, name in zip(shown, (55.316, 7.272, 17.753), ("L", "a", "b")):  # of sRGB (153, 128, 102)
        near(got, wanted, 1, f"{name} of the droplets")


def layers_and_checks_take_the_profile(folder):
    chosen = folder.calibrated()
    folder.run("layer", "ramp.vcad", *chosen, "--z", "0", "-o", "layer.png")
    folder.run("check", "ramp.vcad", *chosen, "--voxel", "0.5")


def alpha_becomes_clear(folder):
    folder.write("glass.vcad", 'attribute("color_rgba", ["0.6", "0.5", "0.4", "0.5 + x/20"]) cube(10);')
    folder.run("resolve", "glass.vcad", *folder.calibrated(clear="clear"), "--voxel", "1", "-o", "resolved.json")
    for x, found in zip((-4, 0, 4), folder.compositions("resolved.json", [(x, 0, 0) for x in (-4, 0, 4)])):
        near(found["clear"], 0.5 - x / 20, 1e-9, f"the share of clear at x = {x}")
        near(sum(found.values()), 1, 1e-9, "the sum of the shares")
    inks = json.loads(folder.read("inks.json"))
    del inks["clear"]
    folder.write("inks.json", inks)
    said = folder.run("resolve", "glass.vcad", "--calibration", "inks.json", "--voxel", "1").stderr
    expect("the alpha of color_rgba is not used" in said, said)


def reports_say_what_is_out_of_gamut(folder):
    """Half of the part is red of a screen, which no ink shows; the other half is the white of the medium."""
    folder.write("half.vcad", 'attribute("color_rgb", ["1", "x > 0 ? 0 : 1", "x > 0 ? 0 : 1"]) cube(10);')
    chosen = folder.calibrated(black_point=False)
    part, = folder.resolved("half.vcad", *chosen, "--voxel", "0.5", "--report", "page.html")["printers"]
    colour, = part["colours"]
    near(colour["share_out_of_gamut"], 0.5, 1e-9, "the share out of gamut")
    expect(colour["worst_at_mm"][0] > 0 and colour["worst_difference"] > 20, f"{colour}")
    near(colour["mean_difference"], colour["worst_difference"] / 2, 0.5, "the mean difference")
    near(colour["worst_lab"][0], 54.29, 0.02, "L of red")
    page = folder.read("page.html")
    expect("out of gamut at z" in page and "data:image/png" in page, "the page has no picture")
    text = folder.run("resolve", "half.vcad", *chosen, "--voxel", "0.5").stdout
    for words in ("CIEDE2000 from what is asked for: mean", "50 % of the volume is out of gamut", "color_rgb to fractions"):
        expect(words in text, text)
    part, = folder.resolved("ramp.vcad", *chosen, "--voxel", "0.5")["printers"]
    expect(part["colours"][0]["mean_difference"] < 6, f"{part['colours']}")


def mixtures_of_ones_own_are_judged(folder):
    folder.write("mixed.vcad", 'attribute("color_rgb", [0.6, 0.5, 0.4]) cube(10, "white");'
                 .replace('"white"', 'colour_mixture([0.6, 0.5, 0.4], ["red", "green", "white"])'))
    folder.write("white.vcad", 'attribute("color_rgb", [1, 1, 1]) material(["white"]) cube(10);')
    chosen = folder.calibrated()
    part, = folder.resolved("white.vcad", *chosen, "--voxel", "1")["printers"]
    expect(part["steps"] == [], f"{part}")
    near(part["colours"][0]["worst_difference"], 0, 0.1, "white as white")
    text = folder.run("resolve", "mixed.vcad", *chosen, "--voxel", "1").stdout
    expect("no point of the part has a mixture of these inks alone" in text, text)


def measured_patches_make_a_calibration(folder):
    made = next(e for e in folder.events("calibrations", "--measured", "patches.csv", "-o", "inks.json")
                if e["event"] == "measured")
    expect(made["patches"] == 15 and made["n"] == 1, f"{made}")
    near(made["worst_error"], 0, 0.01, "the error of patches whose light adds up")
    shown = folder.run("calibrations", "./inks.json").stdout
    for words in ("ink cyan", "the rest is   white", "intent        relative, with black point compensation"):
        expect(words in shown, shown)
    first = (folder.path / "inks.icc").read_bytes()
    folder.run("calibrations", "--measured", "patches.csv", "-o", "inks.json", "--force")
    expect(first == (folder.path / "inks.icc").read_bytes(), "the profile has other bytes the second time")


def colours_of_surfaces_are_values(folder):
    """A square whose corners are red, green, blue and white; and one with a texture of 2 x 2 pixels."""
    corners = [(-5, -5, "255 0 0"), (5, -5, "0 255 0"), (5, 5, "0 0 255"), (-5, 5, "255 255 255")]
    header = ["ply", "format ascii 1.0", "element vertex 4", *(f"property float {axis}" for axis in "xyz"),
              *(f"property uchar {part}" for part in ("red", "green", "blue")), "element face 1",
              "property list uchar int vertex_indices", "end_header"]
    folder.write("square.ply", "\n".join([*header, *(f"{x} {y} 0 {c}" for x, y, c in corners), "4 0 1 2 3"]) + "\n")
    folder.write("square.obj", "".join(f"v {x} {y} 0 {' '.join(str(int(p) / 255) for p in c.split())}\n"
                                       for x, y, c in corners) + "f 1 2 3 4\n")
    folder.write("square.off", "COFF\n4 1 0\n" + "".join(f"{x} {y} 0 {c} 255\n" for x, y, c in corners) + "4 0 1 2 3\n")
    points = ["--at=-5,-5,0", "--at=5,5,3", "--at=0,-5,0", "--at=0,0,-4"]
    for name in ("square.ply", "square.obj", "square.off"):
        folder.write("design.vcad", f'attribute("color_rgb", surface_colour("{name}").colour) cube(20);')
        found = folder.colours("design.vcad", *points)
        middle = found.pop()  # on either diagonal
        for got, wanted in zip(found, [(1, 0, 0), (0, 0, 1), (0.5, 0.5, 0)]):
            for a, b in zip(got, wanted):
                near(a, b, 1e-6, f"a colour of {name}")
        expect(middle in ([0.5, 0, 0.5], [0.5, 1, 0.5]), f"{middle}")
    # The left half of the texture is red and blue from the top, the right half green and white; v runs upwards.
    rows = [b"\0" + bytes((255, 0, 0, 0, 255, 0)), b"\0" + bytes((0, 0, 255, 255, 255, 255))]

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    (folder.path / "pixels.png").write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0)) +
        chunk(b"IDAT", zlib.compress(b"".join(rows))) + chunk(b"IEND", b""))
    folder.write("textured.obj", "".join(f"v {x} {y} 0\nvt {(x + 5) / 10} {(y + 5) / 10}\n" for x, y, _ in corners) +
                 "f 1/1 2/2 3/3 4/4\n")
    folder.write("design.vcad", 'attribute("color_rgb", surface_colour("textured.obj", "pixels.png").colour) cube(20);')
    found = folder.colours("design.vcad", "--at=-2.5,2.5,1", "--at=2.5,2.5,1", "--at=-2.5,-2.5,1", "--at=2.5,-2.5,1",
                           "--at=0,2.5,1")
    for got, wanted in zip(found, [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (0.5, 0.5, 0)]):
        for a, b in zip(got, wanted):
            near(a, b, 1e-6, "a colour of the texture")
    folder.write("mesh.vcad", 'mesh("square.ply", inside="generalized");')
    said = folder.run("probe", "mesh.vcad", "--at", "0,0,0").stderr
    expect("have colours, which do not become materials" in said and 'surface_colour("square.ply").colour' in said, said)
    folder.write("plain.vcad", 'attribute("color_rgb", surface_colour("plain.obj").colour) cube(20);')
    folder.write("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    wrong = folder.run("probe", "plain.vcad", "--at", "0,0,0", status=1).stderr
    expect("have no colours" in wrong, wrong)


def colours_and_a_property_share_the_droplets(folder):
    """A modulus chooses the share of a soft material, and the colour the inks in the rest: all inks are stiff."""
    chosen = folder.calibrated()
    stiff = {"name": "stiff", "title": "stiff", "property": "modulus", "unit": "MPa", "citation": "made up", "licence": "free",
             "inputs": [{"fraction": [*LIGHTS]}], "rest": "clear", "interpolant": "mixture", "constants": {"values": [0, 2000]}}
    folder.write("stiff.json", stiff)
    chosen += ["--calibration", "stiff.json"]
    folder.write("both.vcad", 'attribute("modulus", "1000 + 100*x") ' + RAMP)
    folder.run("resolve", "both.vcad", *chosen, "-o", "both.json")
    folder.run("resolve", "ramp.vcad", *chosen[:2], "-o", "inks_alone.json")
    both, alone = (folder.compositions(name, POINTS) for name in ("both.json", "inks_alone.json"))
    for (x, _, _), mixed, inks in zip(POINTS, both, alone):
        share = (1000 + 100 * x) / 2000
        near(mixed["clear"], 1 - share, 1e-6, "the share of the soft material")
        for name in LIGHTS:
            near(mixed.get(name, 0), share * inks.get(name, 0), 1e-6, f"the share of {name}")
    report = next(e for e in folder.events("resolve", "both.vcad", *chosen) if e["event"] == "resolved")["printers"][0]
    near(report["intent"][0]["mean_miss"], 0, 1e-3, "the modulus")
    folder.write("other.json", stiff | {"inputs": [{"fraction": ["cyan", "magenta"]}]})
    wrong = folder.run("resolve", "both.vcad", *chosen[:2], "--calibration", "other.json", status=1).stderr
    expect("two chains of calibrations lead to fractions" in wrong and "--deciding ATTRIBUTE" in wrong, wrong)
    folder.run("resolve", "both.vcad", *chosen[:2], "--calibration", "other.json", "--deciding", "color_rgb")


def wrong_words(folder):
    folder.calibrated()
    inks = json.loads(folder.read("inks.json"))
    without = {name: value for name, value in inks.items() if name != "channels"}
    folder.write("none.json", inks | {"profile": "none.icc"})
    folder.write("text.json", inks | {"profile": "patches.csv"})
    folder.write("three.json", inks | {"channels": {"C": "cyan", "M": "magenta", "Y": "yellow"}})
    folder.write("channels.json", without)
    folder.write("intent.json", inks | {"intent": "relativ"})
    folder.write("odd.csv", "cyan,white,L,a,b\n0.5,0.6,50,0,0\n")
    for arguments, words in [
            (["resolve", "ramp.vcad", "--calibration", "none.json"], "none.icc"),
            (["resolve", "ramp.vcad", "--calibration", "text.json"], "cannot be used"),
            (["resolve", "ramp.vcad", "--calibration", "three.json"],
             "names 3 channels, and its profile has 4 (CMYK)"),
            (["resolve", "ramp.vcad", "--calibration", "channels.json"], 'needs "channels"'),
            (["resolve", "ramp.vcad", "--calibration", "intent.json"], 'relative'),
            (["resolve", "ramp.vcad", "--calibration", "agilus-vero-modulus"], "no calibration leads from there"),
            (["calibrations", "--measured", "odd.csv", "-o", "odd.json"],
             "odd.csv:2: the shares add up to 1.1")]:
        result = program.run(folder.command(*arguments), cwd=folder.path)
        expect(result.returncode != 0 and words in " ".join(result.stderr.split()), f"{arguments}: {result.stderr}")
    said = folder.run("slice", "ramp.vcad", "--voxel", "0.5", "-o", "plain").stderr
    expect("color_rgb does not choose materials" in said and "colour_mixture" in said, said)


CHECKS = program.named((shares_are_those_of_little_cms, droplets_have_the_shares, layers_and_checks_take_the_profile,
                        alpha_becomes_clear, reports_say_what_is_out_of_gamut, mixtures_of_ones_own_are_judged,
                        measured_patches_make_a_calibration, colours_of_surfaces_are_values,
                        colours_and_a_property_share_the_droplets, wrong_words))

if __name__ == "__main__":
    raise SystemExit(program.main(Folder, CHECKS))

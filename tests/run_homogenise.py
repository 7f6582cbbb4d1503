#!/usr/bin/env python3
"""Cells of designs as materials: what `ombre homogenise` says of them, against mathematics.

    python3 tests/run_homogenise.py build/dev/apps/ombre/ombre
"""
import json
import math
import xml.etree.ElementTree as ElementTree

import program
from program import expect, near_share as near

STUDY = program.SOURCE / "examples" / "studies" / "polyjet.json"


def run(folder, design, *arguments, status=0):
    return folder.describe("homogenise", design, *arguments, status=status)


def homogenised(folder, design, *arguments):
    return folder.described("homogenised", "homogenise", design, "--study", STUDY, *arguments)


def plain_blocks_are_their_material(folder):
    found = homogenised(folder, 'rectprism([6, 5, 4], material="red");', "--cell", "1")
    for value in found["modulus_mpa"]:
        near(value, 2850, 1e-6, "Young's modulus")
    for value in found["poissons_ratio"]:
        near(value, 0.39, 1e-6, "Poisson's ratio")
    expect(abs(found["universal_anisotropy"]) < 1e-6, "it is not isotropic")


def layers_share_strain_in_the_plane(folder):
    """Half stiff, half soft across z: along x nearly half the stiff modulus; along z the soft one holds all."""
    design = 'translate([0, 0, 1]) rectprism([4, 4, 2], material="red"); translate([0, 0, -1]) rectprism([4, 4, 2], material="blue");'
    found = homogenised(folder, design, "--cell", "0.5", "--tolerance", "1e-9")

    def compression(e, nu):
        return e * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    across = 2 / (1 / compression(2850, 0.39) + 1 / compression(0.383, 0.49))
    near(found["stiffness_mpa"][2][2], across, 1e-4, "the stiffness across the layers")
    near(found["modulus_mpa"][0], 1425, 0.01, "Young's modulus along the layers")


def boxes_cut_and_repeat(folder):
    """A rod that fills a quarter of its box, along z."""
    found = homogenised(folder, 'rectprism([2, 2, 8], material="red");', "--cell", "0.5", "--box=-2,-2,-2,2,2,2")
    near(found["solid_share"], 0.25, 1e-9, "the solid share")
    near(found["stiffness_mpa"][2][2], 2850 / 4, 1e-5, "the stiffness along the rod")
    expect("modulus_mpa" not in found, "it says that it holds loads across")


def shares_are_those_of_the_design(folder):
    """A rod of 1.5 mm in a box of 4 mm: 0.140625 of it, whatever its bricks have."""
    rod = 'rectprism([1.5, 1.5, 8], material="red");'
    box = ("--cell", "0.8", "--box=-2,-2,-2,2,2,2")
    found = homogenised(folder, rod, *box)
    near(found["solid_share"], 0.140625, 0.03, "the solid share")
    near(found["brick_share"], 0.140625, 0.03, "the share of the bricks")
    near(found["stiffness_mpa"][2][2], 2850 * found["brick_share"], 1e-4, "the stiffness along the rod")
    whole = homogenised(folder, rod, *box, "--fill", "centre")
    near(whole["solid_share"], 0.140625, 0.03, "the solid share beside whole bricks")
    near(whole["brick_share"], 1 / 25, 1e-9, "the share of whole bricks")


def sizes_are_compared(folder):
    """Richardson's rule, from numbers of two runs; a plain block has no error."""
    cell = 'difference() { rectprism([4, 4, 4], material="red"); sphere(1.5); }'
    fine, coarse = homogenised(folder, cell, "--cell", "0.5"), homogenised(folder, cell, "--cell", "1")
    for axis in range(3):
        near(fine["coarse_modulus_mpa"][axis], coarse["modulus_mpa"][axis], 1e-6, "the modulus of larger bricks")
        difference = fine["modulus_mpa"][axis] - coarse["modulus_mpa"][axis]
        near(fine["extrapolated_modulus_mpa"][axis], fine["modulus_mpa"][axis] + difference / 3, 1e-6, "the limit")
        near(fine["modulus_error_mpa"][axis], abs(difference) / 3, 1e-3, "the error")
    plain = homogenised(folder, 'rectprism([4, 4, 4], material="red");', "--cell", "1")
    for value, error in zip(plain["extrapolated_modulus_mpa"], plain["modulus_error_mpa"]):
        near(value, 2850, 1e-5, "the modulus of a block")
        expect(error < 0.01, f"a block has an error of {error}")


def cell(solid):
    return f"m = box_cells((1, 1, 1), min=(0, 0, 0), max=(1, 1, 1)); {solid}"


def moduli_scale_as_published(folder):
    """E goes with the density where struts are stretched (octet: Deshpande, Fleck, Ashby 2001), and with its square where they bend
    (Gibson, Ashby 1997); both exponents are somewhat greater at finite densities."""
    def exponent(name, *radii):
        found = [homogenised(folder, cell(f'lattice("{name}", radius={r}, map=m, material="red");'), "--cell", "0.05") for r in radii]
        (e0, e1), (d0, d1) = ([f[key] if key == "solid_share" else f[key][0] for f in found] for key in ("modulus_mpa", "solid_share"))
        return math.log(e1 / e0) / math.log(d1 / d0)
    octet, bcc = exponent("octet", 0.05, 0.09), exponent("bcc", 0.06, 0.12)
    expect(1 < octet < 1.5, f"the exponent of an octet truss is {octet}")
    expect(1.9 < bcc < 2.5, f"the exponent of a body-centred lattice is {bcc}")


def plates_are_as_stiff_as_their_plane_stress(folder):
    """Thin plates of thickness t on the faces of cubes of side 1, with k = E t / (1 - nu^2): C11 = 2 k, C12 = nu k."""
    modulus, nu, thickness = 2850, 0.39, 0.05
    k = modulus * thickness / (1 - nu ** 2)
    found = homogenised(folder, cell(f'plates(m, "cubic", {thickness}, "red");'), "--cell", "0.025")
    near(found["modulus_mpa"][0], k * (2 - 2 * nu ** 2 / (2 + nu)), 0.04, "Young's modulus of plates")


def reentrant_cells_widen(folder):
    """Beams of length l and thickness t in hexagons with upright walls of h (Gibson, Ashby 1997, 4.15a with shear and stretch)."""
    length, upright, thickness, degrees, nu = 5, 8, 0.5, -20, 0.39
    sine, cosine = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    share = (thickness / length) ** 2
    wanted = (cosine ** 2 / ((upright / length + sine) * sine) * (1 + (1.4 + 1.5 * nu) * share)
              / (1 + (2.4 + 1.5 * nu + (cosine / sine) ** 2) * share))
    design = (f"w = {2 * length * cosine}; v = {2 * (upright + length * sine)};\n"
              "m = box_cells((w, v, 0.5), min=(0, 0, 0), max=(w, v, 0.5));\n"
              f'honeycomb(m, {thickness}, {degrees}, {upright / length}, "red");')
    found = homogenised(folder, design, "--cell", "0.25")
    expect(wanted < -1.8, f"the formula gives {wanted}")
    near(found["poissons_ratio"][0], wanted, 0.15, "Poisson's ratio of a re-entrant honeycomb")


def densities_find_a_thickness(folder):
    """A rod that fills a quarter of a box of 4 mm is 2 mm thick."""
    rod = 'thickness = 1; rectprism([thickness, thickness, 8], material="red");'
    box = ("--study", STUDY, "--cell", "0.5", "--box=-2,-2,-2,2,2,2")
    lines = run(folder, rod, *box, "--density", "0.25", "--by", "thickness=0.2:3.5", "--json").stdout.splitlines()
    events = {e["event"]: e for e in map(json.loads, lines)}
    near(events["density"]["value"], 2, 0.01, "the thickness")
    near(events["homogenised"]["solid_share"], 0.25, 0.002, "the share")
    for by, wanted in (("thickness=0.2:1", "never 25 %"), ("thickness=3", "needs a variable"), ("width=1:3", "width")):
        reported = run(folder, rod, *box, "--density", "0.25", "--by", by, status=1).stderr
        expect(wanted in reported, reported)
    expect("is of a density" in run(folder, rod, *box, "--by", "thickness=1:3", status=1).stderr, "--by alone")


def draws_are_softer_than_means(folder):
    """A dithered mixture of half and half lies between the bounds that any arrangement has."""
    design = 'fgrade(["0.5", "0.5"], ["red", "blue"]) rectprism([4, 4, 4]);'
    drawn = homogenised(folder, design, "--cell", "0.5", "--seed", "3")
    mixed = homogenised(folder, design, "--cell", "1", "--assign", "mix")
    near(mixed["modulus_mpa"][0], (2850 + 0.383) / 2, 1e-4, "the mean modulus")
    for axis in range(3):
        value = drawn["stiffness_mpa"][axis][axis]
        expect(drawn["reuss_mpa"][axis][axis] < value < drawn["voigt_mpa"][axis][axis], "it is beyond the bounds")
    expect(homogenised(folder, design, "--cell", "0.5", "--seed", "3", "--threads", "1")["stiffness_mpa"] ==
           drawn["stiffness_mpa"], "threads change it")


def charts_are_written(folder):
    run(folder, 'rectprism([2, 2, 2], material="red");', "--study", STUDY, "--cell", "1", "-o", "chart.svg")
    text = folder.read("chart.svg")
    expect(text.startswith("<svg") and text.count("Z\"") == 3, "three diagrams")
    before = text
    reported = run(folder, "cube(2);", "--study", STUDY, "--cell", "1", "-o", "chart.svg", status=2).stderr
    expect("--force" in reported and folder.read("chart.svg") == before, "overwriting")
    folder.write("this & <that>.vcad", 'cube(2, "red");')
    folder.run("homogenise", "this & <that>.vcad", "--study", STUDY, "--cell", "1", "-o", "named.svg")
    texts = [element.text for element in ElementTree.fromstring(folder.read("named.svg")).iter() if element.tag.endswith("text")]
    expect("this & <that>.vcad" in texts, str(texts))


def layers_conduct_in_series_and_parallel(folder):
    design = 'translate([0, 0, 1]) rectprism([4, 4, 2], material="red"); translate([0, 0, -1]) rectprism([4, 4, 2], material="blue");'
    for physics, unit in (("heat", "conductivity_w_mk"), ("electric", "conductivity_s_m")):
        folder.write("heat.json", {"physics": physics, "materials": {"red": {unit: 15}, "blue": {unit: 0.2}}})
        lines = run(folder, design, "--study", "heat.json", "--json", "--cell", "1", "--tolerance", "1e-10").stdout.splitlines()
        found = next(e for e in map(json.loads, lines) if e["event"] == "homogenised")[unit]
        for axis, wanted in enumerate(((15 + 0.2) / 2, (15 + 0.2) / 2, 2 / (1 / 15 + 1 / 0.2))):
            near(found[axis][axis], wanted, 1e-6, f"the conductivity along {'xyz'[axis]}")
    reported = run(folder, design, "--study", "heat.json", "--cell", "1", "-o", "chart.svg", status=1).stderr
    expect("conductivities have none" in reported and not (folder.path / "chart.svg").exists(), reported)


def wrong_use_is_reported(folder):
    def reported(design, *arguments, status=1):
        return run(folder, design, *arguments, status=status).stderr
    study = ("--study", STUDY)
    expect('no elastic properties of "green"' in reported("sphere(2, green);", "--cell", "1", *study), "properties")
    expect("from 1 to 4096" in reported("cube(2, red);", "--cell", "0.0001", *study), "too many bricks")
    expect("no brick is inside the design by enough" in reported("cube(2, red);", "--cell", "1", "--box=8,8,8,9,9,9", *study), "nothing there")
    expect(".svg" in reported("cube(2, red);", "--cell", "1", "-o", "chart.png", *study), "ending")
    expect("more than the" in reported("cube(9, red);", "--cell", "0.1", "--memory", "1M", *study, status=2), "memory")


CHECKS = [plain_blocks_are_their_material, layers_share_strain_in_the_plane, boxes_cut_and_repeat, shares_are_those_of_the_design, sizes_are_compared,
          densities_find_a_thickness, moduli_scale_as_published, plates_are_as_stiff_as_their_plane_stress, reentrant_cells_widen,
          draws_are_softer_than_means, charts_are_written, layers_conduct_in_series_and_parallel,
          wrong_use_is_reported]


if __name__ == "__main__":
    raise SystemExit(program.main(program.Folder, program.named(CHECKS)))

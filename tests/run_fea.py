#!/usr/bin/env python3
"""Finite-element models, run as a user would.

    python3 tests/run_fea.py build/dev/apps/ombre/ombre
    python3 tests/run_fea.py build/dev/apps/ombre/ombre --write-calculix    # tests/fixtures/calculix.json anew
"""
import argparse
import json
import math
import pathlib
import shutil
import subprocess
import tempfile

import processes
import program
from fea_jobs import CUBE, PULL, RED, Folder, has_tetrahedra
from program import expect, near

def bars_stretch_by_hookes_law(folder):
    """100 MPa along z: 100/2850 of 10 mm longer, 0.39 of that narrower, for each of x and y."""
    solution = folder.events("cube.vcad", "--study", "pull.json", "--cell", "2.5", "--solve")["solution"]
    strain = 100 / 2850
    for got, wanted in zip(solution["greatest_displacement_mm"], (-3.9 * strain, -3.9 * strain, 10 * strain)):
        near(got, wanted, 1e-6, "a displacement")
    near(solution["greatest_von_mises_mpa"], 100, 1e-4, "the stress")
    near(solution["reaction_n"][2], -10000, 1e-3, "the reaction")
    near(solution["strain_energy_mj"], 0.5 * 10000 * 10 * strain, 1e-3, "the energy")


PLATE = "translate(10, 0, 0.5) rectprism((20, 4, 1), red);"
STRIP = {"materials": {"red": {"modulus_mpa": 1000, "poissons_ratio": 0, "density_kg_m3": 1000}},
         "supports": [{"on": "xmin", "fix": "xyz"}], "loads": [{"on": "xmax", "force_n": [0, 0, -1]}]}


def plates_are_as_thick_as_they_are(folder):
    """80 mm3, and 8.012 mm of deflection by Timoshenko's beam (8 by Euler and Bernoulli's), whatever the bricks; those
    that are whole make the plate 0.8 mm thick, or 1.6."""
    folder.write("plate.vcad", PLATE)
    folder.write("strip.json", STRIP)
    job = ["plate.vcad", "--study", "strip.json", "--solve", "--tolerance", "1e-9"]
    for cell in "2", "0.8", "0.5":
        events = folder.events(*job, "--cell", cell)
        near(events["model"]["volume_mm3"], 80, 1e-6, "the volume in bricks of " + cell)
        near(-events["solution"]["greatest_displacement_mm"][2], 8.012, 0.03, "the deflection in bricks of " + cell)
        near(events["solution"]["reaction_n"][2], 1, 1e-6, "the reaction")
        # 6 F L / (b h^2) at the root.
        near(events["solution"]["greatest_von_mises_at_nodes_mpa"], 30, 0.06 * 30, "the stress on the surface")
    # A point of each 64th part of the height is looked at: 0.96 to 1.04 mm of 1 mm.
    near(folder.events(*job, "--cell", "0.7")["model"]["volume_mm3"], 80, 0.025 * 80, "a plate across its bricks")
    near(folder.events(*job, "--cell", "0.8", "--fill", "centre")["model"]["volume_mm3"], 64, 1e-6, "whole bricks")
    done = folder.run(*job, "--cell", "0.5")
    noted = done.stdout + done.stderr
    expect("in the middle of an element" in noted and "at an integration point" in noted and "averaged within a material" in noted,
           noted)
    reported = folder.run(*job, "--cell", "0.8").stderr
    expect("100 % of the volume lies in walls fewer than 3 bricks across" in reported, reported)
    expect("warning" not in folder.run(*job, "--cell", "0.25").stderr, "a warning of four bricks")
    expect("--fill is of bricks" in folder.run(*job, "--elements", "tet4", "--size", "1", "--fill", "centre",
                                               status=1).stderr, "of tetrahedra")


def thin_plates_are_solved(folder):
    """A plate of 60 x 20 x 1 mm, which single precision cannot factorise: by Euler and Bernoulli's beam 4 F L^3 / (E b h^3) =
    0.432 mm of deflection, without Poisson's effect; by all ways to solve it. Bricks of 1.5 mm have parts of 0.375 mm, of which the
    third layer is filled by two thirds: the moment of area is 0.0974 mm3 of width instead of 1/12."""
    folder.write("plate.vcad", "translate(30, 10, 0.5) rectprism((60, 20, 1), red);")
    folder.write("strip.json", {**STRIP, "loads": [{"on": "xmax", "force_n": [0, 0, -0.01]}]})
    job = ["plate.vcad", "--study", "strip.json", "--solve"]
    for cell in "0.5", "1", "1.5":
        for solver in ("auto", "multigrid")[:1 if cell == "0.5" else 2]:
            moved = folder.events(*job, "--cell", cell, "--solver", solver)["solution"]["greatest_displacement_mm"][2]
            wanted = 0.432 / 12 / 0.0974 if cell == "1.5" else 0.432
            near(-moved, wanted, 0.03 * wanted, f"the deflection in bricks of {cell} by {solver}")


def cut_bricks_weigh_and_hold_what_they_are(folder):
    """A ball of radius 5: 523.6 mm3 and, of 1000 kg/m3, 5.137 mN. A pressure all around leaves no force, and on the
    upper half pushes with the area of its circle."""
    folder.write("ball.vcad", "sphere(5, red);")
    study = {**STRIP, "supports": [{"on": {"where": "z < -3"}, "fix": "xyz"}], "loads": [],
             "gravity_mm_s2": [0, 0, -9810]}
    for cell, fill, within in ("1.1", "exact", 0.01), ("0.7", "exact", 0.01):
        folder.write("weight.json", study)
        events = folder.events("ball.vcad", "--study", "weight.json", "--cell", cell, "--fill", fill, "--solve")
        near(events["model"]["volume_mm3"], 523.6, within * 523.6, "the volume")
        near(events["solution"]["reaction_n"][2], 5.137e-3, within * 5.137e-3, "the weight")
    folder.write("press.json", json.dumps({**study, "gravity_mm_s2": [0, 0, 0],
                                           "loads": [{"on": {"where": "z > 0.05"}, "pressure_mpa": 1}]}))
    pressed = folder.events("ball.vcad", "--study", "press.json", "--cell", "0.7", "--solve")["solution"]
    near(pressed["reaction_n"][2], math.pi * 25, 0.08 * math.pi * 25, "a pressure from above")


def decks_have_cut_bricks_as_sections(folder):
    folder.write("plate.vcad", PLATE)
    folder.write("strip.json", STRIP)
    folder.run("plate.vcad", "--study", "strip.json", "--cell", "2", "-o", "plate.inp")
    deck = folder.read("plate.inp")
    expect("*MATERIAL, NAME=RED_FILLED_32_OF_64\n*ELASTIC\n500, 0\n" in deck, deck[-1500:])


def results_are_in_the_grid(folder):
    folder.run("cube.vcad", "--study", "pull.json", "--cell", "2.5", "--solve", "-o", "cube.vtu")
    stress = folder.array("cube.vtu", "stress [MPa]")
    expect(len(stress) == 64 * 6, f"{len(stress)} stresses")
    for n, value in enumerate(stress):
        near(value, 100 if n % 6 == 2 else 0, 1e-3, "a stress")
    moves = folder.array("cube.vtu", "displacement [mm]")
    near(max(moves[2::3]), 1000 / 2850, 1e-6, "the greatest displacement along z")
    for name in "nodal von Mises stress [MPa]", "greatest von Mises stress at integration points [MPa]":
        for value in folder.array("cube.vtu", name):
            near(value, 100, 1e-3, name)
    for n, value in enumerate(folder.array("cube.vtu", "nodal stress [MPa]")):
        near(value, 100 if n % 6 == 2 else 0, 1e-3, "a stress at a node")
    expect(set(folder.array("cube.vtu", "modulus [MPa]")) == {2850.0}, "a modulus is wrong")


def vectors_are_one_field(folder):
    """Attributes in the middles of elements; a number that is called like a property keeps its name."""
    folder.write("fibres.vcad", 'attribute("fibre", ["x", "2*y", 1]) attribute("modulus", "2000 + z") ' + CUBE)
    folder.run("fibres.vcad", "--study", "pull.json", "--cell", "5", "-o", "fibres.vtu")
    middles = [(x, y, z) for z in (-2.5, 2.5) for y in (-2.5, 2.5) for x in (-2.5, 2.5)]
    expect(list(folder.array("fibres.vtu", "fibre")) == [n for x, y, z in middles for n in (x, 2 * y, 1)], "fibres")
    expect(list(folder.array("fibres.vtu", "modulus [MPa]")) == [2000 + z for x, y, z in middles], "the attribute")
    expect(set(folder.array("fibres.vtu", "modulus used [MPa]")) == {2850}, "what the elements have")


def mixtures_are_drawn_or_mixed(folder):
    drawn = folder.events("mix.vcad", "--study", "pull.json", "--cell", "0.5", "-o", "drawn.vtu")["model"]
    expect([s["name"] for s in drawn["sections"]] == ["red", "blue"], str(drawn))
    moduli = folder.array("drawn.vtu", "modulus [MPa]")
    # Of 8,000 draws with the odds 3 to 1, three standard deviations are 0.0145.
    near(moduli.count(2850) / len(moduli), 0.75, 0.0145, "the share of red")
    folder.run("mix.vcad", "--study", "pull.json", "--cell", "0.5", "-o", "again.vtu", "--threads", "2")
    expect((folder.path / "drawn.vtu").read_bytes() == (folder.path / "again.vtu").read_bytes(), "draws differ")
    folder.run("mix.vcad", "--study", "pull.json", "--cell", "0.5", "-o", "other.vtu", "--seed", "1")
    expect(folder.array("other.vtu", "modulus [MPa]") != moduli, "the seed does not matter")
    mixed = folder.events("mix.vcad", "--study", "pull.json", "--cell", "2", "--assign", "mix", "-o", "m.vtu")["model"]
    expect(len(mixed["sections"]) == 1, str(mixed))
    near(mixed["sections"][0]["modulus_mpa"], 0.75 * 2850 + 0.25 * 50, 1e-3, "the mean modulus")
    near(folder.array("m.vtu", "fraction of blue")[0], 0.25, 1e-6, "a fraction")


def mixtures_that_are_no_numbers_are_reported(folder):
    """The root of x is no number at x = -4 and -2, two of five columns of 25 bricks; powers whose sum overflows are
    no shares."""
    def grade(red, blue):
        folder.write("root.vcad", f'fgrade(["{red}", "{blue}"], [red, blue]) {{ rectprism((10, 10, 10), red); }}')

    def fea(*arguments, status=0):
        return folder.run("root.vcad", "--study", "pull.json", *arguments, "-o", "root.vtu", "--force",
                          status=status).stderr

    sizes = [("--cell", "2")] + [("--elements", "tet4", "--size", "3")] * has_tetrahedra(folder)
    grade("sqrt(x)", "1 - sqrt(x)")
    reported = fea(*sizes[0])
    expect("(50 of 125 elements, the first around (-4, -4, -4); they are of red)" in reported, reported)
    expect("fractions of fgrade are all zero or not finite" in fea(*sizes[-1]), "elements up to the surface")
    for red, blue in ("sqrt(x - 20)", "1"), ("if(x < 20, 1e308, 1)", "1e308"):
        grade(red, blue)
        for size in sizes:
            (folder.path / "root.vtu").unlink(missing_ok=True)
            reported = fea(*size, status=1)
            expect("error: the mixture is no number in any of the" in reported, reported)
            expect(not (folder.path / "root.vtu").exists(), "a file of a design without mixture")
    grade("if(x < -1, 1e308, 1)", "if(x < -1, 1e308, 1)")
    reported = fea(*sizes[0])
    expect("the mixture is no number in 50 of 125 elements, the first around (-4, -4, -4)" in reported, reported)
    grade("sqrt(x + 20)", "1")
    expect("warning" not in fea(*sizes[0]), "a warning of numbers")


def moduli_come_from_attributes(folder):
    """A bar whose modulus grows along z: its ends part by the integral of stress / modulus."""
    folder.write("graded.vcad", 'attribute("stiffness", "100 * exp(z/10)", unit="MPa") ' + CUBE)
    folder.write("slim.json", {**PULL, "materials": {"red": {"modulus_mpa": 1, "poissons_ratio": 0}}})
    events = folder.events("graded.vcad", "--study", "slim.json", "--cell", "10,10,0.25", "--solve",
                           "--modulus", "stiffness", "--sections", "1000", "-o", "graded.vtu")
    expect(len(events["model"]["sections"]) == 40, "each layer has its modulus")
    # The layers' own sum, by the moduli in their middles.
    wanted = sum(100 / (100 * math.exp((-5 + 0.25 * (n + 0.5)) / 10)) * 0.25 for n in range(40))
    near(max(folder.array("graded.vtu", "displacement [mm]")[2::3]), wanted, 1e-5 * wanted, "the end")
    folder.run("cube.vcad", "--study", "pull.json", "--cell", "1", "--modulus", "nothing", "-o", "x.vtu", status=1)


def decks_are_complete(folder):
    folder.run("mix.vcad", "--study", "pull.json", "--cell", "2.5", "-o", "mix.inp", "--element", "C3D8I")
    deck = folder.read("mix.inp")
    for card in ("*NODE, NSET=NALL", "*ELEMENT, TYPE=C3D8I, ELSET=RED", "*MATERIAL, NAME=BLUE", "*BOUNDARY", "*CLOAD",
                 "*SOLID SECTION, ELSET=RED, MATERIAL=RED", "*STATIC", "*END STEP"):
        expect(card + "\n" in deck, f"no {card}")
    nodes = deck.split("NSET=NALL\n")[1].split("*ELEMENT")[0].splitlines()
    expect(len(nodes) == 125 and nodes[0] == "1, -5, -5, -5" and nodes[-1] == "125, 5, 5, 5", "nodes")
    loads = deck.split("*CLOAD\n")[1].split("*NODE FILE")[0].splitlines()
    near(sum(float(line.split(",")[2]) for line in loads), 10000, 1e-6, "the load")
    if not shutil.which("ccx"):
        return
    # Debian's CalculiX, where it is installed, on the same deck without mixture.
    folder.run("cube.vcad", "--study", "pull.json", "--cell", "5", "-o", "cube.inp")
    done = program.run(["ccx", "-i", "cube"], cwd=folder.path)
    expect("Job finished" in done.stdout, done.stdout[-500:])
    top = [line for line in folder.read("cube.frd").splitlines() if line.startswith(" -1")]
    expect(any(abs(float(line[37:49]) - 1000 / 2850) < 1e-5 for line in top if len(line) >= 49), "CalculiX differs")


HOLED = "difference() { rectprism((10, 10, 10), red); cylinder(3, 20, red); }"
HEAT = {"physics": "heat", "materials": {"red": {"conductivity_w_mk": 0.5}},
        "supports": [{"on": "zmin", "temperature_c": 20}],
        "loads": [{"on": "zmax", "heat_w": 0.1}, {"on": "ymin", "flux_w_mm2": 0.001},
                  {"on": "xmax", "film_w_m2k": 50, "ambient_c": 30}]}
BEND = {**PULL, "supports": [{"on": "xmin", "fix": "xyz"}],
        "loads": [{"on": {"facing": [0, 0, 1]}, "pressure_mpa": 2}, {"on": "xmax", "force_n": [0, 30, 0]}]}
# Where CalculiX has the same elements, numbers agree: all that are reported of a solution, but for places.
CALCULIX = {
    "bricks pulled": ("cube.vcad", "pull.json", ["--cell", "2.5"], 1e-5),
    "tet4 bent": ("holed.vcad", "bend.json", ["--elements", "tet4", "--size", "3"], 1e-5),
    "tet10 bent": ("holed.vcad", "bend.json", ["--elements", "tet10", "--size", "4"], 1e-5),
    "tet10 of two materials": ("mix.vcad", "bend.json", ["--elements", "tet10", "--size", "4"], 1e-5),
    # The films of the program of our own act at nodes.
    "tet10 heated": ("holed.vcad", "heat.json", ["--elements", "tet10", "--size", "4"], 0.01),
    "bricks heated": ("holed.vcad", "heat.json", ["--cell", "2", "--fill", "centre"], 0.01),
}
CALCULIX_FILE = program.SOURCE / "tests" / "fixtures" / "calculix.json"


def write_studies(folder):
    folder.write("holed.vcad", HOLED)
    folder.write("heat.json", HEAT)
    folder.write("bend.json", BEND)


def solve_case(folder, name, solver):
    design, study, arguments, _ = CALCULIX[name]
    solution = folder.events(design, "--study", study, *arguments, "--solve", "--solver", solver)["solution"]
    reported = {key: value for key, value in solution.items() if isinstance(value, (float, int, list))}
    return {key: value for key, value in reported.items()
            if key not in ("iterations", "residual", "seconds") and not key.endswith("_at_mm")}


def agree(got, wanted, tolerance, what):
    for key, value in wanted.items():
        values = value if isinstance(value, list) else [value]
        numbers = got[key] if isinstance(value, list) else [got[key]]
        scale = max(map(abs, values))
        for a, b in zip(numbers, values):
            near(a, b, tolerance * scale, f"{what}: {key}")


def solutions_agree_with_calculix(folder):
    """The numbers of CalculiX 2.20 on bricks; where it is installed, those that it gives now on all."""
    write_studies(folder)
    stored = json.loads(CALCULIX_FILE.read_text(encoding="utf-8"))
    with_tetrahedra = has_tetrahedra(folder)
    for name, (_, _, arguments, tolerance) in CALCULIX.items():
        wanted = stored.get(name)
        if shutil.which("ccx") and (wanted or with_tetrahedra):
            wanted = solve_case(folder, name, "calculix")
            agree(wanted, stored.get(name, {}), 1e-5, name + " by CalculiX")
        expect(wanted or "--elements" in arguments, f"{CALCULIX_FILE.name} has no {name}")
        if wanted:
            agree(solve_case(folder, name, "auto"), wanted, tolerance, name)


def solvers_agree(folder):
    """A lattice of thin struts, drawn of materials that differ 7,400 times: by multigrid, by a factorisation, and by the
    latter since the former is slow."""
    examples = program.SOURCE / "examples" / "studies"
    job = [examples / "lattice.vcad", "-D", "cells=2", "-D", "rule=2", "--study", examples / "press.json", "--cell", "1",
           "--solve", "--tolerance", "1e-9"]
    slow = folder.events(*job, "--solver", "multigrid")
    expect("factorisation" not in slow and slow["solution"]["iterations"] > 100, str(slow["solution"]["iterations"]))
    run = program.run([folder.ombre, "fea", *job, "--solver", "direct", "--json"], cwd=folder.path)
    if "built without MUMPS" in run.stdout + run.stderr:
        return
    quick = folder.events(*job, "--solver", "direct")
    expect(quick["solution"]["iterations"] <= 6, str(quick["solution"]["iterations"]))
    expect(quick["factorisation"]["disk_bytes"] == 0 and quick["factorisation"]["memory_bytes"] > 1e6, "what it takes")
    auto = folder.events(*job)
    expect("factorisation" in auto and auto["solution"]["iterations"] % 40 < 8, str(auto["solution"]["iterations"]))
    for one in (quick, auto):
        near(one["solution"]["strain_energy_mj"], slow["solution"]["strain_energy_mj"],
             1e-5 * slow["solution"]["strain_energy_mj"], "energy")
    limit = int(quick["factorisation"]["memory_bytes"])
    beside = folder.events(*job, "--solver", "direct", "--memory", str(limit))["factorisation"]
    expect(beside["disk_bytes"] > 0 and beside["memory_bytes"] <= limit, "on disk")
    failed = program.run([folder.ombre, "fea", *job, "--solver", "direct", "--memory", "5M"], cwd=folder.path)
    expect(failed.returncode == 2 and "more than the" in failed.stderr, failed.stderr[-500:])


def write_calculix(ombre):
    with tempfile.TemporaryDirectory() as scratch:
        folder = Folder(ombre, scratch)
        write_studies(folder)
        # Meshers of other versions make other tetrahedra.
        solutions = {name: solve_case(folder, name, "calculix") for name, case in CALCULIX.items()
                     if "--elements" not in case[2]}
    CALCULIX_FILE.write_text(json.dumps(solutions, indent=2) + "\n", encoding="utf-8")


def walls_conduct(folder):
    """Through 10 mm of 0.5 W/(m K) and 100 mm2 with 10 degrees between: 50 mW; graded by an attribute, by its integral."""
    study = {**HEAT, "supports": [{"on": "zmin", "temperature_c": 20}, {"on": "zmax", "temperature_c": 30}], "loads": []}
    folder.write("wall.json", study)
    solution = folder.events("cube.vcad", "--study", "wall.json", "--cell", "2.5", "--solve", "-o", "w.vtu")["solution"]
    near(solution["enters_w"], 0.05, 1e-9, "the heat")
    near(max(folder.array("w.vtu", "temperature [C]")), 30, 1e-5, "the temperature")
    for n, value in enumerate(folder.array("w.vtu", "heat flux [W/mm2]")):
        near(value, -5e-4 if n % 3 == 2 else 0, 1e-9, "a flux")
    folder.write("graded.vcad", 'attribute("k", "exp(z/10)", unit="1") ' + CUBE)
    solution = folder.events("graded.vcad", "--study", "wall.json", "--cell", "10,10,0.25", "--solve", "--conductivity",
                             "k", "--sections", "1000")["solution"]
    near(solution["enters_w"], 100 * 10e-3 / (10 * (math.exp(0.5) - math.exp(-0.5))), 1e-5, "the graded wall's heat")


def selections_ask_the_design(folder):
    folder.write("two.vcad", 'part("foot") translate(0, 0, -4) rectprism((10, 10, 2), red); '
                             'part("body") translate(0, 0, 1) rectprism((10, 10, 8), blue);')
    study = {**PULL, "supports": [{"on": {"part": "foot"}, "fix": "xyz"}],
             "loads": [{"on": {"where": "z > 4.9 && x > 0"}, "force_n": [0, 0, 7]}]}
    folder.write("two.json", study)
    solution = folder.events("two.vcad", "--study", "two.json", "--cell", "1", "--solve", "-o", "two.vtu")["solution"]
    near(solution["reaction_n"][2], -7, 1e-5, "the reaction")
    moves = folder.array("two.vtu", "displacement [mm]")
    held = 11 * 11 * 3
    expect(all(value == 0 for value in moves[:3 * held]) and moves[3 * held + 2] != 0, "what is held")
    study["supports"][0]["on"] = {"part": "fot"}
    folder.write("two.json", study)
    error = folder.run("two.vcad", "--study", "two.json", "--cell", "1", "--solve", status=1).stderr
    expect('did you mean "foot"?' in error, error)
    study["supports"][0]["on"] = {"where": "q > 1"}
    folder.write("two.json", study)
    error = folder.run("two.vcad", "--study", "two.json", "--cell", "1", "--solve", status=1).stderr
    expect('"q"' in error and "two.json:1:" in error, error)


def a_hook_holds_its_coat(folder):
    """The supports hold the 20 N of the example's study and the weight of the bricks, whose densities differ by 3 %."""
    examples = program.SOURCE / "examples"
    events = folder.events(examples / "parametric_hook.vcad", "--study", examples / "studies" / "coat.json",
                           "--cell", "1", "--solve")
    weight = events["model"]["volume_mm3"] * 1.22e-9 * 9810
    near(events["solution"]["reaction_n"][1], 20 + weight, 0.02 * weight, "the reaction")


def a_mug_cools(folder):
    """What enters from the tea leaves to the air, about film times area times difference at most; none is colder than it."""
    examples = program.SOURCE / "examples"
    solution = folder.events(examples / "mug.vcad", "--study", examples / "studies" / "tea.json", "--cell", "2",
                             "--assign", "mix", "--solve")["solution"]
    near(solution["enters_w"], solution["leaves_w"], 1e-5 * solution["enters_w"], "the heat")
    expect(solution["least_temperature_c"] > 20 and solution["greatest_temperature_c"] <= 80 + 1e-6, str(solution))


def materials_that_are_nowhere_need_no_properties(folder):
    """Shares that vary make the block's own material, red, possible, but no brick has any of it."""
    folder.write("possible.vcad", "s = noise(size=3).value; fgrade([1 - s, s], [magenta, gray]) rectprism((4, 4, 4), red);")
    folder.write("two.json", {**PULL, "materials": {"magenta": RED, "gray": RED}})
    solution = folder.events("possible.vcad", "--study", "two.json", "--cell", "2", "--solve", "--assign", "mix")["solution"]
    near(solution["greatest_displacement_mm"][2], 4 * 100 / 2850, 1e-6, "the stretch")


def results_are_in_xdmf(folder):
    """The same numbers as in the .vtu, and in the design, through a file of HDF5."""
    folder.write("bend.json", json.dumps({**PULL, "supports": [{"on": "xmin", "fix": "xyz"}],
                                          "loads": [{"on": "xmax", "force_n": [3, 5, -7]}]}))
    result = program.run([folder.ombre, "fea", "mix.vcad", "--study", "bend.json", "--cell", "2.5", "--solve", "-o", "bend.vtu",
                          "-o", "bend.xdmf"], cwd=folder.path)
    if "OMBRE_HDF5" in result.stderr:
        return "skipped: built without HDF5"
    expect(result.returncode == 0, result.stderr[-1000:])
    text, before = folder.read("bend.xdmf"), (folder.path / "bend.h5").read_bytes()
    expect('TopologyType="Hexahedron"' in text and "bend.h5:/Mesh/geometry" in text, text[:500])
    folder.run("mix.vcad", "--study", "bend.json", "--cell", "2.5", "--solve", "-o", "bend.xdmf", "--force", "--threads", "1")
    expect((folder.path / "bend.h5").read_bytes() == before, "another run makes other bytes")

    def fields(name):
        events = program.run([folder.ombre, "info", name, "--json"], cwd=folder.path).stdout.splitlines()
        return {f["name"]: f for f in json.loads(events[0])["fields"]}

    grid, xdmf = fields("bend.vtu"), fields("bend.xdmf")
    expect(grid == xdmf and "stress" in grid, f"{grid}\n{xdmf}")
    places = ["--at", "1,2,3", "--at", "-4,0.5,2"]
    answers = []
    for name in ("bend.vtu", "bend.xdmf"):
        folder.write("asks.vcad", f'attribute("zx", results("{name}", "stress", component="zx").value)'
                                  f'attribute("move", results("{name}", "displacement").vector) cube(10, red);')
        probed = program.run([folder.ombre, "probe", "asks.vcad", *places, "--json"], cwd=folder.path)
        expect(probed.returncode == 0, probed.stderr[-1000:])
        answers.append([json.loads(line)["attributes"] for line in probed.stdout.splitlines() if '"point"' in line])
    expect(answers[0] == answers[1] and len(answers[0]) == 2, str(answers))
    pictures = []
    for name in ("bend.vtu", "bend.xdmf"):
        drawn = program.run([folder.ombre, "render", name, "--by", "von_mises", "--deform", "5", "--size", "80x60", "-o", "p.png",
                             "--force"], cwd=folder.path)
        expect(drawn.returncode == 0, drawn.stderr[-1000:])
        pictures.append((folder.path / "p.png").read_bytes())
    expect(pictures[0] == pictures[1], "the mesh of .xdmf is another than that of .vtu")
    (folder.path / "bend.h5").write_bytes(before[:1000])
    message = program.run([folder.ombre, "probe", "asks.vcad", *places], cwd=folder.path).stderr
    expect("bend.h5" in message and "HDF5" in message, message)
    (folder.path / "bend.h5").unlink()
    message = program.run([folder.ombre, "probe", "asks.vcad", *places], cwd=folder.path).stderr
    expect('"bend.h5"' in message and "values=" in message, message)
    return xdmf_by_h5py(folder, before)


def xdmf_by_h5py(folder, numbers):
    """Another reader of HDF5 finds the shapes and numbers, the tensors in XDMF's order."""
    try:
        import h5py
    except ImportError:
        return ""
    (folder.path / "again.h5").write_bytes(numbers)
    with h5py.File(folder.path / "again.h5") as file:
        expect(file["Mesh/geometry"].shape == (125, 3) and file["Mesh/topology"].shape == (64, 8), "shapes")
        moves = folder.array("bend.vtu", "displacement [mm]")
        expect(list(file["NodeData/displacement"][:].flatten()) == list(moves), "displacements")
        stress, ours = file["CellData/stress"][:][5], folder.array("bend.vtu", "stress [MPa]")[30:36]
        expect(list(stress) == [ours[n] for n in (0, 3, 5, 1, 4, 2)], f"{stress} and {ours}")
    return ""


FOLLOWING = """
moved = "";
share = moved == "" ? 0.1 : clamp(0, results(moved, "displacement", outside="nearest").value * 20, 0.9);
fgrade([1 - share, share], [red, blue]) rectprism((10, 10, 10), red);
"""


def rounds_follow_their_results(folder):
    """A soft block of red and blue whose share of blue is what its own displacement asks for."""
    folder.write("follow.vcad", FOLLOWING)
    folder.write("soft.json", json.dumps({**PULL, "loads": [{"on": "zmax", "pressure_mpa": -20}],
                                          "materials": {"red": {**RED, "modulus_mpa": 4000},
                                                        "blue": {**RED, "modulus_mpa": 8000}}}))
    options = ("--study", "soft.json", "--cell", "2.5", "--assign", "mix", "--tolerance", "1e-10")
    result = folder.run("follow.vcad", *options, "--rounds", "30", "--change", "1e-5", "--follow", "moved", "-o", "follow.vtu",
                        "-o", "follow.csv")
    expect("nothing changes any more" in result.stderr, result.stderr[-500:])
    rows = [line.split(",") for line in folder.read("follow.csv").splitlines()]
    expect(rows[0][:3] == ["round", "elements", "change"] and "share of blue" in rows[0], str(rows[0]))
    expect(3 <= len(rows) - 1 < 30, f"{len(rows) - 1} rounds")
    changes = [float(row[2]) for row in rows[2:]]
    expect(all(b < a for a, b in zip(changes, changes[1:])), f"the changes do not shrink: {changes}")
    expect((folder.path / f"follow_{len(rows) - 1}.vtu").exists(), "the last round's file is missing")
    expect(not (folder.path / f"follow_{len(rows)}.vtu").exists(), "a file of a round that was not solved")
    # A round is what -D says with the file of the round before.
    folder.run("follow.vcad", *options, "--solve", "-D", "moved=follow_1.vtu", "-o", "second.vtu")
    expect((folder.path / "second.vtu").read_bytes() == (folder.path / "follow_2.vtu").read_bytes(), "the second round")
    # Where it ends, the share of blue is what the displacement of the same round asks for.
    last = f"follow_{len(rows) - 1}.vtu"
    wanted = [min(20 * math.hypot(*u), 0.9) for u in zip(*[iter(folder.array(last, "displacement [mm]"))] * 3)]
    shares = folder.array(last, "fraction of blue")
    expect(min(wanted) <= min(shares) and max(shares) <= max(wanted) and max(shares) > 0.3, f"{min(shares)} to {max(shares)}")


def wrong_use_of_rounds_is_reported(folder):
    def error(*arguments):
        return folder.run("cube.vcad", "--study", "pull.json", "--cell", "2.5", *arguments, status=1).stderr

    expect("--follow moved" in error("--rounds", "3", "-o", "x.vtu"), "no variable")
    expect("-o part.vtu" in error("--rounds", "3", "--follow", "moved", "-o", "x.csv"), "no results")
    expect("--rounds 5" in error("--follow", "moved", "-o", "x.vtu"), "no rounds")
    expect("--rounds 5" in error("-o", "x.csv", "--solve"), "a history of one")
    # Before anything is solved.
    folder.write("misspelt.vcad", FOLLOWING)
    result = folder.run("misspelt.vcad", "--study", "pull.json", "--cell", "2.5", "--rounds", "3", "--follow", "movd", "-o", "x.vtu",
                        status=1)
    expect('no variable "movd"' in result.stderr and 'did you mean "moved"' in result.stderr, result.stderr)
    expect(not (folder.path / "x_1.vtu").exists(), "a file is written")


def wrong_use_is_reported(folder):
    def error(*arguments, status=1):
        return folder.run(*arguments, status=status).stderr

    cube = ("cube.vcad", "--cell", "2.5")
    expect("nothing to do" in error(*cube, "--study", "pull.json"), "nothing to do")
    expect(".inp, .vtu or .xdmf" in error(*cube, "--study", "pull.json", "-o", "x.stl"), "ending")
    folder.write("bare.json", {"supports": PULL["supports"]})
    expect('no elastic properties of "red"' in error(*cube, "--study", "bare.json", "--solve"), "properties")
    folder.write("loose.json", {"materials": PULL["materials"], "loads": PULL["loads"]})
    expect("free to move or turn" in error(*cube, "--study", "loose.json", "--solve"), "supports")
    folder.write("odd.json", {**PULL, "materials": {"rde": RED}})
    expect('did you mean "red"?' in error(*cube, "--study", "odd.json", "--solve"), "names")
    folder.write("broken.json", '{"supports": [')
    expect("broken.json:1:" in error(*cube, "--study", "broken.json", "--solve"), "JSON")
    expect("none.json" in error(*cube, "--study", "none.json", "--solve", status=2), "a missing file")
    expect("more than the" in error("cube.vcad", "--study", "pull.json", "--solve", "--memory", "1M", "--cell", "0.5",
                                   status=2), "memory")
    solve = ("cube.vcad", "--study", "pull.json", "--solve")
    expect("--cell 1" in error(*solve), "no size")
    expect("--size 1.5" in error(*solve, "--elements", "tet4"), "no size of tetrahedra")
    expect("--elements tet10" in error(*solve, "--cell", "1", "--size", "1"), "size of bricks")
    expect("--min-cell" in error(*solve, "--elements", "tet4", "--size-by", "1"), "no least size")
    expect("nothing without --solve" in error(*cube, "--study", "pull.json", "--solver", "calculix", "-o", "x.inp"), "solver")
    expect("--solver direct is of bricks" in error(*solve, "--elements", "tet4", "--size", "5", "--solver", "direct"), "bricks")
    if has_tetrahedra(folder):
        folder.run(*solve, "--elements", "tet4", "--size", "100")  # larger than the part
        message = error(*solve, "--elements", "tet4", "--size", "0.01", status=2)
        expect("tetrahedra take about" in message and "larger --size" in message, message)
        message = error(*solve, "--elements", "tet4", "--size-by", "min_cel", "--min-cell", "1", "--max-cell", "2")
        expect("min_cell" in message, message)
        folder.write("soft.json", {**PULL, "materials": {"red": {**RED, "poissons_ratio": 0.5}}})
        message = folder.run("cube.vcad", "--study", "soft.json", "--elements", "tet4", "--size", "5", "--solve").stderr
        expect("is taken for 0.49" in message and "tet4 is far too stiff" in message, message)
    folder.run(*cube, "--study", "pull.json", "-o", "there.inp")
    before = folder.read("there.inp")
    expect("--force" in error(*cube, "--study", "pull.json", "-o", "there.inp", status=2), "overwriting")
    expect(folder.read("there.inp") == before and not list(folder.path.glob("*.part")), "files")


def ctrl_c_ends_it(folder):
    process = subprocess.Popen([folder.ombre, "fea", "mix.vcad", "--study", "pull.json", "--cell", "0.1", "--solve",
                                "-o", "never.vtu"], cwd=folder.path, env=program.environment(), text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    processes.wait_for_work(process, 3)
    processes.interrupt(process)
    expect(not list(folder.path.glob("never*")), "a file is left")


CHECKS = [bars_stretch_by_hookes_law, plates_are_as_thick_as_they_are, thin_plates_are_solved, cut_bricks_weigh_and_hold_what_they_are,
          decks_have_cut_bricks_as_sections, results_are_in_the_grid, vectors_are_one_field,
          mixtures_are_drawn_or_mixed, mixtures_that_are_no_numbers_are_reported, moduli_come_from_attributes,
          decks_are_complete, walls_conduct, selections_ask_the_design, solutions_agree_with_calculix,
          solvers_agree, a_hook_holds_its_coat, a_mug_cools, materials_that_are_nowhere_need_no_properties,
          results_are_in_xdmf, rounds_follow_their_results, wrong_use_of_rounds_is_reported, wrong_use_is_reported,
          ctrl_c_ends_it]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("ombre", type=pathlib.Path)
    parser.add_argument("--write-calculix", action="store_true", help="write CalculiX's numbers anew, and end")
    arguments = parser.parse_args()
    ombre = arguments.ombre.resolve()
    if arguments.write_calculix:
        return write_calculix(ombre)
    return program.check_in_folders(Folder, ombre, program.named(CHECKS))


if __name__ == "__main__":
    raise SystemExit(main())

#!/usr/bin/env python3
"""Finite-element models, run as a user would.

    python3 tests/run_fea.py build/dev/apps/ombre/ombre
"""
import argparse
import functools
import json
import math
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import tempfile
import time

import program

RED = {"modulus_mpa": 2850, "poissons_ratio": 0.39}
CUBE = "rectprism((10, 10, 10), red);"
MIX = 'fgrade(["0.75", "0.25"], [red, blue]) { rectprism((10, 10, 10), red); }'
PULL = {"materials": {"red": RED, "blue": {"modulus_mpa": 50, "poissons_ratio": 0.39}},
        "supports": [{"on": "xmin", "fix": "x"}, {"on": "ymin", "fix": "y"}, {"on": "zmin", "fix": "z"}],
        "loads": [{"on": "zmax", "pressure_mpa": -100}]}


def expect(truth, message):
    if not truth:
        raise AssertionError(message)


class Folder:
    def __init__(self, ombre, scratch):
        self.ombre, self.path = ombre, pathlib.Path(scratch)
        self.write("cube.vcad", CUBE)
        self.write("mix.vcad", MIX)
        self.write("pull.json", json.dumps(PULL))

    def write(self, name, text):
        (self.path / name).write_text(text, encoding="utf-8")

    def read(self, name):
        return (self.path / name).read_text(encoding="utf-8")

    def run(self, *arguments, status=0):
        result = program.run([self.ombre, "fea", *arguments], cwd=self.path)
        expect(result.returncode == status, f"status {result.returncode}, not {status}: {result.stderr[-1500:]}")
        return result

    def events(self, *arguments):
        lines = self.run(*arguments, "--json").stdout.splitlines()
        return {event["event"]: event for event in map(json.loads, lines)}

    def array(self, name, field):
        """The floats of a field of a .vtu file."""
        data = (self.path / name).read_bytes()
        tag = re.search(rb'Name="' + re.escape(field.encode()) + rb'" NumberOfComponents="\d+" format="appended" '
                        rb'offset="(\d+)"', data)
        expect(tag, f"{name} has no {field}")
        begin = data.index(b'<AppendedData encoding="raw">\n_') + 31 + int(tag[1])
        size = struct.unpack_from("<Q", data, begin)[0]
        return struct.unpack_from(f"<{size // 4}f", data, begin + 8)


def near(got, wanted, tolerance, what):
    expect(abs(got - wanted) <= tolerance, f"{what} is {got}, not {wanted}")


def bars_stretch_by_hookes_law(folder):
    """100 MPa along z: 100/2850 of 10 mm longer, 0.39 of that narrower, for each of x and y."""
    solution = folder.events("cube.vcad", "--study", "pull.json", "--cell", "2.5", "--solve")["solution"]
    strain = 100 / 2850
    for got, wanted in zip(solution["greatest_displacement_mm"], (-3.9 * strain, -3.9 * strain, 10 * strain)):
        near(got, wanted, 1e-6, "a displacement")
    near(solution["greatest_von_mises_mpa"], 100, 1e-4, "the stress")
    near(solution["reaction_n"][2], -10000, 1e-3, "the reaction")
    near(solution["strain_energy_mj"], 0.5 * 10000 * 10 * strain, 1e-3, "the energy")


def results_are_in_the_grid(folder):
    folder.run("cube.vcad", "--study", "pull.json", "--cell", "2.5", "--solve", "-o", "cube.vtu")
    stress = folder.array("cube.vtu", "stress [MPa]")
    expect(len(stress) == 64 * 6, f"{len(stress)} stresses")
    for n, value in enumerate(stress):
        near(value, 100 if n % 6 == 2 else 0, 1e-3, "a stress")
    moves = folder.array("cube.vtu", "displacement [mm]")
    near(max(moves[2::3]), 1000 / 2850, 1e-6, "the greatest displacement along z")
    expect(set(folder.array("cube.vtu", "modulus [MPa]")) == {2850.0}, "a modulus is wrong")


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


def moduli_come_from_attributes(folder):
    """A bar whose modulus grows along z: its ends part by the integral of stress / modulus."""
    folder.write("graded.vcad", 'attribute("stiffness", "100 * exp(z/10)", unit="MPa") ' + CUBE)
    folder.write("slim.json", json.dumps({**PULL, "materials": {"red": {"modulus_mpa": 1, "poissons_ratio": 0}}}))
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


def a_hook_holds_its_coat(folder):
    """The supports hold the 20 N of the example's study and the weight of the bricks, whose densities differ by 3 %."""
    examples = program.SOURCE / "examples"
    events = folder.events(examples / "parametric_hook.vcad", "--study", examples / "studies" / "coat.json",
                           "--cell", "1", "--solve")
    weight = events["model"]["bricks"] * 1.22e-9 * 9810
    near(events["solution"]["reaction_n"][1], 20 + weight, 0.02 * weight, "the reaction")


def wrong_use_is_told(folder):
    def error(*arguments, status=1):
        return folder.run(*arguments, status=status).stderr

    cube = ("cube.vcad", "--cell", "2.5")
    expect("nothing to do" in error(*cube, "--study", "pull.json"), "nothing to do")
    expect(".inp or .vtu" in error(*cube, "--study", "pull.json", "-o", "x.stl"), "ending")
    folder.write("bare.json", json.dumps({"supports": PULL["supports"]}))
    expect('no elastic properties of "red"' in error(*cube, "--study", "bare.json", "--solve"), "properties")
    folder.write("loose.json", json.dumps({"materials": PULL["materials"], "loads": PULL["loads"]}))
    expect("free to move or turn" in error(*cube, "--study", "loose.json", "--solve"), "supports")
    folder.write("odd.json", json.dumps({**PULL, "materials": {"rde": RED}}))
    expect('did you mean "red"?' in error(*cube, "--study", "odd.json", "--solve"), "names")
    folder.write("broken.json", '{"supports": [')
    expect("broken.json:1:" in error(*cube, "--study", "broken.json", "--solve"), "JSON")
    expect("none.json" in error(*cube, "--study", "none.json", "--solve", status=2), "a missing file")
    expect("more than the" in error("cube.vcad", "--study", "pull.json", "--solve", "--memory", "1M", "--cell", "0.5",
                                   status=2), "memory")
    folder.run(*cube, "--study", "pull.json", "-o", "there.inp")
    before = folder.read("there.inp")
    expect("--force" in error(*cube, "--study", "pull.json", "-o", "there.inp", status=2), "overwriting")
    expect(folder.read("there.inp") == before and not list(folder.path.glob("*.part")), "files")


def ctrl_c_ends_it(folder):
    process = subprocess.Popen([folder.ombre, "fea", "mix.vcad", "--study", "pull.json", "--cell", "0.1", "--solve",
                                "-o", "never.vtu"], cwd=folder.path, env=program.environment(), text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    time.sleep(3)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    expect(process.returncode == 130, f"status {process.returncode}")
    expect(not list(folder.path.glob("never*")), "a file is left")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("ombre", type=pathlib.Path)
    ombre = parser.parse_args().ombre.resolve()

    def check(function):
        with tempfile.TemporaryDirectory() as scratch:
            function(Folder(ombre, scratch))

    checks = [bars_stretch_by_hookes_law, results_are_in_the_grid, mixtures_are_drawn_or_mixed,
              moduli_come_from_attributes, decks_are_complete, a_hook_holds_its_coat, wrong_use_is_told, ctrl_c_ends_it]
    return program.check_all([(c.__name__, functools.partial(check, c)) for c in checks])


if __name__ == "__main__":
    raise SystemExit(main())

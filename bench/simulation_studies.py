#!/usr/bin/env python3
"""Simulations of the paper of OpenVCAD (2025), as docs/user/simulation-studies.md shows them.

    python3 bench/simulation_studies.py lattice build/release/apps/ombre/ombre      Section 3.3.1 and Fig. 8
    python3 bench/simulation_studies.py lattice ... --calculix                      rule 2 by CalculiX, too
    python3 bench/simulation_studies.py bar build/release/apps/ombre/ombre          Fig. 7

Tables go to the standard output; --chart FILE.svg draws the lattices' displacement by height. --cell 1 is a small run.
"""
import argparse
import json
import math
import os
import pathlib
import re
import statistics
import struct
import subprocess
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent
LATTICE = SOURCE / "examples" / "studies" / "lattice.vcad"
PRESS = SOURCE / "examples" / "studies" / "press.json"
RULES = ["soft", "along z", "soft middle", "two soft layers", "rigid in each cell's middle"]
COLOURS = ["#d81b60", "#1e88e5", "#004d40", "#ffb300", "#6a1b9a"]
LAYERS = 50

BAR = """
fgrade(["0.5 - x/40", "0.5 + x/40"], [red, blue]) { rectprism((40, 6, 6), red); }
"""
# Without a Poisson's ratio the bar of mean moduli stretches by the integral of 1 / E, here F L ln(10) / (A 900 MPa).
PULL = {"materials": {"red": {"modulus_mpa": 100, "poissons_ratio": 0}, "blue": {"modulus_mpa": 1000, "poissons_ratio": 0}},
        "supports": [{"on": "xmin", "fix": "xyz"}],
        "loads": [{"on": "xmax", "force_n": [10, 0, 0]}]}
EXACT_MJ = 0.5 * 10 * 10 * 40 * math.log(10) / (36 * 900)
SEEDS = 5


def run(command, folder):
    """Events, seconds and the most memory in bytes; of a child alone."""
    start = time.perf_counter()
    with open(folder / "stdout", "wb") as out, open(folder / "stderr", "wb") as err:
        process = subprocess.Popen([str(word) for word in command], stdout=out, stderr=err, cwd=folder)
        _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - start
    if status != 0:
        raise SystemExit("".join((folder / name).read_text()[-2000:] for name in ("stdout", "stderr")))
    events = {}
    for line in (folder / "stdout").read_text().splitlines():
        event = json.loads(line)
        events[event["event"]] = event
    return events, seconds, usage.ru_maxrss * 1024


def array(path, name, kind):
    """The numbers of an array of a .vtu file."""
    data = path.read_bytes()
    tag = re.search(rb'Name="' + re.escape(name.encode()) + rb'" NumberOfComponents="\d+" format="appended" offset="(\d+)"',
                    data)
    begin = data.index(b'<AppendedData encoding="raw">\n_') + 31 + int(tag[1])
    size, = struct.unpack_from("<Q", data, begin)
    return struct.unpack_from(f"<{size // struct.calcsize(kind)}{kind}", data, begin + 8)


def profile(path):
    """How far nodes move down on average, for each layer of a millimetre, from the bottom; None where there are none."""
    heights = array(path, "points", "d")[2::3]
    moves = array(path, "displacement [mm]", "f")[2::3]
    low, high = min(heights), max(heights)
    sums, counts = [0.0] * LAYERS, [0] * LAYERS
    for height, move in zip(heights, moves):
        layer = min(LAYERS - 1, int((height - low) / (high - low) * LAYERS))
        sums[layer] -= move
        counts[layer] += 1
    return [s / n if n else None for s, n in zip(sums, counts)]


def chart(profiles):
    """Displacement to the right, height upwards."""
    left, top, width, height = 60, 20, 420, 360
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + width + 220}" height="{top + height + 50}" '
             'font-family="sans-serif" font-size="13">', '<rect width="100%" height="100%" fill="white"/>']
    for n in range(6):
        x, y = left + width * n / 5, top + height * (1 - n / 5)
        lines.append(f'<path d="M{x:.1f} {top}V{top + height}M{left} {y:.1f}H{left + width}" stroke="#ddd"/>')
        lines.append(f'<text x="{x:.1f}" y="{top + height + 18}" text-anchor="middle">{n}</text>')
        lines.append(f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{10 * n}</text>')
    lines.append(f'<text x="{left + width / 2}" y="{top + height + 40}" text-anchor="middle">moved down, mm</text>')
    lines.append(f'<text transform="translate(18 {top + height / 2}) rotate(-90)" text-anchor="middle">height, mm</text>')
    for n, (name, moves) in enumerate(profiles):
        points = [(left + width * move / 5, top + height * (1 - (layer + 0.5) / LAYERS))
                  for layer, move in enumerate(moves) if move is not None]
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        lines.append(f'<path d="{path}" fill="none" stroke="{COLOURS[n]}" stroke-width="2"/>')
        y = top + 20 + 22 * n
        lines.append(f'<path d="M{left + width + 16} {y}h24" stroke="{COLOURS[n]}" stroke-width="2"/>')
        lines.append(f'<text x="{left + width + 46}" y="{y + 4}">{name}</text>')
    return "\n".join(lines) + "\n</svg>\n"


def threads_of(arguments):
    return ["--threads", arguments.threads] if arguments.threads != "0" else []


def lattices(arguments, folder):
    profiles = []
    print("| rule | bricks | force on top | iterations | time | memory |\n| --- | --- | --- | --- | --- | --- |", flush=True)
    for n, name in enumerate(RULES, 1):
        output = folder / f"{n}.vtu"
        events, seconds, memory = run(
            [arguments.ombre, "fea", LATTICE, "-D", f"rule={n}", "--study", PRESS, "--cell", arguments.cell, "--solve",
             "--tolerance", "1e-6", *threads_of(arguments), "--solver", arguments.solver, "--memory", arguments.memory,
             "--json", "-o", output], folder)
        profiles.append((name, profile(output)))
        print(f"| {name} | {events['model']['bricks']:,.0f} | {top_force(events):.4g} N | "
              f"{events['solution']['iterations']:.0f} | {seconds:.1f} s | {memory / 1e6:,.0f} MB |", flush=True)
    if arguments.chart:
        arguments.chart.write_text(chart(profiles), encoding="utf-8")
    if arguments.calculix:
        beside_calculix(arguments, folder)


def beside_calculix(arguments, folder):
    """Solves the deck of rule 2 by CalculiX, whose C3D8 takes the change of volume point by point and is stiffer."""
    output = folder / "calculix.vtu"
    events, seconds, memory = run([arguments.ombre, "fea", LATTICE, "-D", "rule=2", "--study", PRESS, "--cell", arguments.cell,
                                   "--solve", "--solver", "calculix", "--json", "-o", output], folder)
    theirs, ours = (array(path, "displacement [mm]", "f") for path in (output, folder / "2.vtu"))
    difference = math.dist(theirs, ours) / math.hypot(*theirs)
    print(f"CalculiX, rule 2: {top_force(events):.4g} N, {seconds:.0f} s, {memory / 1e9:.1f} GB; displacements differ by "
          f"{100 * difference:.1f} %")


def top_force(events):
    """Returns the force by the energy, which is half of the force times the 5 mm, since both ends are held."""
    return 2 * events["solution"]["strain_energy_mj"] / 5


def bars(arguments, folder):
    (folder / "bar.vcad").write_text(BAR)
    (folder / "pull.json").write_text(json.dumps(PULL))
    sizes = {"coarse": ["--size", "3"], "adaptive": ["--size-by", "min_cell + h*(max_cell - min_cell)", "--min-cell", "0.8",
                                                     "--max-cell", "3"],
             "medium": ["--size", "1.5"], "fine": ["--size", "0.8"]}
    if arguments.cell != "0.5":
        del sizes["fine"]
    print("| mesh | tetrahedra C3D10 | degrees of freedom | stretch of mean moduli | stretch of draws | their spread | time |\n"
          "| --- | --- | --- | --- | --- | --- | --- |")

    def solve(*options):
        events, seconds, _ = run([arguments.ombre, "fea", "bar.vcad", "--study", "pull.json", "--elements", "tet10", *options,
                                  "--sections", "1000", "--solve", "--json"], folder)
        return events["model"], events["solution"]["strain_energy_mj"] / EXACT_MJ, seconds

    for name, size in sizes.items():
        model, mean, seconds = solve(*size, "--assign", "mix")
        draws = [solve(*size, "--seed", seed)[1] for seed in range(SEEDS)]
        print(f"| {name} | {model['tetrahedra']:,.0f} | {3 * model['nodes']:,.0f} | {100 * (mean - 1):+.2f} % | "
              f"{100 * (statistics.mean(draws) - 1):+.1f} % | {100 * statistics.stdev(draws):.1f} % | {seconds:.1f} s |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=["lattice", "bar"])
    parser.add_argument("ombre", type=pathlib.Path)
    parser.add_argument("--cell", default="0.5", help="size of the lattices' bricks, mm")
    parser.add_argument("--threads", default="0", help="0: all cores")
    parser.add_argument("--solver", default="auto", help="of the lattices: auto, multigrid or direct")
    parser.add_argument("--memory", default="8G", help="that solving a lattice may take")
    parser.add_argument("--chart", type=pathlib.Path)
    parser.add_argument("--calculix", action="store_true")
    arguments = parser.parse_args()
    arguments.ombre = arguments.ombre.resolve()
    if arguments.chart:
        arguments.chart = arguments.chart.resolve()
    with tempfile.TemporaryDirectory() as folder:
        {"lattice": lattices, "bar": bars}[arguments.study](arguments, pathlib.Path(folder))


if __name__ == "__main__":
    main()

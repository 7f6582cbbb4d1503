"""Simulations: solving a block of bricks, asking results, and making tetrahedra beside CGAL alone."""
import dataclasses
import json
import math

import programs
from table import Table, seconds

SIDE_MM = 50
BLOCK = """
difference() { rectprism((50, 50, 50), magenta); sphere(15, magenta); }
sphere(15, gray);
"""
# The ball is ten thousand times as stiff, or as conductive, as the block around it.
STUDIES = {
    "elasticity": {"materials": {"magenta": {"modulus_mpa": 1, "poissons_ratio": 0.3},
                                 "gray": {"modulus_mpa": 10000, "poissons_ratio": 0.3}},
                   "supports": [{"on": "zmin", "fix": "xyz"}, {"on": "zmax", "displacement_mm": [0, 0, -1]}]},
    "heat": {"physics": "heat",
             "materials": {"magenta": {"conductivity_w_mk": 0.1}, "gray": {"conductivity_w_mk": 1000}},
             "supports": [{"on": "zmin", "temperature_c": 0}, {"on": "zmax", "temperature_c": 100}]}}
TOLERANCE = 1e-6
MEMORY = "8G"  # that solving may take

GYROID = "sin(pi/4*x)*cos(pi/4*y) + sin(pi/4*y)*cos(pi/4*z) + sin(pi/4*z)*cos(pi/4*x)"
BALL = "x^2 + y^2 + z^2 - 81"


@dataclasses.dataclass(frozen=True)
class Solid:
    name: str  # as bench_tetrahedra calls it
    formula: str
    volume: float = None  # mm3, where mathematics says it


# Without sharp edges, which CGAL alone would not know of.
SOLIDS = [Solid("ball", BALL, 4 / 3 * math.pi * 9 ** 3), Solid("sponge", f"{BALL} + 30*({GYROID})")]


@dataclasses.dataclass(frozen=True)
class Scale:
    bricks: int  # along each axis
    elements: int  # that are asked
    questions: int
    size_mm: float  # of tetrahedra


SCALES = {"tiny": Scale(12, 1000, 10_000, 3), "quick": Scale(96, 1_000_000, 5_000_000, 0.6),
          "paper": Scale(96, 1_000_000, 20_000_000, 0.4)}
LARGE_BRICKS = 216  # 10,077,696 in all


def solve(ombre, physics, along, threads, scratch):
    design, study = scratch / "block.vcad", scratch / "study.json"
    design.write_text(BLOCK)
    study.write_text(json.dumps(STUDIES[physics]))
    done = programs.run([ombre.path, "fea", design, "--study", study, "--cell", f"{SIDE_MM}/{along}", "--solve",
                         "--tolerance", TOLERANCE, "--memory", MEMORY, "--threads", threads, "--json"])
    events = programs.events_of(done.output)
    solution = events["solution"]
    return {"physics": physics, "bricks": events["model"]["bricks"], "threads": threads,
            "iterations": solution["iterations"], "solving_seconds": solution["seconds"], "seconds": done.seconds,
            "peak_bytes": done.peak_bytes}


def solving(ombre, scale, threads, is_large, scratch):
    table = Table(("solving", 12), ("bricks", 11), ("threads", 7), ("iterations", 10), ("solving\ns", 8),
                  ("whole command\ns", 13), ("peak\nGB", 6))
    rows = []
    for along in [scale.bricks, *([LARGE_BRICKS] if is_large else [])]:
        for physics in STUDIES:
            row = solve(ombre, physics, along, threads, scratch)
            table.row(physics, f"{row['bricks']:,.0f}", threads, f"{row['iterations']:.0f}", seconds(row["solving_seconds"]),
                      seconds(row["seconds"]), f"{row['peak_bytes'] / 1e9:.2f}")
            rows.append(row)
    return rows


def asking(program, scale, threads):
    table = Table(("asking", 12), ("elements", 11), ("threads", 7), ("index\ns", 8), ("at random\nmillion/s", 10),
                  ("along rows\nmillion/s", 10), ("greatest\nerror", 9))
    rows = []
    for count in dict.fromkeys([1, threads]):
        output = programs.run([program, scale.elements, scale.questions, count]).output
        for row in map(json.loads, output.splitlines()):
            table.row(row["kind"], f"{row['elements']:,}", count, seconds(row["index_seconds"]),
                      f"{row['at_random'] / 1e6:.2f}", f"{row['in_rows'] / 1e6:.2f}", f"{row['greatest_error']:.0e}")
            rows.append(row)
    return rows


def our_tetrahedra(ombre, solid, size_mm, scratch):
    design, study, deck = scratch / "solid.vcad", scratch / "study.json", scratch / "solid.inp"
    design.write_text(f'function((-13, -13, -13), (13, 13, 13), "{solid.formula}", material=gray);\n')
    study.write_text(json.dumps(STUDIES["heat"]))
    done = programs.run([ombre.path, "fea", design, "--study", study, "--elements", "tet4", "--size", size_mm, "--json",
                         "-o", deck, "--force"])
    events = programs.events_of(done.output)
    return {"seconds": done.seconds, "tetrahedra": events["model"]["tetrahedra"],
            "volume_mm3": events["model"]["volume_mm3"],
            "least_dihedral_degrees": events["quality"]["least_dihedral_degrees"]}


def tetrahedra(ombre, program, scale, scratch):
    """Times tetrahedra from the design to a deck, beside CGAL alone on the same formula."""
    table = Table(("tetrahedra", 12), ("program", 10), ("seconds", 8), ("count", 9), ("least angle\ndegrees", 11),
                  ("volume\nmm3", 9), ("exact", 9))
    rows = []
    for solid in SOLIDS:
        made = {"ombre": our_tetrahedra(ombre, solid, scale.size_mm, scratch)}
        if program:
            made["CGAL alone"] = json.loads(programs.run([program, solid.name, scale.size_mm]).output)
        for name, row in made.items():
            table.row(solid.name, name, seconds(row["seconds"]), f"{row['tetrahedra']:,.0f}",
                      f"{row['least_dihedral_degrees']:.1f}", f"{row['volume_mm3']:.1f}",
                      f"{solid.volume:.1f}" if solid.volume else "-")
            rows.append({"solid": solid.name, "program": name, **row})
    return rows


def measure(programs_of, size, threads, is_large, scratch):
    scale = SCALES[size]
    results = {"solving": solving(programs_of.ombre, scale, threads, is_large, scratch)}
    if programs_of.results:
        print()
        results["asking"] = asking(programs_of.results, scale, threads)
    print()
    results["tetrahedra"] = tetrahedra(programs_of.ombre, programs_of.tetrahedra, scale, scratch)
    return results

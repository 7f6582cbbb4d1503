#!/usr/bin/env python3
"""Meshes of tetrahedra, and of cells that repeat, by ombre fea.

    python3 tests/run_fea_meshes.py build/dev/apps/ombre/ombre
"""
import json
import math
import shutil

import program
from fea_jobs import PULL, RED, Folder, has_tetrahedra
from program import expect, near


def tetrahedra_reach_the_surface(folder):
    """A cylinder's volume, its quality, and the same bytes with any number of threads; a deck that has its sets."""
    if not has_tetrahedra(folder):
        return
    folder.write("rod.vcad", "cylinder(3, 12, red);")
    study = {**PULL, "supports": [{"on": "zmin", "fix": "xyz", "name": "foot"}]}
    folder.write("rod.json", study)
    command = ("rod.vcad", "--study", "rod.json", "--elements", "tet10", "--size", "1.2")
    events = folder.events(*command, "-o", "rod.inp", "-o", "rod.vtu")
    near(events["model"]["volume_mm3"], math.pi * 9 * 12, 0.03 * math.pi * 9 * 12, "the volume")
    expect(events["quality"]["inverted"] == 0 and events["quality"]["least_dihedral_degrees"] > 5, str(events))
    folder.run(*command, "-o", "again.vtu", "--threads", "1")
    expect((folder.path / "rod.vtu").read_bytes() == (folder.path / "again.vtu").read_bytes(), "bytes differ")
    deck = folder.read("rod.inp")
    expect("*ELEMENT, TYPE=C3D10, ELSET=RED\n" in deck and "*NSET, NSET=FOOT\n" in deck, "the deck")
    expect(max(len(field) for line in deck.splitlines() for field in line.split(",")) <= 40, "a long field")


def tetrahedra_of_any_size_come_to_an_end(folder):
    """Two balls that meet in a groove, with volumes by calculus: whatever the size, the mesher must not go on for ever where
    slivers cannot be mended; a mesh may be too coarse for the curves, but no tetrahedron is inside out."""
    if not has_tetrahedra(folder):
        return
    folder.write("balls.vcad", "union() { sphere(2, red); translate(2.5, 0, 0) sphere(2, red); }")
    folder.write("slab.vcad", "rectprism((20, 5, 2), red);")
    folder.write("held.json", {**PULL, "supports": [{"on": {"where": "1"}, "fix": "xyz"}], "loads": []})

    def mesh(design, size):
        events = folder.events(design, "--study", "held.json", "--elements", "tet4", "--size", size, "-o", "held.inp", "--force")
        expect(events["quality"]["inverted"] == 0, str(events["quality"]))
        return events["model"]["volume_mm3"]

    cap = math.pi * 0.75**2 * (3 * 2 - 0.75) / 3
    balls = 2 * (4 / 3 * math.pi * 2**3 - cap)
    for size, share in (("0.75", 0.04), ("1.25", 0.06), ("2", 0.1), ("2.5", 0.12), ("3.75", 0.18)):
        near(mesh("balls.vcad", size), balls, share * balls, f"the balls' volume at {size}")
    near(mesh("slab.vcad", "3.75"), 20 * 5 * 2, 0.1, "the slab's volume")


def wide_plates_keep_their_edges(folder):
    """Half as thick as elements are large: the box's volume, and a side that can be held."""
    if not has_tetrahedra(folder):
        return
    folder.write("plate.vcad", "rectprism((50, 50, 1), red);")
    folder.write("held.json", {**PULL, "supports": [{"on": "xmin", "fix": "xyz"}], "loads": []})
    job = ("plate.vcad", "--study", "held.json", "--elements", "tet4", "--size", "2", "-o", "held.inp")
    done = folder.run(*job)
    expect("elements are down to 1 mm small beside sharp edges" in done.stderr and "cut off" not in done.stderr, done.stderr)
    expect("0 inverted" in done.stderr and "the surface has 2500 mm3" in done.stderr, done.stderr)
    near(folder.events(*job, "--force")["model"]["volume_mm3"], 2500, 5, "the volume")


GYROID = ('root((-5, -5, -5), (5, 5, 5), (0.5, 0.5, 0.5)) { intersection() { rectprism((10.001, 10.001, 10.001), red); function('
          '"sin(2*pi*x/10)*cos(2*pi*y/10) + sin(2*pi*y/10)*cos(2*pi*z/10) + sin(2*pi*z/10)*cos(2*pi*x/10)", red); } }')


def equations_of(deck):
    """The nodes' places, and each equation as {(node, direction): coefficient}, the nodes of periods as their places."""
    nodes, equations, block = {}, [], ""
    lines = iter(deck.splitlines())
    for line in lines:
        if line.startswith("*"):
            block = line.split(",")[0]
        elif block == "*NODE":
            number, *place = line.split(",")
            nodes[int(number)] = tuple(map(float, place))
        elif block == "*EQUATION":
            count, numbers = int(line), []
            while len(numbers) < 3 * count:
                numbers += [float(word) for word in next(lines).split(",")]
            equations.append({(int(numbers[n]), int(numbers[n + 1])): numbers[n + 2] for n in range(0, 3 * count, 3)})
    return nodes, equations


def cells_that_repeat_fit_their_copies(folder):
    """A gyroid fills half of its cell. Each copy of a node lies whole periods from the node that it is tied to."""
    folder.write("gyroid.vcad", GYROID)
    folder.write("strain.json", json.dumps({"materials": {"red": {"modulus_mpa": 1000, "poissons_ratio": 0}},
                                            "mean_strain": [0.01, 0, 0, 0, 0, 0.02]}))
    kinds = [("--cell", "0.625")]
    if has_tetrahedra(folder):
        kinds += [("--elements", "tet4", "--size", "1"), ("--elements", "tet10", "--size", "1.5")]
    for kind in kinds:
        events = folder.events("gyroid.vcad", "--study", "strain.json", *kind, "-o", "cell.inp", "--force")
        near(events["model"]["volume_mm3"], 500, 3, f"half of the cell by {kind}")
        nodes, equations = equations_of(folder.read("cell.inp"))
        last = max(nodes)
        expect(len(equations) > 300 and len(equations) % 3 == 0, f"{len(equations)} equations")
        for equation in equations:
            (copy, _), (original, _) = list(equation)[:2]
            periods = [-equation.get((last - 2 + axis, list(equation)[0][1]), 0) for axis in range(3)]
            for axis in range(3):
                near(nodes[copy][axis] - nodes[original][axis], 10 * periods[axis], 1e-5, "a copy's place")
    error = folder.run("gyroid.vcad", "--study", "strain.json", "--cell", "1", "--solve", status=1).stderr
    expect("ombre homogenise" in error, error)
    if not shutil.which("ccx"):
        return
    # Layers of two materials, without Poisson's ratio: in series across them, side by side along them.
    folder.write("layers.vcad", "union() { translate(0, 0, 2.5) rectprism((10, 10, 5), red); "
                                "translate(0, 0, -2.5) rectprism((10, 10, 5), blue); }")
    folder.write("strain.json", json.dumps({
        "materials": {"red": {"modulus_mpa": 1000, "poissons_ratio": 0}, "blue": {"modulus_mpa": 100, "poissons_ratio": 0}},
        "mean_strain": [0.01, 0, 0.03, 0.002, 0.004, 0]}))
    events = folder.events("layers.vcad", "--study", "strain.json", "--cell", "2.5", "--solve", "--solver", "calculix")
    side_by_side, in_series = (1000 + 100) / 2, 2 / (1 / 1000 + 1 / 100)
    wanted = (0.01 * side_by_side, 0, 0.03 * in_series, 0.002 * side_by_side / 2, 0.004 * in_series / 2, 0)
    for stress, value in zip(events["mean_stress"]["mpa"], wanted, strict=True):
        near(stress, value, 1e-5, "a mean stress")


def designs_with_rough_edges_come_to_an_end(folder):
    """Slivers of a surface are no edges; where edges lie too close together, a warning says which are cut off."""
    if not has_tetrahedra(folder):
        return
    colours = {name: RED for name in ("red", "clear", "cyan", "magenta")}
    folder.write("held.json", json.dumps({**PULL, "materials": colours, "supports": [{"on": {"where": "1"}, "fix": "xyz"}],
                                          "loads": []}))

    def mesh(design, size):
        result = folder.run(program.SOURCE / "examples" / design, "--study", "held.json", "--elements", "tet4", "--size", size,
                            "-o", "held.inp", "--force")
        expect(" 0 inverted" in result.stdout + result.stderr, result.stderr)
        return result.stderr

    expect("cut off" not in mesh("two_lobes.vcad", "3"), "edges of two lobes are cut off")
    expect("a sharp edge is cut off, since others lie too close" in mesh("mug.vcad", "3"), "no warning")


def adaptive_meshes_cost_less(folder):
    """Fig. 7 of the 2025 paper: a graded bar; small elements where the mixture is even."""
    if not has_tetrahedra(folder):
        return
    folder.write("bar.vcad", 'fgrade(["0.5 + x/40", "0.5 - x/40"], [red, blue]) { rectprism((40, 6, 6), red); }')
    def nodes(*size):
        return folder.events("bar.vcad", "--study", "pull.json", "--elements", "tet4", *size, "-o", "bar.inp",
                             "--force")["model"]["nodes"]
    coarse, fine = nodes("--size", "3"), nodes("--size", "0.8")
    adaptive = nodes("--size-by", "min_cell + h*(max_cell - min_cell)", "--min-cell", "0.8", "--max-cell", "3")
    expect(coarse < 0.5 * adaptive and adaptive < 0.5 * fine, f"{coarse}, {adaptive} and {fine} nodes")


CHECKS = [tetrahedra_reach_the_surface, tetrahedra_of_any_size_come_to_an_end, wide_plates_keep_their_edges,
          cells_that_repeat_fit_their_copies, designs_with_rough_edges_come_to_an_end, adaptive_meshes_cost_less]


if __name__ == "__main__":
    raise SystemExit(program.main(Folder, program.named(CHECKS)))

#!/usr/bin/env python3
"""What `ombre characterise` says of parts and cells, against mathematics.

    python3 tests/run_characterise.py build/dev/apps/ombre/ombre
"""
import csv
import json
import math

import program
from program import expect, near_share as near


def run(folder, design, *arguments, status=0):
    return folder.describe("characterise", design, *arguments, status=status)


def characteristics(folder, design, *arguments):
    return folder.described("characteristics", "characterise", design, *arguments)


def balls_are_round(folder):
    found = characteristics(folder, 'translate([1, 2, 3]) sphere(4, "red");', "--voxel", "0.25")
    near(found["volume_mm3"], 4 / 3 * math.pi * 64, 1e-3, "the volume of a ball")
    near(found["surface_mm2"], 4 * math.pi * 16, 2e-3, "the surface of a ball")
    near(found["density"], math.pi / 6, 1e-3, "the share of a ball in its box")
    near(found["sections"]["z"]["mean"], math.pi / 6, 0.01, "the mean section")
    near(found["sections"]["x"]["greatest"], math.pi / 4, 0.01, "the greatest section")
    expect((found["pieces"], found["euler_number"], found["genus"]) == (1, 1, 0), "the topology of a ball")
    expect(all(abs(a - b) < 1e-6 for a, b in zip(found["centroid"], (1, 2, 3))), "the centroid")
    near(found["surface_mm2"] / found["volume_mm3"], 3 / 4, 4e-3, "surface over volume")
    # 4 V / A of what the ball leaves of its box.
    near(found["hydraulic_diameter_mm"], 4 * (512 - 4 / 3 * math.pi * 64) / (64 * math.pi), 5e-3, "the hydraulic diameter")


def handles_pieces_and_hollows_are_counted(folder):
    ring = characteristics(folder, 'torus(6, 2, "red");', "--voxel", "0.4")
    expect((ring["pieces"], ring["euler_number"], ring["genus"]) == (1, 0, 1), "the topology of a torus")
    near(ring["volume_mm3"], 2 * math.pi ** 2 * 6 * 4, 2e-3, "the volume of a torus")
    near(ring["surface_mm2"], 4 * math.pi ** 2 * 6 * 2, 2e-3, "the surface of a torus")
    hollow = characteristics(folder, 'difference() { sphere(5, "red"); sphere(3, "red"); }', "--voxel", "0.4")
    expect((hollow["pieces"], hollow["hollows"], hollow["euler_number"], hollow["genus"]) == (1, 1, 2, 0), "a hollow ball")
    near(hollow["surface_mm2"], 4 * math.pi * (25 + 9), 3e-3, "both surfaces of a hollow ball")
    two = characteristics(folder, 'translate([-4, 0, 0]) sphere(3, "red"); translate([4, 0, 0]) sphere(3, "red");', "--voxel", "0.5")
    expect((two["pieces"], two["euler_number"], two["genus"]) == (2, 2, 0), "two balls")


def borders_of_materials_have_an_area(folder):
    design = 'translate([-2, 0, 0]) rectprism([4, 4, 6], "red"); translate([2, 0, 0]) rectprism([4, 4, 6], "blue");'
    found = characteristics(folder, design, "--voxel", "0.5")
    expect(len(found["interface_mm2"]) == 1, "one border")
    near(next(iter(found["interface_mm2"].values()))["value"], 24, 1e-3, "the border of the halves")
    near(found["surface_mm2"], 2 * (8 * 4 + 8 * 6 + 4 * 6), 1e-3, "the surface of both together")
    near(found["material_mm3"]["red"]["value"], 96, 1e-3, "the volume of one")


CELLS = "m = box_cells((6, 6, 6), min=(0, 0, 0), max=(6, 6, 6));\n"


def cells_repeat(folder):
    """The Euler characteristic of a gyroid in its cubic cell is -8 (Schroeder-Turk, Fogden, Hyde 2006); a wall about it has
    that, too. Walls on the borders of cells are 1 corner, 3 edges and 3 faces in a cell that repeats: 1. Struts there: -2."""
    def euler(solid):
        return characteristics(folder, CELLS + solid, "--voxel", "0.2", "--periodic", "xyz")["euler_number"]
    expect(euler('tpms("gyroid", map=m, thickness=0.9, material="red");') == -8, "a gyroid")
    expect(euler('tpms("schwarz_p", map=m, thickness=0.9, material="red");') == -4, "Schwarz' P")
    expect(euler('plates(m, "cubic", 1, "red");') == 1, "cubic plates")
    expect(euler('lattice("cubic", radius=0.8, map=m, material="red");') == -2, "cubic struts")


def walls_have_their_thickness(folder):
    found = characteristics(folder, CELLS + 'plates(m, "cubic", 0.8, "red");', "--voxel", "0.1", "--periodic", "xyz")
    near(found["density"], 1 - (1 - 0.8 / 6) ** 3, 1e-3, "the density of plates")
    near(found["surface_mm2"], 6 * 5.2 ** 2, 2e-3, "the surface of the hollow")
    near(found["wall"]["mm"], 0.8, 0.13, "the least wall")
    expect(not found["gap"]["is_found"] and found["gap"]["mm"] <= 5.2, "no narrow gap")
    expect(found["genus"] is None if "genus" in found else True, "no genus of cells that repeat")
    slit = characteristics(folder, 'difference() { rectprism([8, 8, 4], "red"); rectprism([0.6, 6, 9], "red"); }', "--voxel", "0.1")
    near(slit["gap"]["mm"], 0.6, 0.17, "the least gap")
    expect(abs(slit["gap"]["place"][0]) <= 0.3 and slit["genus"] == 1, "the slit's place and handle")
    frame = characteristics(folder, 'difference() { rectprism([8, 8, 4], "red"); rectprism([6, 6, 9], "red"); }', "--voxel", "0.1")
    near(frame["wall"]["mm"], 1.0, 0.11, "the wall of a frame")


def folded_sheets_have_their_slope(folder):
    """A sheet of the thickness t fills t times the slope of its function: 1/c up and down, 2 d/a along the fold, and 4 d s/b across
    where creases zigzag. Sheets along waves are longer than the length from trough to trough."""
    cells = "m = box_cells((6, 8, 5), min=(0, 0, 0), max=(6, 8, 5)); "

    def density(rest):
        return characteristics(folder, cells + f'folds(m, 0.5, 0.4, material="red"{rest});', "--voxel", "0.125", "--periodic", "xyz")["density"]
    near(density(""), 0.5 * math.hypot(1 / 5, 0.8 / 6), 2e-3, "a folded sheet")
    near(density(', creases="zigzag", swing=0.5'), 0.5 * math.hypot(1 / 5, 0.8 / 6, 0.8 / 8), 2e-3, "Miura's fold")
    steps = [2 * math.pi * (n + 0.5) / 1000 for n in range(1000)]
    rise = 0.4 * math.pi * 5 / 6
    length = sum(math.hypot(1, rise * math.cos(a)) for a in steps) / 1000
    near(density(', profile="round"'), 0.5 * length / 5, 4e-3, "a corrugated sheet")
    curved = sum(math.hypot(1 / 5, 0.8 / 6, 0.8 * 0.25 * math.pi * math.cos(a) / 8) for a in steps) / 1000
    near(density(', creases="curved"'), 0.5 * curved, 2e-3, "curved creases")


def thin_struts_have_their_length(folder):
    """Struts of an octet truss with the radius r have about pi r^2 times their length, 12 sqrt 2 cells, less the joints."""
    found = characteristics(folder, CELLS + 'lattice("octet", radius=0.24, map=m, material="red");', "--voxel", "0.08",
                            "--periodic", "xyz")
    thin = math.pi * 0.04 ** 2 * 12 * 2 ** 0.5
    expect(0.82 * thin < found["density"] < thin, f"the density of an octet truss is {found['density']}")
    near(found["wall"]["mm"], 0.48, 0.2, "the thickness of struts")


def stiffness_is_that_of_homogenise(folder):
    study = ("--study", program.SOURCE / "examples" / "studies" / "polyjet.json")
    lines = run(folder, 'rectprism([4, 4, 4], material="red");', "--voxel", "1", "--stiffness", *study, "--json").stdout
    found = next(e for e in map(json.loads, lines.splitlines()) if e["event"] == "homogenised")
    near(found["modulus_mpa"][0], 2850, 1e-6, "Young's modulus")
    command = ("characterise", "design.vcad", "--voxel", "1", "--stiffness", "--picture", "cell.svg", *study)
    folder.run("homogenise", "design.vcad", "--cell", "1", "-o", "same.svg", *study)
    folder.run(*command)
    expect((folder.path / "cell.svg").read_bytes() == (folder.path / "same.svg").read_bytes(), "another picture than homogenise draws")
    expect("cell.svg" in folder.run(*command, status=2).stderr, "an existing picture is not named")
    done = folder.events(*command, "--force", "-o", "all.json")[-1]
    expect(done["files"] == ["cell.svg", "all.json"], f"the files are {done['files']}")


def curves_are_tables(folder):
    design = "wall = 0.5;\n" + CELLS + 'plates(m, "cubic", wall, "red");'
    run(folder, design, "--voxel", "0.3", "--periodic", "xyz", "--sweep", "wall=0.6..1.8:4", "--key", "density", "-o", "curve.csv")
    with open(folder.path / "curve.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row, wall in zip(rows, (0.6, 1.0, 1.4, 1.8), strict=True):
        near(float(row["wall"]), wall, 1e-9, "a value of the wall")
        near(float(row["density"]), 1 - (1 - float(row["wall"]) / 6) ** 3, 2e-3, "the density of a row")
    # The table gives the wall of a wanted density.
    wanted = 1 - (1 - 1.4 / 6) ** 3
    back = CELLS + f'plates(m, "cubic", table("curve.csv", {wanted}), "red");'
    near(characteristics(folder, back, "--voxel", "0.3", "--periodic", "xyz")["density"], wanted, 2e-3, "the density that was wanted")


def wrong_use_is_reported(folder):
    def reported(design, *arguments, status=1):
        return run(folder, design, *arguments, status=status).stderr
    ball = 'sphere(2, "red");'
    expect("thickness=0.2..1:9" in reported(ball, "--voxel", "0.5", "--sweep", "a=1:2", "-o", "a.csv"), "a wrong curve")
    expect("xyz" in reported(ball, "--voxel", "0.5", "--periodic", "q"), "a wrong axis")
    expect("at most 4096" in reported(ball, "--voxel", "0.00001"), "too many voxels")
    expect("no voxel of the box is solid" in reported(ball, "--voxel", "0.5", "--box=8,8,8,9,9,9"), "nothing there")
    expect("--sweep" in reported(ball, "--voxel", "0.5", "-o", "a.csv"), "a table without rows")
    expect('no variable "wal"' in reported("wall = 2;\nsphere(wall);", "--voxel", "0.5", "--sweep", "wal=1..2:3", "-o", "a.csv"), "a misspelt variable")
    expect('no column "dens"' in reported("wall = 2;\nsphere(wall);", "--voxel", "0.5", "--sweep", "wall=1..2:3", "--key", "dens", "-o", "a.csv"),
           "a misspelt column")
    expect("fewer than 5 voxels" in reported(CELLS + 'plates(m, "cubic", 1, "red");', "--voxel", "0.5", status=0), "large voxels")
    expect("unbounded" in reported('tpms("gyroid", material="red");', "--voxel", "1"), "no box")


def wrong_use_is_reported_before_anything_is_measured(folder):
    folder.write("heat.json", {"physics": "heat", "materials": {"red": {"conductivity_w_mk": 1}}})
    curve = ["--sweep", "wall=1..2:3", "-o", "a.csv"]
    for arguments, words in (
            (["--stiffness"], 'no elastic properties of "red"'),
            (["--stiffness", "-o", "a.json"], 'no elastic properties of "red"'),
            (["--stiffness", *curve], 'no elastic properties of "red"'),
            (["--stiffness", "--study", "heat.json", "--picture", "h.svg"], "--picture h.svg is a chart of stiffness"),
            ([*curve, "--key", "densty"], 'did you mean "density"?'),
            (["--stiffness", *curve, "--key", "modulus"], 'no column "modulus"')):
        said = run(folder, "wall = 2;\nsphere(wall);", "--voxel", "0.5", *arguments, status=1).stderr
        expect(words in said and "volume " not in said and ": density" not in said, f"{arguments}: {said}")


def random_cells_are_counted(folder):
    """Points of a body-centred lattice have truncated octahedra as cells: 14 faces, 36 edges of sqrt(2)/4 of its side."""
    design = ("points = [for (i = [0:3], j = [0:3], k = [0:3], off = [0, 0.5]) [4*(i + off), 4*(j + off), 4*(k + off)]];\n"
              'translate(5, 0, 0) voronoi_struts(points, 0.4, region=rectprism((8, 8, 8)), material="red");')
    (foam,) = characteristics(folder, design, "--voxel", "0.4")["random_cells"]
    expect((foam["node"], foam["line"], foam["points"]) == ("voronoi_struts", 2, 128), foam)
    # Cells at the rim and those beside them do not count.
    expect(foam["cells"] >= 1 and (foam["faces"]["least"], foam["faces"]["greatest"]) == (14, 14), foam)
    near(foam["volume_mm3"]["mean"], 32, 1e-6, "the volume of a cell")
    near(foam["edges_of_face"], 72 / 14, 1e-6, "the edges of a face")
    near(foam["edge_mm"], 2 ** 0.5, 1e-6, "the length of an edge")
    folder.write("foam.vcad", design)
    expect("128 points" in folder.run("characterise", "foam.vcad", "--voxel", "0.4").stderr, "no cells in the text")


def graphs_of_cells_are_counted(folder):
    """Coordination numbers and Maxwell numbers b - 3 j + 6 of single cells: Deshpande, Ashby, Fleck 2001; octet 36 - 3*14 + 6,
    bcc 8 - 3*9 + 6, cubic 12 - 3*8 + 6. In each repeating cell there are as many struts as half the degrees of its joints."""
    wanted = {"cubic": (1, 6, 1, -6), "bcc": (2, 8, 3 ** 0.5 / 2, -13), "octet": (4, 12, 0.5 ** 0.5, 0),
              "kelvin": (12, 4, 0.125 ** 0.5, -30), "diamond": (8, 4, 3 ** 0.5 / 4, None)}
    for name, (joints, degree, length, maxwell) in wanted.items():
        (found,) = characteristics(folder, CELLS + f'lattice("{name}", radius=0.5, map=m, material="red");', "--voxel", "0.5")["lattices"]
        expect((found["joints"], found["joints_of_degree"]) == (joints, {str(degree): joints}), found)
        expect(found["struts"] == joints * degree / 2 and found["repeats"], found)
        near(found["length_mm"]["mean"], 6 * length, 1e-9, "the length of a strut")
        near(found["slenderness"]["least"], 2 * 6 * length / 0.5, 1e-9, "the slenderness of a strut")
        expect(maxwell is None or found["maxwell"] == maxwell, found)
    pipe = 'p = cylinder_cells(4, 8, 4, count=(8, 1, 1)); lattice("bcc", radius=0.6, map=p, material="red");'
    (bent,) = characteristics(folder, pipe, "--voxel", "0.8")["lattices"]
    expect((bent["joints"], bent["struts"], bent["maxwell"]) == (2, 8, -13) and "length_mm" not in bent, bent)
    expect(bent["lengths_left_out"] == "cells are bent", bent)


def graphs_of_edges_are_counted(folder):
    """A tetrahedron is just rigid: 6 - 3*4 + 6 = 0. A strut in two pieces is one strut."""
    design = """corners = [[0, 0, 0], [8, 0, 0], [0, 8, 0], [0, 0, 8]];
lattice(edges=[for (i = [0:3]) for (j = [i + 1:3]) [corners[i], corners[j]]], radius=0.5, material="red");
translate(20, 0, 0) lattice(edges=[[(0, 0, 0), (3, 0, 0)], [(3, 0, 0), (8, 0, 0)]], radius="0.5 + 0.1*sin(10*t)", material="red");"""
    tetrahedron, line = characteristics(folder, design, "--voxel", "0.5")["lattices"]
    expect((tetrahedron["joints"], tetrahedron["struts"], tetrahedron["maxwell"]) == (4, 6, 0), tetrahedron)
    expect(tetrahedron["joints_of_degree"] == {"3": 4} and not tetrahedron["repeats"], tetrahedron)
    expect((line["joints"], line["struts"], line["length_mm"]["mean"]) == (2, 1, 8) and "slenderness" not in line, line)
    folder.write("graph.vcad", design)
    expect("4 joints and 6 struts" in folder.run("characterise", "graph.vcad", "--voxel", "0.5").stderr, "no graph in the text")


def graphs_are_those_of_the_design(folder):
    """A pyramid of the height 5 on a square of 6 has edges of sqrt(9 + 9 + 25). Twice as large, a strut is twice as long. Three
    struts that cross are six, and one that closes in its cell has one joint there."""
    use = "use <ombre/cellular.vcad>\nintersection() { cube(18); pyramidal_truss(6, 5, 0.5); }"
    (pyramid,) = characteristics(folder, use, "--voxel", "0.5")["lattices"]
    expect((pyramid["struts"], pyramid["joints_of_degree"]) == (4, {"4": 2}), pyramid)
    near(pyramid["length_mm"]["mean"], 43 ** 0.5, 1e-9, "the edge of a pyramid")
    (twice,) = characteristics(folder, 'scale(1, 1, 2) lattice("cubic", (6, 6, 6), 0.5);', "--voxel", "0.5")["lattices"]
    expect((twice["length_mm"]["least"], twice["length_mm"]["greatest"]) == (6, 12) and "slenderness" not in twice, twice)
    expect(twice["slenderness_left_out"] == "the scale is not the same along all axes", twice)
    cross = "[[(-5, 0, 0), (5, 0, 0)], [(0, -5, 0), (0, 5, 0)], [(0, 0, -5), (0, 0, 5)]]"
    (star,) = characteristics(folder, f"lattice(edges={cross}, radius=0.5);", "--voxel", "0.5")["lattices"]
    expect((star["joints"], star["struts"], star["joints_of_degree"]) == (7, 6, {"1": 6, "6": 1}), star)
    line = CELLS + "lattice(edges=[[(0, 0.5, 0.5), (1, 0.5, 0.5)]], radius=0.5, map=m);"
    (closed,) = characteristics(folder, line, "--voxel", "0.5")["lattices"]
    expect((closed["joints_of_degree"], closed["struts"], closed["length_mm"]["mean"]) == ({"2": 1}, 1, 6), closed)


CHECKS = [graphs_of_cells_are_counted, graphs_of_edges_are_counted, graphs_are_those_of_the_design, random_cells_are_counted, balls_are_round, handles_pieces_and_hollows_are_counted, borders_of_materials_have_an_area, cells_repeat,
          walls_have_their_thickness, folded_sheets_have_their_slope, thin_struts_have_their_length, stiffness_is_that_of_homogenise, curves_are_tables,
          wrong_use_is_reported, wrong_use_is_reported_before_anything_is_measured]


if __name__ == "__main__":
    raise SystemExit(program.main(program.Folder, program.named(CHECKS)))

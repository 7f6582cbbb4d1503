#!/usr/bin/env python3
"""Meshes, made as a user would and judged by CGAL.

    python3 tests/run_meshes.py build/dev/apps/ombre/ombre [--checkers build/dev/tests/mesh_checker] [NAME...]

A NAME is that of an example, or of one of the checks below; "checks" are all of these.
"""
import argparse
import functools
import json
import pathlib
import re
import subprocess
import zipfile

import processes
import program
from program import expect

EXAMPLES = sorted((program.SOURCE / "examples").glob("*.vcad"))
# Pairs of facets that lie in a line, and cross once files round their corners to floats.
MOST_CROSSING = 20
# Waves along x of the wing shrink to 0.006 mm, finer than any cells: among them facets cross, and ombre mesh says so. Struts of
# joined lattices graze one another along many lines.
MORE_CROSSING = {"graded_wing": 2000, "joined_lattices": 60}
# Without large faces along the layers: their voxels are right within 0.05 %, and meshes are to be within 0.1 %.
CURVED = {"bcc_ball", "conformal_ring", "graded_wing", "tetrahedron", "unit_cells", "voronoi_foam"}
# Too many facets for CGAL at the tolerance that is usual for their sizes; mm.
COARSE = {"bcc_ball": 0.04, "beam_lattice": 0.09, "conformal_ring": 0.08, "grading_strategies": 0.1, "graded_wing": 0.1,
          "gyroid_block": 0.06, "organic_lattice": 0.1, "part_of_graded_wing": 0.03, "tweel": 0.2, "unit_cells": 0.1, "voronoi_foam": 0.05}
# At coarser tolerances some rims of thin walls, which end in feather edges, lie farther off between the mesher's samples.
FEATHERED = {"dense_pipe": 0.06}
# A part of each is tested, since cells for the size of the whole are too coarse for its thin walls, or take minutes. The
# first text of a pair becomes the second.
CUT = {"helmet": [("difference() {\n  sphere(96", 'intersection(materials = "first") {\ndifference() {\n  sphere(96'),
                  ("rectprism((200, 200, 200));\n}", "rectprism((200, 200, 200));\n}\ntranslate(0, 80, 40) cube(40);\n}")],
       "ski": [('results("models/', f'results("{program.SOURCE}/examples/models/'),
               ("  rotate(90, 0, 0)", "  translate(100, 0, 8) rectprism((36, 40, 30));\n  rotate(90, 0, 0)")],
       "helmet_liner": [("difference() {\n  union(", 'intersection(materials = "first") {\ndifference() {\n  union('),
                        ("cube(150);\n}", "cube(150);\n}\ntranslate(0, -70, 75) cube(50);\n}")]}
# Void is one of their materials; the program that compares surfaces looks at the solids without it.
WITH_VOID = {"bone", "helmet", "paddle", "ski", "tweel"}
# Cells that see waves across the whole wing, 0.1 mm at its tip; mm.
CELLS = {"graded_wing": 0.05}
BAR = 'fgrade(["x/20 + 0.5", "0.5 - x/20"], ["red", "blue"]) { rectprism(20, 10, 5); }'


class Meshes(program.Folder):
    """A folder with a design in it."""

    def __init__(self, checker, comparer, ombre, scratch):
        super().__init__(ombre, scratch)
        self.checker, self.comparer = checker, comparer
        self.write("bar.vcad", BAR)

    def mesh(self, *arguments, design="bar.vcad", **options):
        return self.run("mesh", design, *arguments, **options)

    def bodies(self, *arguments, **options):
        for line in self.mesh(*arguments, "--json", **options).stdout.splitlines():
            if json.loads(line)["event"] == "bodies":
                return json.loads(line)
        raise AssertionError("no bodies were reported")

    def judged(self, name):
        done = program.run([self.checker, name], cwd=self.path)
        expect(done.returncode == 0, done.stderr)
        return json.loads(done.stdout)

    def compared(self, design, name, tolerance):
        """Both sides of the Hausdorff distance between a design's surface and its mesh, at samples."""
        done = program.run([self.comparer, design, name, tolerance], cwd=self.path)
        expect(done.returncode == 0, done.stderr)
        return json.loads(done.stdout)


def near(a, b, share, what):
    expect(abs(a - b) <= share * abs(b), f"{what}: {a}, expected {b}")


def is_as_near_as_requested(design, meshes, tolerance):
    for way, side in meshes.compared(design, "part.off", tolerance).items():
        expect(side["samples"] > 10_000, f"{way}: {side}")
        expect(side["farthest_mm"] <= (1 + 1e-6) * tolerance, f"{way}: {side}, tolerance {tolerance}")
        expect(side["beyond"] == 0, f"{way}: {side}, tolerance {tolerance}")


def with_changes(design, changes, meshes):
    """Returns the path of an example with texts of it replaced."""
    text = design.read_text(encoding="utf-8")
    for before, after in changes:
        expect(text.count(before) == 1, before)
        text = text.replace(before, after)
    return meshes.write(f"part_of_{design.name}", text)


def is_closed_and_as_large_as_its_voxels(whole, meshes):
    """A mesh beside the same design's voxels, of which faces along the layers may gain or lose half a layer."""
    design = with_changes(whole, CUT[whole.stem], meshes) if whole.stem in CUT else whole
    coarse = [f"--{name}={sizes[design.stem]}"
              for name, sizes in [("tolerance", COARSE), ("tolerance", FEATHERED), ("cell", CELLS)] if design.stem in sizes]
    bodies = meshes.bodies("-o", "part.off", *coarse, design=design)
    expect(len(bodies["bodies"]) == 1, str(bodies))
    expect(bodies["farthest_in_tolerances"] == 1, str(bodies))
    (body,) = bodies["bodies"]
    if meshes.checker:
        found = meshes.judged("part.off")
        expect(found["manifold"] and found["closed"], str(found))
        near(found["volume"], body["volume_mm3"], 1e-5, "CGAL's volume")
        expect(found["intersections"] <= MORE_CROSSING.get(design.stem, MOST_CROSSING), str(found))
    if meshes.comparer and whole.stem not in WITH_VOID:
        is_as_near_as_requested(design, meshes, bodies["tolerance_mm"])
    pitch = (body["volume_mm3"] / 3e7) ** (1 / 3)
    reported = meshes.events("slice", design, "-o", "slices", "--voxel", f"{pitch:.4f}")
    voxels = sum(m["volume_mm3"] for event in reported if event["event"] == "done" for m in event["materials"])
    error = 1.5e-3 * voxels if design.stem in CURVED else body["area_mm2"] * pitch / 4 + 1e-3 * voxels
    expect(abs(voxels - body["volume_mm3"]) < error, f"{body}, {voxels} mm3 of voxels of {pitch} mm")


def wing_is_right_where_cells_can_follow_it(meshes):
    """Up to x = 6 mm of 23, where its waves are 0.88 mm long."""
    part = with_changes(program.SOURCE / "examples/graded_wing.vcad",
                        [("(23, 5, 3)", "(6, 5, 3)"), ("models/", f"{program.SOURCE}/examples/models/")], meshes)
    is_closed_and_as_large_as_its_voxels(part, meshes)


def bands_fill_the_whole(meshes):
    for name, arguments in [("stl", []), ("off", ["--by", "red", "--borders", "0.25,0.5,0.75"])]:
        reported = meshes.bodies("-o", "bands." + name, "--bands" if not arguments else "--keep-all",
                             *(["4"] if not arguments else []), *arguments)
        expect([round(b["volume_mm3"], 4) for b in reported["bodies"]] == [250] * 4, str(reported))
        names = [b["name"] for b in reported["bodies"]]
        expect(names == ["red below 25 %", "red 25 to 50 %", "red 50 to 75 %", "red from 75 %"], str(names))


def materials_get_a_body_each(meshes):
    reported = meshes.bodies("-o", "materials.3mf", "--by", "materials")
    expect([b["name"] for b in reported["bodies"]] == ["red", "blue"], str(reported))
    for body in reported["bodies"]:
        near(body["volume_mm3"], 500, 1e-6, body["name"])


def extruders(path):
    with zipfile.ZipFile(path) as archive:
        config = archive.read("Metadata/Slic3r_PE_model.config").decode()
    return re.findall('key="extruder" value="([^"]*)"', config)


def materials_are_not_joined_in_silence(meshes):
    """Without --by: a body for each material, bands of mixtures; a warning where a file cannot hold bodies."""
    (meshes.path / "two.vcad").write_text('part("left") translate(-5, 0, 0) cube(10, "red");\n'
                                            'part("right") translate(5, 0, 0) cube(10, "blue");', encoding="utf-8")
    for ending in ("amf", "glb", "obj", "3mf"):
        flavour = ["--flavour", "prusa"] if ending in ("amf", "3mf") else []
        result = meshes.mesh("-o", "two." + ending, *flavour, design="two.vcad")
        if "without libzip" in result.stderr:
            return "skipped: no libzip"
        for name in ("red", "blue"):
            expect(f"{name}: 12 triangles, 1000 mm3" in result.stderr, result.stderr)
    expect(extruders(meshes.path / "two.3mf") == ["1", "2"], "materials have no extruders of their own")
    meshes.mesh("-o", "parts.3mf", "--by", "parts", "--flavour", "prusa", design="two.vcad")
    expect(extruders(meshes.path / "parts.3mf") == ["1", "2"], "parts have no extruders of their own")
    for ending in ("stl", "ply", "off"):
        result = meshes.mesh("-o", "two." + ending, design="two.vcad")
        expect(result.stderr.count("warning") == 1 and "red, blue are joined" in result.stderr, result.stderr)
        expect("ends in .3mf, .amf, .glb, .obj, or --by" in result.stderr, result.stderr)
        result = meshes.mesh("-o", "two." + ending, "--by", "whole", "--force", design="two.vcad")
        expect("warning" not in result.stderr and "2000 mm3" in result.stderr, result.stderr)
    for ending in ("stl", "ply", "off"):
        result = meshes.mesh("-o", "two." + ending, "--by", "materials", "--force", design="two.vcad")
        expect("2 bodies are joined: two." + ending + " cannot say which triangles are whose" in result.stderr, result.stderr)
    whole = meshes.bodies("-o", "whole.3mf", "--by", "whole", design="two.vcad")
    expect([round(b["volume_mm3"], 3) for b in whole["bodies"]] == [2000], str(whole))
    result = meshes.mesh("-o", "bar.3mf")
    expect("mixtures of red, blue become bodies by bands" in result.stderr, result.stderr)
    expect(result.stderr.count(", 250 mm3") == 4, result.stderr)


def many_cells_are_coarser(meshes):
    """Two walls of a gyroid in 20 mm would have a million cells of 0.08 mm; a block of planes keeps its thousandth."""
    (meshes.path / "gyroid.vcad").write_text('intersection(materials="first") { '
                                               'tpms("gyroid", cell=(10, 10, 10), thickness=1); cube(20); }', encoding="utf-8")
    result = meshes.mesh("-o", "gyroid.stl", design="gyroid.vcad")
    expect("within 0.06 mm of each other; a smaller --tolerance takes longer" in result.stderr, result.stderr)
    (meshes.path / "block.vcad").write_text("rotate(0, 0, 30) rectprism(20, 12, 8);", encoding="utf-8")
    result = meshes.mesh("-o", "block.stl", design="block.vcad")
    expect("part: 12 triangles, 1920 mm3, 992 mm2\n" in result.stderr, result.stderr)
    expect("within 0.02 mm of each other\n" in result.stderr, result.stderr)


def steps_have_borders(meshes):
    """Beyond the step both fractions are the same, and the first material wins."""
    (meshes.path / "step.vcad").write_text('fgrade(["if(x < 0.1, 0, 0.5)", "if(x < 0.1, 1, 0.5)"], ["red", "blue"]) '
                                             'cube(10);', encoding="utf-8")
    reported = meshes.bodies("-o", "step.off", "--by", "materials", "--cell", "0.3", design="step.vcad")
    for body, volume in zip(reported["bodies"], (490, 510), strict=True):
        near(body["volume_mm3"], volume, 1e-4, body["name"])


def materials_come_back(meshes):
    """What a mesh file says of materials, read into a design again, by volumes and at points."""
    (meshes.path / "ball.vcad").write_text('union(materials="first") { translate(1, 2, 2) sphere(4, "red"); '
                                             'rectprism(12, 10, 8, "blue"); }', encoding="utf-8")
    points = ["--at=1,2,2", "--at=4.5,2,2", "--at=5.5,4,3", "--at=1,2,5.5", "--at=-4,-4,-3", "--at=5,4.5,4.5"]
    materials = [["red"], ["red"], ["blue"], ["red"], ["blue"], []]
    for name, rule in [("ball.3mf", "names"), ("ball.amf", "names"), ("ball.obj", "names"), ("ball.3mf", "colours"),
                       ("prusa.3mf", "names"), ("bambu.3mf", "colours")]:
        # Projects stand in the middle of a bed, on z=0; the box of the ball and the block is centred on (0, 0.5).
        flavour, back = {"prusa.3mf": (["--flavour", "prusa"], "translate(-100, -99.5, -4) "),
                         "bambu.3mf": (["--flavour", "bambu"], "translate(-128, -127.5, -4) ")}.get(name, ([], ""))
        reported = meshes.bodies("-o", name, "--by", "materials", "--force", "--tolerance", "0.05", *flavour,
                             design="ball.vcad")
        again = meshes.path / "again.vcad"
        again.write_text(f'{back}mesh("{name}", "gray", materials="{rule}");', encoding="utf-8")
        found = meshes.events("probe", again, *points)
        expect([list(point["composition"]) for point in found] == materials, f"{name}: {found}")
        (done,) = [event for event in meshes.events("slice", again, "-o", "again", "--voxel", "0.1", "--force")
                   if event["event"] == "done"]
        voxels = {material["name"]: material["volume_mm3"] for material in done["materials"]}
        expect(set(voxels) == {"red", "blue"}, f"{name}: {voxels}")
        for body in reported["bodies"]:
            near(voxels[body["name"]], body["volume_mm3"], 2e-3, f"{body['name']} of {name}")


def slicers_get_settings_of_each_band(meshes):
    if "without libzip" in meshes.mesh("-o", "seat.3mf", "--bands", "4", "--flavour", "prusa", "--setting",
                                       "fill_density=10%..70%", "--setting", "perimeters=1,2,3,4").stderr:
        return "skipped: no libzip"
    with zipfile.ZipFile(meshes.path / "seat.3mf") as archive:
        config = archive.read("Metadata/Slic3r_PE_model.config").decode()
    for key, values in [("fill_density", ["10%", "30%", "50%", "70%"]), ("perimeters", ["1", "2", "3", "4"]),
                        ("extruder", ["1", "1", "1", "1"])]:
        found = re.findall(f'key="{key}" value="([^"]*)"', config)
        expect(found == values, f"{key}: {found}")
    return ""


def slips_get_remedies(meshes):
    for arguments, message in [(["-o", "b.png"], "does not say a format"),
                               (["--tolerance", "fine"], "write for example --tolerance 0.05"),
                               (["--by", "materials", "--bands", "3"], "has no bands"),
                               (["--by", "gold"], 'no attribute "gold"'),
                               (["--by", "green"], 'no material "green"'),
                               (["--borders", "0.5,0.2"], "not rising numbers"),
                               (["--setting", "fill"], "write for example --setting"),
                               (["--bands", "4", "--setting", "perimeters=1,2"], "lists 2 values, and there are 4"),
                               (["--cell", "0.0000001"], "too small")]:
        error = meshes.mesh(*arguments, status=1).stderr
        expect(message in error, f"{arguments}: {error}")
    expect(meshes.names() == ["bar.vcad"], str(meshes.names()))


def files_are_kept(meshes):
    (meshes.path / "bar.3mf").write_text("mine")
    error = meshes.mesh(status=2).stderr
    expect("bar.3mf exists already" in error, error)
    error = meshes.mesh("-o", "missing/bar.stl", status=2).stderr
    expect("missing" in error, error)
    expect(meshes.names() == ["bar.3mf", "bar.vcad"], str(meshes.names()))


def interrupts_leave_nothing(meshes):
    job = subprocess.Popen(meshes.command("mesh", "bar.vcad", "-o", "bar.stl", "--cell", "0.005",
                                          "--memory", "1T"), cwd=meshes.path,
                           env=program.environment(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                           stderr=subprocess.PIPE, text=True)
    processes.wait_for_work(job, 1)
    processes.interrupt(job)
    expect(meshes.names() == ["bar.vcad"], str(meshes.names()))


def memory_is_reported_and_kept(meshes):
    result = meshes.mesh("-o", "bar.stl", "--cell", "0.005", "--json", status=1)
    events = [json.loads(line) for line in result.stdout.splitlines()]
    (plan,) = [event for event in events if event["event"] == "plan"]
    cells = 2 * (20 * 10 + 10 * 5 + 5 * 20) / 0.005**2  # of the bar's surface
    expect(abs(plan["cells"] / cells - 1) < 0.1, str(plan))
    (message,) = [event["message"] for event in events if event["event"] == "message"]
    expect("more than the 4 GiB allowed" in message, message)
    expect(meshes.names() == ["bar.vcad"], str(meshes.names()))


def thin_parts_are_reported(meshes):
    (meshes.path / "thin.vcad").write_text("translate(0, 0, 0.013) rectprism((100, 100, 0.05));\n"
                                             "translate(0, 0, 20) cube(10);", encoding="utf-8")
    result = meshes.mesh("-o", "thin.stl", design="thin.vcad")
    expect("thinner than the cells of 0.4 mm is missing" in result.stderr, result.stderr)
    (meshes.path / "thin.stl").unlink()
    result = meshes.mesh("-o", "thin.stl", "--cell", "2", "--tolerance", "1", design="bar.vcad")
    expect("missing" not in result.stderr, result.stderr)


CHECKS = [wing_is_right_where_cells_can_follow_it, bands_fill_the_whole, materials_get_a_body_each,
          materials_are_not_joined_in_silence, many_cells_are_coarser, steps_have_borders,
          materials_come_back, slicers_get_settings_of_each_band, slips_get_remedies, files_are_kept,
          interrupts_leave_nothing, memory_is_reported_and_kept, thin_parts_are_reported]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ombre", type=pathlib.Path)
    parser.add_argument("names", nargs="*", help="only these")
    parser.add_argument("--checkers", type=pathlib.Path, help="the folder of check_mesh and compare_mesh")
    given = parser.parse_intermixed_args()
    checkers = [given.checkers and given.checkers.resolve() / name for name in ("check_mesh", "compare_mesh")]
    checks = {design.stem: functools.partial(is_closed_and_as_large_as_its_voxels, design) for design in EXAMPLES}
    checks |= program.named(CHECKS)
    if "checks" in given.names:
        checks = program.named(CHECKS)
    elif given.names:
        checks = {name: checks[name] for name in given.names}
    return program.check_in_folders(functools.partial(Meshes, *checkers), given.ombre.resolve(), checks)


if __name__ == "__main__":
    raise SystemExit(main())

#!/usr/bin/env python3
"""Jobs as processes: Ctrl-C is answered after little work, --threads 1 means one busy thread, at any moment of any job, and
--memory is kept or reported.

    python3 tests/run_processes.py build/dev/apps/ombre/ombre [NAME or group...]
"""
import json
import subprocess

import processes
import program
from program import expect
from slice_jobs import SUPPORTS, Job

# A surface that fills its box, which all jobs must look at everywhere.
FOAM = """fgrade(["0.5 + x/120", "0.5 - x/120"], ["red", "blue"]) {
  intersection(materials="first") {
    rectprism((60, 60, 60), red);
    function("sin(2*x)*cos(2*y) + sin(2*y)*cos(2*z) + sin(2*z)*cos(2*x) - 0.3*sin(5*x)*sin(5*y)*sin(5*z)");
  }
}
"""
# A block whose materials are smoothed by large kernels in a row, or sorted out as a whole.
BLURRED = "gaussian(sigma_voxels=(10, 10, 10)) gaussian(sigma_voxels=(10, 10, 10)) {\n" + FOAM + "}\n"
SMOOTHED = "smooth(sigma_voxels=(8, 8, 8)) {\n" + FOAM + "}\n"
MEDIAN = "median(\"density\", (9, 9, 9)) attribute(\"density\", \"sin(x*y*z)\") {\n" + FOAM + "}\n"
DISTANCES = "redistance(3, pitch=(0.25, 0.25, 0.25)) {\n" + FOAM + "}\n"
PARTS = "keep_parts(\"largest\", pitch=(0.2, 0.2, 0.2)) {\n" + FOAM + "}\n"
SCAN = """volume_solid("scan.nrrd", level=0.5);\n"""
# Many exact booleans, one after the other; and one that is a single call of the kernel.
SCREWS = """for (i = [0:400]) difference() {
  translate([i, i % 7, 0]) rotate([i, 2*i, 3*i]) sphere(5, $fn = 40);
  translate([i, 0, 0]) cylinder(h = 30, r = 2, center = true, $fn = 50);
}
"""
SUM = "minkowski() { difference() { cube(20); sphere(12, $fn = 60); } sphere(3, $fn = 60); }\n"
# A bar whose width is searched for by solutions that take a second each, or which is a block for a topology.
SLOW_BAR = "width = 20;\nrectprism((width, 20, 60), red);\n"
BLOCK = "rectprism((40, 40, 40), red);\n"
STUDY = {"materials": {name: {"modulus_mpa": 2000, "poissons_ratio": 0.3} for name in ("red", "blue", "white")},
         "supports": [{"on": "zmin", "fix": "xyz"}], "loads": [{"on": "zmax", "force_n": [0, 0, -10]}]}

TOPOLOGY = {"topology": {"volume_fraction": 0.3, "radius": 2}, "fea": STUDY, "cell": 1}
SEARCH = {"variables": {"width": {"from": 10, "to": 40}}, "objectives": [{"minimise": "mass"}],
          "constraints": [{"measure": "displacement", "at_most": 0.001}],
          "fea": {**STUDY, "materials": {"red": {**STUDY["materials"]["red"], "density_kg_m3": 1180}}}, "cell": 0.5}

# Jobs that take half a minute or more on one thread, and when they are stopped, in seconds of processor time.
JOBS = {
    "slice": (FOAM, ["slice", "--voxel", "0.03", "-o", "out"], (0.3, 2)),
    "slice_of_supports": (SUPPORTS, ["slice", "--voxel", "0.03", "-o", "out"], (0.3, 2)),
    "voxels": (FOAM, ["voxels", "--voxel", "0.03", "--what", "distance,fractions", "-o", "out.npy"], (0.3, 2)),
    "voxels_of_supports": (SUPPORTS, ["voxels", "--voxel", "0.03", "-o", "out.vdb"], (0.3, 2)),
    "mesh": (FOAM, ["mesh", "--cell", "0.3", "-o", "out.stl"], (0.3, 2)),
    "render": (FOAM, ["render", "--size", "6000x6000", "-o", "out.png"], (0.3, 2)),
    "render_of_a_slice": (FOAM, ["render", "--size", "16000x16000", "--slice", "z=0", "-o", "out.png"], (0.3, 2)),
    "contours": (FOAM, ["contours", "--cell", "0.02", "--layer-height", "0.02", "-o", "out"], (0.3, 2)),
    "layer": (FOAM, ["layer", "--voxel", "0.001", "--z", "0", "-o", "out.png"], (0.3, 2)),
    "layer_of_supports": (SUPPORTS, ["layer", "--voxel", "0.02", "--z", "0", "-o", "out.png"], (0.3, 2)),
    # Its solver checks between iterations, each of which takes longer with more bricks.
    "fea": (FOAM, ["fea", "--study", "study.json", "--cell", "1", "--solve", "-o", "out.vtu"], (0.3, 1)),
    "homogenise": (FOAM, ["homogenise", "--study", "study.json", "--cell", "0.5"], (0.3, 2)),
    "search": (SLOW_BAR, ["optimise", "--study", "search.json", "-o", "out"], (0.3, 2)),
    "topology": (BLOCK, ["optimise", "--study", "topology.json", "-o", "out"], (0.3, 2)),
    "halo_stages": (BLURRED, ["slice", "--voxel", "0.2", "-o", "out"], (0.3, 2)),
    "halo_stages_of_attributes": (MEDIAN, ["voxels", "--voxel", "0.2", "--what", "density", "-o", "out.npy"], (0.3, 2)),
    "whole_stages": (DISTANCES, ["slice", "--voxel", "0.1", "-o", "out"], (0.3, 4)),
    "whole_stages_of_parts": (PARTS, ["slice", "--voxel", "0.1", "-o", "out"], (0.3, 2)),
    "scan": (SCAN, ["mesh", "--cell", "0.2", "-o", "out.stl"], (0.3, 2)),
    "slice_of_a_scan": (SCAN, ["slice", "--voxel", "0.02", "-o", "out"], (0.3, 2)),
    "booleans_of_openscad": (SCREWS, ["scad", "-o", "out.stl"], (0.3, 2)),
    "a_sum_of_openscad": (SUM, ["scad", "-o", "out.stl"], (0.3, 2)),
    "design_of_openscad": (SCREWS, ["slice", "--voxel", "0.1", "-o", "out"], (0.3, 2)),
    "tetrahedra": (FOAM, ["fea", "--study", "study.json", "--elements", "tet4", "--size", "0.6", "-o", "out.vtu"], (0.3, 2)),
}
# Of work after the interrupt, which a machine under load does not make more.


def write_files(job, design):
    """Returns the design's name and those of all files."""
    name = "part.scad" if design in (SCREWS, SUM) else "part.vcad"
    job.write(name, design)
    for study, content in (("study.json", STUDY), ("topology.json", TOPOLOGY), ("search.json", SEARCH)):
        job.write(study, json.dumps(content))
    side = 200
    (job.path / "scan.nrrd").write_bytes(
        f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: {side} {side} {side}\nspace directions: (0.3,0,0) (0,0.3,0) (0,0,0.3)\n"
        "space dimension: 3\nencoding: raw\n\n".encode() + bytes((n // side // 20 + n % side // 20) % 2 for n in range(side * side)) * side)
    return name, {path.name for path in job.path.iterdir()}


def check_job(job, name):
    design, words, moments = JOBS[name]
    design_name, there = write_files(job, design)
    options = [] if words[0] == "scad" else ["--threads", "1", "--force"]
    for moment in moments:
        with subprocess.Popen([str(job.ombre), words[0], design_name, *words[1:], *options],
                              cwd=job.path, env=program.environment(), stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as process:
            processes.wait_for_work(process, moment)
            busy = processes.busy_seconds(process.pid)
            processes.interrupt(process)
        if options:
            expect(sum(busy) - max(busy) < 0.05, f"threads have worked {busy} s with --threads 1")
        left = [path.name for path in job.path.iterdir() if path.name not in {*there, "out"}]
        expect(not left, f"it left {left}")


# ---- memory


def little_memory_gives_the_same_bytes(job):
    """A megabyte holds one layer of these grids at a time, or less; the plan says so."""
    for words, name in ((["voxels", "ball.vcad", "--voxel", "0.04", "--what", "fractions"], "grid.raw"),
                        (["contours", "ball.vcad", "--cell", "0.02", "--layer-height", "0.5"], "part.cli")):
        stem, ending = name.split(".")
        reported = {}
        for memory in ("1M", "1G"):
            out = f"{stem}{memory}.{ending}"
            events = job.run(*words, "-o", out, "--memory", memory, "--threads", "4", "--json").stdout.splitlines()
            reported[memory] = next(e for e in map(json.loads, events) if e["event"] == "plan")["memory_bytes"]
        few, many = ({p.name.replace(memory, ""): p.read_bytes() for p in job.path.glob(f"{stem}{memory}*.{ending}")}
                     for memory in ("1M", "1G"))
        expect(few and few == many, f"{words[0]}: other bytes with less memory")
        expect(0 < reported["1M"] < reported["1G"] <= 1 << 30, f"{words[0]} says that it takes {reported}")


def too_little_memory_is_reported(job):
    error = job.run("render", "ball.vcad", "--size", "9000x9000", "--memory", "100M", "-o", "a.png", status=2).stderr
    expect("takes about" in error and "--memory" in error and "--size" in error, error)
    warning = job.run("layer", "ball.vcad", "--voxel", "0.003", "--z", "0", "--memory", "1M", "-o", "b.png").stderr
    expect("the layer takes up to" in warning and "--memory of 1 MiB" in warning, warning)
    expect(not (job.path / "a.png").exists() and (job.path / "b.png").exists(), "not the files that were meant")


# Those that are tests by themselves; the rest are "jobs".
GROUPS = {"simulations": ("fea", "homogenise", "search", "topology", "tetrahedra"),
          "stages": ("halo_stages", "halo_stages_of_attributes", "whole_stages", "whole_stages_of_parts", "scan", "slice_of_a_scan",
                     "booleans_of_openscad", "a_sum_of_openscad", "design_of_openscad")}


def with_group(name):
    return name + " " + next((group for group, names in GROUPS.items() if name in names), "jobs")


CHECKS = {with_group(name): lambda job, name=name: check_job(job, name) for name in JOBS}
CHECKS |= {with_group(check.__name__): check for check in (little_memory_gives_the_same_bytes, too_little_memory_is_reported)}


if __name__ == "__main__":
    raise SystemExit(program.main(Job, CHECKS))

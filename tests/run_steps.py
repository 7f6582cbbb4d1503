#!/usr/bin/env python3
"""Commands that write files take their steps in the same order: what may not be replaced, or has nowhere to go, is told
before the design is read; a disk that is too small before the work begins; a dry run writes nothing.

    python3 tests/run_steps.py build/dev/apps/ombre/ombre [NAME...]
"""
import json

import program
from program import expect
from slice_jobs import Job

# What reads it fails, so a command that fails otherwise has not read it.
WRONG = "sphere(;\n"
STUDY = {"materials": {"red": {"modulus_mpa": 2000, "poissons_ratio": 0.3}},
         "supports": [{"on": "zmin", "fix": "xyz"}], "loads": [{"on": "zmax", "force_n": [0, 0, -10]}]}
TOPOLOGY = {"topology": {"volume_fraction": 0.5}, "fea": STUDY, "cell": 1}
SEARCH = {"variables": {"a": {"from": 1, "to": 2}}, "objectives": [{"minimise": "volume"}], "fea": STUDY, "cell": 1}

# What each command writes, and the file that is there already if that is another one.
OUTPUTS = {
    "layer": (["--z", "0"], "out.png"),
    "render": ([], "out.png"),
    "render of frames": (["--frames", "3"], "out.png", "out_1.png"),
    "voxels": (["--voxel", "0.5"], "out.npy"),
    "voxels with a description": (["--voxel", "0.5"], "out.npy", "out.npy.json"),
    "voxels of all kinds": (["--voxel", "0.5", "--what", "materials,distance"], "out.vti"),
    "voxels that are sparse": (["--voxel", "0.5"], "out.vdb"),
    "mesh": ([], "out.stl"),
    "mesh with a library": ([], "out.obj", "out.mtl"),
    "contours": (["--layer-height", "0.5"], "out.cli"),
    "fea": (["--study", "study.json", "--cell", "1"], "out.inp"),
    "fea with numbers": (["--study", "study.json", "--cell", "1"], "out.xdmf", "out.h5"),
    "fea in rounds": (["--study", "study.json", "--cell", "1", "--rounds", "3", "--follow", "r"], "out.vtu", "out_2.vtu"),
    "homogenise": (["--cell", "1"], "out.svg"),
    "characterise": (["--voxel", "1"], "out.json"),
    "bundle": ([], "out.ombre"),
    "sheet": ([], "out.png"),
}


def said(job, *arguments, status=0):
    return job.run(*arguments, status=status).stderr


def prepare(job):
    job.write("wrong.vcad", WRONG)
    job.write("good.vcad", "cube(5, red);")
    job.write("varied.vcad", "a = 1;\ncube(a, red);")
    job.write("study.json", json.dumps(STUDY))
    job.write("topology.json", json.dumps(TOPOLOGY))
    job.write("search.json", json.dumps(SEARCH))


def names(job):
    return sorted(path.name for path in job.path.rglob("*"))


def check_file(job, case):
    """A file that is there is kept, and a folder that is not there is missed, before the design is read."""
    prepare(job)
    arguments, output, *there = OUTPUTS[case]
    command, kept = case.split()[0], there[0] if there else output
    job.write(kept, "mine")
    before = names(job)
    error = said(job, command, "wrong.vcad", *arguments, "-o", output, status=2)
    expect(f"{kept} exists already" in error and "--force" in error, error)
    expect((job.path / kept).read_text(encoding="utf-8") == "mine" and names(job) == before, "it wrote something")
    error = said(job, command, "wrong.vcad", *arguments, "-o", "nowhere/" + output, status=2)
    expect("nowhere" in error and "the folder is missing" in error, error)
    if command != "sheet":  # with --force it reads the design
        error = said(job, command, "wrong.vcad", *arguments, "-o", output, "--force", status=1)
        expect("wrong.vcad:1:" in error, error)
    expect((job.path / kept).read_text(encoding="utf-8") == "mine" and names(job) == before, "it wrote something")


def slices_keep_jobs_and_files_of_others(job):
    prepare(job)
    job.run("slice", "good.vcad", "-o", "out", "--voxel", "1")
    (job.path / "others").mkdir()
    job.write("others/notes.txt", "mine")
    job.write("file", "mine")
    before = names(job)
    for folder, reason in (("out", "already holds a slice job"), ("others", "notes.txt"), ("file", "is a file")):
        expect(reason in said(job, "slice", "wrong.vcad", "-o", folder, status=2), folder)
        expect("wrong.vcad:1:" in said(job, "slice", "wrong.vcad", "-o", folder, "--dry-run", status=1), "a dry run")
    expect("wrong.vcad:1:" in said(job, "slice", "wrong.vcad", "-o", "out", "--force", status=1), "--force")
    expect(names(job) == before, "it wrote something")


def contours_keep_layers(job):
    prepare(job)
    job.run("contours", "good.vcad", "-o", "out", "--layer-height", "1")
    before = names(job)
    expect("has layers already" in said(job, "contours", "wrong.vcad", "-o", "out", status=2), "layers")
    expect(names(job) == before, "it wrote something")


def searches_keep_folders(job):
    prepare(job)
    (job.path / "out").mkdir()
    job.write("out/history.csv", "mine")
    before = names(job)
    expect("--force" in said(job, "optimise", "varied.vcad", "--study", "search.json", "-o", "out", status=1), "variables")
    expect("history.csv exists already" in said(job, "optimise", "wrong.vcad", "--study", "topology.json", "-o", "out",
                                                status=2), "a topology")
    expect(names(job) == before, "it wrote something")


def dry_runs_write_nothing(job):
    prepare(job)
    before = names(job)
    job.run("slice", "good.vcad", "-o", "out", "--voxel", "0.5", "--dry-run")
    expect(names(job) == before, "it wrote something")


def small_disks_are_reported(job):
    """A grid of 10^15 voxels, before it is begun."""
    prepare(job)
    before = names(job)
    for output in ("out.raw", "out.npy", "out.nrrd", "out.vti"):
        error = said(job, "voxels", "good.vcad", "--voxel", "0.00005", "-o", output, status=2)
        expect("the disk of" in error and "free some space" in error and "--voxel" in error, error)
    expect(names(job) == before, "it wrote something")


CHECKS = {case: lambda job, case=case: check_file(job, case) for case in OUTPUTS}
CHECKS |= {check.__name__: check for check in (slices_keep_jobs_and_files_of_others, contours_keep_layers,
                                               searches_keep_folders, dry_runs_write_nothing, small_disks_are_reported)}


if __name__ == "__main__":
    raise SystemExit(program.main(Job, CHECKS))

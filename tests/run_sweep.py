#!/usr/bin/env python3
"""`ombre sweep` runs a job with several values, and its cases are the same whoever runs them.

    python3 tests/run_sweep.py build/dev/apps/ombre/ombre [NAME...]
"""
import csv
import hashlib
import json

import program
from program import expect, near

BAR = """
width = 1;
rectprism([width, 2, 2], red);
"""


def study(modulus):
    return {"materials": {"red": {"modulus_mpa": modulus, "poissons_ratio": 0.3}}}


def bars(folder):
    """The job of a bar, whose mesh has its volume exactly."""
    folder.write("bar.vcad", BAR)
    folder.run("mesh", "bar.vcad", "-o", "bar.stl", "--save-job", "job.json")


def rows(folder, name="sweep"):
    with (folder.path / name / "sweep.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def contents(path):
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(path.iterdir())}


def values_of_a_variable(folder):
    bars(folder)
    said = folder.run("sweep", "job.json", "-D", "width=1,2.5,4", "-o", "sweep").stderr
    expect("3 cases were run; all are in sweep/sweep.csv" in said, said)
    found = rows(folder)
    expect([row["width"] for row in found] == ["1", "2.5", "4"], f"{found}")
    for row in found:
        near(float(row["bodies.bodies.1.volume_mm3"]), 4 * float(row["width"]), 1e-6, "the volume of a bar")
        expect(not row["failure"], f"{row}")
    meshes = [name for name in folder.names() if name.startswith("case")]
    expect(meshes == [], f"{meshes} lie beside the sweep")
    expect([path.name for path in sorted((folder.path / "sweep").glob("*.stl"))] ==
           ["case_0_bar.stl", "case_1_bar.stl", "case_2_bar.stl"], "the meshes are not there")


def options_and_variables_together(folder):
    """A solid cell is as stiff as its material, whatever its bricks. The value that is given last changes first."""
    folder.write("cell.vcad", BAR)
    folder.write("soft.json", study(1000))
    folder.write("stiff.json", study(2500))
    folder.run("homogenise", "cell.vcad", "--cell", "1", "--study", "soft.json", "--save-job", "job.json")
    folder.run("sweep", "job.json", "-D", "width=1,2", "--vary", "study=soft.json,stiff.json", "-o", "sweep")
    found = rows(folder)
    expect([(row["width"], row["study"]) for row in found] == [
        ("1", "soft.json"), ("1", "stiff.json"), ("2", "soft.json"), ("2", "stiff.json")], f"{found}")
    for row in found:
        wanted = 1000 if row["study"] == "soft.json" else 2500
        near(float(row["homogenised.modulus_mpa.1"]), wanted, 1e-3 * wanted, "the modulus of a solid cell")


def shares_make_the_same(folder):
    bars(folder)
    vary = ("sweep", "job.json", "-D", "width=1,2,3,4,5", "--vary", "rotate=[0,0,0],[0,0,90]")
    folder.run(*vary, "-o", "alone")
    folder.run(*vary, "-o", "shared", "--save-job", "sweep.json")
    said = folder.run("plan", "sweep.json", "--shards", 3).stderr
    expect("3 shares of 10 cases" in said, said)
    folder.run_three_shares("cases 3:7")
    expect(contents(folder.path / "shared") == contents(folder.path / "alone"), "the shares have other bytes")


def a_sweep_goes_on(folder):
    bars(folder)
    vary = ("sweep", "job.json", "-D", "width=1,2,3,4")
    folder.run(*vary, "-o", "alone")
    folder.run(*vary, "-o", "sweep", "--save-job", "sweep.json")
    folder.run("plan", "sweep.json", "--shards", 2)
    folder.run("run", "plan.json", "--shard", 2)
    wrong = folder.run(*vary, "-o", "sweep", status=2).stderr
    expect("--resume" in wrong and "--force" in wrong, wrong)
    said = folder.run(*vary, "-o", "sweep", "--resume").stderr
    expect("2 cases were run, 2 before" in said, said)
    expect(contents(folder.path / "sweep") == contents(folder.path / "alone"), "a sweep that goes on has other bytes")
    folder.write("bar.vcad", BAR.replace("2, 2", "2, 3"))
    wrong = folder.run(*vary, "-o", "sweep", "--resume", status=2).stderr
    expect("holds another sweep, since bar.vcad differs" in wrong, wrong)
    wrong = folder.run("run", "plan.json", "--shard", 1, status=2).stderr
    expect("plan.json is the plan of another job: bar.vcad differs" in wrong, wrong)
    folder.run(*vary, "-o", "sweep", "--force")
    near(float(rows(folder)[0]["bodies.bodies.1.volume_mm3"]), 6, 1e-6, "the volume of the other bar")


def cases_that_fail_are_named(folder):
    bars(folder)
    said = folder.run("sweep", "job.json", "-D", "width=2,-1,3", "-o", "sweep").stderr
    expect("case 1 (width = -1) fails: " in said, said)
    found = rows(folder)
    expect([bool(row["failure"]) for row in found] == [False, True, False], f"{found}")
    near(float(found[2]["bodies.bodies.1.volume_mm3"]), 12, 1e-6, "the volume after a failure")


def wrong_words(folder):
    bars(folder)
    folder.run("mesh", "bar.vcad", "--save-job", "nowhere.json")
    folder.run("slice", "bar.vcad", "--voxel", "0.5", "-o", "layers", "--save-job", "slices.json")
    for arguments, words in [
            (["job.json"], "a sweep needs values: write -D wall=0.2,0.4 or --vary cell=1,2"),
            (["job.json", "--vary", "cel=1,2"], "jobs of the kind mesh have no option cel; options are design"),
            (["job.json", "-D", "width"], "-D width does not say values; write for example -D wall=0.2,0.4,0.8"),
            (["job.json", "-D", "width=1,,2"], "does not say values"),
            (["nowhere.json", "-D", "width=1,2"], "the job does not say which file it writes"),
            (["slices.json", "-D", "width=1,2"], "the job writes a folder, case_0_layers"),
            (["bar.vcad", "-D", "width=1,2"], "bar.vcad")]:
        wrong = program.run(folder.command("sweep", *arguments, "-o", "sweep", "--force"), cwd=folder.path)
        expect(wrong.returncode == 1 and words in wrong.stderr, f"{arguments}: {wrong.returncode} {wrong.stderr}")
    events = folder.events("sweep", "job.json", "-D", "width=1,2", "-o", "told", "--force")
    expect(json.dumps(events[-1]) == json.dumps({"event": "sweep", "file": "told/sweep.csv", "cases": 2}), f"{events}")


CHECKS = program.named((values_of_a_variable, options_and_variables_together, shares_make_the_same, a_sweep_goes_on,
                        cases_that_fail_are_named, wrong_words))

if __name__ == "__main__":
    raise SystemExit(program.main(program.Folder, CHECKS))

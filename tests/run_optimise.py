#!/usr/bin/env python3
"""Searches for the best values of variables, and for topologies, run as a user would.

    python3 tests/run_optimise.py build/dev/apps/ombre/ombre
"""
import array
import csv
import json
import math
import signal
import subprocess

import processes
import program
from program import expect, near

# Two bars one on the other, of mixtures of red and blue by the shares a and b.
BARS = """a = 0.9;
b = 0.9;
fgrade([str(a), str(1 - a)], [red, blue]) translate(0, 0, 5) rectprism((10, 10, 10), red);
fgrade([str(b), str(1 - b)], [red, blue]) translate(0, 0, -5) rectprism((10, 10, 10), red);
"""
PULL = {"materials": {"red": {"modulus_mpa": 2000, "poissons_ratio": 0, "density_kg_m3": 2000},
                      "blue": {"modulus_mpa": 100, "poissons_ratio": 0, "density_kg_m3": 1000}},
        "supports": [{"on": "zmin", "fix": "xyz"}], "loads": [{"on": "zmax", "pressure_mpa": -100}]}
LIGHT = {"variables": {"a": {"from": 0, "to": 1, "start": 0.9}, "b": {"from": 0, "to": 1, "start": 0.7}},
         "objectives": [{"minimise": "mass"}],
         "constraints": [{"measure": "displacement", "axis": "z", "at_most": 2}],
         "fea": PULL, "cell": 5, "tolerance": 1e-5}
SCHAFFER = "x = 5;\necho(near = x * x, far = (x - 2) * (x - 2));\nsphere(1);\n"
FRONT = {"variables": {"x": {"from": -10, "to": 10, "start": 5}},
         "objectives": [{"minimise": "echo", "name": "near"}, {"minimise": "echo", "name": "far"}],
         "evaluations": 480}


class Folder(program.Folder):
    FILES = {"bars.vcad": BARS, "light.json": LIGHT, "schaffer.vcad": SCHAFFER, "front.json": FRONT}

    def table(self, name):
        return list(csv.DictReader(self.read(name).splitlines()))

    def run(self, *arguments, command="optimise", **options):
        return super().run(command, *arguments, **options)

    def interrupted(self, out, lines, *arguments):
        """Runs a search and stops it by Ctrl-C once its history has that many lines; returns what it reported."""
        process = subprocess.Popen(self.command("optimise", *arguments, "-o", out), cwd=self.path, env=program.environment(),
                                   text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        history = self.path / out / "history.csv"
        processes.wait_until(lambda: process.poll() is not None or (history.exists() and history.read_text().count("\n") >= lines),
                             f"{lines} lines are in the history")
        process.send_signal(signal.SIGINT)
        _, reported = process.communicate(timeout=program.PATIENCE_S)
        expect(process.returncode == 130, f"status {process.returncode}: {reported}")
        return reported

    def best(self, *arguments):
        return next(event for event in self.events(*arguments) if event["event"] == "best")


def bars_are_as_light_as_hookes_law_lets_them(folder):
    """Of equal stress, the sum of 1/modulus has a limit, and the mass goes with the sum of moduli: so both are equal,
    1000 MPa each where 100 MPa stretch 20 mm by 2 mm."""
    share = (1000 - 100) / (2000 - 100)
    mass = 2000 * (1000 + 1000 * share) * 1e-6
    for method, evaluations, tolerance in (("cobyla", 150, 2e-4), ("cmaes", 1200, 2e-3)):
        folder.write("study.json", {**LIGHT, "method": method, "evaluations": evaluations})
        best = folder.best("bars.vcad", "--study", "study.json", "-o", method)
        near(best["measures"]["mass [g]"], mass, tolerance * mass, f"the mass by {method}")
        near(best["variables"]["a"], share, 0.05, f"a by {method}")
        expect(best["measures"]["displacement z [mm]"] < 2 * (1 + 1e-5), "the limit does not hold")
    rows = folder.table("cobyla/history.csv")
    expect(min(float(row["mass [g]"]) for row in rows if float(row["displacement z [mm]"]) < 2.00001) >= mass * 0.9999,
           "a design is lighter than any can be")


def the_best_design_is_a_script(folder):
    best = folder.best("bars.vcad", "--study", "light.json", "-o", "light")
    folder.write("pull.json", PULL)
    lines = folder.run("light/best_1.vcad", "--study", "pull.json", "--cell", "5", "--assign", "mix", "--solve", "--json",
                       command="fea").stdout.splitlines()
    solution = next(event for event in map(json.loads, lines) if event["event"] == "solution")
    near(solution["greatest_displacement_mm"][2], best["measures"]["displacement z [mm]"], 1e-6, "the displacement")
    expect("<circle" in folder.read("light/chart.svg"), "no chart")


def studies_have_the_options_of_fea(folder):
    """A search and `ombre fea` solve the same bricks in the same way, whichever rule is chosen."""
    folder.write("pull.json", PULL)
    stretches = []
    for fill in ("exact", "centre"):
        study = {**LIGHT, "constraints": [{"measure": "displacement", "axis": "z", "at_most": 9}], "cell": 3, "fill": fill,
                 "solver": "direct", "sections": 7, "evaluations": 1}
        folder.write("one.json", study)
        folder.run("bars.vcad", "--study", "one.json", "-o", fill)
        row = folder.table(f"{fill}/history.csv")[0]
        values = [word for name in ("a", "b") for word in ("-D", f"{name}={row[name]}")]
        lines = folder.run("bars.vcad", "--study", "pull.json", "--cell", "3", "--assign", "mix", "--fill", fill, "--sections",
                           "7", "--solver", "direct", *values, "--solve", "--json", command="fea").stdout.splitlines()
        solution = next(event for event in map(json.loads, lines) if event["event"] == "solution")
        stretches.append(float(row["displacement z [mm]"]))
        near(solution["greatest_displacement_mm"][2], stretches[-1], 1e-6, f"the displacement with {fill}")
    expect(abs(stretches[0] - stretches[1]) > 0.01, f"the rules of filling give {stretches}")


def beams_follow_beam_theory(folder):
    """The lightest beam under a limit of its deflection is as high as may be, and as wide as that needs."""
    length, force, modulus, limit, height = 100, 5, 1000, 2, 10
    best = folder.best(STUDIES / "beam.vcad", "--study", STUDIES / "lighter.json", "-o", "beam")["variables"]
    near(best["h"], height, 0.01, "the height")
    # Deflection by bending and by shear (Timoshenko), of width 1.
    shear = force * length / (5 / 6 * modulus / 2 * height)
    width = (force * length**3 / (3 * modulus * height**3 / 12) + shear) / limit
    # Four linear bricks across the height are some per cent too stiff.
    near(best["b"], width, 0.06 * width, "the width")


def fronts_are_found(folder):
    """Schaffer's problem: between its ends, the roots of the two objectives add up to 2."""
    folder.run("schaffer.vcad", "--study", "front.json", "-o", "front")
    rows = folder.table("front/front.csv")
    expect(len(rows) > 20, f"only {len(rows)} designs are in the front")
    for row in rows:
        near(math.sqrt(float(row["near"])) + math.sqrt(float(row["far"])), 2, 1e-6, "the sum of roots")
    expect(len(list((folder.path / "front").glob("best_*.vcad"))) == 10, "not ten scripts")
    one = folder.read("front/best_1.vcad")
    expect("include <../schaffer.vcad>" in one and "\nx = " in one, one)
    # The same search finds the same, with any number of threads.
    folder.run("schaffer.vcad", "--study", "front.json", "-o", "again", "--threads", "1")
    for name in ("history.csv", "front.csv", "chart.svg"):
        expect(folder.read(f"front/{name}") == folder.read(f"again/{name}"), name + " differs")


def whole_variables_are_whole(folder):
    folder.write("whole.json", {**FRONT, "variables": {"x": {"from": -10.5, "to": 10.5, "whole": True}},
                                "objectives": FRONT["objectives"][1:], "method": "cmaes", "evaluations": 100})
    best = folder.best("schaffer.vcad", "--study", "whole.json", "-o", "whole")
    expect(best["variables"]["x"] == 2, str(best))
    rows = folder.table("whole/history.csv")
    expect(len(rows) <= 21 and all(float(row["x"]) == int(row["x"]) for row in rows), "a number is not whole")
    folder.write("most.json", {**FRONT, "objectives": [{"maximise": "echo", "name": "far"}], "method": "direct",
                               "constraints": [{"measure": "echo", "name": "near", "at_least": 4},
                                               {"measure": "echo", "name": "near", "at_most": 16}]})
    near(folder.best("schaffer.vcad", "--study", "most.json", "-o", "most")["variables"]["x"], -4, 0.01, "x")


def searches_go_on(folder):
    """A search that was cut short, and goes on, measures what a whole one does."""
    folder.run("bars.vcad", "--study", "light.json", "-o", "whole")
    folder.write("short.json", {**LIGHT, "evaluations": 12})
    folder.run("bars.vcad", "--study", "short.json", "-o", "parts")
    before = folder.read("parts/history.csv")
    expect(before.count("\n") == 13, before)
    # What a loss of power leaves of a line does not count, and the table is written from the journal.
    folder.write("parts/journal.jsonl", folder.read("parts/journal.jsonl") + '{"design":13,"files":[],"val')
    folder.write("parts/history.csv", before + "13,0.5,")
    events = folder.events("bars.vcad", "--study", "light.json", "-o", "parts", "--resume")
    known = next(event for event in events if event["event"] == "search")["known"]
    expect(known == 12, f"{known} designs were known")
    expect_same_search(folder, "whole", "parts")


def processes_measure_what_a_search_asks_for(folder):
    """A plan has the designs that a search measures next; round by round they give the search of one process."""
    folder.write("short.json", {**FRONT, "evaluations": 96})
    job = ["schaffer.vcad", "--study", "short.json"]
    folder.run(*job, "-o", "alone")
    folder.run(*job, "-o", "shared", "--save-job", "job.json")
    for rounds in range(20):
        planned = program.run(folder.command("plan", "job.json", "--shards", 3, "--force"), cwd=folder.path)
        if planned.returncode:
            break
        for n in (3, 1):
            folder.run("plan.json", "--shard", n, command="run")
        if rounds == 1:
            wrong = folder.run("plan.json", command="gather", status=2).stderr
            expect("are missing, of shares 2" in wrong, wrong)
        folder.run("plan.json", "--shard", 2, command="run")
        folder.run("plan.json", command="gather")
    expect("the search in shared is over" in planned.stderr, planned.stderr)
    expect(2 < rounds < 20, f"{rounds} rounds")
    expect_same_search(folder, "alone", "shared")


def damaged_lines_are_measured_again(folder):
    """A journal that lost a line in its middle gives the same search, with the same numbers of designs."""
    folder.write("few.json", {**FRONT, "evaluations": 48})
    for name in ("whole", "torn"):
        folder.run("schaffer.vcad", "--study", "few.json", "-o", name)
    lines = folder.read("torn/journal.jsonl").splitlines(keepends=True)
    folder.write("torn/journal.jsonl", "".join([*lines[:6], "{}\n", lines[7][:9] + "\n", *lines[8:]]))
    events = folder.events("schaffer.vcad", "--study", "few.json", "-o", "torn", "--resume")
    search = next(event for event in events if event["event"] == "search")
    expect(search["measured"] == 2 and search["known"] == len(lines) - 2, str(search))
    expect_same_search(folder, "whole", "torn")


def the_journal_is_the_table(folder):
    folder.run("schaffer.vcad", "--study", "front.json", "-o", "found")
    description = json.loads(folder.read("found/search.json"))
    expect((description["variables"], description["measures"]) == (["x"], ["near", "far"]), str(description))
    entries = [json.loads(line) for line in folder.read("found/journal.jsonl").splitlines()]
    rows = folder.table("found/history.csv")
    expect(len(entries) == len(rows), f"{len(entries)} lines for {len(rows)} designs")
    for entry, row in zip(entries, rows):
        expect(entry["design"] == int(row["design"]) and entry["values"] == [float(row["x"])] and
               entry["measures"] == [float(row["near"]), float(row["far"])], f"{entry}, {row}")


def searches_of_older_versions_are_named(folder):
    (folder.path / "old").mkdir()
    folder.write("old/history.csv", 'design,"x","near","far",failure\n1,5,25,9,\n')
    folder.write("old/study.key", "the study 00\n")
    job = ["schaffer.vcad", "--study", "front.json", "-o", "old"]
    for options in ([], ["--resume"]):
        reported = folder.run(*job, *options, status=1).stderr
        expect("older version of Ombre" in reported and "--force" in reported, reported)
    expect(not (folder.path / "old/journal.jsonl").exists(), "a journal was begun")
    folder.run(*job, "--force")
    expect(not (folder.path / "old/study.key").exists(), "the old key is left")
    folder.run(*job, "--resume")


def expect_same_search(folder, one, other):
    for name in ("journal.jsonl", "history.csv", "front.csv", "chart.svg"):
        expect(folder.read(f"{one}/{name}") == folder.read(f"{other}/{name}"), name + " differs")


TETRAHEDRON = """solid t
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 3 0
vertex 3 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 3 0 0
vertex 0 0 3
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 3
vertex 0 3 0
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 3 0 0
vertex 0 3 0
vertex 0 0 3
endloop
endfacet
endsolid t
"""


def designs_are_turned(folder):
    """A bar of 20 mm and 2000 MPa under 100 MPa grows by 1 mm; on its side, 3 mm high, by 0.15 mm."""
    folder.write("bar.vcad", "w = 3; rectprism((w, 4, 20), red);")
    study = {"variables": {"w": {"from": 2, "to": 4}}, "objectives": [{"minimise": "displacement", "axis": "z"}],
             "fea": {**PULL, "materials": {"red": PULL["materials"]["red"]}}, "cell": 1, "evaluations": 3}
    folder.write("bar.json", study)
    folder.run("bar.vcad", "--study", "bar.json", "-o", "upright")
    near(float(folder.table("upright/history.csv")[0]["displacement z [mm]"]), 1, 1e-5, "upright")
    folder.run("bar.vcad", "--study", "bar.json", "-o", "flat", "--rotate", "0,90,0")
    near(float(folder.table("flat/history.csv")[0]["displacement z [mm]"]), 0.15, 1e-5, "on its side")
    expect("with --rotate 0,90,0" in folder.read("flat/best_1.vcad"), folder.read("flat/best_1.vcad"))


def changed_files_are_noticed(folder):
    """What a design includes and reads counts, and how it is turned: with another one the history is not gone on with."""
    folder.write("part.scad", "size = 4;\n")
    folder.write("shape.stl", TETRAHEDRON)
    folder.write("whole.vcad", 'include <part.scad>\nx = 5;\necho(far = (x - 2) * (x - 2));\nmesh("shape.stl");\n')
    folder.write("far.json", {**FRONT, "objectives": FRONT["objectives"][1:], "method": "cobyla", "evaluations": 8})
    job = ["whole.vcad", "--study", "far.json", "-o", "whole"]
    folder.run(*job)
    folder.run(*job, "--resume")

    def refused(name, *options):
        before = folder.read("whole/history.csv")
        reported = folder.run(*job, "--resume", *options, status=1).stderr
        expect(f"of another study or design, since {name} differs" in reported, reported)
        expect(folder.read("whole/history.csv") == before, "the history changed")

    folder.write("part.scad", "size = 5;\n")
    refused("part.scad")
    folder.write("part.scad", "size = 4;\n")
    folder.write("shape.stl", TETRAHEDRON.replace("3", "2"))
    refused("shape.stl")
    folder.write("shape.stl", TETRAHEDRON)
    refused("--rotate", "--rotate", "0,0,90")
    folder.run(*job, "--resume")


def interrupted_topologies_leave_their_steps(folder):
    folder.write("endless.json", {**MBB, "topology": {**MBB["topology"], "steps": 100000, "change": 1e-6}})
    folder.interrupted("endless", 4, STUDIES / "half_beam.vcad", "--study", "endless.json")
    rows = folder.table("endless/history.csv")
    expect(len(rows) >= 3 and [row["step"] for row in rows] == [str(n + 1) for n in range(len(rows))], str(rows[:4]))
    expect(float(rows[2]["compliance [N mm]"]) < float(rows[0]["compliance [N mm]"]), "the compliance does not fall")


def ctrl_c_keeps_the_history(folder):
    folder.write("fine.json", {**LIGHT, "cell": 0.4})
    reported = folder.interrupted("fine", 3, "bars.vcad", "--study", "fine.json")
    expect("--resume goes on" in reported, reported)
    expect(folder.read("fine/history.csv").endswith("\n") and len(folder.table("fine/history.csv")) >= 2, "the history is gone")
    expect(not list((folder.path / "fine").glob("*.part")), "a part of a file is left")


def wrong_studies_are_reported(folder):
    def error(study, design="bars.vcad", *options, status=1):
        folder.write("wrong.json", study)
        return folder.run(design, "--study", "wrong.json", "-o", "wrong", "--force", *options, status=status).stderr

    def with_variables(**variables):
        return {**LIGHT, "variables": variables}

    reported = error(with_variables(width={"from": 0, "to": 1}))
    expect('no top-level variable "width"' in reported and "it has a, b" in reported and "wrong.json:1:" in reported, reported)
    expect("the range of \"a\" is empty" in error(with_variables(a={"from": 1, "to": 1})), "range")
    expect('a variable needs "to"' in error(with_variables(a={"from": 1})), "a bound")
    expect('expected a number from 0 to 1 for "start", not 3' in error(with_variables(a={"from": 0, "to": 1, "start": 3})), "start")
    expect("names no variables" in error({**LIGHT, "variables": {}}), "no variables")
    expect('did you mean "mass"?' in error({**LIGHT, "objectives": [{"minimise": "mas"}]}), "a measure")
    expect('write one of "volume", "mass"' in error({**LIGHT, "objectives": [{"minimise": "beauty"}]}), "measures")
    expect("has no objectives" in error({**LIGHT, "objectives": []}), "objectives")
    expect('either "minimise" or "maximise"' in error({**LIGHT, "objectives": [{}]}), "an objective")
    expect('either "at_most" or "at_least"' in error({**LIGHT, "constraints": [{"measure": "mass"}]}), "a limit")
    expect("needs loads" in error({**LIGHT, "fea": {**PULL, "loads": []}}), "loads")
    expect('a study needs "fea"' in error({name: LIGHT[name] for name in LIGHT if name != "fea"}), "fea")
    expect('did you mean "cobyla"?' in error({**LIGHT, "method": "cobila"}), "a method")
    expect("nsga2 takes several objectives" in error({**LIGHT, "method": "nsga2"}), "nsga2")
    expect("bobyqa takes no constraints" in error({**LIGHT, "method": "bobyqa"}), "bobyqa")
    expect("cobyla takes one objective" in error({**FRONT, "method": "cobyla"}, "schaffer.vcad"), "cobyla")
    expect('did you mean "cell"?' in error({**LIGHT, "cel": 1}), "a member")
    expect('"assign": there is no "mixed"; there are draw, mix' in error({**LIGHT, "assign": "mixed"}), "a word of an option")
    expect('"sections"' in error({**LIGHT, "sections": 0}) and '"modulus" says nothing' in error({**LIGHT, "modulus": ""}),
           "options that are wrong or empty")
    expect("there is no solver" in error({**LIGHT, "solver": "calculix"}), "a solver that searches do not have")
    expect("no design keeps all limits" in error({**LIGHT, "evaluations": 20, "constraints": [
        {"measure": "displacement", "at_most": 0.1}]}, status=3), "infeasible")
    expect('prints no number named "cost"' in error(
        {**FRONT, "objectives": [{"minimise": "echo", "name": "cost"}], "method": "cobyla"}, "schaffer.vcad"), "echo")
    bare = {name: {"modulus_mpa": 1, "poissons_ratio": 0} for name in ("red", "blue")}
    expect("the mass is unknown" in error({**LIGHT, "fea": {**PULL, "materials": bare}}), "density")
    expect("in the box of displacement" in error({**LIGHT, "constraints": [
        {"measure": "displacement", "in": [90, 90, 90, 99, 99, 99], "at_most": 1}]}), "a box")
    folder.write("part.json", {})
    expect("take a .vcad or .scad script" in error(LIGHT, "part.json"), "a design without variables")
    expect("none.json" in folder.run("bars.vcad", "--study", "none.json", "-o", "x", status=2).stderr, "a missing file")
    folder.run("schaffer.vcad", "--study", "front.json", "-o", "there")
    before = folder.read("there/history.csv")
    again = ("schaffer.vcad", "--study", "front.json", "-o", "there")
    expect("--resume to go on" in folder.run(*again, status=1).stderr, "a folder that is there")
    folder.write("other.json", {**FRONT, "seed": 1})
    reported = folder.run("schaffer.vcad", "--study", "other.json", "-o", "there", "--resume", status=1).stderr
    expect("of another study" in reported, reported)
    folder.write("schaffer.vcad", SCHAFFER + "cube(1);\n")
    expect("of another study" in folder.run(*again, "--resume", status=1).stderr, "another design")
    expect(folder.read("there/history.csv") == before, "the history changed")
    expect("leave out --resume" in folder.run("schaffer.vcad", "--study", "front.json", "-o", "new", "--resume",
                                              status=1).stderr, "nothing to resume")


def designs_that_fail_are_left_out(folder):
    folder.write("half.vcad", 'x = 5;\nassert(x > 1, "x, or \\"size\\", is too small");\necho(far = (x + 3) * (x + 3));\n'
                              "sphere(x);\n")
    study = {**FRONT, "objectives": FRONT["objectives"][1:], "method": "cmaes", "evaluations": 200}
    folder.write("half.json", study)
    best = folder.best("half.vcad", "--study", "half.json", "-o", "half")
    near(best["variables"]["x"], 1, 0.05, "x")
    failures = [row["failure"] for row in folder.table("half/history.csv") if row["failure"]]
    expect(failures and 'x, or "size", is too small' in failures[0], str(failures[:1]))
    failed = [json.loads(line) for line in folder.read("half/journal.jsonl").splitlines() if "failure" in line]
    expect(len(failed) == len(failures) and 'x, or "size", is too small' in failed[0]["failure"], str(failed[:1]))
    folder.write("half.json", {**study, "evaluations": 240})
    folder.run("half.vcad", "--study", "half.json", "-o", "half", "--resume")


STUDIES = program.SOURCE / "examples" / "studies"
MBB = json.loads((STUDIES / "stiffest.json").read_text(encoding="utf-8"))


def topologies_are_as_stiff_as_published(folder):
    """Half of a beam on two supports, 60 by 20: Andreassen and others (2011) publish a compliance of 233.71 with a filter
    of densities of radius 2.4. Theirs are plane elements, ours are bricks of one layer."""
    events = folder.events(STUDIES / "half_beam.vcad", "--study", STUDIES / "stiffest.json", "-o", "mbb")
    found = next(event for event in events if event["event"] == "topology")
    near(found["compliance_n_mm"], 233.71, 0.01 * 233.71, "the compliance")
    near(found["volume_fraction"], 0.5, 1e-4, "the volume")
    expect(found["change"] <= 0.01, "it did not come to rest")
    # The result is a volume, which designs take for solids and for mixtures.
    folder.write("mixed.vcad", 'd = volume("mbb/density.nrrd", clamp=true);\n'
                 "fgrade([d.value, 1 - d.value], [red, blue]) translate(30, 10, 0.5) rectprism((60, 20, 1), red);\n")
    for at, share in (("0.5,19.5,0.5", 1), ("0.5,10.5,0.5", 0)):
        reported = folder.run("mixed.vcad", "--at", at, "--json", command="probe").stdout
        expect(('"red":1' if share else '"blue":1') in reported, reported)
        wanted = "inside" if share else "outside"
        expect(wanted in folder.run("mbb/topology.vcad", "--at", at, command="probe").stdout, f"{at} is not {wanted}")


def projection_draws_densities_apart(folder):
    """With a projection few bricks are left between void and solid, where there are many without one, and the volume holds."""
    study = {**MBB, "topology": {**MBB["topology"], "steps": 150}}

    def between(name, **more):
        folder.write("apart.json", {**study, "topology": {**study["topology"], **more}})
        events = folder.events(STUDIES / "half_beam.vcad", "--study", "apart.json", "-o", name)
        found = next(event for event in events if event["event"] == "topology")
        near(found["volume_fraction"], 0.5, 1e-3, "the volume")
        header, _, data = (folder.path / name / "density.nrrd").read_bytes().partition(b"\n\n")
        expect(b"encoding: raw" in header and b"type: float" in header, header.decode())
        densities = array.array("f", data)
        return sum(0.1 < density < 0.9 for density in densities) / len(densities)

    even, apart = between("even"), between("apart", projection=16)
    expect(apart < 0.5 * even, f"{apart:.0%} of the bricks are neither void nor solid, {even:.0%} without a projection")


def displacements_are_goals_of_topologies(folder):
    """Where the only load pulls, least displacement is least compliance: the same densities, and the compliance is force
    times displacement. Elsewhere a displacement is changed as requested, at the same volume."""
    load = MBB["fea"]["loads"][0]
    force = math.dist(load["force_n"], (0, 0, 0))

    def found(name, steps, **displacement):
        goal = {"displacement": displacement} if displacement else {}
        folder.write("goal.json", {**MBB, "topology": {**MBB["topology"], "steps": steps, **goal}})
        events = folder.events(STUDIES / "half_beam.vcad", "--study", "goal.json", "-o", name)
        return next(event for event in events if event["event"] == "topology")

    def densities(name):
        return array.array("f", (folder.path / name / "density.nrrd").read_bytes().partition(b"\n\n")[2])

    stiffest = found("stiffest", 30)
    stillest = found("stillest", 30, on=load["on"], direction=[10 * f for f in load["force_n"]], goal="least")
    near(stillest["compliance_n_mm"], stiffest["compliance_n_mm"], 1e-4 * stiffest["compliance_n_mm"], "the compliance")
    near(force * stillest["displacement_mm"], stillest["compliance_n_mm"], 1e-6 * stillest["compliance_n_mm"], "the work")
    expect(max(abs(a - b) for a, b in zip(densities("stiffest"), densities("stillest"))) < 1e-3, "other densities")
    expect(stiffest["displacement_mm"] is None, "a displacement without a goal")

    # The roller's end moves along x.
    end = {"on": {"box": [60, 0, 0, 60, 0, 1]}, "direction": [1, 0, 0]}
    found("end", 25, **end)
    steps = [float(row["displacement [mm]"]) for row in folder.table("end/history.csv")]
    expect(steps[-1] < 0.6 * steps[0], f"least: {steps}")
    greatest = found("far", 10, **end, goal="greatest")
    steps = [float(row["displacement [mm]"]) for row in folder.table("far/history.csv")]
    expect(steps[-1] > 1.2 * steps[0], f"greatest: {steps}")
    near(greatest["volume_fraction"], 0.5, 1e-3, "the volume")


def wrong_topologies_are_reported(folder):
    folder.write("mbb.vcad", "translate(30, 10, 0.5) rectprism((60, 20, 1), red);\n")

    def error(study, *options):
        folder.write("wrong.json", study)
        return folder.run("mbb.vcad", "--study", "wrong.json", "-o", "wrong", *options, status=1).stderr

    expect('needs "volume_fraction"' in error({**MBB, "topology": {}}), "a volume")
    expect("a number from 0.01 to 1" in error({**MBB, "topology": {"volume_fraction": 2}}), "a large volume")
    expect("did you mean" in error({**MBB, "topology": {"volume_fraction": 0.5, "radios": 2}}), "a member")
    for displacement, wanted in (({"on": "xmax"}, 'needs "direction"'), ({"direction": [0, 1, 0]}, 'needs "on"'),
                                 ({"on": "xmax", "direction": [0, 0, 0]}, "the direction is of no length"),
                                 ({"on": "xmax", "direction": [0, 1, 0], "goal": "most"}, "least"),
                                 ({"on": {"box": [90, 0, 0, 91, 1, 1]}, "direction": [0, 1, 0]}, "in this box")):
        reported = error({**MBB, "topology": {**MBB["topology"], "displacement": displacement}})
        expect(wanted in reported, reported)
    expect("needs loads" in error({**MBB, "fea": {**MBB["fea"], "loads": []}}), "loads")
    expect("takes no gravity" in error({**MBB, "fea": {**MBB["fea"], "gravity_mm_s2": [0, -9810, 0]}}), "gravity")
    expect("supports that do not move" in error({**MBB, "fea": {**MBB["fea"], "supports": [
        {"on": "xmin", "displacement_mm": [1, None, None]}]}}), "a support that moves")
    expect("leave out --resume" in error(MBB, "--resume"), "resume")
    expect(not (folder.path / "wrong").exists(), "a folder is left")


CHECKS = [bars_are_as_light_as_hookes_law_lets_them, the_best_design_is_a_script, studies_have_the_options_of_fea,
          beams_follow_beam_theory, fronts_are_found, whole_variables_are_whole, searches_go_on,
          processes_measure_what_a_search_asks_for,
          damaged_lines_are_measured_again, the_journal_is_the_table, searches_of_older_versions_are_named,
          designs_are_turned, changed_files_are_noticed, interrupted_topologies_leave_their_steps,
          ctrl_c_keeps_the_history, wrong_studies_are_reported, designs_that_fail_are_left_out,
          topologies_are_as_stiff_as_published, projection_draws_densities_apart,
          displacements_are_goals_of_topologies, wrong_topologies_are_reported]


if __name__ == "__main__":
    raise SystemExit(program.main(Folder, program.named(CHECKS)))

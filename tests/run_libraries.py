#!/usr/bin/env python3
"""Operators of libraries: where they are searched, what they are refused, how they are listed.

    python3 tests/run_libraries.py build/dev/apps/ombre/ombre [CHECK...]
"""
import json
import os
import shutil

import program
from program import expect
from slice_jobs import Job, expect_same

# A ball whose inner part is of another material: the operator says where it begins.
OPERATORS = """use <parts/core.vcad>
/// A ball with a core.
/// Category: own
/// Example: own_ball(3);
/// Source: this test
module own_ball(
  radius = 3,   // [1:0.5:5] mm: Radius of the ball
  skin = "red"  // material: Material of the skin
) fgrade(["d > -1", "d <= -1"], [skin, core()]) sphere(radius);

/// How thick two walls are.
/// Returns: value mm
function own_walls(
  wall,           // number mm: Thickness of one
  kind = "thick"  // [thick, thin] text: Which walls
) = 2 * wall;
"""
DESIGN = "use <own/balls.vcad>\nown_ball(2.5);\n"
OPTIONS = ["--voxel", "0.25"]


class Libraries(Job):
    """A folder with a design, and a library of the user elsewhere."""

    def __init__(self, ombre, scratch):
        super().__init__(ombre, scratch)
        self.user = self.path / "home"
        os.makedirs(self.user / "ombre/library/own/parts")
        self.library = self.write("home/ombre/library/own/balls.vcad", OPERATORS)
        self.core("green")
        self.design = self.write("part.vcad", DESIGN)

    def core(self, material):
        self.write("home/ombre/library/own/parts/core.vcad", f'function core() = "{material}";\n')

    def command(self, *arguments):
        return ["env", f"XDG_DATA_HOME={self.user}", *super().command(*arguments)]

    def run(self, *arguments, status=0, **options):
        result = program.run(self.command(*arguments), cwd=self.path, **options)
        expect(result.returncode == status, f"status {result.returncode}, not {status}: {result.stderr[-1500:]}")
        return result


def same(job, one, other):
    try:
        expect_same(job.path / one, job.path / other, lambda name: name.endswith(".png"))
    except AssertionError:
        return False
    return True


def the_users_library_is_found(job):
    plain = job.write("plain.vcad", 'fgrade(["d > -1", "d <= -1"], ["red", "green"]) sphere(2.5);\n')
    job.slice("used", *OPTIONS)
    job.slice("plain", *OPTIONS, design=plain)
    expect(same(job, "used", "plain"), "the operator makes something else")


def a_library_beside_the_design_comes_first(job):
    job.slice("before", *OPTIONS)
    (job.path / "own").mkdir()
    job.write("own/balls.vcad", "module own_ball(radius) cube(radius);\n")
    job.slice("after", *OPTIONS)
    expect(not same(job, "before", "after"), "the user's library was taken")


def a_library_that_changes_makes_another_job(job):
    """Also a file that only the library uses."""
    job.slice("job", *OPTIONS)
    job.core("blue")
    expect("design_hash" in job.slice("job", *OPTIONS, "--resume", status=2).stderr, "the job was taken for the same")
    job.slice("changed", *OPTIONS)
    expect(not same(job, "job", "changed"), "the changed file was not read")


def bundles_carry_libraries(job):
    made = program.run(job.command("bundle", job.design), cwd=job.path)
    if "OMBRE_3MF" in made.stderr:
        return "skipped: built without zip archives"
    expect(made.returncode == 0, made.stderr[-1500:])
    for name in ("own/balls.vcad", "own/parts/core.vcad"):
        expect(name in made.stdout + made.stderr, f"{name} is not told of: {made.stdout}{made.stderr}")
    job.slice("design", *OPTIONS)
    shutil.rmtree(job.user)
    job.slice("bundle", *OPTIONS, design=job.path / "part.ombre")
    expect(same(job, "design", "bundle"), "the bundle makes something else")
    return ""


def folders_that_were_searched_are_named(job):
    design = job.write("none.vcad", "use <own/none.vcad>\nsphere(1);\n")
    message = job.slice("none", *OPTIONS, design=design, status=1).stderr
    for place in (job.path / "own/none.vcad", job.user / "ombre/library/own/none.vcad"):
        expect(str(place) in message, message)
    hostile = job.write("hostile.vcad", "use <own/../../../../secret.vcad>\nsphere(1);\n")
    job.write("home/secret.vcad", "x = 1;")
    message = job.slice("hostile", *OPTIONS, design=hostile, status=1).stderr
    expect("ombre/library" not in message, f"a path led out of the library: {message}")


def wrong_arguments_are_refused_at_the_call(job):
    for call, found in (("own_ball(7);", "own_ball: radius: expected a number from 1 to 5 (mm), found 7"),
                        ('own_ball("big");', 'own_ball: radius: expected a number from 1 to 5 (mm), found "big"'),
                        ("own_ball(skin = 3);", "own_ball: skin: expected a material or a mixture, found 3"),
                        ("own_ball(skin = noise(size = 3));",
                         "own_ball: skin: expected a material or a mixture, found a value that varies in space"),
                        ("own_ball(own_walls(noise(size = 3)));",
                         "own_walls: wall: expected a number (mm), found a value that varies in space"),
                        ('own_ball(own_walls(1, "tick"));',
                         'own_walls: kind: expected one of "thick", "thin", found "tick"')):
        design = job.write("wrong.vcad", f"use <own/balls.vcad>\n{call}\n")
        message = job.slice("wrong", *OPTIONS, design=design, status=1).stderr
        expect(found in message and "wrong.vcad:2:" in message, f"{call}: {message}")
    varying = job.write("varying.vcad", 'use <own/balls.vcad>\nown_ball(2 + noise(size = 3), mix("red", "blue", noise(size = 3)));\n')
    job.slice("varying", *OPTIONS, design=varying)


def operators_are_listed_and_explained(job):
    listed = job.run("nodes").stdout
    expect("own_ball" in listed and "A ball with a core." in listed, listed[-500:])
    explained = job.run("nodes", "own_ball").stdout
    for line in ("own_ball: A ball with a core.", "category: own; use <own/balls.vcad>; gives solids",
                 "  radius: Radius of the ball", "      value, mm, 1 to 5; default 3",
                 '      material; default "red"', "  own_ball(3);", "source: this test"):
        expect(line in explained.splitlines(), f"{line!r} is not in\n{explained}")
    expect("value, mm" in job.run("operators", "own_walls").stdout, "the output")
    described, = job.events("operators", "own_ball")
    expect(described["library"] == "own/balls.vcad" and described["parameters"][0]["most"] == 5, json.dumps(described))
    expect('did you mean "own_ball"' in job.run("nodes", "own_bal", status=1).stderr, "no suggestion")
    expect("own_ball" not in job.run("operators", "--markdown").stdout, "the reference tells of the user's library")


def openscad_scripts_use_operators(job):
    script = job.write("part.scad", "use <own/balls.vcad>\ntranslate([1, 0, 0]) own_ball(2.5);\n")
    moved = job.write("moved.vcad", "use <own/balls.vcad>\ntranslate(1, 0, 0) own_ball(2.5);\n")
    made = program.run(job.slicing("script", *OPTIONS, design=script), cwd=job.path)
    if "OMBRE_SOLIDS" in made.stderr:
        return "skipped: built without CGAL"
    expect(made.returncode == 0, made.stderr[-1500:])
    job.slice("moved", *OPTIONS, design=moved)
    expect(same(job, "script", "moved"), "the script makes something else")
    wrong = job.write("wrong.scad", "use <own/balls.vcad>\nown_ball(7);\n")
    expect("expected a number from 1 to 5 (mm), found 7" in job.slice("wrong", *OPTIONS, design=wrong, status=1).stderr,
           "a wrong argument was taken")
    return ""


CHECKS = [the_users_library_is_found, a_library_beside_the_design_comes_first, a_library_that_changes_makes_another_job,
          bundles_carry_libraries, folders_that_were_searched_are_named, wrong_arguments_are_refused_at_the_call,
          operators_are_listed_and_explained, openscad_scripts_use_operators]

if __name__ == "__main__":
    raise SystemExit(program.main(Libraries, program.named(CHECKS)))

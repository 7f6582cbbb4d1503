#!/usr/bin/env python3
"""`ombre check --fix` corrects what it finds, `ombre slice` looks before it slices, and `ombre tray` packs parts.

    python3 tests/run_check.py build/dev/apps/ombre/ombre [NAME...]
"""
import json
import sys

import program
from program import expect, near

MACHINE = {
    "name": "machine", "title": "A machine", "source": "made up", "build_mm": [60, 40, 30], "image": "indexed",
    "pitch": {"x": "0.1", "y": "0.1", "z": "0.1"}, "smallest_feature": {"distorts_mm": 0.2, "fails_mm": 0.2},
    "forbidden_neighbours": [{"material": "blue", "near": "surface", "within_mm": 0.3}]}
# A core of 2 mm, 0.2 mm below the surface, beside a plate of one voxel by 30 by 20 and a crumb of 4 voxels each way.
PART = """
union() {
  rectprism([2, 2, 2], blue);
  difference() { rectprism([2.4, 2.4, 2.4], red); rectprism([2, 2, 2], red); }
  translate(4, 0, 0) rectprism([3, 0.2, 2], clear);
  translate(8, 0, 0) rectprism([0.4, 0.4, 0.4], clear);
}
"""

# Closed pores of foams, and crumbs that a cut leaves of cells, are really there. Nothing is found in the other examples.
REALLY_THERE = {
    "hollow": {"auxetic_insole", "bone", "graded_wing", "helmet", "helmet_liner", "paddle", "tweel", "voronoi_foam",
               "voronoi_implant"},
    "bodies": {"auxetic_insole", "bone", "changing_cells", "dense_pipe", "graded_wing", "grading_strategies", "gyroid_block",
               "gyroid_pipe", "helmet_liner", "overlap", "paddle", "sharpened_scan", "unit_cells", "value_nodes", "voronoi_foam",
               "voronoi_implant"}}
LARGE = {"head_scan"}  # takes minutes


def machine(folder, **members):
    folder.write("machine.json", json.dumps(MACHINE | members))
    return ["--printer", "./machine.json"]


def faults_are_corrected_by_so_much(folder):
    """The crumb has 64 voxels. A plate of two voxels grows to three by balls without corners."""
    printer = machine(folder, smallest_feature={"distorts_mm": 0.3, "fails_mm": 0.3})
    folder.write("part.vcad", PART)
    events = folder.events("check", "part.vcad", *printer, "--fix", "fixed", "--drop", "0.1", "--neutral", "clear",
                           status=0)
    before, after = [event for event in events if event["event"] == "checked"]
    expect({finding["kind"] for finding in before["findings"]} == {"thin", "neighbour", "bodies"}, f"{before}")
    expect({finding["kind"] for finding in after["findings"]} == {"bodies"}, f"{after}")
    gained = {c["kind"]: c["gained_mm3"] for c in next(e for e in events if e["event"] == "corrected")["corrections"]}
    near(gained["drop"]["clear"], -0.064, 1e-9, "drop of clear")
    # Without the corners of their middle layers, three layers of one voxel more on each side than 29 x 19 middles.
    near(gained["thicken"]["clear"], (3 * 31 * 21 - 7 - 2 * 30 * 20) / 1000, 1e-9, "thicken of clear")
    near(gained["keep-apart"]["blue"], (18 ** 3 - 20 ** 3) / 1000, 1e-9, "keep-apart of blue")
    near(gained["keep-apart"]["clear"], (20 ** 3 - 18 ** 3) / 1000, 1e-9, "keep-apart of clear")
    described = json.loads((folder.path / "fixed/job.json").read_text())
    expect([c["kind"] for c in described["corrections"]] == ["drop", "thicken", "keep-apart"], f"{described}")
    said = folder.run("verify", "fixed", "--design", "part.vcad").stdout
    expect("the job has corrections" in said and "everything that was checked holds" in said, said)


def hollows_get_drains(folder):
    """A wall of 5 voxels above a hollow of 20 x 20 x 20; a ball of three voxels cuts 3 x 3 of each layer."""
    folder.write("trap.vcad", "difference() { rectprism([4, 4, 4], red); translate(0, 0, 0.5) rectprism([2, 2, 2], red); }")
    events = folder.events("check", "trap.vcad", "--voxel", "0.1", "--fix", "drained", "--drain", "0.3")
    before, after = [event for event in events if event["event"] == "checked"]
    expect([finding["kind"] for finding in before["findings"]] == ["hollow"] and after["findings"] == [], f"{events}")
    correction, = next(e for e in events if e["event"] == "corrected")["corrections"]
    expect(correction["kind"] == "drain", f"{correction}")
    near(correction["gained_mm3"]["red"], -9 * 5 / 1000, 1e-9, "the channel")
    said = folder.run("check", "trap.vcad", "--voxel", "0.1", "--fix", "other").stdout
    expect("closed hollows" in said and "channel" not in said, said)
    wrong = folder.run("check", "trap.vcad", "--voxel", "0.1", "--drain", "0.3", status=1).stderr
    expect("--fix" in wrong, wrong)


def what_it_cannot_correct_is_said(folder):
    printer = machine(folder)
    folder.write("part.vcad", PART)
    error = folder.run("check", "part.vcad", *printer, "--fix", "fixed", status=1).stderr
    expect("red and clear may lie between forbidden neighbours" in error and "--neutral" in error, error)
    error = folder.run("check", "part.vcad", *printer, "--fix", "fixed", "--neutral", "blue", status=1).stderr
    expect('a rule of A machine is about "blue"' in error, error)
    (folder.path / "fixed").mkdir()
    folder.write("fixed/notes.txt", "mine")
    error = folder.run("check", "part.vcad", *printer, "--fix", "fixed", "--neutral", "red", status=2).stderr
    expect("fixed" in error, error)
    folder.write("cup.vcad", "difference() { rectprism([3, 3, 3], red); translate(0, 0, 1) rectprism([2, 2, 2], red); }")
    out = folder.run("check", "cup.vcad", "--printer", "vat-50um", "--fix", "cup").stdout
    expect("cups that open upwards" in out and "one correction" in out, out)


def slicing_warns_beforehand(folder):
    printer = machine(folder)
    folder.write("part.vcad", PART)
    warned = folder.run("slice", "part.vcad", *printer, "-o", "a").stderr
    expect(warned.count("warning") == 1 and "blue lies nearer than 0.3 mm to the surface" in warned, warned)
    folder.write("wave.vcad", 'fgrade(["0.5 + 0.5 * sin(40 * x)", "0.5 - 0.5 * sin(40 * x)"], [red, clear]) cube(4);')
    warned = folder.run("slice", "wave.vcad", *printer, "-o", "b").stderr
    expect(warned.count("warning") == 1 and "every 0.1571 mm along x" in warned, warned)
    for design in ("part", "wave"):
        quiet = folder.run("slice", f"{design}.vcad", *printer, "-o", f"{design}_quiet", "--unchecked").stderr
        expect("warning" not in quiet, quiet)


def trays_hold_copies(folder):
    printer = machine(folder, gap_mm=1)
    folder.write("one.vcad", "union() { cylinder(1, 4, red); translate(3, 0, 0) sphere(2, clear); }")
    folder.write("two.vcad", "rectprism([2, 2, 2], red);")
    event = folder.events("tray", "one.vcad", "two.vcad", "--count", "3,5", *printer)[-1]
    expect(event["parts"] == [f"one_{n}" for n in (1, 2, 3)] + [f"two_{n}" for n in (1, 2, 3, 4, 5)], f"{event}")
    done = folder.events("slice", "tray.json", *printer, "--tray", "-o", "tray")[-1]
    counts = {m["name"]: m["voxels"] for m in done["materials"]}
    one = {m["name"]: m["voxels"] for m in folder.events("slice", "one.vcad", *printer, "-o", "one")[-1]["materials"]}
    expect(counts == {"red": 3 * one["red"] + 5 * 8000, "clear": 3 * one["clear"]}, f"{counts} {one}")
    # 20 blocks of 2 mm with gaps of 1 mm fit along 60 mm, and 13 along 40 mm.
    error = folder.run("tray", "two.vcad", "--count", "300", *printer, "-o", "full.json", status=1).stderr
    expect("of 300 parts 260 fit onto the tray of A machine, 60 x 40 mm" in error, error)
    for arguments, part in ((["two.vcad", "two.vcad"], 'two designs are called "two"'),
                            (["one.vcad", "two.vcad", "--count", "1,2,3"], "there are 2 designs and 3 numbers"),
                            (["two.vcad", "--count", "some"], '"some" is no number of copies')):
        error = folder.run("tray", *arguments, *printer, "-o", "wrong.json", status=1).stderr
        expect(part in error, error)


def trays_find_the_files_of_their_parts(folder):
    """A tray names files relative to itself, wherever it is used."""
    printer = machine(folder)
    folder.write_design_of_files()
    folder.run("tray", "sub/part.vcad", "--count", "2", *printer, "-o", "sub/tray.json")
    expect('"path": "corner.off"' in folder.read("sub/tray.json"), folder.read("sub/tray.json"))
    (folder.path / "other").mkdir()
    folder.run("tray", "sub/part.vcad", *printer, "-o", "other/tray.json")
    written = folder.read("other/tray.json")
    expect('"../sub/corner.off"' in written and '"../sub/sizes.csv"' in written, written)
    for place in ("sub", "other"):
        probed = program.run([folder.ombre, "probe", "tray.json", "--at", "1,1,1"], cwd=folder.path / place)
        expect(probed.returncode == 0, probed.stderr)


def trays_are_json(folder):
    folder.write("one.vcad", "cube(2);")
    error = folder.run("tray", "one.vcad", *machine(folder), "-o", "tray.txt", status=1).stderr
    expect("give it a name that ends in .json" in error, error)


def examples_have_no_faults(folder):
    for design in sorted((program.SOURCE / "examples").glob("*.vcad")):
        if design.stem in LARGE:
            continue
        event = folder.events("check", design)[-1]
        expect(event["is_printable"], f"{design.stem}: {event}")
        found = {finding["kind"] for finding in event["findings"]}
        expect(found == {kind for kind, names in REALLY_THERE.items() if design.stem in names}, f"{design.stem}: {event}")


CHECKS = program.named([faults_are_corrected_by_so_much, hollows_get_drains, what_it_cannot_correct_is_said,
                        slicing_warns_beforehand, trays_hold_copies,
                        trays_find_the_files_of_their_parts, trays_are_json])
LONG = program.named([examples_have_no_faults])

if __name__ == "__main__":
    sys.exit(program.main(program.Folder, LONG if "examples_have_no_faults" in sys.argv else CHECKS))

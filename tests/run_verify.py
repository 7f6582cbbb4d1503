#!/usr/bin/env python3
"""`ombre verify` passes what `ombre slice` writes and names what is wrong; `ombre diff` measures what changes.

    python3 tests/run_verify.py build/dev/apps/ombre/ombre [--all] [NAME...]
"""
import functools
import itertools
import sys
import zipfile

import program
from program import expect, near

GRADED = """
height = 4;
fgrade(["(z + 2) / 4", "(2 - z) / 4"], [red, blue]) union() {
  sphere(2);
  translate(2.5, 1, 0) rectprism([2, 1, height]);
}
"""
DITHERS = ["stochastic", "blue-noise", "diffusion", "threshold"]
FORMATS = ["indexed", "rgba", "gray", "mask"]
FEW = ["bcc_ball", "graded_cube", "gyroid_block", "knob", "supported_bridge"]


def example(folder, design, dither, form, voxels):
    """A stack of about so many voxels passes."""
    planned = folder.events("slice", design, "--dry-run")
    plan = next(event for event in planned if event["event"] == "plan")
    size = 1.0
    for length in plan["size_mm"]:
        size *= length
    voxel = (size / voxels) ** (1 / 3)
    folder.run("slice", design, "--voxel", f"{voxel:.4f}", "--dither", dither, "--format", form, "-o", "stack")
    result = folder.run("verify", "stack", "--design", design, "--all")
    expect("everything that was checked holds" in result.stdout, result.stdout)


def stack(folder, *options):
    folder.write("part.vcad", GRADED)
    folder.run("slice", "part.vcad", "--voxel", "0.2", "-o", "stack", *options)
    return folder.path / "stack"


def verified(folder, *options, status=3):
    """The event of a stack with a fault."""
    return folder.events("verify", "stack", *options, status=status)[-1]


def kinds(event):
    return {finding["kind"] for finding in event["findings"]}


def a_right_stack_holds(folder):
    stack(folder)
    event = verified(folder, "--design", "part.vcad", status=0)
    expect(event["holds"] and event["findings"] == [] and event["layers"] == 20, f"{event}")
    expect(event["voxels_compared"] == 28 * 20 * 20, f"{event}")


def without_a_design_this_is_said(folder):
    stack(folder)
    said = folder.run("verify", "stack").stdout
    expect("without a design" in said and "everything that was checked holds" in said, said)


def variables_and_parts_of_jobs_are_known(folder):
    stack(folder, "-D", "height=3", "--box=-1,-1,-1,2,2,1")
    event = verified(folder, "--design", "part.vcad", "-D", "height=3", status=0)
    expect(event["holds"], f"{event}")
    expect("design" in kinds(verified(folder, "--design", "part.vcad")), "another height is the same design")


def a_report_has_pictures(folder):
    stack(folder)
    folder.write("part.vcad", GRADED.replace("sphere(2)", "sphere(1.6)"))
    event = verified(folder, "--design", "part.vcad", "--report", "report.html")
    expect({"design", "voxels"} <= kinds(event), f"{event}")
    page = folder.read("report.html")
    expect("data:image/png;base64,iVBORw0KGgo" in page and "do not hold" in page, page[:500])
    again = folder.run("verify", "stack", "--report", "report.html", status=2).stderr
    expect("exists already" in again, again)


def files_are_compared_with_the_journal(folder):
    path = stack(folder)
    (path / "slice_00003.png").unlink()
    (path / "slice_00030.png").write_bytes((path / "slice_00004.png").read_bytes())
    event = verified(folder)
    expect(kinds(event) == {"missing", "extra"}, f"{event}")


def borders_of_shares_are_compared(folder):
    folder.write("part.vcad", GRADED)
    folder.run("slice", "part.vcad", "--voxel", "0.2", "-o", "stack", "--save-job", "job.json")
    folder.run("plan", "job.json", "--shards", "2")
    folder.run("run", "plan.json", "--shard", "all")
    folder.run("gather", "plan.json")
    event = verified(folder, "--design", "part.vcad", "--plan", "plan.json", "--voxels", "1", status=0)
    expect(event["voxels_compared"] >= 2 * 28 * 20, f"{event}")
    expect(any("are evaluated again" in text for text in event["unchecked"]), f"{event}")


def archives_are_read(folder):
    path = stack(folder)
    folder.run("slice", "part.vcad", "--voxel", "0.2", "-o", "stack.zip")
    said = [folder.events("verify", name, "--design", "part.vcad")[-1] for name in ("stack", "stack.zip")]
    expect(said[0] == said[1], f"{said}")
    expect(folder.events("diff", "stack.zip", "stack")[-1]["same"], "an archive differs from its folder")
    (path / "slice_00003.png").write_bytes((path / "slice_00004.png").read_bytes())
    with zipfile.ZipFile(folder.path / "wrong.zip", "w") as archive:
        for file in sorted(path.iterdir()):
            archive.write(file, file.name)
    event = folder.events("verify", "wrong.zip", status=3)[-1]
    expect("hash" in kinds(event) and "slice_00003.png" in str(event["findings"]), f"{event}")
    whole = (folder.path / "stack.zip").read_bytes()
    (folder.path / "torn.zip").write_bytes(whole[:len(whole) // 2])
    error = folder.run("verify", "torn.zip", status=2).stderr
    expect("torn.zip" in error and "damaged or cut short" in error, error)


def what_is_no_stack_is_named(folder):
    path = stack(folder)
    expect("nowhere" in folder.run("verify", "nowhere", status=2).stderr, "no folder is named")
    (folder.path / "empty").mkdir()
    error = folder.run("verify", "empty", status=2).stderr
    expect("empty holds no slice job: there is no job.json in it" in error, error)
    job = folder.read("stack/job.json")
    (path / "job.json").write_text(job.replace('"dither": "stochastic"', '"dither": "coin"'), encoding="utf-8")
    error = folder.run("verify", "stack", status=2).stderr
    expect("job.json:" in error and "coin" in error, error)
    (path / "job.json").write_text(job.replace('"printer"', '"weather": 1, "printer"'), encoding="utf-8")
    error = folder.run("verify", "stack", status=2).stderr
    expect("weather" in error, error)


def blocks_that_move_differ(folder):
    """2 x 2 x 2 mm, moved by 0.3 mm."""
    folder.write("a.vcad", "rectprism([2, 2, 2], red);")
    folder.write("b.vcad", "translate(0.3, 0, 0) rectprism([2, 2, 2], red);")
    event = folder.events("diff", "a.vcad", "b.vcad", status=3)[-1]
    near(event["lost_mm3"], 1.2, 1e-9, "what is lost")
    near(event["gained_mm3"], 1.2, 1e-9, "what is gained")
    expect([[round(n, 6) for n in corner] for corner in event["box_mm"]] == [[-1, -1, -1], [1.3, 1, 1]], f"{event}")
    expect(folder.events("diff", "a.vcad", "a.vcad")[-1]["same"], "a design differs from itself")


def a_stack_is_its_design(folder):
    stack(folder, "--dither", "blue-noise", "--seed", "9")
    said = folder.run("diff", "stack", "part.vcad").stdout
    expect("there is no difference" in said, said)
    folder.write("part.vcad", GRADED.replace("sphere(2)", "sphere(1.8)"))
    said = folder.run("diff", "stack", "part.vcad", "--report", "changes.html", status=3).stdout
    expect("red to void" in said and "they differ" in said and "\ngained 0 mm3" in said, said)
    expect("data:image/png" in folder.read("changes.html"), "the page has no pictures")


# A cube of 20 x 20 x 20 voxels. Shades stand for 120 / 255 each, so that 24 is the shade 51, and 48 the shade 102.
DOSED = """
attribute("dose", "{dose}", "mJ/cm2") rectprism([2, 2, 2], red);
"""


def values(folder, name, dose, *options):
    folder.write(f"{name}.vcad", DOSED.format(dose=dose))
    folder.run("slice", f"{name}.vcad", "--by", "dose", "--range", "0,120", "--voxel", "0.1", "-o", name, *options)


def values_that_change_are_measured(folder):
    """Half of the cube gets 24 more."""
    values(folder, "a", "24")
    values(folder, "b", "x < 0 ? 24 : 48")
    event = folder.events("diff", "a", "b", "--report", "changes.html", status=3)
    [channel] = next(one for one in event if one["event"] == "changes")["channels"]
    expect(channel["name"] == "dose" and channel["voxels"] == 4000, f"{channel}")
    near(channel["mm3"], 4, 1e-9, "the volume of the differences")
    near(channel["greatest"], 24, 1e-9, "the greatest difference")
    near(channel["mean"], 24, 1e-9, "the mean difference")
    near(channel["at_mm"][0], 0.05, 1e-9, "the place of the greatest difference")
    expect([[round(n, 6) for n in corner] for corner in channel["box_mm"]] == [[0, -1, -1], [1, 1, 1]], f"{channel}")
    expect("more in blue" in folder.read("changes.html"), "the page has no pictures")
    said = folder.run("diff", "a", "b", status=3).stdout
    expect("dose differs in 4 mm3 (4,000 voxels), by at most 24 mJ/cm2" in said, said)
    expect("dose is the same" in folder.run("diff", "a", "a").stdout, "a stack differs from itself")


def values_of_other_kinds(folder):
    """16 bits differ from 8 by rounding alone; masks differ by 1; materials are not compared with values."""
    values(folder, "a", "24 + x")
    values(folder, "deep", "24 + x", "--bits", "16")
    expect("dose is the same" in folder.run("diff", "a", "deep").stdout, "more bits are other values")
    values(folder, "mask", "48", "--bits", "1")
    values(folder, "half", "x < 0 ? 48 : 72", "--bits", "1")
    [channel] = folder.events("diff", "mask", "half", status=3)[-1]["channels"]
    expect(channel["voxels"] == 4000, f"{channel}")
    folder.run("slice", "a.vcad", "--voxel", "0.1", "-o", "materials")
    error = folder.run("diff", "a", "materials", status=2).stderr
    expect("a shows values, so materials has to be a stack of values, too" in error, error)


def checks(ombre, takes_all):
    designs = program.examples(ombre)
    if not takes_all:
        designs = [design for design in designs if design.stem in FEW] or designs[:5]
    ways = itertools.cycle(zip(DITHERS * 4, [form for n in range(4) for form in FORMATS[n:] + FORMATS[:n]]))
    voxels = 300_000 if takes_all else 30_000
    found = {}
    for design, (dither, form) in zip(designs, ways):
        found[f"{design.stem} {dither} {form}"] = functools.partial(
            example, design=design, dither=dither, form=form, voxels=voxels)
    if takes_all:
        return found
    return found | program.named([
        a_right_stack_holds, without_a_design_this_is_said, variables_and_parts_of_jobs_are_known,
        a_report_has_pictures, files_are_compared_with_the_journal, borders_of_shares_are_compared,
        what_is_no_stack_is_named, archives_are_read, blocks_that_move_differ, a_stack_is_its_design,
        values_that_change_are_measured, values_of_other_kinds])


if __name__ == "__main__":
    ALL = "--all" in sys.argv
    sys.argv = [argument for argument in sys.argv if argument != "--all"]
    sys.exit(program.main(program.Folder, checks(sys.argv[1], ALL)))

#!/usr/bin/env python3
"""A slice job that processes share has the bytes of the job that one process does, whatever happens to the processes.

    python3 tests/run_shards.py build/dev/apps/ombre/ombre [NAME...]
"""
import hashlib
import json
import random
import signal
import subprocess
import time

import program
from program import expect

DESIGN = """
height = 4;
fgrade(["(z + 2) / 4", "(2 - z) / 4"], [red, blue]) union() {
  sphere(2);
  translate(3, 0, 0) rectprism([2, 2, height], red);
}
"""
# All shares need the supports, which are values of the whole job.
SUPPORTED = """
support() union() {
  cube(2);
  translate(1, 0, 1.75) rectprism([4, 2, 0.5]);
}
"""
OPTIONS = ["--voxel", "0.1,0.1,0.05"]  # 80 layers


def begin(folder, shards=7, design=DESIGN, output="shared"):
    """Plans a job, and does the same one alone."""
    folder.write("part.vcad", design)
    ending = ".zip" if output.endswith(".zip") else ""
    folder.run("slice", "part.vcad", *OPTIONS, "-o", "alone" + ending)
    folder.run("slice", "part.vcad", *OPTIONS, "-o", output, "--save-job", "job.json")
    said = folder.run("plan", "job.json", "--shards", shards).stderr
    layers = 80 if design == DESIGN else 60
    expect(f"{shards:,} shares of {layers} layers" in said, said)


def contents(path):
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(path.iterdir())}


def gather(folder):
    folder.run("gather", "plan.json")
    expect(contents(folder.path / "shared") == contents(folder.path / "alone"), "the shares have other bytes")


def one_share(folder):
    begin(folder, 1)
    folder.run("run", "plan.json", "--shard", "1/1")
    gather(folder)


def seven_shares_in_any_order(folder):
    seed = random.randrange(1 << 32)
    print(f"the order is that of the seed {seed}")
    begin(folder)
    shards = json.loads(folder.read("plan.json"))["shards"]
    expect(shards[0][0] == 0 and shards[-1][1] == 80, f"{shards}")
    order = list(range(1, 8))
    random.Random(seed).shuffle(order)
    running = [subprocess.Popen(folder.command("run", "plan.json", "--shard", n, "--quiet"), cwd=folder.path,
                                env=program.environment()) for n in order]
    for process in running:
        expect(process.wait(120) == 0, f"a share ended with {process.returncode}")
    said = folder.run("status", "plan.json").stderr
    expect("7 of 7 shares are done; ombre gather plan.json joins them" in said, said)
    gather(folder)
    folder.run("run", "plan.json", "--shard", 3)  # a straggler, after all was joined
    gather(folder)


def more_shares_than_layers(folder):
    begin(folder, 1000)
    folder.run("run", "plan.json", "--shard", "all", "--quiet")
    gather(folder)


def archive(folder):
    begin(folder, 3, output="shared.zip")
    for n in (2, 3, 1):
        folder.run("run", "plan.json", "--shard", n)
    folder.run("gather", "plan.json")
    expect((folder.path / "shared.zip").read_bytes() == (folder.path / "alone.zip").read_bytes(), "the archives differ")
    expect(not (folder.path / "shared.zip.pieces").exists(), "the pieces are left")


def frames(folder):
    """Processes share the frames of a turntable as they share layers."""
    folder.write("part.vcad", DESIGN)
    picture = ("render", "part.vcad", "--frames", 11, "--size", "60x40")
    folder.run(*picture, "-o", "alone/")
    folder.run(*picture, "-o", "shared/", "--save-job", "job.json")
    wrong = folder.run("plan", "job.json", "--minutes", 5, status=1).stderr
    expect("how long this job takes is not known; write for example --shards 40" in wrong, wrong)
    folder.run("plan", "job.json", "--shards", 3)
    folder.run_three_shares("frames 4:7")
    for unknown, option in (("how long the shares take", "--minutes 30"), ("how much memory they take", "--memory 4096")):
        known = ("--minutes", 30) if option != "--minutes 30" else ()
        wrong = folder.run("submit", "plan.json", "--to", "slurm", "--print", *known, status=1).stderr
        expect(f"{unknown} is not known; write for example {option}" in wrong, wrong)
    folder.write("part.vcad", DESIGN.replace("height = 4", "height = 3"))
    wrong = folder.run("run", "plan.json", "--shard", 2, status=2).stderr
    expect("plan.json is the plan of another job: part.vcad differs" in wrong, wrong)
    folder.run("render", "part.vcad", "-o", "one.png", "--save-job", "one.json")
    wrong = folder.run("plan", "one.json", "--shards", 3, "-o", "one_plan.json", status=1).stderr
    expect("of pictures the frames in a folder or an archive are shared out" in wrong, wrong)


def grids(folder):
    """Processes share the slabs of grids, which become the files of one process."""
    folder.write("part.vcad", DESIGN)
    whole = ("voxels", "part.vcad", *OPTIONS, "--what", "materials,distance,fractions")
    folder.run(*whole, "-o", "alone.nrrd")
    folder.run(*whole, "-o", "part.nrrd", "--save-job", "job.json")
    folder.run("plan", "job.json", "--shards", 3)
    folder.run_three_shares("slabs 3:7")
    names = [f"_{name}.nrrd" for name in ("material", "distance", "red", "blue")]
    for name in names:
        expect((folder.path / ("part" + name)).read_bytes() == (folder.path / ("alone" + name)).read_bytes(), name)
    expect(not (folder.path / "part.nrrd.slabs").exists(), "the slabs are left")
    wrong = folder.run("run", "plan.json", "--shard", 1, status=2).stderr
    expect("part_material.nrrd exists already; remove it" in wrong, wrong)
    folder.write("part.vcad", DESIGN.replace("height = 4", "height = 3"))
    wrong = folder.run("run", "plan.json", "--shard", 2, status=2).stderr
    expect("plan.json is the plan of another job: part.vcad" in wrong, wrong)
    folder.run("voxels", "part.vcad", "-o", "part.vdb", "--voxel", "0.2", "--save-job", "sparse.json")
    wrong = folder.run("plan", "sparse.json", "--shards", 3, "-o", "sparse_plan.json", status=1).stderr
    expect("of grids those in .npy, .nrrd and .raw files are shared out" in wrong, wrong)


BODIES = """
height = 1.3;
fgrade(["(z + 4) / 8", "(4 - z) / 8"], [red, blue]) difference() {
  union() { sphere(4); translate(0, 0, 3) rectprism([12, 2, height], red); }
  translate(0.3, 0, 0) sphere(1.1);
}
"""


def plan_mesh(folder, shards, *options):
    folder.write("part.vcad", BODIES)
    mesh = ("mesh", "part.vcad", "--bands", 3, *options)
    folder.run(*mesh, "-o", "alone.3mf", "--force")
    (folder.path / "job.json").unlink(missing_ok=True)
    folder.run(*mesh, "-o", "part.3mf", "--save-job", "job.json")
    folder.run("plan", "job.json", "--shards", shards, "--force")


def gather_mesh(folder):
    folder.run("gather", "plan.json")
    expect(folder.bytes("part.3mf") == folder.bytes("alone.3mf"), "the shares have other bytes")
    expect(not (folder.path / "part.3mf.slabs").exists(), "the slabs are left")
    (folder.path / "part.3mf").unlink()


def meshes(folder):
    """Processes share the cells of a mesh of several bodies, whose surface is made of all of them."""
    for shards in (1, 2, 7):
        plan_mesh(folder, shards)
        for n in range(shards, 0, -1):
            folder.run("run", "plan.json", "--shard", n)
        said = folder.run("status", "plan.json").stderr
        expect(f"{shards} of {shards} shares are done" in said, said)
        gather_mesh(folder)
    for options in (["--keep-all", "--cell", "0.3"], ["--threads", "1", "--tolerance", "0.1", "--colour-by", "materials"]):
        plan_mesh(folder, 2, *options)
        folder.run("run", "plan.json", "--shard", "all")
        gather_mesh(folder)


def unfinished_meshes(folder):
    """A share of a mesh that is killed goes on where it was; a missing one is named; other designs are refused."""
    plan_mesh(folder, 2, "--tolerance", "0.01")
    journal = folder.path / "part.3mf.slabs/journal-1-of-2.jsonl"
    process = subprocess.Popen(folder.command("run", "plan.json", "--shard", 1, "--quiet"), cwd=folder.path,
                               env=program.environment())
    while process.poll() is None and not (journal.exists() and b"\n" in journal.read_bytes()):
        time.sleep(0.001)
    process.send_signal(signal.SIGKILL)
    process.wait()
    missing = [event["missing"] for event in folder.events("status", "plan.json") if event["event"] == "share"]
    expect(missing[0] < 26 and missing[1] == 25, f"{missing} slabs are missing")
    folder.run("run", "plan.json", "--shard", 1)
    wrong = folder.run("gather", "plan.json", status=2).stderr
    expect("are missing, of shares 2; run these again: ombre run plan.json --shard 2" in wrong, wrong)
    folder.write("part.vcad", BODIES.replace("1.3", "1.4"))
    wrong = folder.run("run", "plan.json", "--shard", 2, status=2).stderr
    expect("plan.json is the plan of another job: part.vcad differs" in wrong, wrong)
    folder.write("part.vcad", BODIES)
    planned = folder.read("plan.json")
    folder.write("plan.json", planned.replace('"0.01"', '"0.02"').replace(": 0.01", ": 0.02"))
    wrong = folder.run("run", "plan.json", "--shard", 2, status=2).stderr
    expect("plan.json is the plan of another job: --tolerance" in wrong, wrong)
    folder.write("plan.json", planned)
    folder.run("run", "plan.json", "--shard", 2)
    gather_mesh(folder)
    folder.write("part.3mf", "not ours")
    wrong = folder.run("run", "plan.json", "--shard", 1, status=2).stderr
    expect("part.3mf exists already; remove it, or plan a job with another -o" in wrong, wrong)


def meshes_without_shares(folder):
    """Polyhedra of scripts, and beams, have no cells to share."""
    folder.write("part.scad", "cube(3);")
    folder.write("part.vcad", BODIES)
    for arguments, words in ((("part.scad",), "a script's polyhedra keep their triangles"),
                             (("part.vcad", "--beams"), "meshes are shared out without --beams")):
        folder.run("mesh", *arguments, "-o", "part.3mf", "--save-job", f"{len(arguments)}.json")
        wrong = folder.run("plan", f"{len(arguments)}.json", "--shards", 2, "-o", "more.json", status=1).stderr
        expect(words in wrong, wrong)


def values_of_all_shares(folder):
    """Supports are made once, and the shares read them."""
    begin(folder, 3, SUPPORTED)
    folder.run("run", "plan.json", "--shard", 1)
    expect(not (folder.path / "shared/stages").exists(), "a share keeps what others need")
    folder.run("run", "plan.json", "--stages")
    [kept] = (folder.path / "shared/stages").glob("*.stage")
    changed = kept.stat().st_mtime_ns
    folder.run("run", "plan.json", "--stages")
    expect(kept.stat().st_mtime_ns == changed, "supports are made again")
    folder.run("run", "plan.json", "--shard", 2)
    kept.write_bytes(b"damaged")  # which costs time alone
    folder.run("run", "plan.json", "--shard", 3)
    gather(folder)
    begin_again = folder.run("run", "plan.json", "--stages", "--shard", 1, status=1).stderr
    expect("--stages" in begin_again and "--shard" in begin_again, begin_again)


def killed_processes(folder):
    """A share that is killed goes on where it was, and a torn journal costs one layer."""
    begin(folder, 2)
    journal = folder.path / "shared/journal-1-of-2.jsonl"
    process = subprocess.Popen(folder.command("run", "plan.json", "--shard", 1, "--quiet"), cwd=folder.path,
                               env=program.environment())
    while process.poll() is None and not (journal.exists() and journal.stat().st_size > 0):
        time.sleep(0.001)
    process.send_signal(signal.SIGKILL)
    process.wait()
    folder.run("run", "plan.json", "--shard", 1)
    text = journal.read_bytes()
    journal.write_bytes(text[:-20])
    folder.run("run", "plan.json", "--shard", 2)
    wrong = folder.run("gather", "plan.json", status=2).stderr
    expect("are missing, of shares 1; run these again: ombre run plan.json --shard 1" in wrong, wrong)
    folder.run("run", "plan.json", "--shard", 1)
    gather(folder)


def full_disk(folder):
    """Shares that find no space end with a message; nothing is lost or doubled, and they go on when there is space."""
    small = folder.path / "small"
    small.mkdir()
    if program.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", small]).returncode:
        return "skipped: only root may mount a small disk"
    try:
        begin(folder, 4, output="small/shared")
        running = [subprocess.Popen(folder.command("run", "plan.json", "--shard", n), cwd=folder.path, text=True,
                                    env=program.environment(), stderr=subprocess.PIPE) for n in (1, 2, 3, 4)]
        said = [process.communicate(timeout=program.PATIENCE_S)[1] for process in running]
        failed = [text for process, text in zip(running, said) if process.returncode != 0]
        # Some may be done before the others fill the disk. How many layers a share has depends on what the plan measured.
        expect(failed and all(process.returncode in (0, 2) for process in running), f"{said}")
        expect(all("No space left on device; free some space there and try again" in text for text in failed), f"{said}")
        missing = sum(event["missing"] for event in folder.events("status", "plan.json") if event["event"] == "share")
        expect(0 < missing < 80, f"{missing} layers are missing")
        expect("are missing" in folder.run("gather", "plan.json", status=2).stderr, "a gap is not named")
        expect(program.run(["mount", "-o", "remount,size=4m", small]).returncode == 0, "the disk does not grow")
        folder.run("run", "plan.json", "--shard", "all", "--quiet")
        said = folder.run("gather", "plan.json").stderr
        expect("several processes" not in said, said)
        expect(contents(small / "shared") == contents(folder.path / "alone"), "the shares have other bytes")
    finally:
        program.run(["umount", small])


def missing_shares(folder):
    begin(folder)
    for n in (1, 2, 5):
        folder.run("run", "plan.json", "--shard", n)
    shards = json.loads(folder.read("plan.json"))["shards"]
    wrong = folder.run("gather", "plan.json", status=2).stderr
    gaps = f"layers {shards[2][0]}:{shards[3][1]}, {shards[5][0]}:80 are missing, of shares 3, 4, 6, 7"
    expect(gaps in wrong, wrong)
    states = [event for event in folder.events("status", "plan.json") if event["event"] == "share"]
    expect([state["missing"] > 0 for state in states] == [False, False, True, True, False, True, True], f"{states}")
    folder.run("slice", "part.vcad", *OPTIONS, "-o", "shared", "--resume")  # joins, and makes the rest
    expect(contents(folder.path / "shared") == contents(folder.path / "alone"), "the shares have other bytes")


def layers_twice(folder):
    begin(folder, 2)
    folder.run("run", "plan.json", "--shard", "all")
    folder.run("slice", "part.vcad", *OPTIONS, "-o", "shared", "--shard", "2/10")
    said = folder.run("gather", "plan.json").stderr
    expect("8 layers were made by several processes, the first 8; they are equal, and are taken once" in said, said)
    expect(contents(folder.path / "shared") == contents(folder.path / "alone"), "the shares have other bytes")


def changed_jobs(folder):
    begin(folder, 2)
    folder.run("run", "plan.json", "--shard", 1)
    folder.write("part.vcad", DESIGN.replace("height = 4", "height = 3"))
    wrong = folder.run("run", "plan.json", "--shard", 2, status=2).stderr
    expect("plan.json is the plan of another job: design_hash is" in wrong, wrong)
    wrong = folder.run("slice", "part.vcad", *OPTIONS, "-o", "shared", "--shard", "2/2", status=2).stderr
    expect("shared holds another job: design_hash is" in wrong, wrong)
    folder.write("part.vcad", DESIGN)
    plan = json.loads(folder.read("plan.json"))
    plan["describes"]["program"] = "ombre 0.0.1"
    folder.write("plan.json", plan)
    wrong = folder.run("run", "plan.json", "--shard", 2, status=2).stderr
    expect('program is "ombre 0.0.1" there' in wrong, wrong)


def numbers_of_engines(folder):
    """Schedulers and MPI say which share a process does."""
    begin(folder, 7)
    mine = {"SLURM_ARRAY_TASK_ID": ("3", [3]), "JOB_COMPLETION_INDEX": ("0", [1]), "AWS_BATCH_JOB_ARRAY_INDEX": ("6", [7])}
    for name, (value, shards) in mine.items():
        subprocess.run(folder.command("run", "plan.json", "--quiet"), cwd=folder.path, check=True,
                       env=dict(program.environment(), **{name: value}))
        for n in shards:
            expect((folder.path / f"shared/journal-{n}-of-7.jsonl").exists(), f"{name} did not do share {n}")
    ranks = {"OMPI_COMM_WORLD_RANK": "1", "OMPI_COMM_WORLD_SIZE": "3"}
    subprocess.run(folder.command("run", "plan.json", "--quiet"), cwd=folder.path, check=True,
                   env=dict(program.environment(), **ranks))
    done = [n for n in range(1, 8) if (folder.path / f"shared/journal-{n}-of-7.jsonl").exists()]
    expect(done == [1, 2, 3, 5, 7], f"the shares {done} are there")
    wrong = subprocess.run(folder.command("run", "plan.json"), cwd=folder.path, stderr=subprocess.PIPE, text=True,
                           env=dict(program.environment(), SLURM_ARRAY_TASK_ID="8"))
    expect(wrong.returncode == 1 and "SLURM_ARRAY_TASK_ID is 8" in wrong.stderr, wrong.stderr)


def wrong_words(folder):
    begin(folder, 7)
    for arguments, words in [
            (["run", "plan.json"], "which share of the 7? write for example --shard 1"),
            (["run", "plan.json", "--shard", "8"], "--shard 8/7 is no share of a job"),
            (["run", "plan.json", "--shard", "1/6"], "the plan has 7 shares"),
            (["run", "job.json", "--shard", "1"], "this is no plan"),
            (["plan", "plan.json", "--shards", "3", "-o", "more.json"], "this is no job"),
            (["plan", "job.json", "-o", "more.json"], "how many shares?"),
            (["plan", "job.json", "--shards", "3"], "plan.json"),
            (["slice", "part.vcad", "--shard", "0/3"], "--shard 0/3 is no share of a job; write for example --shard 3/40")]:
        wrong = program.run(folder.command(*arguments), cwd=folder.path)
        expect(wrong.returncode != 0 and words in wrong.stderr, f"{arguments}: {wrong.stderr}")
    folder.run("contours", "part.vcad", "--z", "0", "-o", "part.svg", "--save-job", "outline.json")
    wrong = folder.run("plan", "outline.json", "--shards", 3, "-o", "more.json", status=1).stderr
    expect("jobs of the kind contours have no pieces that could be shared out" in wrong, wrong)


CHECKS = program.named((
    one_share,
    seven_shares_in_any_order,
    more_shares_than_layers,
    frames,
    grids,
    meshes,
    unfinished_meshes,
    meshes_without_shares,
    values_of_all_shares,
    archive,
    killed_processes,
    full_disk,
    missing_shares,
    layers_twice,
    changed_jobs,
    numbers_of_engines,
    wrong_words))


if __name__ == "__main__":
    raise SystemExit(program.main(program.Folder, CHECKS))

#!/usr/bin/env python3
"""What becomes of whole jobs that are killed, interrupted, resumed, or cannot write, run as a user would.

    python3 tests/run_interruptions.py build/dev/apps/ombre/ombre [NAME...]
"""
import json
import os
import random
import signal
import subprocess
import zipfile

import processes
import program
from slice_jobs import BALL, LONG, SMALL, SUPPORTS, Job, expect, expect_same, files, layers, ombre_layer

NOBODY = 65534


# ---- interruptions


def resume_and_compare(job, out, parts_may_lie=True):
    parts = [p.name for p in (job.path / out).glob("*.part")]
    expect(parts_may_lie or not parts, f"unfinished files: {parts}")
    kept = job.slice(out, *LONG, "--resume", "--json")
    done = [json.loads(line) for line in kept.stdout.splitlines()][-1]
    expect_same(job.path / "whole", job.path / out)
    return done["layers_kept"]


def killed_jobs_resume(job):
    """kill -9 after any number of layers, then --resume: the bytes of a job that was left alone."""
    job.slice("whole", *LONG)
    seed = random.SystemRandom().randrange(1 << 32)
    print(f"seed {seed}")
    chance = random.Random(seed)
    for attempt in range(4):
        out, least = f"killed{attempt}", chance.randrange(1, 500)
        kill_after_layers(job, out, least)
        kept = resume_and_compare(job, out)
        expect(kept >= least, f"{kept} layers were kept of {least} or more, seed {seed}")


def killed_twice_resumes(job):
    job.slice("whole", *LONG)
    kill_after_layers(job, "killed", 200)
    kill_after_layers(job, "killed", 400, "--resume")
    expect(resume_and_compare(job, "killed") >= 400, "layers of the first two runs were made again")


def layers_in_journal(folder):
    """Finished layers: the journal's whole lines after its head."""
    journal = folder / "journal.jsonl"
    return journal.read_text().count("\n") - 1 if journal.exists() else 0


def kill_after_layers(job, out, least, *arguments):
    process = job.start(out, *LONG, *arguments)
    processes.wait_until(lambda: process.poll() is not None or layers_in_journal(job.path / out) >= least,
                         f"{least} layers are made")
    expect(process.poll() is None, "it ended before it was killed")
    process.send_signal(signal.SIGKILL)
    process.wait()


def interrupted_jobs_resume(job):
    job.slice("whole", *LONG)
    process = job.start("interrupted", *LONG)
    processes.wait_for_file(process, job.path / "interrupted/journal.jsonl")
    processes.interrupt(process)
    resume_and_compare(job, "interrupted", parts_may_lie=False)


def large_layers_stop_and_resume(job):
    """A whole tray in one piece. Stopped within its first layers; those that are made later are the same."""
    job.design = job.write("tray.vcad", """fgrade(["0.5 + x/480", "0.5 - x/480"], ["red", "blue"]) {
                           ellipsoid((240, 190, 97), "red"); }""")
    tray = ["--printer", "j750", "--format", "indexed"]
    process = job.start("out", *tray)
    processes.wait_for_file(process, job.path / "out/journal.jsonl")
    processes.interrupt(process)
    names = sorted(p.name for p in (job.path / "out").iterdir())
    expect(not [name for name in names if name.endswith(".part")], f"unfinished files: {names}")
    job.slice("out", *tray, "--layers", "30:32", "--memory", "200M", "--resume")
    ombre_layer(job, *tray, "--index", "31", "-o", "one.png")
    expect((job.path / "out" / "slice_00031.png").read_bytes() == (job.path / "one.png").read_bytes(), "other bytes")


def resume_refuses_another_job(job):
    job.slice("out", *SMALL, "--layers", "0:5")
    result = job.slice("out", *SMALL, "--resume", "--seed", "7", status=2)
    expect("seed" in result.stderr, f"it does not say what differs: {result.stderr}")


def damaged_layers_are_made_again(job):
    job.slice("whole", *SMALL)
    job.slice("out", *SMALL)
    first, second, *_ = layers(job.path / "out")
    first.write_bytes(first.read_bytes()[:-7])
    second.unlink()
    job.slice("out", *SMALL, "--resume")
    expect_same(job.path / "whole", job.path / "out")


# ---- supports, which are found before the first layer

def supports_take_the_threads_given_and_stop_at_once(job):
    job.design = job.write("holes.vcad", SUPPORTS)
    process = job.start("out", "--voxel", "0.03", "--threads", "1")
    threads = set()
    for work in range(1, 21):
        processes.wait_for_work(process, work / 10)
        threads.add(len(processes.busy_seconds(process.pid)))
    expect(threads == {1}, f"{threads} threads with --threads 1")
    processes.interrupt(process)
    expect(not layers(job.path / "out"), "layers were written before the supports were known")


def supports_are_the_same_in_pieces(job):
    job.design = job.write("holes.vcad", SUPPORTS)
    coarse = ["--voxel", "0.5"]
    job.slice("whole", *coarse, "--threads", "1")
    job.slice("pieces", *coarse, "--layers", "41:90")
    expect(len(list((job.path / "pieces/stages").glob("*.stage"))) == 1, "the supports are not kept for the next run")
    job.slice("pieces", *coarse, "--layers", ":17", "--resume", "--memory", "2M")
    job.slice("pieces", *coarse, "--resume")
    expect_same(job.path / "whole", job.path / "pieces")


def supports_are_reported(job):
    design = job.write("holes.vcad", SUPPORTS)
    result = job.slice("out", "--voxel", "0.02", "--memory", "5M", design=design, status=2)
    expect("supports: computing them takes about" in result.stderr and "--memory" in result.stderr, result.stderr)
    expect(not (job.path / "out").exists(), "a folder was made")
    result = job.slice("out", "--voxel", "0.03", "--dry-run", "--json", design=design)
    estimate = [json.loads(line) for line in result.stdout.splitlines()][-1]
    expect(estimate["event"] == "estimate" and estimate["seconds"] > 5, str(estimate))
    expect(not (job.path / "out").exists(), "a folder was made")


# ---- folders


def foreign_files_are_left_alone(job):
    out = job.path / "out"
    out.mkdir()
    (out / "notes.txt").write_text("mine")
    result = job.slice("out", *SMALL, status=2)
    expect("notes.txt" in result.stderr or str(out) in result.stderr, f"it does not say where: {result.stderr}")
    expect([p.name for p in out.iterdir()] == ["notes.txt"], "it wrote all the same")
    job.slice("out", *SMALL, "--force")
    job.slice("out", *SMALL, "--force")
    expect((out / "notes.txt").read_text() == "mine", "it changed a file of others")
    expect(len(layers(out)) == 100, f"{len(layers(out))} layers")


def finished_jobs_are_not_overwritten(job):
    job.slice("out", *SMALL)
    before = files(job.path / "out")
    job.slice("out", *SMALL, status=2)
    expect(files(job.path / "out") == before, "it changed the job")


def force_removes_the_old_layers(job):
    job.slice("out", "--voxel", "0.1")
    job.slice("out", "--voxel", "0.5", "--force")
    job.slice("fresh", "--voxel", "0.5")
    expect_same(job.path / "out", job.path / "fresh")


def output_that_is_a_file(job):
    job.write("out", "not a folder")
    result = job.slice("out", *SMALL, status=2)
    expect(str(job.path / "out") in result.stderr, f"it does not name the path: {result.stderr}")
    expect((job.path / "out").read_text() == "not a folder", "it changed the file")


def become_nobody():
    os.setgroups([])
    os.setgid(NOBODY)
    os.setuid(NOBODY)


def folder_that_may_not_be_written(job):
    closed = job.path / "closed"
    closed.mkdir()
    closed.chmod(0o555)
    job.path.chmod(0o755)
    options = {"preexec_fn": become_nobody} if os.getuid() == 0 else {}
    try:
        able = program.run([job.ombre, "--version"], **options).returncode == 0
    except (PermissionError, subprocess.SubprocessError):
        able = False
    if not able:
        return "skipped: no user without rights to run as"
    result = job.slice("closed/out", *SMALL, status=2, **options)
    expect(str(closed / "out") in result.stderr, f"it does not name the path: {result.stderr}")
    expect("ermission" in result.stderr, f"it does not say why: {result.stderr}")
    return ""


def full_disk(job):
    """Status 2 and a message with the path; nothing half-written; --resume once there is space."""
    disk = job.path / "disk"
    disk.mkdir()
    mounted = program.run(["mount", "-t", "tmpfs", "-o", "size=1m", "none", disk])
    if mounted.returncode != 0:
        return "skipped: mounting a small file system needs root's rights: " + mounted.stderr.strip()
    try:
        job.slice("whole", *SMALL)
        (disk / "filler").write_bytes(bytes((1 << 20) - 64 * 1024))
        reported = job.slice("disk/out", *SMALL, "--dry-run").stderr
        expect("KiB left" in reported and not (disk / "out").exists(), f"no word about the disk: {reported}")
        result = job.slice("disk/out", *SMALL, status=2)
        expect(str(disk / "out") in result.stderr, f"it does not name the path: {result.stderr}")
        for path in layers(disk / "out"):
            expect(path.read_bytes() == (job.path / "whole" / path.name).read_bytes(), f"{path.name} is not whole")
        (disk / "filler").unlink()
        job.slice("disk/out", *SMALL, "--resume")
        expect_same(job.path / "whole", disk / "out")
    finally:
        program.run(["umount", disk])
    return ""


# ---- archives, and frames in folders


def unpacked(path):
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def archives_hold_what_the_folder_holds(job):
    job.slice("whole", *SMALL)
    job.slice("part.zip", *SMALL, "--layers", ":30")
    expect(not (job.path / "part.zip").exists(), "an archive of some layers was written")
    job.slice("part.zip", *SMALL, "--resume")
    expect(unpacked(job.path / "part.zip") == files(job.path / "whole"), "the archive has other files or bytes")
    expect(not (job.path / "part.zip.pieces").exists(), "the folder of the layers stayed")
    refused = job.slice("part.zip", *SMALL, status=2).stderr
    expect("part.zip exists already; replace it with --force" in refused, refused)
    refused = job.run("sheet", job.path / "part.zip", status=2).stderr
    expect("part.zip is an archive; unpack it, and give the folder" in refused, refused)
    job.slice("part.zip", "--voxel", "0.2", "--force")
    expect(len(unpacked(job.path / "part.zip")) == 2 + 50, "the archive was not replaced")


TURN = ["--frames", "12", "--size", "60x40", "--aa", "1"]


def render(job, out, *arguments, **options):
    return job.run("render", job.design, "-o", job.path / out, *TURN, *arguments, **options)


def frames_resume(job):
    whole = [json.loads(line) for line in render(job, "whole", "--json").stdout.splitlines()][-1]
    expect((whole["frames_written"], whole["frames_kept"]) == (12, 0), f"{whole}")
    folder = job.path / "stopped"
    process = subprocess.Popen(job.command("render", job.design, "-o", folder, *TURN), cwd=job.path, env=program.environment(),
                               stderr=subprocess.DEVNULL)
    processes.wait_for_file(process, folder / "frame_01.png")
    process.send_signal(signal.SIGKILL)
    process.wait()
    refused = render(job, "stopped", status=2).stderr
    expect("already holds a set of frames; continue it with --resume" in refused, refused)
    refused = render(job, "stopped", "--resume", "--zoom", "2", status=2).stderr
    expect("holds another set of frames, since --zoom differs" in refused, refused)
    done = [json.loads(line) for line in render(job, "stopped", "--resume", "--threads", "1", "--json").stdout.splitlines()][-1]
    expect(done["frames_kept"] >= 1 and done["frames_kept"] + done["frames_written"] == 12, f"{done}")
    expect_same(job.path / "whole", folder)
    render(job, "turn.zip")
    expect(unpacked(job.path / "turn.zip") == files(folder), "the archive has other files or bytes")
    job.write("ball.vcad", BALL.replace("0.5", "0.6"))
    refused = render(job, "stopped", "--resume", status=2).stderr
    expect("holds another set of frames, since" in refused and "ball.vcad differs" in refused, refused)
    refused = render(job, "turn.png", "--resume", status=1).stderr
    expect("goes on with frames in a folder or an archive; write for example -o turn/" in refused, refused)


CHECKS = [supports_take_the_threads_given_and_stop_at_once, supports_are_the_same_in_pieces, supports_are_reported,
          killed_jobs_resume, killed_twice_resumes, interrupted_jobs_resume, large_layers_stop_and_resume,
          resume_refuses_another_job, damaged_layers_are_made_again, foreign_files_are_left_alone,
          finished_jobs_are_not_overwritten, force_removes_the_old_layers, output_that_is_a_file,
          folder_that_may_not_be_written, full_disk, archives_hold_what_the_folder_holds, frames_resume]

if __name__ == "__main__":
    raise SystemExit(program.main(Job, program.named(CHECKS)))

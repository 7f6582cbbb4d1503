"""Two builds in one sitting: another commit is built beside this one, and both run in turns."""
import contextlib
import statistics
import subprocess

import measure
import programs
from table import Table, seconds


def _git(*arguments):
    done = subprocess.run(["git", "-C", programs.ROOT, *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise programs.Failed(f"git {arguments[0]}: {done.stderr.strip()}")
    return done.stdout.strip()


def _remove(tree):
    if tree.exists():
        _git("worktree", "remove", "--force", tree)


@contextlib.contextmanager
def built(commit):
    """The release build of a commit, in a worktree under build/ that does not stay."""
    name = _git("rev-parse", "--short", commit + "^{commit}")
    tree = programs.ROOT / "build" / f"against-{name}"
    _remove(tree)
    try:
        _git("worktree", "add", "--detach", tree, name)
        for command in (["cmake", "--preset", "release"], ["cmake", "--build", "build/release", "--target", "ombre"]):
            done = subprocess.run(command, cwd=tree, capture_output=True, text=True)
            if done.returncode != 0:
                raise programs.Failed(f"{name} does not build:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        yield name, programs.Ombre(tree / "build/release/apps/ombre/ombre", tree)
    finally:
        _remove(tree)


def _in_turns(builds, job, size, threads, runs, scratch):
    """Seconds of each build; one run of each comes first and is not counted."""
    design = scratch / "design.vcad"
    job.write(design)
    grid = job.grid(size)
    arguments = ["--voxel", job.pitch(grid), "--threads", threads]
    taken = [[] for _ in builds]
    for turn in range(runs + 1):
        for build, times in zip(builds, taken):
            finished, _ = build.slice(design, arguments, scratch)
            if turn > 0:
                times.append(finished.seconds)
    return taken


def compare(commit, head, jobs, size, threads, runs, scratch):
    with built(commit) as (name, base):
        print(f"\nbase is {name}, head is this build; {runs} runs in turns on {threads} thread(s); "
              "spread is (slowest - fastest)/median")
        table = Table(("job", 16), ("base s", 9), ("spread", 7), ("head s", 9), ("spread", 7), ("base/head", 10))
        results = []
        for job in jobs:
            taken = _in_turns((base, head), job, size, threads, runs, scratch)
            medians = [statistics.median(times) for times in taken]
            spreads = [(max(times) - min(times)) / median for times, median in zip(taken, medians)]
            table.row(job.name, seconds(medians[0]), f"{spreads[0]:.0%}", seconds(medians[1]), f"{spreads[1]:.0%}",
                      f"{medians[0] / medians[1]:.2f}")
            results.append({"job": job.name, "base": taken[0], "head": taken[1]})
        return results

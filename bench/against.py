"""Two builds in one sitting: another commit is built beside this one, and both run in turns."""
import contextlib
import statistics
import subprocess

import programs
from table import Table, seconds


def _git(*arguments):
    return programs.run_quietly(["git", "-C", programs.ROOT, *arguments])


def _remove(tree):
    """Removes the worktree, also after a signal, when only this program may still be started."""
    if tree.exists():
        subprocess.run(["git", "-C", programs.ROOT, "worktree", "remove", "--force", tree], check=True)


@contextlib.contextmanager
def built(commit):
    """The release build of a commit, in a worktree under build/ that does not stay."""
    name = _git("rev-parse", "--short", commit + "^{commit}")
    tree = programs.ROOT / "build" / f"against-{name}"
    _remove(tree)
    try:
        _git("worktree", "add", "--detach", tree, name)
        for command in (["cmake", "--preset", "release"], ["cmake", "--build", "build/release", "--target", "ombre"]):
            programs.run_quietly(command, cwd=tree)
        yield name, programs.Ombre(tree / "build/release/apps/ombre/ombre", tree)
    finally:
        _remove(tree)


def _in_turns(builds, job, size, threads, runs, scratch):
    """Seconds and processor seconds of each build; one run of each comes first and is not counted."""
    design = scratch / "design.vcad"
    job.write(design)
    grid = job.grid(size)
    arguments = ["--voxel", job.pitch(grid), "--threads", threads]
    taken = [[] for _ in builds]
    for turn in range(runs + 1):
        for build, times in zip(builds, taken):
            finished, _ = build.slice(design, arguments, scratch)
            if turn > 0:
                times.append((finished.seconds, finished.cpu_seconds))
    return taken


class Side:
    """The runs of one build."""

    def __init__(self, runs):
        wall, cpu = zip(*runs)
        self.wall, self.cpu = statistics.median(wall), min(cpu)
        self.spread = (max(wall) - min(wall)) / self.wall


def compare(commit, head, jobs, size, threads, runs, scratch):
    """One row for each job. Where other work shares the machine, the ratio of the least processor time is the safer one."""
    with built(commit) as (name, build):
        print(f"base is {name}, head is this build; {runs} runs in turns on {threads} thread(s); "
              "spread is (slowest - fastest)/median\n")
        table = Table(("job", 16), ("base s", 9), ("spread", 7), ("head s", 9), ("spread", 7), ("base/head", 10),
                      ("of processor time", 18))
        results = []
        for job in jobs:
            try:
                taken = _in_turns((build, head), job, size, threads, runs, scratch)
            except programs.Failed as problem:  # an older program may lack what a row needs
                print(f"{job.name}: not compared.\n{problem}", flush=True)
                continue
            base, ours = map(Side, taken)
            table.row(job.name, seconds(base.wall), f"{base.spread:.0%}", seconds(ours.wall), f"{ours.spread:.0%}",
                      f"{base.wall / ours.wall:.2f}", f"{base.cpu / ours.cpu:.2f}")
            results.append({"job": job.name, "base": taken[0], "head": taken[1]})
        return results

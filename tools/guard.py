#!/usr/bin/env python3
"""Records what a build writes for all designs of the project, to compare another build with it.

    ./dev guard record out/before.txt                  hashes there, the outputs themselves in out/before.txt.zip
    ./dev guard compare out/before.txt                 what the build writes now: status 1 where an output differs;
                                                       both are then in out/before.txt.differences
    ./dev guard compare out/before.txt --quick         a part of it in less than a minute
    ./dev guard record FILE --cases FOLDER             also the command lines in FOLDER/*/expect.txt
    ./dev guard record FILE --only 'gear|say-'         jobs whose "DESIGN JOB" holds this regular expression
    ./dev guard record FILE --program PATH/ombre       another build

tools/guard_jobs.py has the table of designs and jobs; docs/developer/guard.md says more.
"""
import argparse
import collections
import concurrent.futures
import contextlib
import os
import pathlib
import re
import shutil
import sys
import tempfile
import time

import guard_differences
import guard_jobs
from guard_jobs import ROOT
from guard_record import Line, Record, Store, archive_of, hash_of, hashes_of, listing
from guard_run import NORMALISED, SECONDS_AT_MOST, Runner

DESCRIBED_AT_MOST = 200
SLOWEST = 3


class Task:
    """A job and its design, or a given case."""

    def __init__(self, name, job=None, design=None, folder=None, commands=()):
        self.name, self.job, self.design, self.folder, self.commands = name, job, design, folder, commands
        self.seconds = 0.0

    @property
    def kind(self):
        return self.job.kind if self.job else "given"

    @property
    def shape(self):
        return "internal" if self.job and self.job.internal else "output"

    def run(self, runner, boxes):
        start = time.monotonic()
        outcome = (runner.run(self.job, self.design, boxes[self.design.name]) if self.job else
                   runner.run_given(self.folder, self.commands))
        self.seconds = time.monotonic() - start
        return outcome

    def typed(self, runner, boxes, out):
        if self.job:
            return runner.typed(self.job, self.design, boxes[self.design.name], out)
        return runner.typed_given(self.folder, self.commands, out)


def chosen_tasks(a, runner, cases):
    """Those that the options choose, and that this build can run."""
    tasks = []
    for design in guard_jobs.designs(a.program):
        if design.source == "python" and not runner.has_package:
            continue
        tasks += [Task(f"{design.name} {job.name}", job, design) for job in guard_jobs.jobs_of(design, a.quick)]
    for name, folder, commands in guard_jobs.given_cases(cases) if cases and not a.quick else ():
        tasks.append(Task(f"{name} run", folder=folder, commands=commands))
    return [task for task in tasks if re.search(a.only, task.name)]


def boxes_of(tasks, known, runner, pool):
    """Boxes of the designs: those that are known, and the others by asking the program."""
    designs = {task.design.name: task.design for task in tasks if task.design}
    for design in designs.values():
        if design.text:
            runner.write_design(design)
    # Wrong designs have none, and what the program says by itself needs none.
    measured = [d for d in designs.values() if d.name not in known and d.source not in ("errors", "corpus", "program")]
    found = dict(zip((d.name for d in measured), pool.map(runner.box_of, measured)))
    return {name: known.get(name) or found.get(name, guard_jobs.USUAL_BOX) for name in designs}


def keep(record, store, task, outcome):
    """Adds a job's two outputs: what it said, and its files."""
    files = listing(outcome.files)
    for content in (outcome.said, files, *outcome.files.values()):
        store.add(content)
    size = sum(map(len, outcome.files.values()))
    record.lines[f"{task.name} said"] = Line(hash_of(outcome.said), len(outcome.said), outcome.status, task.shape)
    record.lines[f"{task.name} files"] = Line(hash_of(files), size, outcome.status, task.shape)


def recorded(a, runner, archive, before):
    """Runs all tasks: the record, and the tasks by name. Boxes of a record before are used again, so that the same
    commands run."""
    record = Record()
    record.cases = (a.cases and a.cases.resolve()) or before.cases
    with concurrent.futures.ThreadPoolExecutor(a.jobs) as pool, Store(archive, "w") as store:
        tasks = chosen_tasks(a, runner, record.cases)
        record.boxes = boxes_of(tasks, before.boxes, runner, pool)
        outcomes = {pool.submit(task.run, runner, record.boxes): task for task in tasks}
        try:
            for done, future in enumerate(concurrent.futures.as_completed(outcomes), 1):
                keep(record, store, outcomes.pop(future), future.result())
                if sys.stderr.isatty():
                    print(f"\r{done} of {len(tasks)} jobs", end="", file=sys.stderr, flush=True)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
        finally:
            if sys.stderr.isatty():
                print("\r\033[K", end="", file=sys.stderr)
    return record, {task.name: task for task in tasks}


def report_runs(record, tasks, seconds, runner):
    outputs = [line for name, line in record.lines.items() if name.endswith(" files")]
    print(f"{len(tasks)} jobs in {seconds:.0f} s, {sum(line.size for line in outputs) / 1e6:.1f} MB of files")
    slowest = sorted(tasks.values(), key=lambda task: -task.seconds)[:SLOWEST]
    print("the slowest: " + ", ".join(f"{task.name} {task.seconds:.1f} s" for task in slowest))
    late = [name for name, line in record.lines.items() if "timeout" in line.status and name.endswith(" said")]
    if late:
        print(f"longer than {SECONDS_AT_MOST} s: {', '.join(name.rpartition(' ')[0] for name in late)}")
    if not runner.has_package:
        print("the build has no Python package: designs in Python were left out")


# ---- comparing


class Comparison:
    """A record before and one of now, with the contents of both."""

    def __init__(self, before, now, old, new):
        self.before, self.now, self.old, self.new = before, now, old, new

    def different(self, shape):
        """Names of outputs that are in both and differ, in the order of the table."""
        return [name for name, line in self.now.lines.items() if line.shape == shape and name in self.before.lines and
                (line.hash, line.status) != (self.before.lines[name].hash, self.before.lines[name].status)]

    def described(self, name):
        before, now = self.before.lines[name].hash, self.now.lines[name].hash
        if self.old is None:
            return f"{self.now.lines[name].size} bytes, were {self.before.lines[name].size}"
        if name.endswith(" said"):
            return guard_differences.of_contents(name, self.old.get(before), self.new.get(now))
        return guard_differences.of_files(files_of(self.old, before), files_of(self.new, now))

    def keep_both(self, task, folder):
        """Puts a job's outputs before and now beside each other."""
        for word, record, store in (("before", self.before, self.old), ("now", self.now, self.new)):
            if store is None:
                continue
            files = files_of(store, record.lines[f"{task} files"].hash)
            files["said.txt"] = store.get(record.lines[f"{task} said"].hash)
            for name, content in files.items():
                path = folder / word / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)


def files_of(store, listing_hash):
    return {name: store.get(digest) for name, digest in hashes_of(store.get(listing_hash)).items()}


def report_differences(comparison, names, tasks, runner, kept):
    """By design and kind of job: what differs, and how to see it."""
    groups = collections.defaultdict(lambda: collections.defaultdict(list))
    for name in sorted(names):
        task, _, part = name.rpartition(" ")
        groups[task.partition(" ")[0], tasks[task].kind][task].append(part)
    described = 0
    for (design, kind), jobs in groups.items():
        print(f"\n{design}, {kind}")
        for task, parts in jobs.items():
            described += 1
            if described > DESCRIBED_AT_MOST:
                print(f"  {task.partition(' ')[2]}: {' and '.join(parts)}")
                continue
            folder = kept / task.replace(" ", "/")
            comparison.keep_both(task, folder)
            for part in parts:
                print(f"  {task.partition(' ')[2]}, {part}: {comparison.described(f'{task} {part}')}".rstrip())
            print(f"    both are in {folder}; again:")
            print(f"    {tasks[task].typed(runner, comparison.now.boxes, folder / 'again')}")


def missing_from(names, others, quick, only):
    """Names of outputs that ought to be among others; a part of the jobs does not know of the rest."""
    return [name for name in names - others if not quick and re.search(only, name.rpartition(" ")[0])]


def report_jobs(word, names):
    jobs = sorted({name.rpartition(" ")[0] for name in names})
    if jobs:
        print(f"{len(jobs)} {word}: {', '.join(jobs[:5])}{', ...' if len(jobs) > 5 else ''}")


def compare(a, runner, scratch):
    before, start = Record.read(a.file), time.monotonic()
    archive = pathlib.Path(scratch) / "now.zip"
    now, tasks = recorded(a, runner, archive, before)
    report_runs(now, tasks, time.monotonic() - start, runner)
    kept = a.file.resolve().with_name(a.file.name + ".differences")
    shutil.rmtree(kept, ignore_errors=True)
    with contextlib.ExitStack() as stack:
        old = stack.enter_context(Store(archive_of(a.file))) if archive_of(a.file).exists() else None
        comparison = Comparison(before, now, old, stack.enter_context(Store(archive)))
        different, internal = comparison.different("output"), comparison.different("internal")
        report_differences(comparison, different, tasks, runner, kept)
    expected = {name for name in before.lines if runner.has_package or not name.startswith("python/")}
    gone = missing_from(expected, now.lines.keys(), a.quick, a.only)
    report_jobs("jobs were recorded and are no more", gone)
    report_jobs("jobs are new", now.lines.keys() - before.lines.keys())
    report_jobs("internal forms differ, which no output shows", internal)
    same = len({name for name, line in now.lines.items() if line.shape == "output"}) - len(different)
    print(f"{same} outputs are the same, {len(different)} differ")
    return 1 if different or gone else 0


def record_to_file(a, runner):
    start = time.monotonic()
    a.file.parent.mkdir(parents=True, exist_ok=True)
    record, tasks = recorded(a, runner, archive_of(a.file), Record())
    record.write(a.file)
    report_runs(record, tasks, time.monotonic() - start, runner)
    print(f"recorded in {a.file} and {archive_of(a.file).name}")
    return 0


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="Taken out of what is compared:\n" +
                                     "\n".join(f"  {reason}: {pattern}" for pattern, _, reason in NORMALISED))
    parser.add_argument("action", choices=("record", "compare"))
    parser.add_argument("file", type=pathlib.Path, help="the record")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/apps/ombre/ombre",
                        help="the ombre to run (default: that of build/release)")
    parser.add_argument("--quick", action="store_true", help="a part of the jobs, in less than a minute")
    parser.add_argument("--only", metavar="REGEX", default="", help="jobs whose \"DESIGN JOB\" holds this")
    parser.add_argument("--cases", metavar="FOLDER", type=pathlib.Path,
                        help="also the commands in FOLDER/*/expect.txt (default with compare: the folder that was recorded)")
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count(), help="jobs at a time (default: all cores)")
    parser.add_argument("--threads", metavar="N", type=int, default=1, help="threads of each job (default 1)")
    a = parser.parse_args()
    a.program = a.program.resolve()
    if not a.program.is_file():
        parser.error(f"there is no {a.program}; build it with ./dev build release, or name one by --program")
    if a.action == "compare" and not a.file.is_file():
        parser.error(f"there is no {a.file}; record one with ./dev guard record {a.file}")
    return a


def main():
    a = arguments()
    with tempfile.TemporaryDirectory() as scratch:
        runner = Runner(a.program, a.threads, scratch)
        return record_to_file(a, runner) if a.action == "record" else compare(a, runner, scratch)


if __name__ == "__main__":
    try:
        raise SystemExit(main())
    except KeyboardInterrupt:
        raise SystemExit(130) from None
    except (ValueError, OSError) as error:
        raise SystemExit(f"guard: {error}") from None

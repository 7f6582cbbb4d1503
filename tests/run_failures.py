#!/usr/bin/env python3
"""One allocation, or one call that writes to the disk, fails: the first, the second, the third ... of a job. The
program ends with a message and the exit code of the machine's failures, or does its work all the same. It never
crashes, and no file under a final name has other bytes than those of an undisturbed run.

    python3 tests/run_failures.py build/release/apps/ombre/ombre build/release/tests/libfailing_calls.so [--all]

--all lets about ten times as many calls fail.
"""
import argparse
import functools
import os
import pathlib
import struct
import subprocess
import tempfile

import program
from program import expect

DESIGN = """union() {
  translate((2, 0, 0)) sphere(2.5, red);
  fgrade(["1 - z / 4", "z / 4"], [red, blue]) cylinder(2, 4);
}
"""
JOBS = {
    "slice": ["slice", "part.vcad", "--voxel", "0.4", "--threads", "1", "-o", "out"],
    "slice by two threads": ["slice", "part.vcad", "--voxel", "0.4", "--threads", "2", "-o", "out"],
    "load": ["probe", "gear.vcad", "--at", "0,0,1"],
    "mesh": ["mesh", "part.vcad", "--tolerance", "0.2", "--threads", "1", "-o", "part.obj"],
    "3mf": ["mesh", "part.vcad", "--tolerance", "0.2", "--threads", "1", "-o", "part.3mf"],
    "voxels": ["voxels", "part.vcad", "--voxel", "0.5", "--threads", "1", "-o", "part.nrrd"],
}
UNFINISHED = ("out/job.json", "out/journal.jsonl")  # of a slice that can be resumed
ACCEPTED = {0: "done", 1: "wrong input", 2: "the machine failed"}


class Failing:
    """A job in a folder of its own, of which one call fails."""

    def __init__(self, ombre, library, kind, name):
        self.ombre, self.library, self.kind, self.name = ombre, library, kind, name

    def run(self, folder, at, more=()):
        """(the finished process, how many calls could fail)"""
        begin, end = os.pipe()
        variables = dict(program.environment(), LD_PRELOAD=str(self.library), OMBRE_FAIL_KIND=self.kind,
                         OMBRE_FAIL_AT=str(at), OMBRE_FAIL_REPORT=str(end),
                         OMBRE_FAIL_FROM=next(word for word in JOBS[self.name] if word.endswith(".vcad")))
        try:
            command = [str(self.ombre), *JOBS[self.name], *more]
            process = subprocess.run(command, cwd=folder, env=variables, pass_fds=[end], stdin=subprocess.DEVNULL,
                                     capture_output=True, timeout=program.PATIENCE_S)
        finally:
            os.close(end)
        with open(begin, "rb") as report:
            bytes_ = report.read(8)
        return process, struct.unpack("q", bytes_)[0] if len(bytes_) == 8 else 0

    def check(self, at, wanted):
        with tempfile.TemporaryDirectory(prefix="ombre-failures-") as temporary:
            folder = make_folder(pathlib.Path(temporary))
            process, _ = self.run(folder, at)
            where = f"{self.name}, {self.kind} call {at}: status {process.returncode}"
            said = process.stderr.decode(errors="replace")
            expect(process.returncode in ACCEPTED, f"{where}\n{said[-2000:]}")
            expect(process.returncode == 0 or "error: " in said, f"{where}, without a message\n{said[-2000:]}")
            written = files_of(folder)
            if process.returncode == 0:
                expect(written.keys() == wanted.keys(), f"{where}: {sorted(written)}")
            for name, content in written.items():
                expect(name in wanted, f"{where}: {name} is left")
                expect(content == wanted[name] or name in UNFINISHED, f"{where}: {name} differs")
            if process.returncode == 0 or self.name == "load":
                return
            further = ["--resume"] if (folder / "out" / "job.json").exists() else []
            again = program.run([self.ombre, *JOBS[self.name], *further], cwd=folder)
            expect(again.returncode == 0, f"{where}: it cannot be done afterwards\n{again.stderr}")
            expect(files_of(folder) == wanted, f"{where}: other files afterwards")


def make_folder(folder):
    (folder / "part.vcad").write_text(DESIGN)
    (folder / "gear.vcad").write_text(f'use <part.vcad>\nmesh("{program.SOURCE}/examples/models/gear.stl", red);\n')
    return folder


def files_of(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.suffix != ".vcad"}


def spread(count, most):
    """The first calls all, then fewer and fewer of them, up to the last."""
    first = list(range(1, min(count, most // 3) + 1))
    places, rest = set(first), most - len(first)
    for n in range(rest):
        places.add(round(len(first) + (count - len(first)) * ((n + 1) / rest) ** 2))
    return sorted(place for place in places if 1 <= place <= count)


def check_job(ombre, library, kind, name, most):
    failing = Failing(ombre, library, kind, name)
    with tempfile.TemporaryDirectory(prefix="ombre-failures-") as temporary:
        folder = make_folder(pathlib.Path(temporary))
        process, count = failing.run(folder, 0)
        expect(process.returncode == 0, process.stderr.decode(errors="replace"))
        expect(count > 0 or name == "load", f"{name}: no call of the kind {kind}")
        wanted = files_of(folder)
    wrong = []
    for at in spread(count, most):
        try:
            failing.check(at, wanted)
        except AssertionError as problem:
            wrong.append(str(problem))
    return "\n".join(wrong[:5]) + (f"\nand {len(wrong) - 5} more" if len(wrong) > 5 else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ombre", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--job", choices=JOBS)
    args = parser.parse_args()
    ombre, library = args.ombre.resolve(), args.library.resolve()
    most = 400 if args.all else 40
    checks = [(name, kind) for name in JOBS for kind in ("memory", "disk")
              if args.job in (None, name) and (name, kind) != ("load", "disk")]
    return program.check_all([(f"{name}, {kind}", functools.partial(check_job, ombre, library, kind, name, most))
                              for name, kind in checks])


if __name__ == "__main__":
    raise SystemExit(main())

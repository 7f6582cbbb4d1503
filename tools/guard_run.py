"""Runs a job, and gives what it said and wrote without what differs from one run to the next."""
import dataclasses
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile

import guard_jobs
from guard_jobs import ROOT, program

SECONDS_AT_MOST = 120
HAVE_THREADS = {"slice", "render", "voxels", "mesh", "contours"}

# What is not the same in each run of one program, what stands in its place, and why.
NORMALISED = [
    (r"\bin [\d.e+-]+ s\b", "in TIME s", "how long a job took"),
    (r'"seconds": ?[\d.e+-]+', '"seconds": TIME', "the same for programs"),
    (r"[\d.,e+-]+ ?[kMG]? voxels/s", "SPEED voxels/s", "how fast a job was"),
    (r"(?m)^(about|more than) .*; nothing was written$", "ESTIMATE",
     "what a dry run expects from the layers that it had time for, and memory, which grows with the threads"),
    (r"at most [\d.]+ \w+ of memory", "at most MEMORY", "what voxels and contours may take, which grows with the threads"),
    (r"(?m)^\d+%  .*\n", "", "progress, which slow jobs tell"),
    (r'\{"event":"progress",.*\}\n', "", "the same for programs"),
    (r'\{"event":"estimate",.*\}', '{"event":"estimate"}', "the same for programs"),
]


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What a job left: "said" is its standard output and error, with the exit status of each command."""
    said: bytes
    files: dict
    status: str


class Runner:
    """Runs jobs by one build. Its Python package is used where it lies in the same build folder."""

    def __init__(self, ombre, threads, scratch):
        self.ombre, self.threads, self.scratch = ombre, threads, pathlib.Path(scratch)
        self.python = os.environ.get("OMBRE_PYTHON", "/usr/bin/python3")
        package = ombre.parents[2] / "python"
        self.has_package = any(package.glob("ombre/_core*"))
        os.environ.update({"PYTHONDONTWRITEBYTECODE": "1", "PYTHONPATH": str(package)} if self.has_package
                          else {"PYTHONDONTWRITEBYTECODE": "1"})

    # ---- commands

    def command(self, words):
        """The words of a command line, with the programs' paths and the number of threads."""
        first, *rest = words
        if first == "python3":
            return [self.python, *rest]
        threads = ["--threads", str(self.threads)] if rest and rest[0] in HAVE_THREADS and "--help" not in rest else []
        return [str(self.ombre), *rest, *threads]

    def filled_in(self, job, design, box, out):
        """The command lines of a job for a design: words, and the file that takes the standard output or None."""
        file = str(self.design_file(design)) if design.text else design.file
        several = {"{design}": [file, *design.defines], "{small}": [file, *design.defines, *design.fewer],
                   "{own}": list(design.own)}
        values = {**guard_jobs.values(box), "out": out}
        for text in job.commands:
            words = []
            for word in text.split():
                words += several[word] if word in several else [word.format_map(values)]
            written = words[-1] if words[-2:-1] == [">"] else None
            yield self.command(words[:-2] if written else words), written

    def design_file(self, design):
        return self.scratch / "designs" / design.file

    def write_design(self, design):
        path = self.design_file(design)
        path.parent.mkdir(exist_ok=True)
        path.write_text(design.text, encoding="utf-8")

    def box_of(self, design):
        words = ["ombre", "slice", str(self.design_file(design)) if design.text else design.file, *design.defines,
                 "--emit", "stats"]
        return guard_jobs.measured_box(self.run_one(self.command(words), design.folder).stdout)

    # ---- runs

    def run_one(self, words, folder):
        try:
            return program.run(words, cwd=folder, timeout=SECONDS_AT_MOST)
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(words, "timeout", "", f"it took longer than {SECONDS_AT_MOST} s\n")

    def run(self, job, design, box):
        with tempfile.TemporaryDirectory(dir=self.scratch) as out:
            steps = []
            for words, written in self.filled_in(job, design, box, out):
                done = self.run_one(words, design.folder)
                if written:
                    pathlib.Path(written).write_text(done.stdout, encoding="utf-8")
                    done.stdout = ""
                steps.append(done)
            return self.outcome(steps, files_below(pathlib.Path(out)), out)

    def run_given(self, folder, commands):
        """A case with commands of its own, in a copy of its folder; what is new there or changed are its files."""
        with tempfile.TemporaryDirectory(dir=self.scratch) as out:
            copy = pathlib.Path(out) / "case"
            shutil.copytree(folder, copy, symlinks=True)
            before = files_below(copy)
            steps = [self.run_one(self.command(shlex.split(command)), copy) for command in commands]
            files = {name: content for name, content in files_below(copy).items() if before.get(name) != content}
            return self.outcome(steps, files, copy)

    def outcome(self, steps, files, out):
        said = "".join(f"status {step.returncode}\n{step.stdout}{step.stderr}" for step in steps)
        return Outcome(self.normalised(said, out).encode(), files, ",".join(str(step.returncode) for step in steps))

    def normalised(self, text, out):
        for path, name in ((out, "OUT"), (self.scratch, "SCRATCH"), (ROOT, "SOURCE")):
            text = text.replace(str(path), name)
        for pattern, instead, _ in NORMALISED:
            text = re.sub(pattern, instead, text)
        return text

    # ---- what a person types

    def typed(self, job, design, box, out):
        """The command lines of a job as one line for a shell; its outputs go to the folder `out`."""
        parts = [f"cd {shlex.quote(str(design.folder))}", f"mkdir -p {shlex.quote(str(out))}"]
        if design.text:
            parts.append(f"printf %s {shlex.quote(design.text)} > {shlex.quote(str(out / design.file))}")
        for words, written in self.filled_in(job, design, box, str(out)):
            words = [str(out / design.file) if word == str(self.design_file(design)) else word for word in words]
            parts.append(shlex.join(words) + (f" > {shlex.quote(written)}" if written else ""))
        return "; ".join(parts)

    def typed_given(self, folder, commands, out):
        parts = [f"cp -a {shlex.quote(str(folder))} {shlex.quote(str(out))}", f"cd {shlex.quote(str(out))}"]
        return "; ".join(parts + [shlex.join(self.command(shlex.split(command))) for command in commands])


def files_below(folder):
    """Contents by name; layers are in a folder of their own."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and not path.is_symlink()}

#!/usr/bin/env python3
"""Wrong designs, and their messages.

tests/errors/NAME.vcad, NAME.scad or NAME.json is a design with a mistake, NAME.txt the text on stderr. The first lines of
a .vcad may say how it is run:

    // arguments: --printer j750 --voxel 0.1
    // status: 0

The status is 1 unless it is stated. A job that starts also reports sizes and times: with another status only the
errors, warnings and notes are compared.

    python3 tests/run_errors.py build/dev/apps/ombre/ombre [--update] [NAME...]

--update rewrites the .txt files, to be read before they are committed.
"""
import difflib
import pathlib
import re
import shlex
import tempfile

import program

FOLDER = program.TESTS / "errors"
DIRECTIVE = re.compile(r"// (arguments|status): (.*)")
REPORTED = re.compile(r"(^|: )(error|warning|note): |^ +\d* \| ")


def directives(design):
    """The arguments and the status that the first lines of a design ask for."""
    found = {"arguments": "", "status": "1"}
    for line in design.read_text(encoding="utf-8", errors="replace").splitlines():
        match = DIRECTIVE.fullmatch(line)
        if not match:
            break
        found[match[1]] = match[2]
    return shlex.split(found["arguments"]), int(found["status"])


def final_names(folder):
    """Files under a name that a printer or a person would take for finished."""
    if not folder.exists():
        return []
    return sorted(p.name for p in folder.iterdir() if not p.name.endswith(".part"))


def check(ombre, design, update):
    arguments, status = directives(design)
    with tempfile.TemporaryDirectory() as scratch:
        output = pathlib.Path(scratch) / "out"
        result = program.run([ombre, "slice", design.name, "-o", output, *arguments], cwd=FOLDER)
        written = final_names(output)
    reported = result.stderr.replace(scratch, "OUT").replace(str(FOLDER), "HERE")
    if status != 1:
        reported = "".join(line for line in reported.splitlines(keepends=True) if REPORTED.search(line))
    expected = design.with_suffix(".txt")
    if update:
        expected.write_text(reported, encoding="utf-8")
    problems = []
    if result.returncode != status:
        problems.append(f"status {result.returncode}, expected {status}")
    if result.stdout:
        problems.append("something on stdout: " + result.stdout[:200])
    if status == 1 and written:
        problems.append("written all the same: " + ", ".join(written[:5]))
    if not expected.exists():
        problems.append(f"{expected.name} is missing; --update writes it")
    elif reported != expected.read_text(encoding="utf-8"):
        problems += difflib.unified_diff(expected.read_text(encoding="utf-8").splitlines(), reported.splitlines(),
                                         "expected", "reported", lineterm="")
    return "\n".join(problems)


def main():
    a = program.arguments("Runs the wrong designs of tests/errors.", update="rewrite the expected texts")
    designs = sorted(path for ending in ("vcad", "scad", "json") for path in FOLDER.glob(f"*.{ending}"))
    if a.names:
        designs = [d for d in designs if d.stem in a.names]
    return program.check_all([(d.name, lambda d=d: check(a.ombre, d, a.update)) for d in designs])


if __name__ == "__main__":
    raise SystemExit(main())

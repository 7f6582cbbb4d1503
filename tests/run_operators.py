#!/usr/bin/env python3
"""Calls each operator of tests/data/operators.txt, and compares what it gives with what is written there.

    python3 tests/run_operators.py build/release/apps/ombre/ombre [NUMBER...]
    python3 tests/run_operators.py build/release/apps/ombre/ombre --evaluators    # the same voxels, however they are computed
"""
import math
import pathlib
import re
import struct
import tempfile
import zlib

import program
import run_cases

TABLE = program.TESTS / "data" / "operators.txt"
LIBRARY = program.SOURCE / "data" / "library" / "ombre"
COUNT = 140  # rows of the table


def rows():
    """Number, name and lines of each row."""
    found = []
    for line in TABLE.read_text(encoding="utf-8").splitlines():
        title = re.fullmatch(r"(\d+) (.+)", line)
        if title:
            found.append((int(title[1]), title[2], []))
        elif line.startswith("  "):
            found[-1][2].append(line.strip())
    return found


def design_of(lines):
    """A design as tests/cases has it: expectations first, then the script, which may call all libraries."""
    def is_stated(line):
        return line.startswith(("expect ", "arguments: "))
    stated = [f"// {line}" for line in lines if is_stated(line)]
    uses = [f"use <{path}>" for path in sorted(LIBRARY.glob("*.vcad"))]
    script = [line for line in lines if not is_stated(line) and not line.startswith("# ")]
    return "\n".join([*stated, *uses, *script, ""])


def png_of(rows):
    """A gray image of 8 bits."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def quarter_turn(radius, height, columns):
    """A quarter of a cylinder around z, from the plane z = 0, as an OFF file whose faces look outward."""
    angles = [math.pi / 2 * n / columns for n in range(columns + 1)]
    points = [(radius * math.cos(a), radius * math.sin(a), z) for z in (0, height) for a in angles]
    up = columns + 1
    triangles = [t for n in range(columns) for t in ((n, n + 1, up + n + 1), (n, up + n + 1, up + n))]
    return "\n".join([f"OFF\n{len(points)} {len(triangles)} 0", *(" ".join(map(repr, p)) for p in points),
                      *(f"3 {a} {b} {c}" for a, b, c in triangles), ""])


def write_design(folder, lines):
    (folder / "checks.png").write_bytes(png_of([[255, 0], [0, 255]]))
    (folder / "quarter.off").write_text(quarter_turn(6, 10, 64), encoding="utf-8")
    design = folder / "operator.vcad"
    design.write_text(design_of(lines), encoding="utf-8")
    return design


def check(ombre, lines):
    with tempfile.TemporaryDirectory() as scratch:
        return "\n".join(run_cases.Case(ombre, write_design(pathlib.Path(scratch), lines)).problems)


def voxels_of(ombre, design, name, *options):
    """Voxels of each material, and the layers' bytes."""
    folder = design.parent / name
    found = run_cases.events([ombre, "slice", design, "-o", folder, "--voxel", "0.71", "--json", *options], design.parent)
    done = next(event for event in found if event["event"] == "done")
    return ({material["name"]: material["voxels"] for material in done["materials"]},
            {path.name: path.read_bytes() for path in folder.glob("*.png")})


def check_evaluators(ombre, lines):
    """Threads change nothing; floats differ from doubles in few voxels, at borders alone."""
    with tempfile.TemporaryDirectory() as scratch:
        design = write_design(pathlib.Path(scratch), lines)
        counts, layers = voxels_of(ombre, design, "one", "--threads", "1")
        program.expect(voxels_of(ombre, design, "four", "--threads", "4")[1] == layers, "threads change the layers")
        exact, _ = voxels_of(ombre, design, "exact", "--evaluator", "reference")
    other = sum(abs(counts.get(name, 0) - exact.get(name, 0)) for name in {*counts, *exact})
    program.expect(other <= 1e-4 * sum(exact.values()), f"evaluators differ: {counts}, {exact}")


def examples():
    """Name, library and example of each operator."""
    for library in sorted(LIBRARY.glob("*.vcad")):
        for block, name in re.findall(r"((?:^///.*\n)+)(?:function|module) (\w+)", library.read_text(encoding="utf-8"), re.M):
            example = re.search(r"^/// Example: (.*)$", block, re.M)
            yield name, library, example[1] if example else ""


def write_example(design, library, example):
    """Models stand beside the examples of the repository."""
    design.write_text(f"use <{library}>\n{example}\n".replace("models/", f"{program.SOURCE}/examples/models/"))


def example_works(ombre, library, example):
    if not example:
        return "it has no example"
    with tempfile.TemporaryDirectory() as scratch:
        design = pathlib.Path(scratch) / "example.vcad"
        write_example(design, library, example)
        result = program.run([ombre, "probe", design, "--at", "1,2,3", "--json"])
    return result.stdout if result.returncode or '"message"' in result.stdout else ""


def numbers_are_complete(found):
    missing = sorted(set(range(1, COUNT + 1)) - {number for number, _, _ in found})
    return f"rows without a call: {missing}" if missing else ""


def operators_are_called(found):
    """Each operator of the library has a row with numbers."""
    scripts = "\n".join(line for _, _, lines in found for line in lines if not line.startswith("# "))
    missing = [name for name, _, _ in examples() if not re.search(rf"\b{name}\(", scripts)]
    return f"operators without a row: {missing}" if missing else ""


def main():
    given = program.arguments("Calls each operator: those of the given rows.", int,
                              evaluators="compare ways to compute the same")
    found, ombre = rows(), given.ombre
    run = check_evaluators if given.evaluators else check
    checks = [(f"{number} {name}", lambda lines=lines: run(ombre, lines))
              for number, name, lines in found if not given.names or number in given.names]
    if not given.names and not given.evaluators:
        checks += [(f"example of {name}", lambda library=library, example=example: example_works(ombre, library, example))
                   for name, library, example in examples()]
        checks.append(("all rows", lambda: numbers_are_complete(found)))
        checks.append(("all operators", lambda: operators_are_called(found)))
    return program.check_all(checks)


if __name__ == "__main__":
    raise SystemExit(main())

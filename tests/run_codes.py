#!/usr/bin/env python3
"""The same mistake in a script, a design file and an OpenSCAD script has one code, and a remedy in the right language. The
wrong designs of tests/errors have codes that say more than that something is wrong.

    python3 tests/run_codes.py build/dev/apps/ombre/ombre

tests/python/test_codes.py does so for Python.
"""
import json
import pathlib
import re
import shutil
import sys
import tempfile

import program
import run_errors

MATERIALS = '"materials": [{"name": "red", "r": 255, "g": 0, "b": 0, "a": 255}]'
CUBE = '{"id": "n1", "type": "cube", "parameters": {"side": 5}}'


def design_file(*nodes):
    """A design file whose last node, n9, is the part."""
    return (f'{{"format": "ombre-design", "version": 1, {MATERIALS}, "nodes": [{", ".join(nodes)}], '
            '"parts": [{"name": "part", "node": "n9"}]}')


def node(text, inputs=""):
    kind, _, parameters = text.partition(" ")
    return f'{{"id": "n9", "type": "{kind}", "parameters": {{{parameters}}}{inputs}}}'


ON_CUBE = ', "inputs": ["n1"]'
# code, values, then for each language the design, and what the remedy holds
MISTAKES = [
    ("unknown-node", {"node": "sphre", "similar": "sphere"},
     {".vcad": ("sphre(5);", 'did you mean "sphere"?'),
      ".json": (design_file(node("sphre")), 'did you mean "sphere"?')}),
    ("unknown-parameter", {"node": "sphere", "parameter": "radios", "similar": "radius"},
     {".vcad": ("sphere(radios=5);", 'did you mean "radius"?'),
      ".json": (design_file(node('sphere "radios": 5')), 'did you mean "radius"?')}),
    ("unknown-material", {"material": "redd", "similar": "red"},
     {".vcad": ('sphere(5, "redd");', 'did you mean "red"?'),
      ".json": (design_file(node('sphere "radius": 5, "material": "redd"')), 'did you mean "red"?')}),
    ("parameter-range", {"node": "sphere", "parameter": "radius", "found": "the number -1"},
     {".vcad": ("sphere(-1);", ""), ".json": (design_file(node('sphere "radius": -1')), "")}),
    ("parameter-missing", {"node": "translate", "parameter": "by"},
     {".vcad": ("translate() cube(5);", "for example translate(5, 0, 0)"),
      ".json": (design_file(CUBE, node("translate", ON_CUBE)), "ombre nodes translate")}),
    ("inputs", {"node": "sphere"},
     {".vcad": ("sphere(5) { cube(1); }", 'end it with ";"'),
      ".json": (design_file(CUBE, node('sphere "radius": 5', ON_CUBE)), 'leave "inputs" out')}),
    ("inputs", {"node": "translate"},
     {".vcad": ("translate(1, 2, 3);", "write translate(...) { sphere(5); }"),
      ".json": (design_file(node('translate "by": [1, 2, 3]')), 'write "inputs": ["n1"]')}),
    ("parameters", {"node": "rotate"},
     {".vcad": ("rotate(axis=[0, 0, 0], deg=5) cube(5);", "write x, y, z or for example (1, 1, 0)"),
      ".json": (design_file(CUBE, node('rotate "axis": [0, 0, 0], "degrees": 5', ON_CUBE)),
                "write for example [1, 1, 0]")}),
    ("parameters", {"node": "union"},
     {".vcad": ('union(materials="blend") { cube(5); sphere(3); }', 'union(blend=1, materials="blend")'),
      ".json": (design_file(CUBE, node('union "materials": "blend"', ', "inputs": ["n1", "n1"]')),
                '{"type": "union", "parameters": {"blend": 1, "materials": "blend"}}')}),
    ("parameter-range", {"node": "lattice", "parameter": "radius", "found": "the number -1"},
     {".vcad": ('lattice("bcc", (5, 5, 5), radius=-1);', ""),
      ".scad": ('use <ombre>\nlattice("bcc", [5, 5, 5], radius=-1);', "")}),
    ("parameters", {"node": "lattice"},
     {".vcad": ("lattice(radius=1);", 'lattice(cell="bcc", size=(10, 10, 10), radius=1)'),
      ".scad": ("use <ombre>\nlattice(radius=1);", 'lattice(cell="bcc", size=[10, 10, 10], radius=1)'),
      ".json": (design_file(node('lattice "radius": 1')), '"size": [10, 10, 10]')}),
    ("unknown-material", {"material": "redd", "similar": "red"},
     {".scad": ('use <ombre>\nlattice("bcc", [5, 5, 5], 1, material="redd");', 'did you mean "red"?')}),
    ("unbounded", {},
     {".vcad": ('function("z");', "put everything into root(min, max, voxel)"),
      ".json": (design_file(node('function "expression": "z"')), 'say "sampling" with min, max and voxel')}),
    ("file-missing", {"file": "no.stl"},
     {".vcad": ('mesh("no.stl");', "looked for"), ".json": (design_file(node('mesh "path": "no.stl"')), "looked for")}),
    ("nothing-inside", {},
     {".vcad": ("intersection() { cube(2); translate(9, 0, 0) cube(2); }", ""),
      ".json": (design_file(CUBE, '{"id": "n2", "type": "translate", "parameters": {"by": [9, 0, 0]}, "inputs": ["n1"]}',
                            node("intersection", ', "inputs": ["n1", "n2"]')), "")}),
]


def first_error(ombre, design, *options):
    result = program.run([ombre, "slice", design, "--voxel", "1", "--json", "-o", design.parent / "layers", *options])
    events = [json.loads(line) for line in result.stdout.splitlines()]
    errors = [e for e in events if e["event"] == "message" and e["severity"] == "error"]
    assert result.returncode != 0 and errors, f"{design.read_text()}\nhas no error: {result.stdout}{result.stderr}"
    return errors[0]


def check(ombre, folder, code, values, designs):
    for ending, (text, remedy) in designs.items():
        design = folder / ("part" + ending)
        design.write_text(text, encoding="utf-8")
        error = first_error(ombre, design)
        found = {name: error["values"].get(name) for name in values}
        assert error["code"] == code, f"{text}: the code is {error['code']}, expected {code}: {error}"
        assert found == values, f"{text}: {error['values']}, expected {values}"
        assert remedy in error["hint"], f"{text}: {error['hint']!r} lacks {remedy!r}"


def check_machine(ombre, folder):
    """What the machine says has codes, too, and options of the command line."""
    design = folder / "good.vcad"
    design.write_text("cube(3);", encoding="utf-8")
    program.run([ombre, "slice", design, "--voxel", "1", "-o", folder / "layers"])
    error = first_error(ombre, design)
    assert error["code"] == "exists" and "--force" in error["message"], error
    assert error["values"] == {"file": str(folder / "layers")}, error
    error = first_error(ombre, design, "--force", "--materials", "none.json")
    assert error["code"] == "file-missing" and error["values"] == {"file": "none.json"}, error
    for wrong in (["--voxel", "2"], ["--vxel", "2"], ["--threads", "none"]):
        assert first_error(ombre, design, *wrong)["code"] == "option", wrong
    taken = folder / "taken"
    taken.mkdir()
    (taken / "layers").write_text("no folder", encoding="utf-8")
    error = first_error(ombre, pathlib.Path(shutil.copy(design, taken)))
    assert error["code"] == "cannot-write" and error["values"] == {"file": str(taken / "layers")}, error


def check_all_used():
    """No code is only in the table."""
    sources = "".join(p.read_text(encoding="utf-8") for top in ("src", "apps/ombre", "bindings/python/core")
                      for p in (program.SOURCE / top).rglob("*") if p.suffix in (".h", ".cpp") and p.stem != "code"
                      and "_test" not in p.name)
    names = [line.strip(" ,") for line in (program.SOURCE / "src/base/text/code.h").read_text().split("{")[2].split("}")[0]
             .splitlines() if line.strip()]
    unused = [name for name in names if f"Code::{name}" not in sources]
    assert not unused, f"codes that nothing has: {', '.join(unused)}"


GENERAL = {"machine", "design"}
# What the operating system refuses without a reason that a program could act on.
MACHINES = {
    "apps/studio/workspace/guard.cpp", "src/base/math/point_sets.cpp", "src/base/system/temporary_folder.cpp", "src/stages/stage_input.cpp",
    "src/import/surfaces/closest_point.cpp", "src/lang/openscad/run_script.cpp", "src/render/ray_cast.cpp",
}


def codes_of(ombre, design):
    """The codes of the errors of a wrong design."""
    arguments, _ = run_errors.directives(design)
    with tempfile.TemporaryDirectory() as scratch:
        result = program.run([ombre, "slice", design.name, "--json", "-o", pathlib.Path(scratch) / "out", *arguments],
                             cwd=run_errors.FOLDER)
    events = [json.loads(line) for line in result.stdout.splitlines()]
    return {e["code"] for e in events if e["event"] == "message" and e["severity"] == "error"}


def check_wrong_designs(ombre):
    """No wrong design ends in a general code."""
    def check(design):
        general = GENERAL & codes_of(ombre, design)
        return f"has the general code {general.pop()}" if general else ""

    designs = sorted(path for ending in ("vcad", "scad", "json") for path in run_errors.FOLDER.glob(f"*.{ending}"))
    assert program.check_all([(d.name, lambda d=d: check(d)) for d in designs]) == 0, "wrong designs lack codes"


def check_all_coded():
    """Errors have a code where they are thrown."""
    general = re.compile(r"throw (?:ombre::)?Error\((?!\s*(?:ombre::)?(?:Code::|code\b))")
    without = {path.relative_to(program.SOURCE).as_posix()
               for top in ("src", "apps", "bindings/python/core") for path in (program.SOURCE / top).rglob("*")
               if path.suffix in (".h", ".cpp") and "test_" not in path.name and "_test" not in path.name
               and general.search(path.read_text(encoding="utf-8"))}
    assert without <= MACHINES, f"errors are thrown without a code in {', '.join(sorted(without - MACHINES))}"


def main():
    ombre = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as scratch:
        for code, values, designs in MISTAKES:
            check(ombre, pathlib.Path(scratch), code, values, designs)
        check_machine(ombre, pathlib.Path(scratch))
    check_wrong_designs(ombre)
    check_all_used()
    check_all_coded()
    print(f"{len(MISTAKES)} mistakes have their codes")


if __name__ == "__main__":
    main()

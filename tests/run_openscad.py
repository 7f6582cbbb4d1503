#!/usr/bin/env python3
"""OpenSCAD scripts: what `ombre scad` says and makes of them, line by line beside OpenSCAD itself.

tests/openscad/NAME.scad is a script; NAME.echo holds the messages and NAME.csg the tree that OpenSCAD 2021.01 made of it.
The test does not need it: only those scripts that use its libraries are skipped where these are missing.

    python3 tests/run_openscad.py build/dev/apps/ombre/ombre [--update] [NAME...]

--update asks an installed openscad for the .echo and .csg files again.
"""
import difflib
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import zipfile

import program

FOLDER = program.TESTS / "openscad"
LIBRARIES = pathlib.Path("/usr/share/openscad/libraries")


def ask_openscad(script):
    for ending in ("echo", "csg"):
        output = script.with_suffix("." + ending)
        output.unlink(missing_ok=True)
        subprocess.run(["openscad", "-o", output.name, script.name], cwd=FOLDER, timeout=program.PATIENCE_S, check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def difference(expected, made, name):
    return "\n".join(difflib.unified_diff(expected.splitlines(), made.splitlines(), f"expected {name}", f"made {name}",
                                          lineterm="", n=1))


def without_places(text):
    """Where libraries lie, and how old files are, differs from machine to machine."""
    return re.sub(r"timestamp = \d+", "timestamp = 0", re.sub(r"in file \S*/libraries/", "in file LIBRARIES/", text)).strip()


def check(ombre, script):
    if "<MCAD/" in script.read_text(encoding="utf-8") and not (LIBRARIES / "MCAD").exists():
        return "skipped: OpenSCAD's libraries are not installed"
    with tempfile.TemporaryDirectory() as scratch:
        outputs = {ending: pathlib.Path(scratch) / f"out.{ending}" for ending in ("echo", "csg")}
        for ending, output in outputs.items():
            result = program.run([ombre, "scad", script.name, "-o", output], cwd=FOLDER)
            if result.returncode not in (0, 1):
                return f"ended with {result.returncode}: {result.stderr}"
        problems = []
        for ending, output in outputs.items():
            expected = script.with_suffix("." + ending)
            made = output.read_text(encoding="utf-8") if output.exists() else ""
            wanted = expected.read_text(encoding="utf-8") if expected.exists() else ""
            made, wanted = without_places(made), without_places(wanted)
            if made != wanted:
                problems.append(difference(wanted, made, script.with_suffix("." + ending).name))
    return "\n".join(problems)


def check_rounds(ombre):
    """A .csg file is a script that makes the same tree."""
    with tempfile.TemporaryDirectory() as scratch:
        first, second = pathlib.Path(scratch) / "first.csg", pathlib.Path(scratch) / "second.csg"
        program.run([ombre, "scad", FOLDER / "operations.scad", "-o", first])
        program.run([ombre, "scad", first, "-o", second])
        return difference(first.read_text(), second.read_text(), "a .csg read again")


def check_options(ombre):
    script = FOLDER / "parameters.scad"

    def said(*arguments):
        result = program.run([ombre, "scad", script, *arguments, "-o", "-", "--export-format", "echo"])
        return result.stdout.strip(), result.returncode

    sets = FOLDER / "parameters.json"
    cases = [
        ((), 'ECHO: 20, "box", true, [1, 2, 3], 3'),
        (("-D", "width=5 * 2", "-D", 'name="lid"'), 'ECHO: 10, "lid", true, [1, 2, 3], 3'),
        (("-p", sets, "-P", "small"), 'ECHO: 7, "a \\"small\\" one", false, [4, 5, 6], 3'.replace('\\"', '"')),
        (("-p", sets, "-P", "small", "-D", "width=8"), 'ECHO: 8, "a "small" one", false, [4, 5, 6], 3'),
    ]
    problems = [f"{arguments}: {said(*arguments)}" for arguments, wanted in cases if said(*arguments) != (wanted, 0)]
    if program.run([ombre, "scad", script, "-p", sets, "-P", "none"]).returncode != 1:
        problems.append("a missing parameter set is no error")
    piped = program.run([ombre, "scad", "-", "-o", "-", "--export-format", "off"], input="cube(2);")
    if piped.returncode != 0 or not piped.stdout.startswith("OFF") or "0 0 2" not in piped.stdout:
        problems.append(f"a solid from stdin to stdout: {piped.returncode} {piped.stdout[:200]} {piped.stderr}")
    with tempfile.TemporaryDirectory() as scratch:
        named = pathlib.Path(scratch) / "cube.part"
        made = program.run([ombre, "scad", "-", "-o", named, "--export-format", "binstl"], input="cube(2);")
        if made.returncode != 0 or abs(volume_of_stl(named) - 8) > 1e-5 or f"written to {named}" not in made.stderr:
            problems.append(f"a file of another name: {made.returncode} {made.stderr}")
    warned = program.run([ombre, "scad", FOLDER / "unknown_names.scad", "--hardwarnings"])
    if warned.returncode != 1:
        problems.append("--hardwarnings goes on after a warning")
    return "\n".join(problems)


TWO_PARTS = """part("block") material("PLA") color("red") difference() { cube(10); translate([5, 5, -1]) cube([9, 9, 20]); }
part("lid") material("TPU") translate([20, 0, 0]) linear_extrude(3) square(4);"""


def volume_of_stl(path):
    """Of an STL file, binary or text, by the divergence theorem."""
    data = path.read_bytes()
    if data[:5] == b"solid" and b"facet" in data[:300]:
        numbers = [tuple(map(float, line.split()[1:])) for line in data.decode().splitlines() if "vertex" in line]
        triangles = [numbers[n:n + 3] for n in range(0, len(numbers), 3)]
    else:
        count = struct.unpack_from("<I", data, 80)[0]
        values = [struct.unpack_from("<12f", data, 84 + 50 * n) for n in range(count)]
        triangles = [(v[3:6], v[6:9], v[9:12]) for v in values]
    def six(a, b, c):
        return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return sum(six(*t) for t in triangles) / 6


def check_meshes(ombre):
    problems = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "two.scad").write_text(TWO_PARTS, encoding="utf-8")
        result = program.run([ombre, "scad", "two.scad", "-o", "all.stl", "-o", "two-{part}.stl", "-o", "two.3mf"], cwd=folder)
        if result.returncode != 0:
            return result.stderr
        for name, wanted in (("all.stl", 798), ("two-block.stl", 750), ("two-lid.stl", 48)):
            found = volume_of_stl(folder / name)
            if abs(found - wanted) > 1e-3:
                problems.append(f"{name} has a volume of {found}, not {wanted}")
        with zipfile.ZipFile(folder / "two.3mf") as package:
            model = package.read("3D/3dmodel.model").decode("utf-8")
        problems += [f"no {word} in the .3mf" for word in ("block", "lid", "PLA", "TPU", "#FF0000") if word not in model]
        (folder / "area.scad").write_text("difference() { square(10); translate([2, 2]) circle(1); }", encoding="utf-8")
        if program.run([ombre, "scad", "area.scad", "-o", "area.svg"], cwd=folder).returncode != 0 \
                or "<path" not in (folder / "area.svg").read_text():
            problems.append("no area.svg")
        wrong = program.run([ombre, "scad", "area.scad", "-o", "area.stl"], cwd=folder)
        if wrong.returncode != 1 or (folder / "area.stl").exists():
            problems.append("an area was written as a mesh")
    return "\n".join(problems)


WORDS = """use <ombre>
part("graded") difference() {
  fgrade(["x/10", "1 - x/10"], ["white", "black"]) cube(10);
  translate([2, 2, -1]) cube([4, 4, 12]);
}
part("ball") ombre_translate([0, 0, 20]) { ombre_sphere(4); }
echo("done");"""


def check_words(ombre):
    """Scripts that say use <ombre>: their meshes by part, their .csg read again, their messages."""
    problems = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "words.scad").write_text(WORDS, encoding="utf-8")
        outputs = [word for name in ("out-{part}.stl", "words.csg", "words.echo", "words.3mf") for word in ("-o", name)]
        result = program.run([ombre, "scad", "words.scad", *outputs], cwd=folder)
        if result.returncode != 0:
            return result.stderr
        for name, wanted in (("graded", 1000 - 4 * 4 * 10), ("ball", 4 / 3 * 3.14159265 * 4**3)):
            found = volume_of_stl(folder / f"out-{name}.stl")
            if abs(found - wanted) > 2e-3 * wanted:
                problems.append(f"{name} has a volume of {found}, not {wanted}")
        if (folder / "words.echo").read_text() != 'ECHO: "done"\n':
            problems.append("words.echo: " + (folder / "words.echo").read_text())
        program.run([ombre, "scad", "words.csg", "-o", "again.csg"], cwd=folder)
        problems.append(difference((folder / "words.csg").read_text(), (folder / "again.csg").read_text(), "a .csg with words"))
        with zipfile.ZipFile(folder / "words.3mf") as package:
            model = package.read("3D/3dmodel.model").decode("utf-8")
        problems += [f"no {word} in the .3mf" for word in ("graded", "ball") if word not in model]
        (folder / "wrong.scad").write_text('use <ombre>\nfgrade(["x"], ["whiet"]) cube(1);', encoding="utf-8")
        wrong = program.run([ombre, "scad", "wrong.scad", "-o", "wrong.stl"], cwd=folder)
        if wrong.returncode != 1 or (folder / "wrong.stl").exists() or 'did you mean "white"' not in wrong.stderr:
            problems.append("a wrong material: " + wrong.stderr)
    return "\n".join(filter(None, problems))


# Listing 4.3 of the thesis of 2023: a vase with stripes in a second colour.
VASE = """module vase() {
  translate([0, 0, 4]) linear_extrude(height = 30, convexity = 10, twist = 360, $fn = 50)
    translate([1.5, 0, 0]) difference() { circle(r = 16); circle(r = 14); }
  translate([1.5, 0, 0]) linear_extrude(height = 4, convexity = 10, $fn = 50) { circle(r = 16); }
}
module vase_color1() {
  difference() {
    vase();
    for (i = [1 : 1 : 8]) translate([-40, -20, -40 + 10 * i]) rotate([45, 0, 0]) cube([80, 80, 3]);
  }
}
color("green") vase_color1();
color("white") difference() { vase(); vase_color1(); }
"""


def check_vase(ombre):
    """The slicer prints the colours with two tools."""
    if not shutil.which("prusa-slicer"):
        return "skipped: no prusa-slicer"
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "vase.scad").write_text(VASE, encoding="utf-8")
        made = program.run([ombre, "scad", "vase.scad", "-o", "vase.3mf"], cwd=folder)
        if made.returncode != 0:
            return made.stderr
        sliced = program.run(["prusa-slicer", "--export-gcode", "vase.3mf", "-o", "vase.gcode", "--nozzle-diameter", "0.4,0.4",
                              "--center", "100,100", "--skirts", "0", "--fill-density", "100%", "--fill-pattern", "rectilinear"],
                             cwd=folder, timeout=program.PATIENCE_S)
        if sliced.returncode != 0:
            return sliced.stderr
        code = (folder / "vase.gcode").read_text(encoding="utf-8")
        tools = set(re.findall(r"^T(\d)", code, re.MULTILINE))
        return "" if tools == {"0", "1"} else f"the slicer uses the tools {tools}"


def check_bytes(ombre):
    """The triangles are the same wherever the script lies and whatever the environment is, which move the heap's blocks."""
    script = "".join(f"hull() {{ translate([{x}, 0, {z}]) sphere(d=5, $fn=24); translate([0, 0, 12]) sphere(d=5, $fn=24); }}\n"
                     for x, z in ((0, 0), (6, 20), (-6, 20)))
    made = set()
    with tempfile.TemporaryDirectory() as scratch:
        for n, length in enumerate((1, 40, 80, 120, 200)):
            folder = pathlib.Path(scratch) / ("f" * length)
            folder.mkdir()
            (folder / "hulls.scad").write_text(script)
            subprocess.run([ombre, "scad", folder / "hulls.scad", "-o", folder / "hulls.stl"], check=True, timeout=program.PATIENCE_S,
                           env={**program.environment(), "OMBRE_UNUSED": "x" * (100 * n)}, capture_output=True)
            made.add((folder / "hulls.stl").read_bytes())
    if len(made) > 1:
        raise AssertionError(f"{len(made)} different files of one script")


def main():
    arguments = program.arguments(__doc__.splitlines()[0], update="ask an installed openscad for the expected files again")
    ombre = arguments.ombre
    scripts = [s for s in sorted(FOLDER.glob("*.scad")) if not arguments.names or s.stem in arguments.names]
    if arguments.update:
        for script in scripts:
            ask_openscad(script)
    checks = [(script.stem, lambda script=script: check(ombre, script)) for script in scripts if script.stem != "parameters"]
    if not arguments.names:
        checks += [("a .csg file is a script", lambda: check_rounds(ombre)), ("options", lambda: check_options(ombre)),
                   ("meshes", lambda: check_meshes(ombre)), ("words", lambda: check_words(ombre)),
                   ("vase", lambda: check_vase(ombre)), ("bytes", lambda: check_bytes(ombre))]
    return program.check_all(checks)


if __name__ == "__main__":
    raise SystemExit(main())

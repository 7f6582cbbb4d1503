#!/usr/bin/env python3
"""Small pictures of the examples, against those in tests/golden, which a person has looked at.

    python3 tests/run_pictures.py build/dev/apps/ombre/ombre [NAME...]
    python3 tests/run_pictures.py build/dev/apps/ombre/ombre --renew [NAME...]
"""
import pathlib
import tempfile

import png
import program

EXAMPLES = program.SOURCE / "examples"
GOLDEN = program.TESTS / "golden"
FOUND = program.SOURCE / "out" / "pictures"

# Of a channel's 255: more is another colour. Rounding moves some pixels at edges, all together by little.
MOST_DIFFERENCE, MOST_OTHER_PIXELS, MOST_MEAN = 12, 0.001, 0.1

# Example and options, for pictures that are not just an example seen as usual.
FURTHER = {
    "knob_cut": ("knob", "--cut", "x=0", "--from=-50,20"),
    "knob_slice": ("knob", "--slice", "x=0", "--background", "transparent"),
    "gear_slice": ("gear", "--slice", "z=2", "--background", "#203040"),
    "gear_perspective": ("gear", "--perspective", "45"),
    "wing_perspective": ("graded_wing", "--perspective", "60", "--zoom", "1.5"),
    "overlap_translucent": ("overlap", "--opacity", "blue=0.1", "--opacity", "red=0.3"),
    "cone_and_sphere_top": ("cone_and_sphere", "--view", "top", "--aa", "1"),
    "knob_annotated": ("knob", "--annotate"),
    "gear_annotated": ("gear", "--perspective", "30", "--annotate", "--background", "black"),
}
DESIGNS = {example.stem: example for example in [*sorted(EXAMPLES.glob("*.vcad")), *sorted(EXAMPLES.glob("openscad/*.scad"))]}
CASES = {name: (name,) for name in DESIGNS} | FURTHER


def render(ombre, name, picture):
    """Returns what keeps it from being compared, or nothing."""
    example, *options = CASES[name]
    size = "320x240" if "--annotate" in options else "200x150"
    result = program.run([ombre, "render", DESIGNS[example], "-o", picture, "--force", "--size", size,
                          *options])
    lacking = ("without FreeType", "no font", "DejaVu", "no library for polyhedra")
    if any(word in result.stderr for word in lacking):
        return "skipped: " + result.stderr.strip()
    return result.stderr if result.returncode else ""


def compare(found, golden):
    """What is different between two images, "" for no more than tolerated."""
    if (found.width, found.height) != (golden.width, golden.height):
        return f"it has {found.width} x {found.height} pixels, not {golden.width} x {golden.height}"
    differences = [max(abs(a - b) for a, b in zip(p, q)) for row, other in zip(found.rows, golden.rows)
                   for p, q in zip(row, other)]
    others = sum(d > MOST_DIFFERENCE for d in differences) / len(differences)
    mean = sum(differences) / len(differences)
    if others <= MOST_OTHER_PIXELS and mean <= MOST_MEAN:
        return ""
    return (f"{100 * others:.2f} % of the pixels have another colour (tolerated: {100 * MOST_OTHER_PIXELS} %), "
            f"the mean difference is {mean:.2f} of 255 (tolerated: {MOST_MEAN})")


def check(ombre, name):
    golden = GOLDEN / f"{name}.png"
    with tempfile.TemporaryDirectory() as scratch:
        picture = pathlib.Path(scratch) / "found.png"
        problem = render(ombre, name, picture)
        if problem:
            return problem
        if not golden.exists():
            return f"there is no {golden}; make it with\npython3 tests/run_pictures.py {ombre} --renew {name}"
        problem = compare(png.read(picture), png.read(golden))
        if not problem:
            return ""
        FOUND.mkdir(parents=True, exist_ok=True)
        kept = FOUND / f"{name}.png"
        kept.write_bytes(picture.read_bytes())
    return (f"{problem}\nlook at {kept} beside {golden}; if the new one is right, make it the golden one with\n"
            f"python3 tests/run_pictures.py {ombre} --renew {name}")


MISTAKES = [
    (["--zoom", "nan"], "--zoom: \"nan\" is not a number from 0.01 to 1000"),
    (["--perspective", "nan"], "--perspective: \"nan\" is not a number from 0 to 120"),
    (["--from", "nan,0"], "azimuth,elevation"),
    (["--slice", "z"], "--slice z=3.2"),
    (["--slice", "z=50"], "z -15 to 10 mm"),
    (["--slice", "z=0", "--view", "top"], "do not go together"),
    (["--cut", "x<50"], "nothing of the design is left"),
    (["--size", "20000x1"], "at most 16384"),
    (["--output", "picture.jpg"], "PNG"),
]


def mistakes_are_explained(ombre):
    with tempfile.TemporaryDirectory() as scratch:
        for arguments, part in MISTAKES:
            result = program.run([ombre, "render", EXAMPLES / "knob.vcad", *arguments], cwd=scratch)
            if result.returncode != 1 or part not in result.stderr:
                return f"{arguments}: status {result.returncode}, {result.stderr}"
        return "it wrote all the same" if any(pathlib.Path(scratch).iterdir()) else ""


def attributes_are_said(ombre):
    """What a design has besides materials is said, unless the picture shows it."""
    with tempfile.TemporaryDirectory() as scratch:
        design = pathlib.Path(scratch, "ball.vcad")
        design.write_text('attribute("dose", "3 + x") sphere(5, "red");', encoding="utf-8")
        plain = program.run([ombre, "render", design, "-o", "a.png", "--size", "40x30"], cwd=scratch).stderr
        coloured = program.run([ombre, "render", design, "-o", "b.png", "--size", "40x30", "--by", "dose"], cwd=scratch).stderr
    return "" if "attributes dose; --by dose" in plain and "attributes" not in coloured else plain + coloured


# ---- what the comparison must see


class Changed:
    """An image with other rows."""

    def __init__(self, rows):
        self.rows, self.width, self.height = rows, len(rows[0]), len(rows)


def brighter(pixel, factor):
    return tuple(min(255, round(c * factor)) for c in pixel[:3]) + pixel[3:]


def changes_are_seen(name):
    image = png.read(GOLDEN / f"{name}.png")
    changes = {
        "a shift to the right": [row[:1] + row[:-1] for row in image.rows],
        "a shift downwards": image.rows[:1] + image.rows[:-1],
        "less light": [[p if p[:3] == (255, 255, 255) else brighter(p, 0.97) for p in row] for row in image.rows],
        "red and blue exchanged": [[(p[2], p[1], p[0], p[3]) for p in row] for row in image.rows],
    }
    unseen = [what for what, rows in changes.items() if not compare(Changed(rows), image)]
    return f"not seen: {', '.join(unseen)}" if unseen or compare(image, image) else ""


def renew(ombre, names):
    GOLDEN.mkdir(exist_ok=True)
    for name in names:
        problem = render(ombre, name, GOLDEN / f"{name}.png")
        print(f"{name}: {problem or 'made; look at it'}")
    return 0


def main():
    a = program.arguments("Compares pictures of the examples with golden ones.", renew="make the golden pictures anew")
    ombre, names = a.ombre, a.names or list(CASES)
    if a.renew:
        return renew(ombre, names)
    checks = [(name, lambda n=name: check(ombre, n)) for name in names]
    if not a.names:
        checks += [("mistakes are explained", lambda: mistakes_are_explained(ombre)),
                   ("attributes are said", lambda: attributes_are_said(ombre))]
        checks += [(f"changes of {n} are seen", lambda n=n: changes_are_seen(n)) for n in ("gear", "knob", "mug")]
    return program.check_all(checks)


if __name__ == "__main__":
    raise SystemExit(main())

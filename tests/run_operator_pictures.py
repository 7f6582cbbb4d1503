#!/usr/bin/env python3
"""Small pictures of the operators' examples: docs/reference/operators.md shows one for each, which a person has looked at.

    python3 tests/run_operator_pictures.py build/release/apps/ombre/ombre [NAME...]
    python3 tests/run_operator_pictures.py build/release/apps/ombre/ombre --renew [NAME...]

Without names, all pictures are looked at, and one of each library is drawn again.
"""
import pathlib
import tempfile

import png
import program
import run_operators
import run_pictures

PICTURES = program.SOURCE / "docs" / "reference" / "operators"
SIZE = (160, 120)
MOST_BYTES = 2_000_000  # of all pictures together
LEAST_SHARE = 0.03      # of the pixels that an example covers

MIDDLE = ("--cut", "y=0")  # the half that hides the middle is taken away
CORNER = ("--cut", "x<0,y<0")

# Options of `ombre render`, where an example seen from outside does not show what its operator does.
OPTIONS = {
    "bone_layers": CORNER, "chamber": MIDDLE, "honeycomb_sandwich": ("--cut", "z=1"),
    "here": MIDDLE, "line_fibres": MIDDLE, "line_distance": MIDDLE, "spline_distance": ("--cut", "z=0"),
    "b_spline_points": ("--view", "top"), "bezier_points": ("--view", "top"), "on_curve": ("--view", "top"),
    "axis_parameter": MIDDLE, "medial_radius": MIDDLE, "medial_parameter": MIDDLE, "medial_strata": MIDDLE,
    "surface_frame": ("--by", "fibre.z"), "cross_product": ("--by", "fibre.x"), "normalised": ("--by", "fibre.x"),
    "swizzle": ("--by", "fibre.y"), "curl_noise": ("--by", "fibre.x"), "height_normal": ("--by", "fibre.x"),
    "distance_gradient": MIDDLE, "gradient_between": MIDDLE, "in_cone": MIDDLE, "in_torus": MIDDLE,
    "in_ellipsoid": MIDDLE, "in_sphere": MIDDLE, "displaced": MIDDLE, "stratum": MIDDLE, "strata": MIDDLE,
    "layers_of": MIDDLE, "point_strata": ("--cut", "x<0,y<0,z>0"), "spline_strata": ("--cut", "z=0"),
    "patch_distance": MIDDLE, "assign": MIDDLE, "assign_all": MIDDLE, "region_or": MIDDLE,
}


def draw(ombre, name, library, example, picture):
    """Returns what keeps it from being drawn, or nothing."""
    design = picture.with_suffix(".vcad")
    run_operators.write_example(design, library, example)
    result = program.run([ombre, "render", design, "-o", picture, "--force", "--quiet", "--size",
                          "{}x{}".format(*SIZE), *OPTIONS.get(name, ())])
    return result.stderr if result.returncode else ""


def is_shown(name):
    """The picture has its size, and the example is on it."""
    path = PICTURES / f"{name}.png"
    if not path.exists():
        return f"there is no {path}; make it with\npython3 tests/run_operator_pictures.py OMBRE --renew {name}"
    image = png.read(path)
    if (image.width, image.height) != SIZE:
        return f"it has {image.width} x {image.height} pixels"
    background = image.rows[0][0]
    covered = sum(pixel != background for row in image.rows for pixel in row)
    return "" if covered >= LEAST_SHARE * SIZE[0] * SIZE[1] else f"{covered} pixels show something"


def is_drawn_again(ombre, name, library, example):
    with tempfile.TemporaryDirectory() as scratch:
        found = pathlib.Path(scratch) / f"{name}.png"
        problem = draw(ombre, name, library, example, found) or run_pictures.compare(
            png.read(found), png.read(PICTURES / found.name))
    return problem and f"{problem}\nif it shall look so, python3 tests/run_operator_pictures.py {ombre} --renew {name}"


def pictures_differ(names):
    """No picture stands for two operators, none for no operator, and together they are small."""
    contents = {path.stem: path.read_bytes() for path in sorted(PICTURES.iterdir())}
    program.expect(sorted(contents) == sorted(names), f"not of one operator each: {set(contents) ^ set(names)}")
    alike = [(a, b) for a in contents for b in contents if a < b and contents[a] == contents[b]]
    program.expect(not alike, f"the same picture: {alike}")
    size = sum(map(len, contents.values()))
    program.expect(size <= MOST_BYTES, f"pictures have {size} bytes, more than {MOST_BYTES}")


def page_shows_pictures(names):
    page = (program.SOURCE / "docs" / "reference" / "operators.md").read_text(encoding="utf-8")
    missing = [name for name in names if f"\n![{name}](operators/{name}.png)\n" not in page]
    return f"not on the page: {missing}" if missing else ""


def renew(ombre, operators):
    PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        for name, library, example in operators:
            picture = pathlib.Path(scratch) / f"{name}.png"
            problem = draw(ombre, name, library, example, picture)
            if not problem:
                (PICTURES / picture.name).write_bytes(picture.read_bytes())
            print(f"{name}: {problem or 'made; look at it'}")


def main():
    given = program.arguments("Compares pictures of operators with those of the reference.", renew="make pictures anew")
    ombre, all_operators = given.ombre, list(run_operators.examples())
    operators = [one for one in all_operators if not given.names or one[0] in given.names]
    if given.renew:
        return renew(ombre, operators)
    names = [name for name, _, _ in all_operators]
    drawn = operators if given.names else {library: one for one in operators for library in [one[1]]}.values()
    checks = [(f"picture of {one[0]}", lambda name=one[0]: is_shown(name)) for one in operators]
    checks += [(f"{one[0]} drawn again", lambda one=one: is_drawn_again(ombre, *one)) for one in drawn]
    if not given.names:
        checks += [("one for each", lambda: pictures_differ(names)), ("page", lambda: page_shows_pictures(names))]
    return program.check_all(checks)


if __name__ == "__main__":
    raise SystemExit(main())

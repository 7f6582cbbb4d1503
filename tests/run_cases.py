#!/usr/bin/env python3
"""Designs with what they give. The expectations stand in comments at the top of tests/cases/*/*.vcad and *.scad:

    // arguments: --voxel 0.1
    // expect volume red 4/3*pi*5^3 within 0.5%
    // expect volume total 1000 exactly
    // expect count red 400
    // expect voxels 10 x 11 x 3
    // expect at (0, 0, 4): inside, red 0.5, blue 0.5, distance -2, infill = 0.3, part lid
    // expect warning the part is only

Numbers may be formulas. Volumes are mm3, points and distances mm. A composition names all of its materials.
A warning that is not expected is a failure. All numbers come from mathematics or a paper, with the reason beside
them, never from what the program said.

    python3 tests/run_cases.py build/dev/apps/ombre/ombre [NAME...]
"""
import json
import math
import re
import shlex
import tempfile

import program

FOLDER = program.TESTS / "cases"
NAMES = {name: getattr(math, name) for name in dir(math) if not name.startswith("_")}
TOLERANCE = 1e-9


def number(text):
    return float(eval(text.replace("^", "**"), {"__builtins__": {}}, NAMES))  # formulas of this repository


def close(value, wanted):
    return value is not None and abs(value - wanted) <= TOLERANCE * max(1.0, abs(wanted))


def split_top(text):
    """At the commas that stand in no brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter == "(") - (letter == ")")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def expectations(design):
    arguments, expected = [], []
    for line in design.read_text(encoding="utf-8").splitlines():
        if not line.startswith("//"):
            break
        text = line[2:].strip()
        if text.startswith("arguments: "):
            arguments = shlex.split(text[len("arguments: "):])
        elif text.startswith("expect "):
            expected.append(text[len("expect "):])
    return arguments, expected


def events(command, cwd):
    result = program.run(command, cwd=cwd)
    found = [json.loads(line) for line in result.stdout.splitlines()]
    if result.returncode != 0:
        reported = [e.get("message", "") for e in found if e["event"] == "message"]
        raise AssertionError(f"status {result.returncode}: " + "; ".join(reported) + result.stderr[:500])
    return found


class Case:
    """One design, sliced and probed."""

    def __init__(self, ombre, design):
        self.design = design
        self.arguments, self.expected = expectations(design)
        self.problems = []
        points = [e for e in self.expected if e.startswith("at ")]
        rest = [e for e in self.expected if not e.startswith("at ")]
        self.reported = []
        if points:
            self.check_points(ombre, points)
        if rest:
            self.check_slices(ombre, rest)
        self.check_warnings()
        if not self.expected:
            self.problems.append("nothing is expected of it")

    def note(self, events_of_run):
        self.reported += [e["message"] for e in events_of_run if e["event"] == "message"]

    def check_points(self, ombre, expected):
        parsed = []
        for text in expected:
            match = re.fullmatch(r"at (\(.*?\)): (.*)", text)
            if not match:
                self.problems.append(f"not understood: {text}")
                continue
            parsed.append((text, [number(c) for c in split_top(match[1][1:-1])], split_top(match[2])))
        command = [ombre, "probe", self.design.name, "--json"]
        for _, point, _ in parsed:
            command += ["--at=" + ",".join(repr(c) for c in point)]
        found = events(command, self.design.parent)
        self.note(found)
        results = [e for e in found if e["event"] == "point"]
        for (text, _, expectations), result in zip(parsed, results):
            self.check_point(text, expectations, result)

    def check_point(self, text, expectations, result):
        composition, parts = {}, []
        for expectation in expectations:
            if expectation in ("inside", "outside"):
                good = result["inside"] == (expectation == "inside")
            elif expectation.startswith("part ") and " = " not in expectation:
                parts.append(expectation[len("part "):])
                continue
            elif " = " in expectation:
                name, value = expectation.split(" = ")
                good = close(result["attributes"].get(name), number(value))
            else:
                name, value = expectation.split(" ", 1)
                if name != "distance":
                    composition[name] = number(value)
                    continue
                good = close(result["distance_mm"], number(value))
            if not good:
                self.problems.append(f"{text}: {expectation}, found {json.dumps(result)}")
        found = result["composition"]
        if composition and not (found.keys() == composition.keys() and
                                all(close(found[name], share) for name, share in composition.items())):
            self.problems.append(f"{text}: found {found}")
        if parts and sorted(parts) != sorted(result["parts"]):
            self.problems.append(f"{text}: found parts {result['parts']}")

    def check_slices(self, ombre, expected):
        with tempfile.TemporaryDirectory() as scratch:
            command = [ombre, "slice", self.design.name, "--unchecked", "--json", "-o", scratch + "/out", *self.arguments]
            found = events(command, self.design.parent)
        self.note(found)
        plan = next(e for e in found if e["event"] == "plan")
        done = next(e for e in found if e["event"] == "done")
        volume = math.prod(plan["pitch_mm"])
        counts = {m["name"]: m["voxels"] for m in done["materials"]}
        counts["total"] = sum(counts.values())
        for text in expected:
            words = text.split()
            if words[0] == "volume":
                self.check_volume(text, counts.get(words[1], 0) * volume)
            elif words[0] == "count":
                self.compare(text, counts.get(words[1], 0), number(" ".join(words[2:])))
            elif words[0] == "voxels":
                self.compare(text, plan["voxels"], [int(n) for n in words[1::2]])
            elif words[0] != "warning":
                self.problems.append(f"not understood: {text}")

    def compare(self, text, found, wanted):
        if found != wanted:
            self.problems.append(f"{text}: found {found}")

    def check_volume(self, text, found):
        match = re.fullmatch(r"volume \S+ (.*?) (?:within (\S+)%|exactly)", text)
        if not match:
            self.problems.append(f"not understood: {text}")
            return
        wanted = number(match[1])
        allowed = float(match[2]) / 100 * wanted if match[2] else 1e-9 * max(1, wanted)
        if not abs(found - wanted) <= allowed:
            self.problems.append(f"{text}: found {found:.6g}, expected {wanted:.6g}")

    def check_warnings(self):
        wanted = [e[len("warning "):] for e in self.expected if e.startswith("warning ")]
        for text in wanted:
            if not any(text in message for message in self.reported):
                self.problems.append(f"there was no warning: {text}")
        for message in dict.fromkeys(self.reported):
            if not any(text in message for text in wanted):
                self.problems.append(f"it warned: {message}")


def main():
    a = program.arguments("Runs the designs of tests/cases.")
    designs = sorted([*FOLDER.glob("*/*.vcad"), *FOLDER.glob("*/*.scad")])
    if a.names:
        designs = [d for d in designs if d.stem in a.names]
    checks = [(str(d.relative_to(FOLDER)), lambda d=d: "\n".join(Case(a.ombre, d).problems)) for d in designs]
    return program.check_all(checks)


if __name__ == "__main__":
    raise SystemExit(main())

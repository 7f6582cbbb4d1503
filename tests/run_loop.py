#!/usr/bin/env python3
"""The seat of the examples: solved soft, graded by what moved, and solved again, as docs/user/simulation-loop.md tells.

    python3 tests/run_loop.py build/dev/apps/ombre/ombre
"""
import json
import math

import program
from fea_jobs import array
from program import expect

SEAT = program.SOURCE / "examples" / "seat.vcad"
STUDY = program.SOURCE / "examples" / "studies" / "rider.json"
WITHOUT_READERS = "built without libzip and pugixml"
LEAST, MOST, STIFFEST = 3, 9, 0.8  # as the design has them


class Lacking(Exception):
    """This build cannot read results."""


class Loop(program.Folder):
    def run(self, *arguments):
        result = program.run([self.ombre, *arguments, "--json"], cwd=self.path)
        if WITHOUT_READERS in result.stderr:
            raise Lacking()
        expect(result.returncode == 0, result.stderr[-1500:])
        return [json.loads(line) for line in result.stdout.splitlines()]

    def solve(self, output, *arguments):
        """The greatest displacement in mm."""
        self.run("fea", SEAT, "--study", STUDY, "--cell", "8", "--solve", "--tolerance", "1e-5", "-o", output, *arguments)
        moved = array(self.path / output, "displacement [mm]")
        return max(math.hypot(*moved[n:n + 3]) for n in range(0, len(moved), 3))

    def nodes(self, name):
        """Places and displacements."""
        places = array(self.path / name, "points", "d")
        moved = array(self.path / name, "displacement [mm]")
        return [(places[n:n + 3], math.hypot(*moved[n:n + 3])) for n in range(0, len(places), 3)]

    def gray(self, places, *arguments):
        """The shares of gray there; None outside."""
        at = [word for p in places for word in ("--at", ",".join(f"{x:.9g}" for x in p))]
        events = [e for e in self.run("probe", SEAT, *arguments, *at) if e["event"] == "point"]
        expect(len(events) == len(places), "not every point is answered")
        return [e["composition"].get("gray", 0) if e["inside"] else None for e in events]


def stiff_where_it_moved(loop):
    """The share of gray at nodes in the middle of the pad is that which the design's formula gives."""
    nodes = [n for n in loop.nodes("soft.vtu") if abs(n[0][0]) < 60 and abs(n[0][1]) < 16 and abs(n[0][2]) < 8]
    nodes = nodes[::max(1, len(nodes) // 40)]
    shares = loop.gray([place for place, _ in nodes], "-D", "moved=soft.vtu")
    compared = 0
    for (place, moved), share in zip(nodes, shares):
        if share is None:
            continue
        wanted = min(max((moved - LEAST) / (MOST - LEAST) * STIFFEST, 0), STIFFEST)
        expect(abs(share - wanted) < 1e-4, f"at {place}, which moved by {moved} mm, the share is {share}, not {wanted}")
        compared += 1
    expect(compared >= 20, f"only {compared} nodes are in the pad")


def check(loop):
    soft = loop.solve("soft.vtu")
    stiff_where_it_moved(loop)
    once = loop.solve("once.vtu", "-D", "moved=soft.vtu")
    expect(once < 0.7 * soft, f"it sags by {once} mm, after {soft} mm when it was soft")
    twice = loop.solve("twice.vtu", "-D", "moved=once.vtu")
    expect(twice < 0.7 * soft, f"after another round it sags by {twice} mm")
    expect(any(array(loop.path / "twice.vtu", "stiffened")), "the second round has forgotten the first")


def check_if_possible(loop):
    try:
        check(loop)
    except Lacking:
        return "skipped: " + WITHOUT_READERS
    return ""


if __name__ == "__main__":
    raise SystemExit(program.main(Loop, {"the seat": check_if_possible}))

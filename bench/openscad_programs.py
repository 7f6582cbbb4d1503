#!/usr/bin/env python3
"""Times `ombre scad` from script to STL, beside OpenSCAD and beside CGAL's corefinement alone.

    python3 bench/openscad_programs.py build/release/apps/ombre/ombre [--corefinement build/bench/bench/bench_corefinement]

The scripts are those of bench/openscad. Times are those of the processor, of all threads together, since other programs
do not lengthen them; the least of several runs of whole programs. Memory is the most that a run held. CGAL's times,
which bench_corefinement prints, are of the boolean alone, without a script and a file.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SCRIPTS = pathlib.Path(__file__).resolve().parent / "openscad"
ALONE = {"ball_less_ten_40": "$fn=40", "ball_less_ten_100": "$fn=100", "plate_300_holes": "plate"}


def run(command):
    """Seconds and most memory in MB; nothing where it failed."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    return None if status else (usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def least(command, runs):
    found = [run(command) for _ in range(runs)]
    return None if None in found else min(found)


def corefinement(program, runs):
    """Seconds by case, the least of some runs."""
    times = {}
    for _ in range(runs if program else 0):
        printed = subprocess.run([program], capture_output=True, text=True, check=True).stdout
        for line in printed.splitlines():
            for case, word in ALONE.items():
                if word + " " in line:
                    times[case] = min(times.get(case, 1e9), float(line.split(word)[1].split()[0]))
    return times


def row(case, ombre, openscad, alone):
    cells = [case, f"{ombre[0]:.2f} s, {ombre[1]:.0f} MB" if ombre else "failed"]
    cells.append(f"{openscad[0]:.1f} s, {openscad[1]:.0f} MB" if openscad else "-")
    cells.append(f"{openscad[0] / ombre[0]:.0f}" if ombre and openscad else "-")
    cells.append(f"{alone:.2f} s" if alone else "-")
    cells.append(f"{ombre[0] / alone:.2f}" if ombre and alone else "-")
    return "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ombre", type=pathlib.Path)
    parser.add_argument("--corefinement", type=pathlib.Path, help="bench_corefinement")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--without-openscad", action="store_true", help="it takes a minute and more")
    a = parser.parse_args()
    openscad = None if a.without_openscad else shutil.which("openscad")
    alone = corefinement(a.corefinement and a.corefinement.resolve(), a.runs)
    print("| script | ombre | OpenSCAD | times as fast | corefinement alone | times as long |\n| --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as scratch:
        for script in sorted(SCRIPTS.glob("*.scad")):
            output = str(pathlib.Path(scratch) / "out.stl")
            ours = least([str(a.ombre.resolve()), "scad", "-q", str(script), "-o", output], a.runs)
            theirs = least([openscad, "-o", output, str(script)], 1) if openscad else None
            print(row(script.stem, ours, theirs, alone.get(script.stem)), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Runs the benchmark suite at a tiny size: all rows are there, the published method counts the same voxels
where nothing is left to chance, scaling is reported, and no folder stays. Times are not judged.

    python3 tests/run_bench.py build/bench
"""
import argparse
import json
import pathlib
import signal
import subprocess
import sys
import tempfile

import processes
import program
from program import expect

sys.path.insert(0, str(program.SOURCE / "bench"))
import jobs  # noqa: E402

SUITE = program.SOURCE / "bench" / "run.py"


def command(build, scratch, *arguments):
    return [sys.executable, "-B", SUITE, build, "--size", "tiny", "--runs", "1", "--scratch", scratch, *arguments]


def whole_suite(build, folder):
    scratch, figures = folder / "scratch", folder / "figures.json"
    scratch.mkdir()
    result = program.run(command(build, scratch, "--json", figures))
    expect(result.returncode == 0, f"status {result.returncode}: {result.stderr}")
    expect(not list(scratch.iterdir()), f"it left {list(scratch.iterdir())}")
    return result.stdout, json.loads(figures.read_text())


def rows_are_there(printed, figures):
    names = [job.name for job in jobs.all_jobs("", "tiny")]
    expect([row["job"] for row in figures["rows"]] == names, f"rows {[row['job'] for row in figures['rows']]}")
    for name in names:
        expect(f"\n{name} " in printed, f"the table has no row {name}")
    for row in figures["rows"]:
        expect([o["threads"] for o in row["ours"]] == [1, 2], f"{row['job']}: threads")
    expect(len(figures["growth"]) == 6, f"{len(figures['growth'])} growth laws")


def close(a, b):
    """Up to a few voxels whose centres lie on the surface but for rounding."""
    return abs(a - b) <= max(2, 1e-4 * max(a, b))


def counts_agree(figures):
    compared = 0
    for row in figures["rows"]:
        if "baseline" not in row or row["counts"] == "none":
            continue
        done, baseline = row["ours"][0]["done"], row["baseline"]
        expect(not baseline["extrapolated"], f"{row['job']}: the baseline did not work on all of it")
        found = {"inside": (done["voxels_inside"], baseline["inside"])}
        if row["counts"] == "materials":
            found.update({m["name"]: (m["voxels"], baseline["materials"].get(m["name"], 0)) for m in done["materials"]})
        for what, (ours, theirs) in found.items():
            expect(close(ours, theirs), f"{row['job']}, {what}: {ours} voxels, the baseline has {theirs}")
        compared += 1
    return compared


def suite_is_whole(build):
    with tempfile.TemporaryDirectory() as folder:
        printed, figures = whole_suite(build, pathlib.Path(folder))
    rows_are_there(printed, figures)
    if (build / "bench/baseline/bench_baseline").exists():
        expect(counts_agree(figures) == 6, "not all of sphere, cube, F-rep, grade, actuator and mug were compared")


def scaling_takes_turns(build):
    with tempfile.TemporaryDirectory() as folder:
        scratch, figures = pathlib.Path(folder, "scratch"), pathlib.Path(folder, "figures.json")
        scratch.mkdir()
        result = program.run(command(build, scratch, "--scaling", "--only", "^cube", "--runs", "2", "--json", figures))
        expect(result.returncode == 0, f"status {result.returncode}: {result.stderr}")
        expect(not list(scratch.iterdir()), f"it left {list(scratch.iterdir())}")
        (row,) = json.loads(figures.read_text())["scaling"]
    expect(row["job"] == "cube" and len(row["turns"]) == 2, f"{row}")
    for turn in row["turns"]:
        expect(turn["copies"] > 0, f"{turn}")
        expect(abs(turn["gain"] * turn["threads"] - turn["one"]) < 1e-9, f"{turn}")


def simulations_are_whole(build):
    with tempfile.TemporaryDirectory() as folder:
        scratch, figures = pathlib.Path(folder, "scratch"), pathlib.Path(folder, "figures.json")
        scratch.mkdir()
        result = program.run(command(build, scratch, "--simulation", "--json", figures))
        expect(result.returncode == 0, f"status {result.returncode}: {result.stderr}")
        expect(not list(scratch.iterdir()), f"it left {list(scratch.iterdir())}")
        found = json.loads(figures.read_text())["simulations"]
    expect([row["physics"] for row in found["solving"]] == ["elasticity", "heat"], f"{found['solving']}")
    for row in found["solving"]:
        expect(row["bricks"] == 12 ** 3 and row["iterations"] > 0, f"{row}")
    for row in found.get("asking", []):
        expect(row["greatest_error"] < 1e-9 and row["at_random"] > 0, f"{row}")
    ball = [row for row in found["tetrahedra"] if row["solid"] == "ball"]
    for row in ball:
        expect(abs(row["volume_mm3"] / 3053.6 - 1) < 0.05, f"{row}")


def interrupts_leave_nothing(build):
    with tempfile.TemporaryDirectory() as scratch:
        process = subprocess.Popen([str(c) for c in command(build, scratch, "--runs", "1000")], text=True,
                                   env=program.environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        processes.wait_until(lambda: process.poll() is not None or list(pathlib.Path(scratch).iterdir()), "it has a folder")
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=program.PATIENCE_S)
        expect(process.returncode == 130, f"status {process.returncode}: {errors}")
        expect(not list(pathlib.Path(scratch).iterdir()), "folders stayed")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="the build folder")
    build = parser.parse_args().build.resolve()
    checks = [suite_is_whole, scaling_takes_turns, simulations_are_whole, interrupts_leave_nothing]
    return program.check_all([(check.__name__, lambda check=check: check(build)) for check in checks], threads=1)


if __name__ == "__main__":
    raise SystemExit(main())

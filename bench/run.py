#!/usr/bin/env python3
"""Whole jobs, design to files, as a user meets them: one table, beside the published method.

    ./dev bench                         the table at a size that takes minutes
    ./dev bench --size paper            the papers' voxels; "~" marks what a part was measured of
    ./dev bench --only 'sphere|grade'   some rows
    ./dev bench --against main          this build and another commit's, in turns
    ./dev bench --scaling               what threads gain, beside copies of the program that share nothing
    ./dev bench --simulation            solving, asking results, tetrahedra; --large: also 10^7 bricks

bench/README.md explains rows and columns, docs/developer/performance.md what limits them. Nothing is asserted: figures
are for this machine, now.
"""
import argparse
import json
import math
import os
import pathlib
import re
import sys

import against
import growth
import jobs
import measure
import meshes
import programs
import scaling
import simulations
import surfaces
from table import Table, rate, seconds


class Programs:
    """The programs of a build folder."""

    def __init__(self, build):
        self.ombre = programs.Ombre(build / "apps/ombre/ombre")
        self.baseline = self._optional(build / "bench/baseline/bench_baseline")
        self.probe = self._optional(build / "bench/bench_probe")
        self.volume_to_mesh = self._optional(build / "bench/bench_volume_to_mesh")
        self.results = self._optional(build / "bench/bench_results")
        self.tetrahedra = self._optional(build / "bench/bench_tetrahedra")

    @staticmethod
    def _optional(path):
        return path if path.exists() else None


def probe(program):
    """Prints whether the machine is fit to judge scaling at the moment."""
    if program is None:
        return None
    told = json.loads(programs.run([program]).output)
    gains = [two / one for one, two in told.values()]
    verdict = "fit" if gains[0] >= 1.8 else "NOT fit"
    print(f"probe: hash and compare {told['picks'][0]:.2f} G/s on one thread, x {gains[0]:.2f} on two; "
          f"memory fill {told['fills'][0]:.0f} GB/s, x {gains[1]:.2f}: {verdict} to judge scaling", flush=True)
    return told


def job_table(threads):
    columns = [("job", 14), ("M voxels", 9)]
    columns += [(f"{n} thread{'s' if n > 1 else ''}\ns", 10) for n in threads]
    columns += [("gain", 5), ("M voxels/s\na core", 11), ("peak\nMB", 6), ("files\nMB", 8),
                ("published method, 1 thread\nevaluate + write s", 27), ("ratio", 7),
                ("paper, 16 threads\nits voxels, s", 18)]
    return Table(*columns)


def show(table, row):
    first, last = row["ours"][0], row["ours"][-1]
    voxels = math.prod(row["voxels"])
    cells = [row["job"], f"{voxels / 1e6:,.1f}", *[seconds(o["seconds"], o["extrapolated"]) for o in row["ours"]],
             f"{first['seconds'] / last['seconds']:.2f}", rate(voxels / first["seconds"] / first["threads"] / 1e6),
             megabytes(last["peak_bytes"]), f"{last['bytes'] / 1e6:,.1f}"]
    cells += _beside(row.get("baseline"))
    cells += [f"{row['ratio']:.1f}" if "ratio" in row else "-"]
    cells += [f"{row['paper'][0]} + {row['paper'][1]}" if row["paper"] else "-"]
    table.row(*cells)


def megabytes(peak):
    return ("<" if peak <= programs.least_peak() else "") + f"{peak / 1e6:,.0f}"


def _beside(baseline):
    if baseline is None:
        return ["-"]
    prepared = f" (after {seconds(baseline['build_seconds'])})" if baseline["build_seconds"] > 0.5 else ""
    return [f"{seconds(baseline['evaluate_seconds'], baseline['extrapolated'])} + "
            f"{seconds(baseline['write_seconds'], baseline['extrapolated'])}{prepared}"]


def show_laws(programs_of, a, rows, limits, scratch):
    print()
    table = Table(("growth law", 44), ("exponent", 9), ("wanted", 46))
    results = []
    for law in growth.laws(programs_of, a.size, rows, limits, scratch):
        table.row(law.name, f"{law.exponent():.2f}", law.wanted)
        print(f"    {law.of}: " + ", ".join(f"{x:,}: {y:.3g}" for x, y in law.points), flush=True)
        results.append({"name": law.name, "of": law.of, "points": law.points, "exponent": law.exponent()})
    return results


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="the build folder (./dev bench names it)")
    parser.add_argument("--size", choices=jobs.SIZES, default="quick", help="voxels of each row (default quick)")
    parser.add_argument("--only", metavar="PATTERN",
                        help="rows whose names hold this regular expression, without growth laws")
    parser.add_argument("--runs", type=int, help="runs of each row at most (default 3; 5 with --against and --scaling)")
    parser.add_argument("--threads", default="1,2", help="counts of threads, the first for the ratio (default 1,2)")
    parser.add_argument("--full", action="store_true", help="also 100,000 and 1,000,000 struts")
    parser.add_argument("--seconds", type=float, metavar="S",
                        help="a run longer than this is measured in parts (default 15; 60 with --size paper)")
    parser.add_argument("--no-baseline", action="store_true", help="leave out the published method")
    parser.add_argument("--no-growth", action="store_true", help="leave out the growth laws")
    parser.add_argument("--against", metavar="COMMIT", help="compare with another commit instead")
    parser.add_argument("--scaling", action="store_true",
                        help="time one thread, the most of --threads, and as many copies of the program instead")
    parser.add_argument("--simulation", action="store_true",
                        help="solve, ask results and make tetrahedra instead, with the most of --threads")
    parser.add_argument("--large", action="store_true", help="with --simulation: also 10^7 bricks, minutes and 5 GB")
    parser.add_argument("--scratch", metavar="DIR", default=programs.memory_disk(),
                        help="where jobs are written and removed (default: /dev/shm if there is room, so that no disk is timed)")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="also write all figures there")
    a = parser.parse_args()
    a.threads = [int(n) for n in a.threads.split(",")]
    a.seconds = a.seconds or (60 if a.size == "paper" else 15)
    return a


def measure_all(a, programs_of, chosen, scratch):
    # The test of the suite compares counts, so the published method has to reach the end of tiny rows.
    limits = measure.Limits(a.runs or 3, a.seconds, 20 if a.size == "tiny" else 2)
    results = {"size": a.size, "probe_before": probe(programs_of.probe), "rows": []}
    print(f"{a.size} size, {os.cpu_count()} cores; ~ marks what is extrapolated from a part\n")
    table = job_table(a.threads)
    for job in chosen:
        try:
            results["rows"].append(measure.row(programs_of, job, a.size, a.threads, limits, scratch))
            show(table, results["rows"][-1])
        except programs.Failed as problem:
            results.setdefault("failed", []).append(job.name)
            print(f"{job.name} FAILED: {problem}", flush=True)
    if not a.only and not a.no_growth:
        results["growth"] = show_laws(programs_of, a, results["rows"], limits, scratch)
    if not a.only:
        results["meshes"] = surfaces.measure(programs_of.ombre, programs_of.volume_to_mesh, a.size, scratch)
    print()
    results["probe_after"] = probe(programs_of.probe)
    return results


def measure_scaling(a, programs_of, chosen, scratch):
    results = {"size": a.size, "probe_before": probe(programs_of.probe)}
    results["scaling"] = scaling.compare(programs_of.ombre, chosen, a.size, max(a.threads), a.runs or 5, scratch)
    results["probe_after"] = probe(programs_of.probe)
    return results


def measure_simulations(a, programs_of, scratch):
    results = {"size": a.size, "probe_before": probe(programs_of.probe)}
    results["simulations"] = simulations.measure(programs_of, a.size, max(a.threads), a.large, scratch)
    results["probe_after"] = probe(programs_of.probe)
    return results


def main():
    a = arguments()
    programs.stop_on_signals()
    programs_of = Programs(a.build.resolve())
    if a.no_baseline:
        programs_of.baseline = None
    data = programs.ROOT / "build" / "bench-data"
    meshes.make(data)
    chosen = [job for job in jobs.all_jobs(data, a.size, a.full) if not a.only or re.search(a.only, job.name)]
    if not chosen:
        raise programs.Failed(f"no row is named like {a.only}")
    with programs.scratch_folder(a.scratch) as scratch:
        if a.against:
            rows = against.compare(a.against, programs_of.ombre, chosen, a.size, a.threads[0], a.runs or 5, scratch)
            results = {"against": rows}
        elif a.scaling:
            results = measure_scaling(a, programs_of, chosen, scratch)
        elif a.simulation:
            results = measure_simulations(a, programs_of, scratch)
        else:
            results = measure_all(a, programs_of, chosen, scratch)
    if a.json:
        a.json.write_text(json.dumps(results, indent=1))
    return 1 if results.get("failed") else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
    except programs.Failed as problem:
        sys.exit(f"bench: {problem}")

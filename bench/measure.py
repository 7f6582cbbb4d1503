"""Measures one job: ours on some counts of threads, and the published method beside it."""
import json
import math
import statistics

import programs

SLABS = 5  # parts of a job that is too long to run whole


class Limits:
    """How often, and how long a run may take."""

    def __init__(self, runs, run_seconds, baseline_seconds):
        self.runs, self.run_seconds, self.baseline_seconds = runs, run_seconds, baseline_seconds


def _slabs(layers, share):
    """Ranges of layers, spread over the height, that are together that share of all."""
    thick = max(1, min(layers // SLABS, round(layers * share / SLABS)))
    for n in range(SLABS):
        first = round((n + 0.5) * layers / SLABS - thick / 2)
        yield first, first + thick


def _whole(ombre, design, arguments, scratch):
    finished, events = ombre.slice(design, arguments, scratch)
    done = events["done"]
    return {"seconds": finished.seconds, "cpu_seconds": finished.cpu_seconds, "peak_bytes": finished.peak_bytes,
            "bytes": done["bytes_written"], "extrapolated": False, "done": done}


def _parts(ombre, design, arguments, layers, share, scratch):
    """A few slabs for the whole: what a run takes besides slicing counts once."""
    besides, slicing, written, peak, done = [], 0.0, 0, 0, 0
    for first, last in _slabs(layers, share):
        finished, events = ombre.slice(design, [*arguments, "--layers", f"{first}:{last}"], scratch)
        slicing += events["done"]["seconds"]
        besides.append(finished.seconds - events["done"]["seconds"])
        written += events["done"]["bytes_written"]
        peak = max(peak, finished.peak_bytes)
        done += last - first
    return {"seconds": slicing * layers / done + statistics.median(besides), "peak_bytes": peak,
            "bytes": round(written * layers / done), "extrapolated": True}


def ours(ombre, design, job, grid, threads, limits, scratch, further=()):
    """Several runs on so many threads, or one of a part where all of it would take too long."""
    arguments = ["--voxel", job.pitch(grid), "--threads", threads, *further]
    if math.prod(grid) > 1e7:
        estimate = ombre.estimate(design, arguments)
        share = limits.run_seconds / max(estimate["seconds"], 1e-3)
        if share < 1:
            return _summary(threads, [_parts(ombre, design, arguments, grid[2], share, scratch)])
        programs.need_room(scratch, estimate["bytes"])
    runs = []
    while len(runs) < limits.runs and sum(run["seconds"] for run in runs) < limits.run_seconds / 2:
        runs.append(_whole(ombre, design, arguments, scratch))
    return _summary(threads, runs)


def _summary(threads, runs):
    seconds = [run["seconds"] for run in runs]
    return {**runs[-1], "threads": threads, "runs": seconds, "seconds": statistics.median(seconds),
            "peak_bytes": max(run["peak_bytes"] for run in runs)}


def baseline(program, ombre, design, grid, limits, scratch):
    """The published method, on one thread; a part stands for the whole where `extrapolated` says so."""
    design_file = scratch / "design.json"
    design_file.write_text(ombre.design_file(design))
    finished = programs.run([program, design_file, *grid, limits.baseline_seconds, scratch])
    told = json.loads(finished.output)
    scale = told["voxels"] / told["measured_voxels"]
    return {"evaluate_seconds": told["evaluate_seconds"] * scale, "write_seconds": told["write_seconds"] * scale,
            "build_seconds": told["build_seconds"], "bytes": round(told["bytes"] * scale),
            "peak_bytes": finished.peak_bytes, "extrapolated": scale > 1, "inside": told["inside"],
            "materials": told["materials"]}


def row(programs_of, job, size, threads, limits, scratch):
    design = scratch / "design.vcad"
    job.write(design)
    grid = job.grid(size)
    result = {"job": job.name, "voxels": grid, "paper": job.paper, "counts": job.counts,
              "ours": [ours(programs_of.ombre, design, job, grid, n, limits, scratch) for n in threads]}
    if programs_of.baseline and job.published:
        result["baseline"] = baseline(programs_of.baseline, programs_of.ombre, design, grid, limits, scratch)
        total = result["baseline"]["evaluate_seconds"] + result["baseline"]["write_seconds"]
        result["ratio"] = total / result["ours"][0]["seconds"]
    return result

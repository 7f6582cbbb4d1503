"""Measures the gain of further threads, beside as many copies of the program with one thread each. Copies share nothing
but the machine, so their gain is the greatest possible. Everything runs in turns.
"""
import concurrent.futures
import statistics
import time

import programs
from table import Table, seconds


def _copies(ombre, design, arguments, count, scratch):
    """Seconds until the last of them ends."""
    folders = [scratch / f"copy{n}" for n in range(count)]
    for folder in folders:
        folder.mkdir(exist_ok=True)
    began = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(count) as pool:
        list(pool.map(lambda folder: ombre.slice(design, arguments, folder), folders))
    return time.monotonic() - began


def _turn(ombre, design, pitch, threads, scratch):
    one = ["--voxel", pitch, "--threads", 1]
    alone, _ = ombre.slice(design, one, scratch)
    together, _ = ombre.slice(design, ["--voxel", pitch, "--threads", threads], scratch)
    copies = _copies(ombre, design, one, threads, scratch)
    return {"one": alone.seconds, "threads": together.seconds, "copies": copies,
            "gain": alone.seconds / together.seconds, "gain_of_copies": threads * alone.seconds / copies}


def compare(ombre, jobs, size, threads, turns, scratch):
    """One row for each job: medians over the turns, and the range of the gains."""
    print(f"{threads} threads, and {threads} copies of the program with one thread each; "
          f"{turns} turns, after one that is not counted\n")
    table = Table(("job", 14), ("1 thread s", 10), (f"{threads} threads s", 11), ("gain", 5), ("from to", 12),
                  ("copies' gain", 12), ("from to", 12))
    results = []
    for job in jobs:
        design = scratch / "design.vcad"
        job.write(design)
        pitch = job.pitch(job.grid(size))
        taken = [_turn(ombre, design, pitch, threads, scratch) for _ in range(turns + 1)][1:]
        middle = {key: statistics.median(turn[key] for turn in taken) for key in taken[0]}
        table.row(job.name, seconds(middle["one"]), seconds(middle["threads"]), f"{middle['gain']:.2f}",
                  _range(taken, "gain"), f"{middle['gain_of_copies']:.2f}", _range(taken, "gain_of_copies"))
        results.append({"job": job.name, "turns": taken})
    return results


def _range(taken, key):
    values = [turn[key] for turn in taken]
    return f"{min(values):.2f} {max(values):.2f}"

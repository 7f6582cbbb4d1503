#!/usr/bin/env python3
"""The simulation of many machines: the same seed gives the same table, and simple cases have the times that one can
calculate.

    python3 tests/run_scale.py
"""
import dataclasses
import math
import sys

import program
from program import expect, near

sys.path.insert(0, str(program.SOURCE / "bench"))
import scale  # noqa: E402

COSTS = scale.Costs(seconds_per_voxel=1e-7, bytes_per_voxel=0.1, memory_per_pixel=10)
IDEAL = {"start_s": 0, "slow_share": 0, "spread": 0, "core_hours_between_failures": math.inf}


def a_seed_decides_the_outcome():
    def outcome(seed):
        return scale.simulate(1e12, scale.Cluster(1000), COSTS, seed)
    expect(outcome(3) == outcome(3), "the same seed gives another outcome")
    expect(outcome(3) != outcome(4), "all seeds give one outcome")


def one_process_works_all_the_time():
    """10^9 voxels of 1e-7 s are 100 s of one core."""
    outcome = scale.simulate(1e9, scale.Cluster(1, **IDEAL), COSTS)
    near(outcome.ideal_s, 100, 1e-9, "the work of one core")
    near(outcome.shares_s, 100, 1e-9, "the time of one process")
    expect(outcome.failures == 0 and outcome.failures_s == 0, f"{outcome}")
    near(outcome.join_s, 1e9 * 0.1 / 1e9 + 1000 / 2000, 1e-9, "the time of the join")


def layers_are_not_divided():
    """1,000 layers for 6,250 processes: only 1,000 of them have work, each one layer."""
    cluster = scale.Cluster(100_000, **(IDEAL | {"starts_per_s": math.inf}))
    outcome = scale.simulate(1e9, cluster, COSTS)
    expect(outcome.shares == 1000, f"{outcome}")
    near(outcome.shares_s, 100 / 1000 / 16, 1e-9, "the time of one layer")
    for layers, shares in ((1000, 7), (5, 5), (80, 3)):
        expect(sum(scale.split(layers, shares)) == layers, f"{layers} layers are not split into {shares}")


def failures_come_at_their_rate():
    """10^15 voxels are 27,778 core hours: at one failure in 100 of them some 278, give or take 17."""
    often = scale.Cluster(10_000, **(IDEAL | {"core_hours_between_failures": 100}))
    never = dataclasses.replace(often, core_hours_between_failures=math.inf)
    outcome = scale.simulate(1e15, often, COSTS)
    near(outcome.failures, 1e15 * 1e-7 / 3600 / 100, 5 * 17, "the number of failures")
    expect(outcome.failures_s > 0, f"{outcome}")
    expect(scale.simulate(1e15, never, COSTS).failures == 0, "machines that never fail do")


def the_page_has_the_table():
    page = (program.SOURCE / "docs/user/cluster.md").read_text(encoding="utf-8")
    rows = scale.table(scale.simulate(voxels, scale.Cluster(cores), scale.kept()) for voxels in scale.VOXELS
                       for cores in scale.CORES)
    expect(rows in page, f"docs/user/cluster.md lacks the table of python3 bench/scale.py:\n{rows}")


if __name__ == "__main__":
    sys.exit(program.check_all([(check.__name__, check) for check in (
        a_seed_decides_the_outcome, one_process_works_all_the_time, layers_are_not_divided, failures_come_at_their_rate,
        the_page_has_the_table)]))

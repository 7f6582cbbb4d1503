#!/usr/bin/env python3
"""Simulates slice jobs that many machines share, with costs that a dry run measures, and says what limits them first.

    python3 bench/scale.py --ombre build/release/apps/ombre/ombre     measure, and print the table
    python3 bench/scale.py                                            the table with the measurement that is kept

The job is a cube in which two materials are mixed everywhere, so that each voxel is evaluated and dithered. Shares take
whole layers, as `ombre plan` gives them. The machines, their failures and their file system are assumed: see Cluster.
"""
import argparse
import dataclasses
import datetime
import heapq
import json
import math
import pathlib
import platform
import random
import subprocess
import tempfile

KEPT = pathlib.Path(__file__).parent / "results" / "scale.jsonl"
DESIGN = 'fgrade(["(x + 10) / 20", "(10 - x) / 20"], [red, blue]) cube(20);\n'
EDGE_MM = 20
MEASURED_EDGE = 1000  # voxels along each edge of the cube of the dry run
VOXELS = (1e12, 1e15)
CORES = (10, 1000, 100_000)
MOST_SHARES = 1_000_000  # ombre plan makes no more


@dataclasses.dataclass
class Costs:
    """What one core and one process need."""
    seconds_per_voxel: float  # evaluation and encoding
    bytes_per_voxel: float    # of the files
    memory_per_pixel: float   # bytes of a process for each voxel of a layer


@dataclasses.dataclass
class Cluster:
    cores: int
    cores_per_process: int = 16
    start_s: float = 3                         # of a process, which loads the design
    starts_per_s: float = 50                   # of the scheduler
    core_hours_between_failures: float = 1e4   # far more than usual; then a share goes on with the layer that was lost
    restart_s: float = 60
    slow_share: float = 0.01                   # of the processes run at half speed
    spread: float = 0.05                       # of the time of a share
    files_per_s: float = 2000                  # of the file system; a layer is written aside, renamed and noted
    bytes_per_s: float = 1e10
    read_bytes_per_s: float = 1e9              # of the one process that checks hashes and joins
    memory_per_core: float = 4e9

    @property
    def processes(self):
        return max(1, self.cores // self.cores_per_process)

    @property
    def process_cores(self):
        return min(self.cores, self.cores_per_process)


@dataclasses.dataclass
class Outcome:
    voxels: float
    cores: int
    shares: int
    ideal_s: float   # all cores at work all the time
    shares_s: float  # until the last share is done, with no failures
    failures_s: float  # what failures add
    files_s: float     # what the file system adds
    join_s: float
    memory: float      # of a process, as a share of what there is
    failures: int

    @property
    def total_s(self):
        return self.shares_s + self.failures_s + self.files_s + self.join_s

    def limits(self):
        """What limits the job: memory, without which it does not begin, and what adds the most time."""
        short = [f"memory: a process needs {self.memory:.1f} times what it has"] if self.memory > 1 else []
        lost = {"idle cores at the end": self.shares_s - self.ideal_s, "failures": self.failures_s,
                "the file system": self.files_s, "the join": self.join_s}
        worst = max(lost, key=lost.get)
        return short + [worst] if lost[worst] > 0.05 * self.ideal_s else short


def split(layers, shares):
    """The numbers of layers of the shares."""
    return [layers * (n + 1) // shares - layers * n // shares for n in range(shares)]


def share_count(layers, work_s, cluster):
    """Shares of about 20 minutes, eight for each process where there are layers enough."""
    by_time = work_s / cluster.process_cores / (20 * 60)
    return int(max(1, min(layers, MOST_SHARES, max(8 * cluster.processes, by_time))))


def failures_in(seconds, cluster, chance):
    """A random number of failures of a process in this time (Poisson)."""
    mean = seconds * cluster.process_cores / 3600 / cluster.core_hours_between_failures
    if mean > 30:
        return max(0, round(chance.gauss(mean, math.sqrt(mean))))
    count, product, least = 0, chance.random(), math.exp(-mean)
    while product > least:
        count, product = count + 1, product * chance.random()
    return count


def run_shares(layers, layer_s, shares, cluster, seed, fails):
    """(seconds until the last share is done, failures): each process takes the next share when it is free."""
    chance = random.Random(seed)
    speeds = [0.5 if chance.random() < cluster.slow_share else 1 for _ in range(cluster.processes)]
    free = [(0.0, n) for n in range(cluster.processes)]  # a heap
    next_start, end, failures = 0.0, 0.0, 0
    for count in split(layers, shares):
        at, process = heapq.heappop(free)
        at = max(at, next_start)
        next_start = at + 1 / cluster.starts_per_s if cluster.processes > 1 else at
        own = layer_s / cluster.process_cores / speeds[process]
        seconds = cluster.start_s + count * own * math.exp(chance.gauss(0, cluster.spread))
        if fails:
            lost = failures_in(seconds, cluster, chance)
            failures += lost
            seconds += sum(cluster.restart_s + chance.random() * own for _ in range(lost))
        end = max(end, at + seconds)
        heapq.heappush(free, (at + seconds, process))
    return end, failures


def simulate(voxels, cluster, costs, seed=1):
    edge = round(voxels ** (1 / 3))
    pixels, work_s = edge * edge, voxels * costs.seconds_per_voxel
    shares = share_count(edge, work_s, cluster)
    layer_s = work_s / edge
    quiet_s, _ = run_shares(edge, layer_s, shares, cluster, seed, fails=False)
    real_s, failures = run_shares(edge, layer_s, shares, cluster, seed, fails=True)
    bytes_ = voxels * costs.bytes_per_voxel
    files_s = max(bytes_ / cluster.bytes_per_s, 3 * edge / cluster.files_per_s)
    return Outcome(voxels, cluster.cores, shares, work_s / cluster.cores, quiet_s, max(0.0, real_s - quiet_s),
                   max(0.0, files_s - real_s), bytes_ / cluster.read_bytes_per_s + edge / cluster.files_per_s,
                   pixels * costs.memory_per_pixel / (cluster.process_cores * cluster.memory_per_core), failures)


def measure(ombre):
    """The costs of one thread, by a dry run."""
    with tempfile.TemporaryDirectory() as scratch:
        design = pathlib.Path(scratch) / "mixed.vcad"
        design.write_text(DESIGN)
        command = [ombre, "slice", design, "--voxel", EDGE_MM / MEASURED_EDGE, "--threads", 1, "--dry-run", "--json"]
        said = subprocess.run([str(part) for part in command], cwd=scratch, check=True, stdout=subprocess.PIPE, text=True)
    estimate = next(event for event in map(json.loads, said.stdout.splitlines()) if event["event"] == "estimate")
    voxels, pixels = MEASURED_EDGE ** 3, MEASURED_EDGE ** 2
    return Costs(estimate["seconds"] / voxels, estimate["bytes"] / voxels, estimate["memory_bytes"] / pixels)


def keep(costs):
    """Adds a record to the measurements, as bench/results/README.md describes them."""
    commit = subprocess.run(["git", "rev-parse", "--short=8", "HEAD"], cwd=KEPT.parent, stdout=subprocess.PIPE, text=True)
    record = {"date": datetime.date.today().isoformat(), "commit": commit.stdout.strip(), "machine": platform.machine(),
              "what": "bench/scale.py: dry run on one thread", "numbers": dataclasses.asdict(costs)}
    with KEPT.open("a") as file:
        file.write(json.dumps(record) + "\n")


def kept():
    return Costs(**json.loads(KEPT.read_text().splitlines()[-1])["numbers"])


def time_text(seconds):
    for unit, size in (("years", 365 * 86400), ("days", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 2 * size:
            return f"{seconds / size:,.0f} {unit}"
    return f"{seconds:.0f} s"


def table(outcomes):
    rows = ["| voxels | cores | shares | all cores at work | until joined | failures | what limits it first |",
            "| --- | --- | --- | --- | --- | --- | --- |"]
    for one in outcomes:
        rows.append(f"| 10^{round(math.log10(one.voxels))} | {one.cores:,} | {one.shares:,} | {time_text(one.ideal_s)} | "
                    f"{time_text(one.total_s)} | {one.failures:,} | {', then '.join(one.limits()) or 'nothing'} |")
    return "\n".join(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ombre", type=pathlib.Path, help="measure with this program, and keep it")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    if args.ombre:
        keep(measure(args.ombre.resolve()))
    costs = kept()
    print(f"{costs.seconds_per_voxel * 1e9:.0f} ns and {costs.bytes_per_voxel:.2f} bytes a voxel, "
          f"{costs.memory_per_pixel:.0f} bytes of memory for each voxel of a layer\n")
    print(table(simulate(voxels, Cluster(cores), costs, args.seed) for voxels in VOXELS for cores in CORES))


if __name__ == "__main__":
    main()

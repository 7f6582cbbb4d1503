#!/usr/bin/env python3
"""Measures the efficiency of two processes of MPI that share a job, beside two jobs of one process each, which share
nothing but the machine.

    python3 bench/ranks.py build/release/apps/ombre/ombre [--turns 3] [--edge 1400]
"""
import argparse
import os
import pathlib
import shutil
import statistics
import subprocess
import tempfile
import time

DESIGN = 'fgrade(["(x + 10) / 20", "(10 - x) / 20"], [red, blue]) cube(20);\n'
SHARES = 32
ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def plan(ombre, folder, edge):
    """A plan whose processes have one thread each."""
    folder.mkdir()
    (folder / "mixed.vcad").write_text(DESIGN)
    job = ["slice", "mixed.vcad", "--voxel", str(20 / edge), "--threads", "1", "-o", "out", "--save-job", "job.json"]
    for arguments in (job, ["plan", "job.json", "--shards", str(SHARES)]):
        subprocess.run([ombre, *arguments], cwd=folder, check=True, stderr=subprocess.DEVNULL)


def begin(ombre, folder, processes):
    shutil.rmtree(folder / "out", ignore_errors=True)
    return subprocess.Popen(["mpirun", "-n", str(processes), "--bind-to", "none", ombre, "run", "plan.json", "--quiet"],
                            cwd=folder, env=dict(os.environ, **ROOT), stdin=subprocess.DEVNULL)


def seconds(ombre, folders, processes):
    """Until the jobs in all folders are done."""
    began = time.monotonic()
    for process in [begin(ombre, folder, processes) for folder in folders]:
        if process.wait():
            raise SystemExit("mpirun failed")
    return time.monotonic() - began


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ombre", type=pathlib.Path)
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--edge", type=int, default=1400, help="voxels along each edge of the cube")
    args = parser.parse_args()
    ombre = str(args.ombre.resolve())
    with tempfile.TemporaryDirectory() as scratch:
        folders = [pathlib.Path(scratch) / name for name in ("one", "other")]
        for folder in folders:
            plan(ombre, folder, args.edge)
        turns = [(seconds(ombre, folders[:1], 1), seconds(ombre, folders[:1], 2), seconds(ombre, folders, 1))
                 for _ in range(args.turns + 1)][1:]  # the first one warms the disk
    alone, together, copies = (statistics.median(times) for times in zip(*turns))
    print(f"one process {alone:.2f} s, two processes {together:.2f} s, two jobs at once {copies:.2f} s")
    print(f"efficiency of two processes {alone / (2 * together):.3f}; of two jobs {alone / copies:.3f}; "
          f"beside these {copies / (2 * together):.3f}")


if __name__ == "__main__":
    main()

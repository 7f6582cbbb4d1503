#!/usr/bin/env python3
"""Jobs as processes: Ctrl-C is answered at once, and --threads 1 means one thread, at any moment of any job.

    python3 tests/run_processes.py build/dev/apps/ombre/ombre [NAME...]
"""
import json
import os
import signal
import subprocess
import time

import program
from program import expect
from slice_jobs import main

# Very many overhangs, each of which asks for the surface's slope: seconds for what comes before the first layer.
SUPPORTS = """module block() {
  difference() {
    rectprism((60, 60, 60), white);
    for (i = [0:7]) for (j = [0:7]) translate(i*7 - 25, j*7 - 25, 0) sphere(3);
  }
}
block();
support(angle=45) block();
"""
# A surface that fills its box, which all jobs must look at everywhere.
FOAM = """fgrade(["0.5 + x/120", "0.5 - x/120"], ["red", "blue"]) {
  intersection(materials="first") {
    rectprism((60, 60, 60), red);
    function("sin(2*x)*cos(2*y) + sin(2*y)*cos(2*z) + sin(2*z)*cos(2*x) - 0.3*sin(5*x)*sin(5*y)*sin(5*z)");
  }
}
"""
STUDY = {"materials": {name: {"modulus_mpa": 2000, "poissons_ratio": 0.3} for name in ("red", "blue", "white")},
         "supports": [{"on": "zmin", "fix": "xyz"}], "loads": [{"on": "zmax", "force_n": [0, 0, -10]}]}

# Jobs that take half a minute or more on one thread, and the moments at which they are stopped, in seconds.
JOBS = {
    "slice": (FOAM, ["slice", "--voxel", "0.03", "-o", "out"], (0.3, 2)),
    "slice_of_supports": (SUPPORTS, ["slice", "--voxel", "0.02", "-o", "out"], (0.3, 2)),
    "voxels": (FOAM, ["voxels", "--voxel", "0.03", "--what", "distance,fractions", "-o", "out.npy"], (0.3, 2)),
    "voxels_of_supports": (SUPPORTS, ["voxels", "--voxel", "0.02", "-o", "out.vdb"], (0.3, 2)),
    "mesh": (FOAM, ["mesh", "--cell", "0.3", "-o", "out.stl"], (0.3, 2, 5)),
    "render": (FOAM, ["render", "--size", "6000x6000", "-o", "out.png"], (0.3, 2)),
    "render_of_a_slice": (FOAM, ["render", "--size", "16000x16000", "--slice", "z=0", "-o", "out.png"], (0.3, 2)),
    "contours": (FOAM, ["contours", "--cell", "0.02", "--layer-height", "0.02", "-o", "out"], (0.3, 2)),
    "layer": (FOAM, ["layer", "--voxel", "0.001", "--z", "0", "-o", "out.png"], (0.3, 2)),
    "layer_of_supports": (SUPPORTS, ["layer", "--voxel", "0.02", "--z", "0", "-o", "out.png"], (0.3, 2)),
    "fea": (FOAM, ["fea", "--study", "study.json", "--cell", "0.5", "--solve", "-o", "out.vtu"], (0.3, 2, 6)),
}
# A machine under load answers later. On an idle one it takes 0.3 s at most.
MOST_SECONDS = 1.5


def watch(process, seconds):
    """The greatest number of threads that the process has within this time."""
    most, end = 0, time.monotonic() + seconds
    while time.monotonic() < end and process.poll() is None:
        most = max(most, len(os.listdir(f"/proc/{process.pid}/task")))
        time.sleep(0.01)
    return most


def stop(process):
    """Interrupts the process. Returns the seconds that it takes to end."""
    begin = time.monotonic()
    process.send_signal(signal.SIGINT)
    status = process.wait(timeout=60)
    expect(status == 130, f"status {status} after an interrupt, expected 130")
    return time.monotonic() - begin


def check_job(job, name):
    design, words, moments = JOBS[name]
    (job.folder / "part.vcad").write_text(design)
    (job.folder / "study.json").write_text(json.dumps(STUDY))
    for moment in moments:
        with subprocess.Popen([str(job.ombre), words[0], "part.vcad", *words[1:], "--threads", "1", "--force"],
                              cwd=job.folder, env=program.environment(), stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as process:
            threads = watch(process, moment)
            expect(process.poll() is None, f"it has ended within {moment} s: " + process.stderr.read())
            seconds = stop(process)
        if os.environ.get("OMBRE_TELL_TIMES"):
            print(f"{name}, stopped at {moment} s: {threads} threads, {seconds:.3f} s")
        expect(threads == 1, f"{threads} threads with --threads 1")
        expect(seconds < MOST_SECONDS, f"stopped at {moment} s, it took {seconds:.2f} s to end")
        left = [path.name for path in job.folder.iterdir() if path.name not in ("part.vcad", "study.json", "out")]
        expect(not left, f"it left {left}")


CHECKS = {name: lambda job, name=name: check_job(job, name) for name in JOBS}

if __name__ == "__main__":
    raise SystemExit(main("Checks jobs as processes.", CHECKS))

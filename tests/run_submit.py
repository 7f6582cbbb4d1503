#!/usr/bin/env python3
"""The scripts of `ombre submit` make the same bytes as one process, run by Slurm, Dask, GNU parallel and mpirun themselves,
whatever happens to their processes. What is not installed is skipped; Kubernetes is played by a program of this test.

    python3 tests/run_submit.py build/dev/apps/ombre/ombre [NAME...]
"""
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time

import processes
import program
import slurm_cluster
from program import expect
from run_shards import SUPPORTED, begin, contents

PATH = slurm_cluster.PATH  # Debian's python3 comes first, which has Dask


def is_missing(engine):
    return "" if shutil.which(engine, path=PATH) else f"skipped: there is no {engine}"


def submit(folder, *arguments, status=0, variables=(), path=PATH):
    """Submits plan.json."""
    environment = dict(program.environment(), OMBRE=str(folder.ombre), PATH=path, **dict(variables))
    done = subprocess.run(folder.command("submit", "plan.json", *arguments), cwd=folder.path, env=environment,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=program.PATIENCE_S)
    expect(done.returncode == status, f"status {done.returncode}, not {status}: {done.stdout}\n{done.stderr}")
    return done.stdout + done.stderr


def expect_same(folder):
    expect(contents(folder.path / "shared") == contents(folder.path / "alone"), "the shares have other bytes")


def scripts_are_printed(folder):
    begin(folder)
    for engine, words in {
            "slurm": ("--array=1-7", "--cpus-per-task=3", "--mem=900M", "--time=25", "--dependency=afterok:"),
            "kubernetes": ("completions: 7", "completionMode: Indexed", "backoffLimit: 14", '"lab/ombre:1"', '"parts"'),
            "parallel": ("seq 7 | parallel", "--retries 3"), "dask": ("range(1, 7 + 1)", "retries=2")}.items():
        volume = ("--image", "lab/ombre:1", "--claim", "parts") if engine == "kubernetes" else ()
        script = submit(folder, "--to", engine, "--print", "--cores", "3", "--memory", "900", "--minutes", "25", *volume)
        for word in words:
            expect(word in script, f"{engine} has no {word}:\n{script}")
    expect(not list(folder.path.glob("plan.*.sh")), "printing writes a file")


def hostile_names(folder):
    """Names of files and images are never commands."""
    begin(folder)
    name = "it's $(touch made) \"; touch made; `touch made` {shares}.json"
    (folder.path / "plan.json").rename(folder.path / name)
    stand_in = folder.path / "bin"
    stand_in.mkdir()
    for engine in ("sbatch", "kubectl", "parallel"):
        (stand_in / engine).write_text("#!/bin/sh\ncat > /dev/null\necho 1\nexit 1\n")
        (stand_in / engine).chmod(0o755)
    for engine in ("slurm", "kubernetes", "parallel"):
        volume = ("--image", "a$(touch made)", "--claim", "b`touch made`") if engine == "kubernetes" else ()
        subprocess.run(folder.command("submit", name, "--to", engine, *volume), cwd=folder.path, stdin=subprocess.DEVNULL,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                       env=dict(program.environment(), PATH=f"{stand_in}:{PATH}", OMBRE="true"))
        expect(not (folder.path / "made").exists(), f"{engine} ran a name")
    script = subprocess.run(folder.command("submit", name, "--to", "dask", "--print"), cwd=folder.path, check=True,
                            env=program.environment(), stdout=subprocess.PIPE, text=True).stdout
    compile(script, "dask", "exec")
    expect(f"PLAN, FOLDER = {json.dumps(name)}" in script, script)


def wrong_submissions(folder):
    begin(folder)
    said = submit(folder, "--to", "slurm", status=2, path=str(folder.path))
    expect("there is no sbatch here; plan.slurm.sh is the script" in said, said)
    expect((folder.path / "plan.slurm.sh").exists(), "the script is not left")
    expect("plan.slurm.sh exists" in submit(folder, "--to", "slurm", status=2), "the script is replaced")
    said = submit(folder, "--to", "kubernetes", status=1)
    expect("--to kubernetes needs --image IMAGE" in said, said)
    expect("are for --to kubernetes" in submit(folder, "--to", "dask", "--image", "x", status=1), "an image is ignored")
    folder.write("plan.json", {"format": "ombre plan, version 1"})
    expect("needs" in submit(folder, "--to", "dask", status=1), "a plan without shares is taken")


def gnu_parallel(folder):
    if is_missing("parallel"):
        return is_missing("parallel")
    begin(folder, design=SUPPORTED)
    said = submit(folder, "--to", "parallel")
    expect("what all shares need is kept in shared" in said, said)
    expect_same(folder)


def dask(folder):
    python = shutil.which("python3", path=PATH)
    if subprocess.run([python, "-c", "import distributed"], stderr=subprocess.DEVNULL).returncode:
        return "skipped: there is no dask.distributed"
    begin(folder, design=SUPPORTED)
    submit(folder, "--to", "dask")
    expect_same(folder)


# 400 layers, so that there is time to disturb a process.
SLOW = """
fgrade(["(z + 2) / 4", "(2 - z) / 4"], [red, blue]) union() {
  sphere(2);
  translate(3, 0, 0) rectprism([2, 2, 4], red);
}
"""


def mpirun(folder, processes):
    root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return subprocess.Popen(["mpirun", "-n", str(processes), "--oversubscribe", "--bind-to", "none",
                             *folder.command("run", "plan.json", "--quiet")], cwd=folder.path, text=True,
                            env=dict(program.environment(), **root), stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def journals(folder):
    return list((folder.path / "shared").glob("journal-*.jsonl"))


def begin_slow(folder, shards):
    folder.write("part.vcad", SLOW)
    options = ("--voxel", "0.04,0.04,0.01")
    folder.run("slice", "part.vcad", *options, "-o", "alone")
    folder.run("slice", "part.vcad", *options, "-o", "shared", "--save-job", "job.json")
    folder.run("plan", "job.json", "--shards", shards)


def wait_for_journals(folder, count, process):
    for _ in range(6000):
        if len(journals(folder)) >= count or process.poll() is not None:
            return
        time.sleep(0.01)


def mpi(folder):
    if is_missing("mpirun"):
        return is_missing("mpirun")
    begin(folder, 20)
    process = mpirun(folder, 4)
    said = process.communicate(timeout=program.PATIENCE_S)[0]
    expect(process.returncode == 0, said)
    expect(len(journals(folder)) == 20, f"{len(journals(folder))} shares were made")
    folder.run("gather", "plan.json")
    expect_same(folder)


def slow_process_of_mpi(folder):
    """The others take the shares of a process that stands still."""
    if is_missing("mpirun"):
        return is_missing("mpirun")
    if "ombre_mpi_counter" not in {path.stem.removeprefix("lib") for path in folder.ombre.parents[2].glob("modules/*.so")}:
        return "skipped: this ombre was built without MPI"
    begin_slow(folder, 16)
    process = mpirun(folder, 2)
    wait_for_journals(folder, 2, process)
    slow = processes.helpers_of(process.pid)[-1:]
    for rank in slow:
        os.kill(rank, signal.SIGSTOP)
    wait_for_journals(folder, 15, process)  # it may have taken a share without having begun it
    found = len(journals(folder))
    for rank in slow:
        os.kill(rank, signal.SIGCONT)
    said = process.communicate(timeout=program.PATIENCE_S)[0]
    expect(process.returncode == 0, said)
    expect(slow and found >= 15, f"{found} shares were begun beside a process that stood still: {said}")
    folder.run("gather", "plan.json")
    expect_same(folder)


def killed_process_of_mpi(folder):
    """mpirun ends the others; the same command goes on, and what was finished stays."""
    if is_missing("mpirun"):
        return is_missing("mpirun")
    begin_slow(folder, 16)
    process = mpirun(folder, 3)
    wait_for_journals(folder, 3, process)
    for rank in processes.helpers_of(process.pid)[1:2]:
        os.kill(rank, signal.SIGKILL)
    process.communicate(timeout=program.PATIENCE_S)
    expect(process.returncode != 0, "a killed process is not noticed")
    before = {path.name: path.read_bytes() for path in (folder.path / "shared").glob("slice_*.png")}
    process = mpirun(folder, 3)
    said = process.communicate(timeout=program.PATIENCE_S)[0]
    expect(process.returncode == 0, said)
    folder.run("gather", "plan.json")
    expect_same(folder)
    expect(all((folder.path / "shared" / name).read_bytes() == bytes_ for name, bytes_ in before.items()), "layers changed")


KUBECTL = """#!/usr/bin/python3
# Plays a cluster: a job runs at once, each index twice, since pods may be doubled.
import json, os, pathlib, subprocess, sys, yaml
if sys.argv[1] == "get":
    print("Complete")
else:
    job = yaml.safe_load(sys.stdin)
    spec = job["spec"]
    [container] = spec["template"]["spec"]["containers"]
    assert container["image"] == "lab/ombre:1" and container["workingDir"] == "/work"
    assert spec["template"]["spec"]["volumes"][0]["persistentVolumeClaim"]["claimName"] == "parts"
    command = [os.environ["OMBRE"], *container["command"][1:]]
    for index in range(spec.get("completions", 1)) if "completions" in spec else [None]:
        indexed = {} if index is None else {"JOB_COMPLETION_INDEX": str(index)}
        for _ in range(2 if indexed else 1):
            subprocess.run(command, env=dict(os.environ, **indexed), check=True)
    print(f"job.batch/{job['metadata']['name']} created")
"""


def kubernetes(folder):
    if subprocess.run(["/usr/bin/python3", "-c", "import yaml"], stderr=subprocess.DEVNULL).returncode:
        return "skipped: there is no python3-yaml"
    begin(folder, design=SUPPORTED)
    (folder.path / "bin").mkdir()
    kubectl = folder.path / "bin/kubectl"
    kubectl.write_text(KUBECTL)
    kubectl.chmod(0o755)
    submit(folder, "--to", "kubernetes", "--image", "lab/ombre:1", "--claim", "parts", path=f"{kubectl.parent}:{PATH}")
    expect_same(folder)


def in_slurm(folder, shares, disturb):
    """Submits to a Slurm of its own; `disturb` gets it while the shares run."""
    if not slurm_cluster.is_installed():
        return "skipped: there is no Slurm"
    begin(folder, shares, design=SUPPORTED)
    home = folder.path / "slurm"
    home.mkdir()
    with slurm_cluster.Cluster(home) as cluster:
        said = submit(folder, "--to", "slurm", "--cores", "1", "--memory", "1", variables={
            "SLURM_CONF": cluster.environment["SLURM_CONF"]}.items())
        disturb(cluster)
        cluster.wait(lambda: not cluster.run("squeue", "--noheader").strip(), "the end of the jobs")
    logs = "\n".join(path.read_text() for path in sorted(folder.path.glob("ombre-plan*.log")))
    expect((folder.path / "shared").is_dir(), f"{said}\n{logs}")
    expect(not list((folder.path / "shared").glob("journal-*")), f"the shares were not joined:\n{logs}")
    expect_same(folder)


def slurm(folder):
    return in_slurm(folder, 7, lambda cluster: None)


def slurm_with_losses(folder):
    """Shares are put back into the queue at random, and the node is drained in between."""
    seed = random.randrange(1 << 32)
    print(f"shares are lost by the seed {seed}")
    chance = random.Random(seed)

    def disturb(cluster):
        for _ in range(6):
            running = cluster.run("squeue", "--array", "--noheader", "--states=running", "--format=%i").split()
            if running:
                subprocess.run(["scontrol", "requeue", chance.choice(running)], env=cluster.environment,
                               stderr=subprocess.DEVNULL)
        cluster.run("scontrol", "update", f"nodename={cluster.node}", "state=drain", "reason=test")
        cluster.wait(lambda: cluster.state() == "drained", "a drained node")
        cluster.run("scontrol", "update", f"nodename={cluster.node}", "state=resume")
    return in_slurm(folder, 20, disturb)


CHECKS = program.named([scripts_are_printed, hostile_names, wrong_submissions, gnu_parallel, dask, mpi,
                        slow_process_of_mpi, killed_process_of_mpi, kubernetes, slurm,
                        slurm_with_losses])

if __name__ == "__main__":
    sys.exit(program.main(program.Folder, CHECKS))

"""A Slurm of one node, which belongs to a test: its controller, its node and munge, with all files in one folder."""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

import program

PATH = "/usr/bin:/usr/sbin:/bin:/sbin"
PROGRAMS = ("mungekey", "munged", "slurmctld", "slurmd", "sbatch")


def is_installed():
    return all(shutil.which(program, path=PATH) for program in PROGRAMS)


def free_port():
    with socket.socket() as chosen:
        chosen.bind(("127.0.0.1", 0))
        return chosen.getsockname()[1]


class Cluster:
    """With it, its node takes jobs; at its end all its processes are gone."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.node = socket.gethostname().split(".")[0]
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"), PATH=PATH)
        self.daemons = []

    def configuration(self):
        user = subprocess.run(["id", "-un"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
        return f"""
ClusterName=test
SlurmctldHost={self.node}(127.0.0.1)
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={self.folder}/munge.socket
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MailProg=/bin/true
ReturnToService=2
KillWait=2
SchedulerParameters=sched_interval=1,bf_interval=1,requeue_delay=0,batch_sched_delay=0
NodeName={self.node} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""

    def begin(self, *command):
        log = open(self.folder / f"{command[0]}.log", "ab")
        self.daemons.append(subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log,
                                             stderr=log, start_new_session=True))

    def run(self, *command):
        return subprocess.run(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=True).stdout

    def wait(self, condition, what):
        end = time.monotonic() + program.PATIENCE_S
        while not condition():
            if time.monotonic() > end:
                raise AssertionError(f"{what} did not come: {self.run('squeue', '--array')}\n{self.logs()}")
            time.sleep(0.1)

    def logs(self):
        return "\n".join(path.read_text(errors="replace")[-1500:] for path in sorted(self.folder.glob("*.log")))

    def state(self):
        try:
            return self.run("sinfo", "--noheader", "--format=%T").strip()
        except subprocess.CalledProcessError:
            return "no controller yet"

    def __enter__(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        (self.folder / "slurm.conf").write_text(self.configuration(), encoding="utf-8")
        self.run("mungekey", "--create", f"--keyfile={self.folder}/key")
        self.begin("munged", "--foreground", "--force", f"--socket={self.folder}/munge.socket",
                   f"--key-file={self.folder}/key", f"--pid-file={self.folder}/munge.pid",
                   f"--seed-file={self.folder}/seed")
        self.wait((self.folder / "munge.socket").exists, "munge")
        self.begin("slurmctld", "-D")
        self.begin("slurmd", "-D")
        self.wait(lambda: self.state() == "idle", "the node")
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
        for daemon in self.daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                os.killpg(daemon.pid, signal.SIGKILL)
                daemon.wait()

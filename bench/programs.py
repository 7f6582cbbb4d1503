"""Runs the programs that the suite times, in folders that do not stay."""
import contextlib
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import tempfile
import threading
import time

GIVE_UP_SECONDS = 900  # no run is meant to take so long: longer ones are measured in parts

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Failed(Exception):
    """A program ended with an error, or there is no room."""


_running = set()
_signals = []  # those that came


def _kill(process):
    """Kills a process without polling it, which would take its end from the thread that waits for it."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(process.pid, signal.SIGKILL)


def stop_on_signals():
    """Lets Ctrl-C and its like end the programs that run, and `run` raise. To raise wherever Python happens to be would
    leave what it was about to close or to cancel."""
    def stop(number, _):
        _signals.append(number)
        for process in list(_running):
            _kill(process)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, stop)


@contextlib.contextmanager
def child(command, **options):
    """A program in the background, which signals end; KeyboardInterrupt after one."""
    if _signals:
        raise KeyboardInterrupt
    process = subprocess.Popen([str(c) for c in command], stdin=subprocess.DEVNULL, **options)
    _running.add(process)
    if _signals:
        _kill(process)
    try:
        yield process
    finally:
        _running.discard(process)
    if _signals:
        raise KeyboardInterrupt


def run_quietly(command, **options):
    """Runs a program that is not timed; returns what it printed."""
    with child(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options) as process:
        output, _ = process.communicate()
    if process.returncode != 0:
        raise Failed(f"{' '.join(map(str, command))}\nended with {process.returncode}\n{output[-4000:]}")
    return output.strip()


def memory_disk():
    """A disk in memory with room for the largest job, or nothing. File systems take their time over files that
    follow others just removed."""
    where = pathlib.Path("/dev/shm")
    return where if where.is_dir() and shutil.disk_usage(where).free > 4e9 else None


@contextlib.contextmanager
def scratch_folder(where=None):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="ombre-bench-", dir=where))
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


class Finished:
    def __init__(self, output, seconds, usage):
        self.output, self.seconds = output, seconds
        self.cpu_seconds = usage.ru_utime + usage.ru_stime
        self.peak_bytes = usage.ru_maxrss * 1024


def least_peak():
    """The kernel's figure for a child starts with what this process had when it began the child."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def run(command, data=ROOT):
    """Runs a program to its end; its peak memory is the kernel's figure."""
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        environment = dict(os.environ, OMBRE_DATA=str(data), NO_COLOR="1")
        began = time.monotonic()
        with child(command, stdout=output, stderr=errors, env=environment) as process:
            patience = threading.Timer(GIVE_UP_SECONDS, _kill, [process])
            patience.start()
            try:
                _, status, usage = os.wait4(process.pid, 0)
            finally:
                patience.cancel()
        seconds = time.monotonic() - began
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        errors.seek(0)
        if seconds >= GIVE_UP_SECONDS:
            raise Failed(f"{' '.join(map(str, command))}\nwas ended after {GIVE_UP_SECONDS} s")
        if process.returncode != 0:
            told = output.read()[-2000:] + errors.read()[-2000:]
            raise Failed(f"{' '.join(map(str, command))}\nended with {process.returncode}\n{told}")
        return Finished(output.read(), seconds, usage)


def need_room(folder, wanted):
    free = shutil.disk_usage(folder).free
    if free < wanted * 1.2 + 2**30:
        raise Failed(f"{folder} has {free / 1e9:.1f} GB free, the job writes about {wanted / 1e9:.1f} GB; "
                     "name another folder with --scratch")


def events_of(output):
    return {event["event"]: event for event in map(json.loads, output.splitlines())}


class Ombre:
    """One build of the program, and where its data is."""

    def __init__(self, path, data=ROOT):
        self.path, self.data = path, data

    def design_file(self, design):
        return run([self.path, "slice", design, "--emit", "json"], self.data).output

    def estimate(self, design, arguments):
        events = events_of(run([self.path, "slice", design, *arguments, "--dry-run", "--json"], self.data).output)
        return events["estimate"]

    def slice(self, design, arguments, folder):
        """Returns how the program finished and its events; what it wrote is removed."""
        out = folder / "job"
        try:
            finished = run([self.path, "slice", design, "-o", out, "--force", "--json", *arguments], self.data)
            return finished, events_of(finished.output)
        finally:
            shutil.rmtree(out, ignore_errors=True)

"""Running processes, judged by the work they have done and never by the clock, which depends on what else a machine does."""
import contextlib
import os
import pathlib
import signal
import time

from program import PATIENCE_S, expect

# Processor time between Ctrl-C and the end of a process: ten times what any job takes.
MOST_WORK_S = 3


def wait_until(is_so, what):
    """Waits for something to come true; fails with what was waited for."""
    end = time.monotonic() + PATIENCE_S
    while not is_so():
        expect(time.monotonic() < end, f"waited in vain until {what}")
        time.sleep(0.005)


def of_threads(pid, name):
    """The texts of a file that the kernel keeps for each thread of a process, without threads that have ended."""
    texts = []
    with contextlib.suppress(OSError):
        for thread in os.listdir(f"/proc/{pid}/task"):
            with contextlib.suppress(OSError):
                texts.append(pathlib.Path(f"/proc/{pid}/task/{thread}/{name}").read_text())
    return texts


def busy_seconds(pid):
    """The processor time of each thread of a process; libraries may keep threads that do nothing."""
    numbers = [text.rpartition(")")[2].split() for text in of_threads(pid, "stat")]
    return [(int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK") for words in numbers]


def helpers_of(pid):
    """The ids of the processes that a process has started, in their order."""
    return sorted(int(child) for text in of_threads(pid, "children") for child in text.split())


def work_of(process):
    """The processor time of a process and its helpers."""
    return sum(sum(busy_seconds(pid)) for pid in (process.pid, *helpers_of(process.pid)))


def wait_for_work(process, seconds):
    """Waits until the process has had so much processor time. Fails if it ends before."""
    wait_until(lambda: process.poll() is not None or work_of(process) >= seconds, f"it has worked {seconds} s")
    if process.poll() is not None:
        raise AssertionError(f"it ended within {seconds} s of work: " + (process.stderr.read() if process.stderr else ""))


def wait_for_file(process, path):
    """Waits until the process has begun to write a file. Fails if it ends before."""
    wait_until(lambda: process.poll() is not None or path.exists(), f"{path.name} is there")
    if process.poll() is not None:
        raise AssertionError(f"it ended without {path.name}: " + (process.stderr.read() if process.stderr else ""))


def interrupt(process):
    """Sends Ctrl-C, which must be answered after little work, with status 130."""
    before = work_of(process)
    process.send_signal(signal.SIGINT)
    ended = {}

    def has_ended():
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            ended.update(status=os.waitstatus_to_exitcode(status), work=usage.ru_utime + usage.ru_stime - before)
        return bool(ended)

    try:
        wait_until(has_ended, "it ended after an interrupt")
    except AssertionError:
        process.kill()
        raise
    process.returncode = ended["status"]
    expect(process.returncode == 130, f"status {process.returncode} after an interrupt, expected 130: "
           + (process.stderr.read() if process.stderr else ""))
    expect(ended["work"] < MOST_WORK_S, f"it worked {ended['work']:.2f} s after an interrupt")

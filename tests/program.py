"""What the runners share: how the program is called, and how checks run side by side."""
import concurrent.futures
import os
import pathlib
import subprocess
import sys

TESTS = pathlib.Path(__file__).resolve().parent
SOURCE = TESTS.parent
WITHOUT_CAD = "this ombre was built without Open CASCADE"


def examples(ombre):
    """Those that this build can read."""
    def is_readable(design):
        return "cad(" not in design.read_text(encoding="utf-8") or WITHOUT_CAD not in run(
            [ombre, "probe", design, "--at", "0,0,0"]).stderr
    return [design for design in sorted((SOURCE / "examples").glob("*.vcad")) if is_readable(design)]


def environment():
    variables = dict(os.environ, NO_COLOR="1")
    variables.setdefault("OMBRE_DATA", str(SOURCE))
    return variables


def run(arguments, cwd=None, timeout=120, **options):
    """Runs a command; its output as text, its status in .returncode."""
    if "input" not in options:
        options["stdin"] = subprocess.DEVNULL
    return subprocess.run([str(a) for a in arguments], cwd=cwd, env=environment(), timeout=timeout, text=True,
                          encoding="utf-8", errors="replace", stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)


def expect(truth, message):
    """Fails a check with a message, unless it is true."""
    if not truth:
        raise AssertionError(message)


def near(got, wanted, tolerance, what):
    """Fails a check unless the numbers differ by at most the tolerance."""
    expect(abs(got - wanted) <= tolerance, f"{what} is {got}, not {wanted}")


def check_all(checks, threads=None):
    """Runs (name, function) pairs side by side. A function returns what is wrong, "" if nothing is, or
    "skipped: why". Prints the failures and a summary; returns the exit status."""
    def guarded(function):
        try:
            problem = function() or ""
        except Exception as error:  # a check that breaks is a check that fails
            problem = f"{type(error).__name__}: {error}"
        return f"skipped: {WITHOUT_CAD}" if WITHOUT_CAD in problem else problem

    failed = skipped = 0
    with concurrent.futures.ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        results = [(name, pool.submit(guarded, function)) for name, function in checks]
        for name, future in results:
            problem = future.result()
            if problem.startswith("skipped: "):
                skipped += 1
                print(f"{name}: {problem}")
            elif problem:
                failed += 1
                print(f"FAILED {name}\n    " + problem.rstrip().replace("\n", "\n    "))
            sys.stdout.flush()
    print(f"{len(checks) - failed - skipped} of {len(checks)} passed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed else 0

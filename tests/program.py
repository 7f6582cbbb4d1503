"""What the runners share: how the program is called, and how checks run side by side."""
import argparse
import concurrent.futures
import functools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parent
SOURCE = TESTS.parent
WITHOUT_CAD = "this ombre was built without Open CASCADE"


def examples(ombre):
    """Those that this build can read."""
    def is_readable(design):
        return "cad(" not in design.read_text(encoding="utf-8") or WITHOUT_CAD not in run(
            [ombre, "probe", design, "--at", "0,0,0"]).stderr
    return [design for design in sorted((SOURCE / "examples").glob("*.vcad")) if is_readable(design)]


# Seconds after which a command hangs; no test measures it, since machines may do other things as well.
PATIENCE_S = 1200


def environment():
    variables = dict(os.environ, NO_COLOR="1")
    variables.setdefault("OMBRE_DATA", str(SOURCE))
    return variables


def run(arguments, cwd=None, timeout=PATIENCE_S, **options):
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


def near_share(got, wanted, share, what):
    """Fails a check unless the numbers differ by at most a share of the wanted one."""
    near(got, wanted, share * abs(wanted), what)


class Folder:
    """A folder that one check has for itself, with some files, and the program in it."""

    FILES: dict = {}  # contents by names, as `write` takes them

    def __init__(self, ombre, scratch):
        self.ombre, self.path = ombre, pathlib.Path(scratch)
        for name, content in self.FILES.items():
            self.write(name, content)

    def write(self, name, content):
        """Writes a text, or what is no text as JSON; returns the file's path."""
        path = self.path / name
        path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
        return path

    def read(self, name):
        return (self.path / name).read_text(encoding="utf-8")

    def write_design_of_files(self, attributes=""):
        """Writes sub/part.vcad, which reads files beside it: a mesh with the corners 0 and 6, and a table from 1 to 2."""
        corners = [(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6)]
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        (self.path / "sub").mkdir()
        self.write("sub/corner.off", "\n".join(["OFF", "4 4 0"] + [" ".join(map(str, c)) for c in corners] +
                                               [" ".join(map(str, (3, *f))) for f in faces]) + "\n")
        self.write("sub/sizes.csv", "0,1\n10,2\n")
        self.write("sub/part.vcad", attributes + """union() {
  mesh("corner.off");
  translate(20, 0, 0) sphere(table("sizes.csv", "z"));
}
""")

    def bytes(self, name):
        return (self.path / name).read_bytes()

    def names(self):
        return sorted(path.name for path in self.path.iterdir())

    def command(self, *arguments):
        return [str(self.ombre), *(str(a) for a in arguments)]

    def run(self, *arguments, status=0, **options):
        result = run([self.ombre, *arguments], cwd=self.path, **options)
        expect(result.returncode == status, f"status {result.returncode}, not {status}: {result.stderr[-1500:]}")
        return result

    def describe(self, command, design, *arguments, status=0):
        """Runs a command that describes a design, which is given as its text."""
        self.write("design.vcad", design)
        return self.run(command, "design.vcad", *arguments, status=status)

    def described(self, event, command, design, *arguments):
        """The event of that name by which a command describes a design."""
        lines = self.describe(command, design, "--json", *arguments).stdout.splitlines()
        return next(found for found in map(json.loads, lines) if found["event"] == event)

    def run_three_shares(self, missing):
        """Runs the shares of plan.json, the second after an attempt to gather, which names its pieces; gathers them."""
        for share in (3, 1):
            self.run("run", "plan.json", "--shard", share)
        wrong = self.run("gather", "plan.json", status=2).stderr
        expect(f"{missing} are missing, of shares 2" in wrong, wrong)
        self.run("run", "plan.json", "--shard", 2)
        self.run("gather", "plan.json")

    def events(self, *arguments, **options):
        return [json.loads(line) for line in self.run(*arguments, "--json", **options).stdout.splitlines()]


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


def check_in_folders(folder, ombre, checks):
    """Runs checks, {name: function}, side by side, each with folder(ombre, scratch) of a temporary folder."""
    def in_scratch(check):
        with tempfile.TemporaryDirectory() as scratch:
            return check(folder(ombre, scratch))
    return check_all([(name, functools.partial(in_scratch, check)) for name, check in checks.items()])


def named(functions):
    return {function.__name__: function for function in functions}


def arguments(about, name=str, **switches):
    """What the command line of a test gives: the program, names of checks, and switches, {name: help}."""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("ombre", type=lambda path: pathlib.Path(path).resolve(), help="the program")
    parser.add_argument("names", nargs="*", type=name, help="only these")
    for switch, meaning in switches.items():
        parser.add_argument(f"--{switch}", action="store_true", help=meaning)
    return parser.parse_intermixed_args()


def main(folder, checks):
    """Runs the checks, {name: function of a folder}, or those that are named on the command line."""
    given = arguments(None)
    if given.names:
        checks = {name: check for name, check in checks.items()
                  if name in given.names or not set(given.names).isdisjoint(name.split())}
    return check_in_folders(folder, given.ombre, checks)

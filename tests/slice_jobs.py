"""What the runners of whole slice jobs share: a folder with a design in it, and how its files are compared."""
import argparse
import pathlib
import subprocess
import tempfile

import png
import program
from program import expect

# Something to do for some seconds at small voxels: a graded gyroid in a ball.
BALL = """
fgrade(["0.5 + z/10", "0.5 - z/10"], ["red", "blue"]) {
  intersection(materials="first") {
    sphere(5);
    function("sin(4*x)*cos(4*y) + sin(4*y)*cos(4*z) + sin(4*z)*cos(4*x)");
  }
}
"""
SMALL = ["--voxel", "0.1"]
LONG = ["--voxel", "0.012"]


class Job:
    """A folder for one check, with a design in it."""

    def __init__(self, ombre, scratch):
        self.ombre, self.folder = ombre, pathlib.Path(scratch)
        self.design = self.write("ball.vcad", BALL)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def command(self, out, *arguments, design=None):
        return [self.ombre, "slice", design or self.design, "-o", self.folder / out, *arguments]

    def slice(self, out, *arguments, design=None, status=0, **options):
        result = program.run(self.command(out, *arguments, design=design), cwd=self.folder, **options)
        expect(result.returncode == status, f"status {result.returncode}, expected {status}: {result.stderr[-1500:]}")
        return result

    def start(self, out, *arguments):
        command = [str(a) for a in self.command(out, *arguments)]
        return subprocess.Popen(command, cwd=self.folder, env=program.environment(), stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def images(self, out):
        return [png.read(path) for path in layers(self.folder / out)]


def layers(folder):
    return sorted(folder.glob("slice_*.png"))


def files(folder):
    return {p.name: p.read_bytes() for p in sorted(folder.iterdir())}


def expect_same(one, other, names=None):
    """The same files with the same bytes; of these names alone, if they are given."""
    a, b = files(one), files(other)
    if names:
        a, b = ({n: c for n, c in f.items() if names(n)} for f in (a, b))
    expect(a.keys() == b.keys(), f"other files: {sorted(a.keys() ^ b.keys())[:8]}")
    different = [name for name in a if a[name] != b[name]]
    expect(not different, f"other bytes: {different[:8]}")


def ombre_layer(job, *arguments, status=0):
    result = program.run([job.ombre, "layer", job.design, *arguments], cwd=job.folder)
    expect(result.returncode == status, f"status {result.returncode}, expected {status}: {result.stderr[-1500:]}")
    return result


def in_scratch(function, ombre):
    with tempfile.TemporaryDirectory() as scratch:
        return function(Job(ombre, scratch))


def main(description, functions):
    """Runs the checks, {name: function of a Job}, or those that are named on the command line."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("ombre", type=pathlib.Path, help="the program")
    parser.add_argument("names", nargs="*", help="only these")
    a = parser.parse_args()
    if a.names:
        functions = {name: f for name, f in functions.items() if name in a.names or not set(a.names).isdisjoint(name.split())}
    ombre = a.ombre.resolve()
    return program.check_all([(name, lambda f=f: in_scratch(f, ombre)) for name, f in functions.items()])

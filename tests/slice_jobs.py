"""What the runners of whole slice jobs share: a folder with a design in it, and how its files are compared."""
import subprocess

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
SMALL = ["--voxel", "0.1"]
LONG = ["--voxel", "0.012"]


class Job(program.Folder):
    """A folder with a design in it."""

    def __init__(self, ombre, scratch):
        super().__init__(ombre, scratch)
        self.design = self.write("ball.vcad", BALL)

    def slicing(self, out, *arguments, design=None):
        return self.command("slice", design or self.design, "-o", self.path / out, *arguments)

    def slice(self, out, *arguments, design=None, **options):
        return self.run("slice", design or self.design, "-o", self.path / out, *arguments, **options)

    def start(self, out, *arguments):
        return subprocess.Popen(self.slicing(out, *arguments), cwd=self.path, env=program.environment(), stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def images(self, out):
        return [png.read(path) for path in layers(self.path / out)]


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


def ombre_layer(job, *arguments, **options):
    return job.run("layer", job.design, *arguments, **options)

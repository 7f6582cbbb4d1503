#!/usr/bin/env python3
"""The Python package, installed by pip in an empty environment, and used away from the sources. Needs the network.

    python3 tests/run_wheel.py
"""
import os
import pathlib
import subprocess
import sys
import tempfile

sources = pathlib.Path(__file__).resolve().parent.parent

USE = """
import ombre, pyvcad
assert "site-packages" in ombre.__file__, ombre.__file__
part = ombre.sphere(5, "blue") - ombre.cube(4)
assert abs(part.volume(0.1) - (4/3*3.14159265*125 - 64)) < 1, part.volume(0.1)
part.slice("layers", printer="j750", layers=":3")
part.write_voxels("part.vdb", voxel=1)  # by a module that is loaded
print(pyvcad.Sphere(pyvcad.Vec3(0, 0, 0), 10).evaluate(15, 0, 0))
"""


def changes():
    """What git sees in the sources beside the last commit; files elsewhere have no git."""
    return subprocess.run(["git", "-C", sources, "status", "--porcelain"], capture_output=True, text=True).stdout


def main():
    before = changes()
    with tempfile.TemporaryDirectory() as scratch:
        venv = pathlib.Path(scratch) / "venv"
        subprocess.run([sys.executable, "-m", "venv", venv], check=True)
        environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "OMBRE_DATA")}
        environment["CXX"] = "c++"  # the name that the compiler cache knows
        subprocess.run([venv / "bin" / "pip", "install", "--quiet", sources, sources / "bindings" / "pyvcad"], check=True, env=environment)
        assert changes() == before, f"building the packages left files in the sources: {changes()}"
        subprocess.run([venv / "bin" / "python", "-W", "error", "-c", USE], check=True, cwd=scratch, env=environment)
        subprocess.run([venv / "bin" / "ombre", "nodes"], check=True, cwd=scratch, env=environment,
                       stdout=subprocess.DEVNULL)
        layers = list((pathlib.Path(scratch) / "layers").glob("*.png"))
        assert len(layers) == 3, layers
    print("the package installs and works")


if __name__ == "__main__":
    main()

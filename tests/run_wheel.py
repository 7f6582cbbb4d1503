#!/usr/bin/env python3
"""The Python package, installed offline as the manual says, and used away from the sources.

    python3 tests/run_wheel.py BUILD_FOLDER
"""
import argparse
import os
import pathlib
import shlex
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
print(pyvcad.Sphere(pyvcad.Vec3(0, 0, 0), 10).evaluate(15, 0, 0))
"""


def compiler_flags(build):
    """Those of the build that is there, which its compiler cache knows."""
    wanted = ("CMAKE_BUILD_TYPE", "CMAKE_CXX_FLAGS_RELWITHDEBINFO", "OMBRE_OPENVDB", "OMBRE_3MF", "OMBRE_FREETYPE",
              "OMBRE_TEXT", "OMBRE_QHULL", "OMBRE_MESH_DISTANCE")
    lines = (build / "CMakeCache.txt").read_text(encoding="utf-8").splitlines()
    values = dict(line.split("=", 1) for line in lines if "=" in line and not line.startswith(("#", "//")))
    return ["-DCMAKE_UNITY_BUILD=OFF",
            *(f"-D{name}={value}" for key, value in values.items() if (name := key.split(":")[0]) in wanted)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    build = parser.parse_args().build
    with tempfile.TemporaryDirectory() as scratch:
        venv = pathlib.Path(scratch) / "venv"
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", venv], check=True)
        environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "OMBRE_DATA")}
        environment["CMAKE_ARGS"] = shlex.join(compiler_flags(build))
        subprocess.run([venv / "bin" / "pip", "install", "--quiet", "--no-build-isolation", "--no-index", sources],
                       check=True, env=environment)
        subprocess.run([venv / "bin" / "python", "-W", "error", "-c", USE], check=True, cwd=scratch, env=environment)
        subprocess.run([venv / "bin" / "ombre", "nodes"], check=True, cwd=scratch, env=environment,
                       stdout=subprocess.DEVNULL)
        layers = list((pathlib.Path(scratch) / "layers").glob("*.png"))
        assert len(layers) == 3, layers
    print("the package installs and works")


if __name__ == "__main__":
    main()

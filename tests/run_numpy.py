#!/usr/bin/env python3
"""The Python package's functions of arrays under another NumPy, which pip puts into an environment of its own.

    python3 tests/run_numpy.py oldest|newest FOLDER

The package is the one on PYTHONPATH, whose metadata say which versions it takes (pyproject.toml).
"""
import os
import pathlib
import subprocess
import sys

from program import TESTS, expect

# The first NumPy from 1.22 on with wheels for each Python.
OLDEST = {(3, 10): "1.22.0", (3, 11): "1.23.2", (3, 12): "1.26.0", (3, 13): "2.1.0", (3, 14): "2.3.2"}


def main():
    age, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    wanted = "numpy==" + OLDEST[sys.version_info[:2]] if age == "oldest" else "numpy<3"
    python = folder / "bin/python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", folder], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--only-binary", ":all:", "--upgrade", wanted], check=True)
    version = subprocess.run([python, "-c", "import numpy; print(numpy.__version__)"], check=True, text=True,
                             stdout=subprocess.PIPE).stdout.strip()
    expect(age == "newest" or version == OLDEST[sys.version_info[:2]], f"this is NumPy {version}")
    expect(age == "oldest" or int(version.split(".")[0]) >= 2, f"this is NumPy {version}")
    print(f"NumPy {version}")
    return subprocess.run([python, "-m", "pytest", "-q", "-p", "no:cacheprovider", TESTS / "python/test_arrays.py"],
                          env=dict(os.environ), check=False).returncode


if __name__ == "__main__":
    sys.exit(main())

"""Builds the compiled part of the Python package by CMake, and puts beside it what it reads: printers, materials."""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

sources = pathlib.Path(__file__).resolve().parent
python = sources / "bindings" / "python"
packages = sorted(p.parent.name for p in python.glob("*/__init__.py"))


class CMakeBuild(build_ext):
    """One CMake build gives the extension, the modules that it loads, and the type stub."""

    def build_extension(self, ext):
        folder = sources / "build" / "wheel"  # as deep as the other builds, so that ccache knows what they compiled
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON", "-DOMBRE_TESTS=OFF",
                   "-DOMBRE_PYTHON_MODULE=ON", f"-DPython_EXECUTABLE={sys.executable}",
                   *shlex.split(os.environ.get("CMAKE_ARGS", ""))]
        subprocess.run(["cmake", "-S", str(sources), "-B", str(folder), "-G", "Ninja", *options], check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "ombre_python"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        target.mkdir(parents=True, exist_ok=True)
        for file in (folder / "python" / "ombre").iterdir():
            if not file.is_symlink() and (file.suffix == ".pyi" or file.name.startswith("_core.")):
                shutil.copy2(file, target / file.name)
        for module in folder.glob("src/*/libombre_*.so"):
            shutil.copy2(module, target / module.name)
        for data in ("printers", "materials"):
            shutil.copytree(sources / data, target / "data" / data, dirs_exist_ok=True)


setup(
    version=re.search(r"project\(ombre VERSION (\S+)", (sources / "CMakeLists.txt").read_text(encoding="utf-8"))[1],
    packages=packages,
    package_dir={name: f"bindings/python/{name}" for name in packages},
    package_data={name: ["py.typed"] for name in packages},
    ext_modules=[Extension("ombre._core", [])],
    cmdclass={"build_ext": CMakeBuild},
)

#!/usr/bin/env python3
"""An installed Ombre, moved to another folder: the program, what it loads, the Python package, completion in bash.

    python3 tests/run_install.py build/release
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import program

SCRIPT = 'import ombre\nroot = ombre.sphere(5, "blue")\nprint(ombre.__file__)\n'
COMPLETE = """
source "$1"
COMP_WORDS=("$2" slice part.vcad --pri) COMP_CWORD=3
_ombre
echo "${COMPREPLY[@]}"
COMP_WORDS=("$2" slice part.vcad --printer j75) COMP_CWORD=4
_ombre
echo "${COMPREPLY[@]}"
"""


def run(*command, folder):
    """Without anything that says where the sources are; messages of the loader say which files it opens."""
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "OMBRE_DATA", "OMBRE_PROGRAM")}
    done = subprocess.run([str(a) for a in command], cwd=folder, env={**environment, "LD_DEBUG": "files"}, text=True,
                          capture_output=True, check=False)
    assert done.returncode == 0, (command, done.stderr[-2000:])
    return done


def modules_come_from(installed, loader_messages):
    opened = set(re.findall(r"file=(\S*libombre_\S*)", loader_messages))
    assert opened and all(path.startswith(str(installed)) for path in opened), opened


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    build = parser.parse_args().build.resolve()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        subprocess.run(["cmake", "--install", build, "--prefix", folder / "first"], check=True,
                       stdout=subprocess.DEVNULL)
        installed = (folder / "first").rename(folder / "second")
        ombre = installed / "bin" / "ombre"

        assert "j750" in run(ombre, "printers", folder=folder).stdout
        assert "agilus-vero-modulus" in run(ombre, "calibrations", folder=folder).stdout
        (folder / "part.stl").write_bytes((program.TESTS / "cases/other_programs/fixtures/openscad.stl").read_bytes())
        (folder / "part.vcad").write_text('offset(0.5) { mesh("part.stl", "red"); }', encoding="utf-8")
        modules_come_from(installed, run(ombre, "slice", "part.vcad", "--voxel", "1", folder=folder).stderr)

        (folder / "part.py").write_text(SCRIPT, encoding="utf-8")
        assert str(installed) in run(ombre, "run", "part.py", folder=folder).stdout
        packages = next(installed.glob("lib/python3*/*-packages"))
        use = f"import sys; sys.path.insert(0, {str(packages)!r}); import ombre, pyvcad; print(pyvcad.resources_path()); " \
              "ombre.sphere(5).write_voxels('part.vdb', voxel=1)"
        reported = run(sys.executable, "-B", "-c", use, folder=folder)
        assert reported.stdout.strip() == str(installed / "share/ombre"), reported.stdout
        modules_come_from(installed, reported.stderr)

        script = installed / "share/bash-completion/completions/ombre"
        words = run("bash", "-c", COMPLETE, "bash", script, ombre, folder=folder).stdout.splitlines()
        assert words == ["--printer", "j750 j750-fine"], words
        for pattern in ("fish/*/ombre.fish", "zsh/*/_ombre"):
            (file,) = (installed / "share").glob(pattern)
            assert " completion words " in file.read_text(encoding="utf-8"), file
    print("the installed program works in another folder")


if __name__ == "__main__":
    main()

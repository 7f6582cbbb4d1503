"""Fixtures for the checks of the Python packages, which ctest runs with the built packages on the path."""
import pathlib
import subprocess
import sys

import pytest

sources = pathlib.Path(__file__).resolve().parents[1]


@pytest.fixture
def run_program(tmp_path):
    """Runs the command line in an empty folder."""
    def run(*arguments, status=0):
        result = subprocess.run([sys.executable, "-m", "ombre", *map(str, arguments)], cwd=tmp_path, text=True,
                                capture_output=True)
        assert result.returncode == status, result.stderr
        return result
    return run

"""Libraries of PyPI beside which files are compared."""
import os
import pathlib
import subprocess
import sys


def add_option(parser):
    parser.add_argument("--install", metavar="FOLDER", help="a virtual environment for the libraries, made by pip")


def use(folder, packages):
    """Runs this program again in a virtual environment that has the packages."""
    python = pathlib.Path(folder).resolve() / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        subprocess.run([python, "-m", "pip", "--quiet", "install", *packages], check=True)
    os.execv(python, [str(python), "-B", *(word for word in sys.argv if word not in ("--install", folder))])

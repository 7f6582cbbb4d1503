"""The tutorial notebook, run from its first cell to its last."""
import pathlib
import sys

import pytest

sources = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(sources / "tools"))


def texts(notebook):
    """What each cell gave as text."""
    return [[output.get("data", {}).get("text/plain") for output in cell.get("outputs", [])] for cell in notebook.cells]


@pytest.mark.filterwarnings("ignore")
def test_tutorial_gives_what_it_shows():
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    import run_notebook
    path = sources / "docs" / "user" / "tutorial.ipynb"
    shown, run = nbformat.read(path, as_version=4), run_notebook.run(path)
    assert texts(run) == texts(shown), "the notebook shows other results: python3 tools/run_notebook.py " + str(path)
    assert sum("image/png" in output.get("data", {}) for cell in run.cells for output in cell.get("outputs", [])) == 4

#!/usr/bin/env python3
"""Runs a notebook and writes it with what its cells gave, without times and counts that differ from run to run.

    python3 tools/run_notebook.py docs/user/tutorial.ipynb [-o OUT.ipynb]
"""
import argparse

import nbclient
import nbformat


def run(path):
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, record_timing=False).execute()
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            output.get("data", {}).pop("text/html", None)  # the picture is there as PNG
            output.get("data", {}).pop("image/jpeg", None)
    return notebook


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("notebook")
    parser.add_argument("-o", "--output", help="default: the notebook itself")
    arguments = parser.parse_args()
    nbformat.write(run(arguments.notebook), arguments.output or arguments.notebook)


if __name__ == "__main__":
    main()

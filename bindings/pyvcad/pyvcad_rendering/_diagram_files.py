"""Trees as files of Mermaid."""
from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from typing import Any

from pyvcad._diagrams import diagram
from pyvcad._errors import missing
from pyvcad._tree import as_node

_legend = """flowchart LR
    node["Kind of node<br/>names of its attributes"]
    child["Child"]
    node --> child
"""


def _write(text: str, file: Any) -> None:
    path = os.fspath(file)
    ending = os.path.splitext(path)[1].lower()
    if ending in (".mmd", ".md", ".txt"):
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
        return
    if ending not in (".svg", ".png", ".pdf"):
        raise ValueError(f"expected a file that ends in .mmd, .svg or .png, found {path}")
    if shutil.which("mmdc") is None:
        raise missing(f"a diagram as {ending} without Mermaid's mmdc", "write a .mmd file")
    with tempfile.TemporaryDirectory(prefix="ombre_") as folder:
        source = os.path.join(folder, "tree.mmd")
        _write(text, source)
        subprocess.run(["mmdc", "-i", source, "-o", path], check=True)


def Render_Tree_Diagram(root: Any, file: Any) -> None:
    """Writes the tree below a node: text for Mermaid (.mmd), or by its program mmdc a .svg or .png."""
    _write(diagram(as_node(root)), file)


def Render_Tree_Legend(file: Any) -> None:
    """Writes what boxes and arrows of a diagram are, in the same formats."""
    _write(_legend, file)

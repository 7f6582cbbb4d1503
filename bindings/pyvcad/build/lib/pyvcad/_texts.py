"""Designs in texts of the .vcad language."""
from __future__ import annotations

import os
import tempfile

import ombre

from ._tree import Node, Wrapped


def parse_vcad_text(text: str, material_config_path: str | os.PathLike[str] | None = None) -> Node:
    """The design of a .vcad text.

    Args:
        text: the script; files that it names are relative to the working directory.
        material_config_path: a materials file; without it the default materials.

    Raises DesignError.
    """
    with tempfile.TemporaryDirectory(prefix="ombre_") as folder:
        path = os.path.join(folder, "text.vcad")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return Wrapped(ombre.load(path, materials=material_config_path or None))


def version() -> str:
    """Ombre's version."""
    return str(ombre.__version__)

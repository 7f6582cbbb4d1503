"""Decks of Abaqus and CalculiX that hold a mesh and its materials; supports and loads are to be added."""
from __future__ import annotations

import os
import re
from typing import Any, TextIO

import numpy

_kinds = {8: "C3D8", 4: "C3D4"}


def write_inp(path: str, nodes: numpy.ndarray, cells: numpy.ndarray, material_ids: numpy.ndarray,
              materials: dict[int, dict[str, Any]]) -> None:
    """Writes nodes, a set of elements for each material, and a section for each set.

    Args:
        nodes: of the shape (n, 3), mm. cells: (m, 8) or (m, 4), from 0; they count from 1 in the file.
        material_ids: (m,)
        materials: {id: {"name": ..., "properties": ...}}; with modulus_mpa and poissons_ratio they are elastic.
    """
    beside = f"{path}.{os.getpid()}.part"
    try:
        with open(beside, "w", encoding="ascii") as file:
            _write(file, nodes, cells, material_ids, materials)
        os.replace(beside, path)
    finally:
        if os.path.exists(beside):
            os.remove(beside)


def _write(file: TextIO, nodes: numpy.ndarray, cells: numpy.ndarray, material_ids: numpy.ndarray,
           materials: dict[int, dict[str, Any]]) -> None:
    file.write("*HEADING\nmm, N, MPa\n*NODE, NSET=NALL\n")
    for number, place in enumerate(nodes, 1):
        file.write(f"{number}, " + ", ".join(f"{c:.12g}" for c in place) + "\n")
    ids = [int(i) for i in numpy.unique(material_ids)]
    sets = _set_names({i: materials[i]["name"] for i in ids})
    for i in ids:
        file.write(f"*ELEMENT, TYPE={_kinds[cells.shape[1]]}, ELSET={sets[i]}\n")
        for number in numpy.flatnonzero(material_ids == i):
            file.write(f"{number + 1}, " + ", ".join(str(node + 1) for node in cells[number]) + "\n")
    for i in ids:
        file.write(f"*MATERIAL, NAME={sets[i]}\n")
        properties = materials[i].get("properties", {})
        if "modulus_mpa" in properties and "poissons_ratio" in properties:
            file.write(f"*ELASTIC\n{properties['modulus_mpa']:.12g}, {properties['poissons_ratio']:.12g}\n")
        file.write(f"*SOLID SECTION, ELSET={sets[i]}, MATERIAL={sets[i]}\n")


def _set_names(names: dict[int, str]) -> dict[int, str]:
    """Letters, digits and underscores, a letter first, no two the same."""
    result: dict[int, str] = {}
    for i, name in names.items():
        word = re.sub(r"[^A-Z0-9]", "_", name.upper())
        word = word if word[:1].isalpha() else f"M_{word}"
        result[i] = word[:60] if word[:60] not in result.values() else f"{word[:60]}_{i}"
    return result

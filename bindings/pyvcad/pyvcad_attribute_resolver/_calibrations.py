"""Conversions by calibrations, which `ombre calibrations` lists."""
from __future__ import annotations

import math
import os
from typing import Any

import ombre
from ombre import _commands

from pyvcad import MaterialDefs, default_materials
from pyvcad._resolvers import numbers_of

from ._registry import OneToOne, register_conversion

_fractions = "volume_fractions"


class CalibrationConverter(OneToOne):
    """A curve of an attribute; beyond its ends it has the value at the nearer one.

    Without materials the output is an attribute; with them it is the composition: the fraction of the first, and the rest.
    """

    def __init__(self, source: str, target: str, curve: dict[str, Any], materials: tuple[int, int] | None = None) -> None:
        super().__init__(source, target)
        self._curve, self._ids = curve, materials

    def _apply(self, solid: ombre.Solid) -> ombre.Solid:
        key = numbers_of(solid, self._source)[0]
        if self._curve["of_logarithm"]:  # a number that is not positive has no logarithm; it gets that of the least
            key = ombre.log(ombre.max(key, math.exp(self._curve["points"][0][0])))
        result = ombre.table(self._curve["points"], key)
        if self._ids is None:
            return ombre.attribute(solid, self._target, result)
        return ombre.fgrade(solid, [result, 1 - result], list(self._ids))

    def _materials(self) -> set[int] | None:
        return None if self._ids is None else set(self._ids)


def register_calibration(name_or_path: str | os.PathLike[str], material_defs: MaterialDefs | None = None) -> list[str]:
    """Registers what a calibration of one input converts, from its property and to it; returns the conversions' names.

    Args:
        name_or_path: a calibration of Ombre, such as "agilus-vero-modulus", or a file of one's own.
        material_defs: where its materials are looked up; the default materials if it is left out.
    """
    about, _ = _commands.run("calibrations", {"calibration": os.fspath(name_or_path)}, {})
    if "inverse" not in about and "forward" not in about:
        raise ValueError(f"register_calibration: {about['name']} has several inputs, so one attribute does not decide them")
    source, name = about["input"], about["name"]
    names = []
    ids = None
    if "materials" in about:
        ids = _ids_of(about, material_defs or default_materials)
    target = _fractions if ids else source
    if "inverse" in about:
        names.append(register_conversion(about["property"], target, lambda: CalibrationConverter(
            about["property"], target, about["inverse"], ids), name=f"{about['property']}_to_{target}_by_{name}", tags=[name]))
    if ids is None:
        names.append(register_conversion(source, about["property"], lambda: CalibrationConverter(
            source, about["property"], about["forward"]), name=f"{source}_to_{about['property']}_by_{name}", tags=[name]))
    return names


def _ids_of(about: dict[str, Any], table: MaterialDefs) -> tuple[int, int]:
    """The ids of the first materials of each list that the table has."""
    known = {entry["name"].lower(): entry["id"] for entry in table._entries()}
    found = []
    for names in about["materials"]:
        ids = [known[name.lower()] for name in names if name.lower() in known]
        if not ids:
            raise ValueError(f"register_calibration: {about['name']} needs one of the materials {', '.join(names)}, which the "
                             "materials file lacks")
        found.append(ids[0])
    return found[0], found[1]

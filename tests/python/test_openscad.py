"""OpenSCAD scripts as solids."""
import pathlib

import ombre
import pytest

BOX = pathlib.Path(__file__).parents[1] / "cases" / "openscad" / "fixtures" / "box.scad"


def test_variables_and_parts():
    lid = ombre.scad(str(BOX), part="lid", width=30)
    low, high = lid.bounds
    assert list(low) == [0, 0, 9] and list(high) == [30, 12, 11]


def test_solids_of_scripts_combine():
    lid = ombre.scad(str(BOX), part="lid", materials="one", material="green")
    cut = lid - ombre.translate((10, 6, 10), ombre.sphere(1))
    assert cut.distance([[10, 6, 10]])[0] == pytest.approx(1)


def test_wrong_values_are_reported():
    with pytest.raises(ombre.DesignError, match="cannot get a sphere"):
        ombre.scad(str(BOX), width=ombre.sphere(2))
    with pytest.raises(ombre.DesignError, match='has no part "lod"; did you mean "lid"'):
        ombre.scad(str(BOX), part="lod")

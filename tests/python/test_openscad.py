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


def test_a_map_gives_materials_to_names_and_colours(tmp_path):
    script = tmp_path / "two.scad"
    script.write_text('material("PLA white") cube(2); color("#1234ab") translate([2, 0, 0]) cube(2);')
    design = ombre.load(script, material_map={"PLA white": "white", "#1234ab": "cyan"})
    points = [event for event in design.probe(at=[(1, 1, 1), (3, 1, 1)]).events if event["event"] == "point"]
    assert [list(point["composition"]) for point in points] == [["white"], ["cyan"]]
    with pytest.raises(ombre.DesignError, match="no material or colour"):
        ombre.load(script, material_map={"PLA white": "white", "PLA": "red"})
    with pytest.raises(ombre.DesignError, match='"PLA white"'):
        ombre.load(script)

"""Properties of designs, resolved from Python."""
import pytest

import ombre


def test_properties_become_settings():
    part = ombre.attribute(ombre.cube(10), "temperature", 238)
    printer, = part.resolve(printer="fff-foaming-pla")["printers"]
    step, = printer["steps"]
    assert step["from"] == ["temperature"] and step["to"] == "flow_rate" and step["calibration"] == "foaming-pla-flow"
    assert printer["is_within_reach"] and printer["intent"][0]["mean_miss"] == 0


def test_what_is_out_of_reach_is_an_error():
    part = ombre.attribute(ombre.cube(10), "temperature", 300)
    with pytest.raises(ombre.CheckError):
        part.resolve(printer="fff-foaming-pla")
    printer, = part.resolve(printer="fff-foaming-pla", out_of_reach="nearest")["printers"]
    assert printer["intent"][0]["share_out_of_reach"] == 1



def test_one_property_decides():
    part = ombre.attribute(ombre.attribute(ombre.cube(4), "density", 1.16), "modulus", 100)
    report = part.resolve(printer=["fff-infill", "fff-foaming-pla"], deciding=["modulus"], out_of_reach="nearest")
    infill, foam = report["printers"]
    step, = infill["steps"]
    assert step["from"] == ["modulus"] and step["to"] == "infill_density" and step["rounded_to"] == 5
    # 3600 MPa * (infill / 100)^2: 100 MPa need 16.67 %, of which 15 % are left, with 81 MPa and 0.186 g/cm3.
    rows = {row["attribute"]: row for row in infill["intent"]}
    assert abs(rows["modulus"]["given"] - 81) < 1e-6 and abs(rows["density"]["given"] - 0.186) < 1e-9
    assert "no calibration leads" in foam["problem"]


def test_checks_correct_what_they_find(tmp_path):
    trap = ombre.rectprism((4, 4, 4)) - ombre.rectprism((2, 2, 2)).translate(z=0.5)
    report = trap.check(voxel=0.1, fix=tmp_path / "drained", drain=0.3)
    correction, = report["corrections"]
    assert correction["kind"] == "drain"
    assert sum(correction["gained_mm3"].values()) == pytest.approx(-9 * 5 / 1000)
    assert report["findings"] == [] and (tmp_path / "drained" / "job.json").exists()

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


"""Errors have codes and values, and remedies in Python's words. tests/run_codes.py has the same for other languages."""
import ombre
import pytest

MISTAKES = [
    (lambda: ombre.sphere(radios=5), "unknown-parameter", {"node": "sphere", "parameter": "radios"}, '"radius"'),
    (lambda: ombre.sphere(5, "redd"), "unknown-material", {"material": "redd", "similar": "red"}, '"red"'),
    (lambda: ombre.sphere(-1), "parameter-range", {"node": "sphere", "parameter": "radius"}, ""),
    (lambda: ombre.union([ombre.cube(5), ombre.sphere(3)], materials="blend"), "parameters", {"node": "union"},
     'ombre.union(blend=1, materials="blend")'),
    (lambda: ombre.cube(5).rotate(axis=(0, 0, 0), degrees=5), "parameters", {"node": "rotate"}, "(1, 1, 0)"),
    (lambda: ombre.mesh("no.stl"), "file-missing", {"file": "no.stl"}, "looked for"),
]


@pytest.mark.parametrize("make, code, values, remedy", MISTAKES)
def test_wrong_nodes(make, code, values, remedy):
    with pytest.raises(ombre.DesignError) as reported:
        make()
    error = reported.value
    assert error.code == code
    assert {name: error.values.get(name) for name in values} == values
    assert remedy in error.diagnostics[0]["hint"]
    assert "{ ... }" not in str(error)


def test_wrong_jobs(tmp_path):
    with pytest.raises(ombre.DesignError) as reported:
        ombre.function("z").slice(tmp_path / "layers", voxel=1)
    assert reported.value.code == "unbounded"
    assert "ombre.Design(solid, box=" in str(reported.value)
    with pytest.raises(ombre.DesignError) as reported:
        ombre.cube(3).slice(tmp_path / "layers", voxel=1, memory="2X")
    assert reported.value.code == "option"
    assert 'memory="2G"' in str(reported.value) and "--" not in str(reported.value)


def test_machine_errors(tmp_path):
    ombre.cube(3).slice(tmp_path / "layers", voxel=1)
    with pytest.raises(ombre.MachineError) as reported:
        ombre.cube(3).slice(tmp_path / "layers", voxel=1)
    assert reported.value.code == "exists"
    assert "replace it with force" in str(reported.value)

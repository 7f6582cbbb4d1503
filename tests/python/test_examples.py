"""The examples in Python, at a size that tests can afford."""
import pathlib

import numpy
import pytest

import ombre

examples = pathlib.Path(__file__).resolve().parents[2] / "examples" / "python"


@pytest.mark.parametrize("path", sorted(examples.glob("*.py")), ids=lambda path: path.stem)
def test_every_example_has_a_picture_and_slices(path, tmp_path):
    assert path.with_suffix(".png").exists()
    pytest.importorskip("scipy")
    design = ombre.load(path, points=60, struts=200)
    (x0, y0, z0), (x1, y1, z1) = design.bounds
    report = design.slice(tmp_path / "layers", voxel=round(max(x1 - x0, y1 - y0, z1 - z0) / 60, 4))
    assert report["complete"] and sum(m["voxels"] for m in report["materials"]) > 1000


def test_struts_of_the_lattice_are_graded_by_their_length():
    pytest.importorskip("scipy")
    lattice, body = ombre.load(examples / "mesh_lattice.py", points=60, struts=200).parts[0][1].inputs
    ends = numpy.array([[s.inputs[0].parameters["start"], s.inputs[0].parameters["end"]] for s in lattice.inputs])
    length = numpy.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    share = (length - length.min()) / (length.max() - length.min())
    magenta = [float(s.parameters["functions"][1]) for s in lattice.inputs]
    assert numpy.allclose(magenta, share, atol=1e-12)
    assert body.inside(ends).all()

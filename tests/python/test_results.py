"""Results of simulations in Python: the node, and pyvcad's nodes over it."""
import pathlib
import shutil

import pytest

import ombre
import pyvcad as pv

INP = """*NODE
1,0,0,0
2,10,0,0
3,0,10,0
4,0,0,10
*ELEMENT, TYPE=C3D4
1,1,2,3,4
"""
CSV = "1,0,0,0\n2,1,0,0\n3,0,2,0\n4,0,0,3\n"


@pytest.fixture
def files(tmp_path):
    (tmp_path / "part.inp").write_text(INP, encoding="utf-8")
    (tmp_path / "part.csv").write_text(CSV, encoding="utf-8")
    return str(tmp_path / "part.inp"), str(tmp_path / "part.csv")


def test_values_stand_in_formulas(files):
    moves = ombre.results(files[0], "displacement", values=files[1])
    solid = ombre.attribute(ombre.mesh(files[0]), "twice", 2 * moves.vector.z + 1)
    assert solid.attribute("twice", (1, 2, 3)) == pytest.approx(2 * 0.9 + 1)


def test_listing_5(tmp_path):
    """The seat of the 2025 paper, a bracket of its first formula mended: a slab of tetrahedra whose displacement grows
    linearly along x, so that shares do, too."""
    seat = pv.TetrahedralMesh.from_tree(pv.RectPrism(pv.Vec3(20, 5, 2), pv.Vec3(40, 10, 4)), 25, 2.4, 1, 3, 2.4)
    seat.write_to_inp(tmp_path / "bike_seat_new.inp")
    table = [f"{n},0,0,{-0.000055 - 0.00035 * x / 40}" for n, (x, _, _) in enumerate(seat.nodes, 1)]
    (tmp_path / "bike_seat_point_map.csv").write_text("\n".join(table) + "\n", encoding="utf-8")
    shutil.copy(pathlib.Path(__file__).parents[1] / "pyvcad" / "listings" / "listing5.py", tmp_path)
    design = ombre.load(tmp_path / "listing5.py")
    assert design.volume(0.5) == pytest.approx(40 * 10 * 4)
    points = [[0.5, 5, 2], [10, 1, 3], [20, 5, 2], [39.5, 9, 1]]
    shares = design.material(points)
    assert shares["blue"] == pytest.approx([x / 40 for x, _, _ in points], abs=1e-5)
    assert shares["green"] == pytest.approx([1 - x / 40 for x, _, _ in points], abs=1e-5)


def test_shares_by_the_length_of_displacements(files):
    materials = pv.default_materials
    root = pv.SimulationField(*files, ["(len-0.1)/0.9", "-(len-0.1)/0.9+1"],
                              [materials.id("blue"), materials.id("green")])
    length = (0.1 ** 2 + 0.4 ** 2 + 0.9 ** 2) ** 0.5
    assert root.evaluate(1, 2, 3) < 0 < root.evaluate(5, 5, 5)
    shares = dict(root.distribution(1, 2, 3))
    assert shares[materials.id("blue")] == pytest.approx((length - 0.1) / 0.9)
    assert shares[materials.id("green")] == pytest.approx(1 - (length - 0.1) / 0.9)


def test_point_map_takes_the_solid_of_another_file(files):
    root = pv.PointMap(files[0], *files, ["dx", "1 - dx"], [1, 2], True)
    assert dict(root.distribution(5, 1, 1))[1] == pytest.approx(0.5)


def test_wrong_arguments_say_so(files):
    with pytest.raises(ValueError, match="an expression for each material"):
        pv.SimulationField(*files, ["dx"], [1, 2])
    with pytest.raises(FileNotFoundError, match="none.csv"):
        pv.SimulationField(files[0], "none.csv", ["dx"], [1])
    pathlib.Path(files[1]).write_text("1,2\n99,3\n", encoding="utf-8")
    with pytest.raises(ombre.DesignError, match="no node 99"):
        pv.SimulationField(*files, ["dx"], [1]).prepare()

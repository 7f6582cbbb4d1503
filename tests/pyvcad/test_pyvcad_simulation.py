"""Meshes for simulations and their results in pyvcad: fields on tetrahedra, meshes of elements, compilers."""
import json
import pathlib
import re
import shutil
import subprocess

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_compilers as compilers
from pyvcad_parts import blue, green, red

# A cube of 2 mm in five tetrahedra.
POINTS = numpy.array([[x, y, z] for z in (0, 2) for y in (0, 2) for x in (0, 2)], dtype=float)
CELLS = numpy.array([[0, 3, 5, 6], [1, 0, 3, 5], [2, 0, 3, 6], [4, 0, 5, 6], [7, 3, 5, 6]])


def dataset():
    """A linear field, which interpolation meets exactly, a field of vectors, and the numbers of the cells."""
    fields = pv.UnstructuredFieldDataset.from_tetrahedra(POINTS, CELLS)
    fields.add_point_scalar("heat", 1 + POINTS @ [1, 2, 4], units="W", step_identifier="3", description="made up")
    fields.add_point_vector("move", POINTS * [1, -1, 0.5], units="mm")
    fields.add_cell_scalar("cell", numpy.arange(5))
    fields.add_cell_vector("flow", [[n, 0, 2] for n in range(5)])
    return fields


# Fields on tetrahedra.

def test_fields_say_what_they_are():
    fields = dataset()
    assert (fields.domain.point_count, fields.domain.cell_count) == (8, 5)
    assert fields.field_names == ["heat", "move", "cell", "flow"]
    heat, flow = fields.field_metadata("heat"), fields.field_metadata("flow")
    assert (heat.association, heat.component_count, heat.value_count) == (pv.FieldAssociation.POINT, 1, 8)
    assert (heat.minimum, heat.maximum, heat.units, heat.step_identifier) == (1, 15, "W", "3")
    assert (flow.association, flow.component_count, flow.value_count) == (pv.FieldAssociation.CELL, 3, 5)
    assert (flow.minimum, flow.maximum) == pytest.approx((2, 20 ** 0.5))


def test_linear_fields_are_met_exactly():
    heat, move = dataset().float_attribute("heat"), dataset().vec3_attribute("move")
    for point in ((1, 1, 1), (0.3, 1.7, 0.2), (2, 2, 2), (0, 0, 0)):
        assert heat.sample(*point) == pytest.approx(1 + numpy.dot(point, [1, 2, 4]), rel=1e-6)
        assert tuple(move.sample(*point)) == pytest.approx(tuple(numpy.multiply(point, [1, -1, 0.5])), rel=1e-6)
    assert (2 * heat + 1).sample(1, 1, 1) == pytest.approx(17)


def test_fields_of_cells_are_constant_in_each():
    cell, flow = dataset().float_attribute("cell"), dataset().vec3_attribute("flow")
    corners = [(1, 1, 1), (1.8, 0.1, 0.1), (0.1, 1.8, 0.1), (0.1, 0.1, 1.8), (1.8, 1.9, 1.9)]
    assert [cell.sample(*point) for point in corners] == [0, 1, 2, 3, 4]
    assert tuple(flow.sample(*corners[3])) == (3, 0, 2)


def test_outside_is_an_error_unless_it_is_clamped():
    fields = dataset()
    with pytest.raises(RuntimeError, match=r"no finite value at \(3, 1, 1\)"):
        fields.float_attribute("heat").sample(3, 1, 1)
    clamped = fields.float_attribute("heat", outside="boundary_clamp", max_distance=1.5)
    assert clamped.sample(3, 1, 1) == pytest.approx(1 + 2 + 2 + 4)  # at (2, 1, 1)
    with pytest.raises(RuntimeError, match="no finite value"):
        clamped.sample(4, 1, 1)
    assert fields.float_attribute("heat", "boundary_clamp").sample(40, 1, 1) == pytest.approx(9)
    assert tuple(fields.vec3_attribute("move", "boundary_clamp").sample(3, 1, 1)) == pytest.approx((2, -1, 0.5))


def test_coverage_counts():
    points = [[1, 1, 1], [2 + 1e-8, 1, 1], [2.5, 1, 1], [5, 1, 1], [-7, 1, 1]]
    strict = dataset().coverage(points)
    assert (strict.total_queries, strict.inside_count, strict.tolerance_adjusted_count) == (5, 1, 1)
    assert (strict.boundary_clamped_count, strict.outside_count, strict.maximum_clamp_distance) == (0, 3, 0)
    clamped = dataset().coverage(points, outside="boundary_clamp", max_distance=3)
    assert (clamped.boundary_clamped_count, clamped.outside_count) == (2, 1)
    assert clamped.maximum_clamp_distance == pytest.approx(3)
    failure, = clamped.representative_failures
    assert tuple(failure.position) == (-7, 1, 1) and failure.boundary_distance == pytest.approx(7)
    assert dataset().float_attribute("heat").sample(*points[1]) == pytest.approx(9)  # adjusted


def test_positions_and_vectors_are_transformed_apart():
    turn = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    moved = [[0, -1, 0, 10], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    fields = dataset().transformed(moved, turn)
    assert fields.float_attribute("heat").sample(10 - 1.5, 0.5, 0.25) == pytest.approx(1 + 0.5 + 3 + 1)
    assert tuple(fields.vec3_attribute("move").sample(10 - 1.5, 0.5, 0.25)) == pytest.approx((1.5, 0.5, 0.125))
    assert fields.field_metadata("heat").units == "W"
    doubled = dataset().transformed(lambda points: 2 * points)
    assert doubled.float_attribute("heat").sample(2, 2, 2) == pytest.approx(8)
    assert tuple(doubled.vec3_attribute("move").sample(2, 2, 2)) == pytest.approx((1, -1, 0.5))


def test_fields_are_attributes_of_designs():
    part = pv.RectPrism(pv.Vec3(1, 1, 1), pv.Vec3(2, 2, 2))
    part.set_attribute("modulus", dataset().float_attribute("heat"))
    distance, samples = part.sample(0.5, 0.5, 0.5)
    assert distance == pytest.approx(-0.5)
    assert samples.get_sample("modulus") == pytest.approx(1 + 3.5)


def test_fields_decide_of_what_a_part_is(tmp_path):
    """Half of the part reaches beyond the mesh: there it stays what it was, and the job says so."""
    part = pv.RectPrism(pv.Vec3(1, 1, 1), pv.Vec3(4, 2, 2))
    part.set_attribute("heat", dataset().float_attribute("heat"))
    mixture = pv.VolumeFractionsExpressionConverter(["heat"], [red, green], ["heat/15", "1 - heat/15"])
    root = pv.AttributeModifier(mixture, part)
    assert dict(root.distribution(1, 1, 1)) == {red: pytest.approx(8 / 15), green: pytest.approx(7 / 15)}
    with pytest.warns(ombre.DesignWarning, match="64 voxels"):
        root._design().slice(tmp_path / "layers", voxel=0.5)


@pytest.mark.parametrize("points, cells, said", [
    (POINTS, [[0, 1, 2]], r"expected the shape \(m, 4\)"), (POINTS, [[0, 1, 2, 8]], "cell 0 names a point"),
    (POINTS, [[0, 1, 2, 3]], "cell 0 is flat"), (POINTS[:, :2], CELLS, r"expected the shape \(n, 3\)"),
    (POINTS * numpy.nan, CELLS, "finite"), (POINTS, CELLS.astype(float), "whole numbers")])
def test_wrong_meshes_say_so(points, cells, said):
    with pytest.raises(ValueError, match=said):
        pv.UnstructuredFieldDataset.from_tetrahedra(points, cells)


def test_wrong_fields_say_so():
    fields = dataset()
    with pytest.raises(ValueError, match=r"'x': expected numbers of the shape \(8,\), found \(7,\)"):
        fields.add_point_scalar("x", numpy.zeros(7))
    with pytest.raises(ValueError, match="already"):
        fields.add_cell_scalar("heat", numpy.zeros(5))
    with pytest.raises(KeyError, match="there are heat, move"):
        fields.float_attribute("cold")
    with pytest.raises(TypeError, match="ask vec3_attribute"):
        fields.float_attribute("move")
    with pytest.raises(ValueError, match="expected 'error' or 'boundary_clamp'"):
        fields.float_attribute("heat", outside="nearest")
    with pytest.raises(ValueError, match="goes with outside"):
        fields.float_attribute("heat", max_distance=1)


# XDMF.

GRID = """<Xdmf Version="3.0"><Domain><Grid Name="mesh" GridType="Uniform">
<Topology TopologyType="Tetrahedron"><DataItem Dimensions="5 4" Format="HDF">part.h5:/mesh/cells</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem Dimensions="8 3" Format="HDF">part.h5:/mesh/points</DataItem></Geometry>
<Attribute Name="heat" AttributeType="Scalar" Center="Node">
<DataItem Dimensions="8 1" Format="HDF">part.h5:/heat</DataItem></Attribute>
<Attribute Name="flow" AttributeType="Vector" Center="Cell">
<DataItem Dimensions="5 3" Format="HDF">part.h5:/flow</DataItem></Attribute>
</Grid></Domain></Xdmf>
"""


@pytest.fixture
def grid_file(tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "part.h5", "w") as file:
        file["mesh/points"], file["mesh/cells"] = POINTS, CELLS
        file["heat"], file["flow"] = (1 + POINTS @ [1, 2, 4]).reshape(-1, 1), [[n, 0, 2] for n in range(5)]
    path = tmp_path / "part.xdmf"
    path.write_text(GRID, encoding="utf-8")
    return path


def test_xdmf_is_loaded(grid_file):
    fields = pv.XDMFFieldLoader.load(str(grid_file), grid_name="mesh")
    assert fields.field_names == ["heat", "flow"] and fields.domain.cell_count == 5
    assert fields.field_metadata("flow").association is pv.FieldAssociation.CELL
    assert fields.float_attribute("heat").sample(1, 0.5, 0.25) == pytest.approx(4)
    assert tuple(fields.vec3_attribute("flow").sample(0.1, 0.1, 1.8)) == (3, 0, 2)
    assert pv.XDMFFieldLoader.load(grid_file).field_names == ["heat", "flow"]


@pytest.mark.parametrize("old, new, said", [
    ('"Tetrahedron"', '"Hexahedron"', "TopologyType is 'Hexahedron'; read is Tetrahedron"),
    ('"Tetrahedron"', '"Mixed"', "TopologyType is 'Mixed'"), ('"XYZ"', '"XY"', "GeometryType is 'XY'"),
    ('"Uniform"', '"Collection"', "GridType is 'Collection'"), ('"Vector"', '"Tensor6"', "read is Scalar or Vector"),
    ('"8 1" Format="HDF"', '"8 1" Format="XML"', "Format is 'XML'; read is HDF"),
    ('"Cell"', '"Face"', "Center is 'Face'"), ("part.h5:/heat", "part.h5:/cold", "part.h5 has no numbers at /cold"),
    ("part.h5:/heat", "part.h5", "found 'part.h5'"), ('"8 1"', '"7 1"', "expected 7 x 1 numbers, found 8"),
    ("</Domain>", "", "mismatched tag"), ("<Topology", '<Time Value="1"/><Topology', "steps in time"),
    ('Center="Node"', 'Center="Cell"', r"\(5,\), found \(8,\)")])
def test_other_xdmf_is_an_error(grid_file, old, new, said):
    grid_file.write_text(GRID.replace(old, new), encoding="utf-8")
    with pytest.raises(ValueError, match=said):
        pv.XDMFFieldLoader.load(grid_file)


def test_missing_grids_and_files_say_so(grid_file):
    with pytest.raises(ValueError, match="no grid 'other'; there are 'mesh'"):
        pv.XDMFFieldLoader.load(grid_file, grid_name="other")
    grid_file.write_text(GRID.replace("part.h5:/heat", "gone.h5:/heat"), encoding="utf-8")
    with pytest.raises(FileNotFoundError, match="there is no file .*gone.h5"):
        pv.XDMFFieldLoader.load(grid_file)
    with pytest.raises(FileNotFoundError, match="nowhere.xdmf"):
        pv.XDMFFieldLoader.load("nowhere.xdmf")


# Meshes of elements.

def graded():
    """A bar of 8 x 4 x 4 mm: red (1) at x = 8, blue at x = 0."""
    bar = pv.RectPrism(pv.Vec3(4, 2, 2), pv.Vec3(8, 4, 4))
    return pv.FGrade(["x/8", "1 - x/8"], [red, blue], True, bar)


def volumes(nodes, cells):
    """Of tetrahedra, mm3."""
    return numpy.linalg.det(nodes[cells[:, 1:]] - nodes[cells[:, :1]]) / 6


def test_bricks_fill_a_tree():
    mesh = pv.HexahedralMesh.from_tree(graded(), pv.Vec3(1, 2, 0.5))
    assert (mesh.number_of_elements(), mesh.number_of_nodes()) == (8 * 2 * 8, 9 * 3 * 9)
    assert mesh.bounding_box() == (pv.Vec3(0, 0, 0), pv.Vec3(8, 4, 4)) and mesh.voxel_size() == pv.Vec3(1, 2, 0.5)
    corners = mesh.nodes[mesh.elements[0]] - mesh.nodes[mesh.elements[0]][0]
    assert numpy.allclose(corners[[1, 2, 3, 6]], [[1, 0, 0], [1, 2, 0], [0, 2, 0], [1, 2, 0.5]])
    assert numpy.allclose(mesh.cell_centroids.mean(axis=0), [4, 2, 2])
    assert pv.HexahedralMesh.from_tree(graded()).number_of_elements() == 128  # of 1 mm


def test_counted_bricks_of_pyvcad_2():
    mesh = pv.HexahedralMesh(graded(), 12, 3, 3)
    with pytest.raises(RuntimeError, match="call compute()"):
        mesh.nodes()
    mesh.compute()
    assert mesh.nodes().shape == (13 * 4 * 4, 3) and mesh.elements().shape == (108, 8)
    assert set(mesh.material_assignments()) == {red, blue}
    with pytest.raises(ValueError, match="nx: expected a count"):
        pv.HexahedralMesh(graded(), 0, 1, 1)


def test_tetrahedra_fill_a_tree():
    mesh = pv.TetrahedralMesh.from_tree(graded(), 30, 1, 0.25, 3, 1)
    assert mesh.elements.shape[1] == 4 and (volumes(mesh.nodes, mesh.elements) > 0).all()
    assert volumes(mesh.nodes, mesh.elements).sum() == pytest.approx(128, rel=1e-3)
    assert set(numpy.unique(mesh.elements)) == set(range(mesh.number_of_nodes()))
    coarse = pv.TetrahedralMesh.from_tree(graded(), facet_angle=25, facet_size=2, facet_distance=0.5,
                                          cell_radius_edge_ratio=3, cell_size=2)
    assert coarse.number_of_elements() < mesh.number_of_elements() / 3


def test_sizes_of_tetrahedra_follow_a_formula():
    """The even mixture is in the middle of the bar: there elements are small."""
    mesh = pv.TetrahedralMesh.from_tree(graded(), 25, 3, 1, 3, cell_size_lower=0.5, cell_size_upper=3)
    sizes = volumes(mesh.nodes, mesh.elements)
    near = abs(mesh.cell_centroids[:, 0] - 4) < 1
    assert sizes[near].mean() < sizes[~near].mean() / 2
    even = pv.TetrahedralMesh.from_tree(graded(), 25, 3, 1, 3, 0.5, 3, "max_cell + 0*h*min_cell")
    assert even.number_of_elements() < mesh.number_of_elements() / 2
    with pytest.raises(ValueError, match="cell_size_lower <= cell_size_upper"):
        pv.TetrahedralMesh.from_tree(graded(), 25, 3, 1, 3, 3, 0.5)


def deck(path):
    """{heading line: lines of numbers} of an .inp file."""
    parts = {}
    for line in path.read_text(encoding="ascii").splitlines():
        if line.startswith("*"):
            last = parts.setdefault(line, [])
        elif line[0].isdigit():
            last.append([float(word) for word in line.split(",")])
    return parts


def test_tetrahedra_are_written_with_their_materials(tmp_path):
    mesh = pv.TetrahedralMesh.from_tree(graded(), 25, 2, 0.5, 3, 2)
    mesh.write_to_inp(tmp_path / "own.inp", pv.default_materials, graded())
    mesh.write_to_inp(tmp_path / "other.inp", pv.default_materials, pv.Sphere(pv.Vec3(4, 2, 2), 9, green))
    parts, other = deck(tmp_path / "own.inp"), deck(tmp_path / "other.inp")
    assert numpy.allclose(numpy.array(parts["*NODE, NSET=NALL"])[:, 1:], mesh.nodes, atol=1e-9)
    sets = {name: numpy.array(parts[f"*ELEMENT, TYPE=C3D4, ELSET={name}"], dtype=int) for name in ("RED", "BLUE")}
    places = {name: mesh.cell_centroids[lines[:, 0] - 1, 0].mean() for name, lines in sets.items()}
    assert places["RED"] > 4 > places["BLUE"]
    assert sum(map(len, sets.values())) == mesh.number_of_elements()
    assert (sets["RED"][:, 1:] - 1 == mesh.elements[sets["RED"][:, 0] - 1]).all()
    assert len(other["*ELEMENT, TYPE=C3D4, ELSET=GREEN"]) == mesh.number_of_elements()
    assert "*SOLID SECTION, ELSET=BLUE, MATERIAL=BLUE" in parts
    with pytest.raises(ValueError, match="lie outside the tree"):
        mesh.write_to_inp(tmp_path / "no.inp", pv.default_materials, pv.Sphere())
    assert not (tmp_path / "no.inp").exists()


# Compilers.

def settings(folder, **members):
    made = compilers.SimulationCompilerSettings()
    made.output_directory, made.file_prefix, made.material_defs = str(folder), "bar", pv.default_materials
    for name, value in members.items():
        setattr(made, name, value)
    return made


def stiff():
    """The graded bar with a modulus that grows along it, and a vector."""
    bar = graded()
    bar.set_attribute("modulus", pv.FloatAttribute("100 + 10*x"))
    bar.set_attribute("grain", pv.Vec3Attribute(1, 0, 0))
    return bar


def model_of(root, **members):
    compiler = compilers.SimulationCompiler(root, settings(".", backend=compilers.SimulationBackend.GENERIC, **members))
    compiler.compile()
    assert compiler.written_files() == []
    return compiler.model()


def test_models_hold_arrays():
    model = model_of(stiff(), direct_attributes=["modulus"])
    x = model.cell_centroids[:, 0]
    assert (model.cell_type, model.nodes_per_cell) == (pv.SimulationCellType.HEX8, 8)
    assert model.nodes.shape == (9 * 5 * 5, 3) and model.connectivity.shape == (128 * 8,)
    assert numpy.allclose(model.nodes[model.connectivity].reshape(-1, 8, 3).mean(axis=1), model.cell_centroids)
    assert model.material_names == {red: "red", blue: "blue"}
    assert numpy.allclose(model.volume_fraction_fields[f"volume_fraction_{red}"], x / 8)
    assert numpy.allclose(model.volume_fraction_fields[f"volume_fraction_{blue}"], 1 - x / 8)
    assert numpy.allclose(model.scalar_fields["modulus"], 100 + 10 * x)


def test_draws_follow_odds_and_seed():
    fine = compilers.SimulationHexMeshSettings()
    fine.voxel_size = 0.25
    first, again, other = (model_of(graded(), hex_settings=fine, random_seed=seed).material_ids for seed in (1, 1, 2))
    assert (first == again).all() and (first != other).any()
    assert abs((first == red).mean() - 0.5) < 4 * 0.5 / len(first) ** 0.5  # four standard deviations


def test_models_of_tetrahedra():
    fine = compilers.SimulationTetFixedMeshSettings()
    fine.cell_size = fine.facet_size = 1.5
    model = model_of(stiff(), mesh_kind=compilers.SimulationMeshKind.TET, tet_fixed_settings=fine,
                     direct_attributes=["modulus"])
    cells = model.connectivity.reshape(-1, 4)
    assert model.cell_type is pv.SimulationCellType.TET4
    assert volumes(model.nodes, cells).sum() == pytest.approx(128, rel=1e-3)
    assert numpy.allclose(model.scalar_fields["modulus"], 100 + 10 * model.cell_centroids[:, 0])


def test_decks_are_written(tmp_path):
    reported = []
    compiler = compilers.SimulationCompiler(graded(), settings(tmp_path / "new"))
    compiler.set_progress_callback(reported.append)
    compiler.compile()
    path, = compiler.written_files()
    parts = deck(tmp_path / "new" / "bar.inp")
    assert path == str(tmp_path / "new" / "bar.inp") and reported[-1] == 1
    assert len(parts["*NODE, NSET=NALL"]) == 9 * 5 * 5
    assert sum(len(parts[f"*ELEMENT, TYPE=C3D8, ELSET={name}"]) for name in ("RED", "BLUE")) == 128


@pytest.mark.parametrize("kind", compilers.SimulationMeshKind)
def test_xdmf_is_written(tmp_path, kind):
    h5py = pytest.importorskip("h5py")
    made = settings(tmp_path, backend=compilers.SimulationBackend.FENICSX_XDMF, mesh_kind=kind,
                    direct_attributes=["modulus"])
    compiler = compilers.SimulationCompiler(stiff(), made)
    compiler.compile()
    assert compiler.written_files() == [str(tmp_path / "bar.xdmf"), str(tmp_path / "bar.h5")]
    assert 'Grid Name="OpenVCADMesh"' in (tmp_path / "bar.xdmf").read_text(encoding="utf-8")
    model = model_of(stiff(), mesh_kind=kind, direct_attributes=["modulus"])
    with h5py.File(tmp_path / "bar.h5") as file:
        cells = file["CellData"]
        assert set(cells) == {"material_id", "modulus", f"volume_fraction_{red}", f"volume_fraction_{blue}"}
        assert (cells["material_id"][()] == model.material_ids).all()
        assert (cells["modulus"][()] == model.scalar_fields["modulus"]).all()
    heat = ombre.results(str(tmp_path / "bar.xdmf"), "modulus")
    assert heat.value(model.cell_centroids[:5]) == pytest.approx(100 + 10 * model.cell_centroids[:5, 0])
    if kind is compilers.SimulationMeshKind.TET:
        fields = pv.XDMFFieldLoader.load(tmp_path / "bar.xdmf", grid_name="OpenVCADMesh")
        assert fields.domain.cell_count == len(model.material_ids)
    first = (tmp_path / "bar.h5").read_bytes()
    compiler.compile()
    assert (tmp_path / "bar.h5").read_bytes() == first and len(list(tmp_path.iterdir())) == 2


def test_wrong_settings_say_so(tmp_path):
    def compiled(root=None, **members):
        compilers.SimulationCompiler(root or stiff(), settings(tmp_path, **members)).compile()
    generic = compilers.SimulationBackend.GENERIC
    with pytest.raises(ValueError, match="decks hold materials alone"):
        compiled(direct_attributes=["modulus"])
    with pytest.raises(RuntimeError, match="no node of the tree has the attribute density"):
        compiled(backend=generic, direct_attributes=["density"])
    with pytest.raises(RuntimeError, match="direct attributes are numbers; 'grain' is none"):
        compiled(backend=generic, direct_attributes=["grain"])
    with pytest.raises(ValueError, match="'material_id' cannot be a direct attribute"):
        compiled(backend=generic, direct_attributes=["material_id"])
    with pytest.raises(TypeError, match="mesh_kind: expected a SimulationMeshKind, found str"):
        compiled(mesh_kind="HEX")
    with pytest.raises(RuntimeError, match="needs the backend GENERIC"):
        compilers.SimulationCompiler(stiff(), settings(tmp_path)).model()
    with pytest.raises(RuntimeError, match="call compile()"):
        compilers.SimulationCompiler(stiff(), settings(tmp_path, backend=generic)).model()
    with pytest.raises(AttributeError, match="no member 'random_sed'; it has output_directory"):
        compiled(random_sed=1)
    with pytest.raises(TypeError, match="expected SimulationCompilerSettings, found dict"):
        compilers.SimulationCompiler(stiff(), {})
    assert list(tmp_path.iterdir()) == []


def test_inp_writer(tmp_path):
    path = tmp_path / "bar.inp"
    compilers.InpWriter().write(path, graded(), pv.Vec3(1, 1, 1), pv.default_materials, False)
    parts = deck(path)
    halves = {name: [int(line[0]) - 1 for line in parts[f"*ELEMENT, TYPE=C3D8, ELSET={name}"]]
              for name in ("RED", "BLUE")}
    x = model_of(graded()).cell_centroids[:, 0]
    assert (x[halves["RED"]] > 4).all() and (x[halves["BLUE"]] < 4).all() and len(halves["RED"]) == 64
    compilers.InpWriter().write(path, graded(), 1, pv.default_materials, use_volumetric_dither=True)
    drawn = {int(line[0]) - 1 for line in deck(path)["*ELEMENT, TYPE=C3D8, ELSET=RED"]}
    assert drawn != set(halves["RED"]) and drawn == set(numpy.flatnonzero(model_of(graded()).material_ids == red))


def test_the_manual_runs(capsys):
    """The stress is 5 times the distance from (8, 2, 2), so 20 at the middle, where the modulus is 500."""
    manual = (pathlib.Path(__file__).resolve().parents[2] / "docs" / "user" / "pyvcad.md").read_text(encoding="utf-8")
    script = re.search(r"```python\n(import numpy.*?)```", manual, re.S)[1]
    names = {}
    exec(compile(script, "manual.py", "exec"), names)
    assert capsys.readouterr().out == "1\n"
    assert names["root"].sample(4, 2, 2)[1].get_sample("modulus") == pytest.approx(500, rel=0.02)


PULL = """*STEP
*STATIC
*BOUNDARY
FIXED, 1, 1, 0
{corner}, 2, 3, 0
{other}, 3, 3, 0
PULLED, 1, 1, 0.08
*EL PRINT, ELSET=STEEL_1
S
*END STEP
"""


@pytest.mark.parametrize("kind", compilers.SimulationMeshKind)
def test_calculix_takes_decks(tmp_path, kind):
    """A bar of 8 mm is pulled by 0.08 mm: with a modulus of 1000 MPa and no Poisson's ratio its stress is 10 MPa."""
    if not shutil.which("ccx"):
        pytest.skip("there is no ccx")
    table = tmp_path / "materials.json"
    table.write_text(json.dumps({"materials": [{"name": "steel 1", "r": 1, "g": 2, "b": 3, "a": 255, "modulus_mpa": 1000,
                                                "poissons_ratio": 0}]}), encoding="utf-8")
    bar = pv.RectPrism(pv.Vec3(4, 2, 2), pv.Vec3(8, 4, 4), 1)
    compiler = compilers.SimulationCompiler(bar, settings(tmp_path, mesh_kind=kind, material_defs=pv.MaterialDefs(table)))
    compiler.compile()
    path = tmp_path / "bar.inp"
    nodes = numpy.array(deck(path)["*NODE, NSET=NALL"])
    sets = "".join(f"*NSET, NSET={name}\n" + "".join(f"{n:.0f},\n" for n in nodes[abs(nodes[:, 1] - x) < 1e-3, 0])
                   for name, x in (("FIXED", 0), ("PULLED", 8)))
    corner, other = (1 + numpy.linalg.norm(nodes[:, 1:] - place, axis=1).argmin() for place in ([0, 0, 0], [0, 4, 0]))
    path.write_text(path.read_text(encoding="ascii") + sets + PULL.format(corner=corner, other=other), encoding="ascii")
    subprocess.run(["ccx", "-i", "bar"], cwd=tmp_path, check=True, capture_output=True)
    lines = [line.split() for line in (tmp_path / "bar.dat").read_text(encoding="ascii").splitlines()]
    stresses = numpy.array([[float(word) for word in line[2:]] for line in lines if len(line) == 8])
    assert len(stresses) and numpy.allclose(stresses, [10, 0, 0, 0, 0, 0], atol=0.01)

"""Cells on parts of meshes and on faces of CAD files."""
import math
import pathlib

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_metamaterials as mm


def sheet(bend=None, n=8, side=16.0):
    """Points and triangles of a square sheet, which `bend` moves."""
    at = numpy.linspace(0, side, n + 1)
    points = numpy.stack([*(axis.ravel() for axis in numpy.meshgrid(at, at, indexing="ij")), numpy.zeros((n + 1) ** 2)], axis=-1)
    corners = [(i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1)
               for i in range(n) for j in range(n)]
    triangles = [t for a, b, c, d in corners for t in ((a, b, c), (a, c, d))]
    return (points if bend is None else numpy.array([bend(*p) for p in points])), numpy.array(triangles)


def rolled(x, y, z):
    """A sheet rolled around the y axis with the radius 10."""
    return 10 * math.sin(x / 10), y, 10 * math.cos(x / 10) - 10


def test_flat_patches_of_meshes_have_the_cells_of_boxes():
    surface = pv.TriangleMeshSurface(*sheet(), u_axis_hint=(1, 0, 0))
    cells = mm.cell_map_from_surface(surface, cells=(4, 4, 2), height=6)
    assert [round(c, 9) for c in cells.inverse((6, 10, 1.5))] == [1.5, 2.5, 0.5]
    assert [round(c, 9) for c in cells.forward((1.5, 2.5, 0.5))] == [6, 10, 1.5]
    assert cells.validate().valid
    walls = mm.simple_cubic_plate(cells, wall_thickness=0.4)
    assert walls.evaluate(2, 2, 3.19) < 0 < walls.evaluate(2, 2, 3.21)
    below = mm.cell_map_from_surface(surface, cells=(4, 4, 2), height=-6)
    assert below.inverse((6, 10, -1.5)).z == pytest.approx(0.5, abs=1e-9)


# Rolled, a sheet keeps its lengths; chords of 2 mm on a radius of 10 are 1/600 shorter than their arcs.
def test_rolled_patches_of_meshes_have_the_cells_of_pipes():
    surface = pv.TriangleMeshSurface(*sheet(rolled), u_axis_hint=(1, 0, 0))
    cells = mm.cell_map_from_surface(surface, cells=(4, 4, 1), height=3)
    angle = 0.9
    place = cells.inverse((11.5 * math.sin(angle), 6, 11.5 * math.cos(angle) - 10))
    assert place.x == pytest.approx(angle * 10 / 4, abs=0.02)
    assert (place.y, place.z) == pytest.approx((1.5, 0.5), abs=0.02)
    back = cells.inverse(cells.forward((2.3, 1.1, 0.6)))
    assert tuple(back) == pytest.approx((2.3, 1.1, 0.6), abs=1e-8)
    with pytest.raises(RuntimeError, match="folded"):
        mm.cell_map_from_surface(surface, cells=(4, 4, 1), height=-12)


def test_cells_reach_from_one_patch_to_another():
    upper, triangles = sheet(lambda x, y, z: (x, y, 5 + x / 16))
    cells = mm.cell_map_between_surfaces(pv.TriangleMeshSurface(*sheet(), u_axis_hint=(1, 0, 0)),
                                         pv.TriangleMeshSurface(upper, triangles), cells=(4, 4, 2))
    assert tuple(cells.inverse((8, 6, 2.75))) == pytest.approx((2, 1.5, 1), abs=1e-6)  # 5.5 mm high there
    other = mm.cell_map_between_surfaces(pv.TriangleMeshSurface(upper, triangles), pv.TriangleMeshSurface(*sheet()), (4, 4, 2))
    assert other.inverse((8, 6, 0.02)).z == pytest.approx(2, abs=0.02)


def test_surfaces_without_cells_are_refused():
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    with pytest.raises(RuntimeError, match="closed"):
        pv.TriangleMeshSurface(points, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    with pytest.raises(RuntimeError, match="not there"):
        pv.TriangleMeshSurface(points, [(0, 1, 4)])
    with pytest.raises(RuntimeError, match="no triangles"):
        pv.TriangleMeshSurface([], [])
    with pytest.raises(ValueError, match="lscm, arap, authalic"):
        pv.TriangleMeshSurface(*sheet(), method="best")
    surface = pv.TriangleMeshSurface(*sheet())
    with pytest.raises(ValueError, match="above or below 0"):
        mm.cell_map_from_surface(surface, (1, 1, 1), height=0)
    with pytest.raises(Exception, match="only a single face of a CAD file goes on beyond its border"):
        mm.cell_map_from_surface(surface, (1, 1, 1), height=1, trim="none")
    with pytest.raises(TypeError, match="CADFace or a TriangleMeshSurface"):
        mm.cell_map_from_surface("part.step", (1, 1, 1), height=1)


def box_surface():
    """A cuboid of 2 x 3 x 4 mm: twelve triangles."""
    points = [(x, y, z) for x in (0, 2) for y in (0, 3) for z in (0, 4)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return pv.SurfaceMesh(points, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))])


def test_triangles_are_chosen():
    mesh = box_surface()
    top = mesh.ray_intersection((1, 1, 9), (0, 0, -2))
    assert (top.distance, top.point.z) == (5, 4)
    assert mesh.ray_intersection((5, 5, 9), (0, 0, -1)) is None
    assert mesh.nearest_triangle((1, 1, 5)).point == pv.Vec3(1, 1, 4)
    assert mesh.nearest_vertex((1.9, 2.8, 4.5)) == 7
    face = mesh.select_linked_by_face_angle(seed_triangle=top.triangle_id, max_angle_degrees=10)
    assert (face.triangle_count, face.area, len(face.boundary_edges())) == (2, 6, 4)
    assert mesh.select_linked(seed_triangle=0).triangle_count == 12
    assert mesh.select_linked(seed_triangle=0).area == pytest.approx(2 * (6 + 8 + 12))
    assert face.grown(1).shrunk(1).triangle_ids == face.triangle_ids
    labels = [0] * 6 + [1] * 6
    assert mesh.select_linked_constrained(seed_triangle=0, triangle_regions=labels).triangle_count <= 6
    loop = face.boundary_edges()
    assert mesh.select_enclosed_region(loop, top.triangle_id).triangle_ids == face.triangle_ids
    assert mesh.select_enclosed_region(loop, 0).triangle_count == 10
    with pytest.raises(RuntimeError, match="no closed loop"):
        mesh.select_enclosed_region(loop[:2], 0)
    path = mesh.shortest_surface_path(0, 4)
    assert path.edges == [(0, 4)] and path.length == 2
    assert mesh.select_by_geodesic_radius(0, radius=100).triangle_count == 12
    assert mesh.select_by_geodesic_radius(0, radius=0.5).triangle_count == 0
    with pytest.raises(ValueError, match="there is no triangle 40"):
        mesh.select_triangles([40])
    cells = mm.cell_map_from_surface(face.to_triangle_mesh_surface(u_axis_hint=(1, 0, 0)), cells=(2, 3, 1), height=1)
    assert tuple(cells.inverse((0.5, 1, 4.5))) == pytest.approx((0.5, 1, 0.5), abs=1e-9)


# tests/cad/cylinder.step is a cylinder of radius 5 and height 20 around the z axis.
def test_cells_lie_on_faces_of_cad_files():
    model = pv.CADModel.from_step(pathlib.Path(__file__).parents[1] / "cad" / "cylinder.step")
    assert len(model.faces) == 3 and [face.index for face in model.faces] == [0, 1, 2]
    (side,) = model.select_faces(surface_type="cylinder")
    assert side.area == pytest.approx(2 * math.pi * 5 * 20, rel=1e-3)
    lids = model.select_faces(surface_type="plane")
    assert [face.area for face in lids] == pytest.approx([math.pi * 25] * 2, rel=2e-3)
    (upper,) = model.select_faces(normal=(0, 0, 2), min_dot=0.9)
    assert upper.normal.z == pytest.approx(1) and upper.centroid.z == pytest.approx(upper.bounding_box[1].z)
    assert model.select_faces(area_range=(100, 1000)) == [side]
    assert upper in model.select_faces(bounding_box_intersection=(upper.centroid - pv.Vec3(1, 1, 1), upper.centroid))
    assert [face.index for face in model.select_faces(indices=[1])] == [1]
    layer = mm.cell_map_from_cad_face(side, cells=(12, 5, 1), height=2)
    for angle in (0.3, 2.0, 4.5):
        place = layer.inverse((5.5 * math.cos(angle), 5.5 * math.sin(angle), side.centroid.z + 2))
        assert place.z == pytest.approx(0.25, abs=0.02)
    there = layer.forward((3.3, 2.2, 0.5))
    assert math.hypot(there.x, there.y) == pytest.approx(6, abs=0.02)
    assert tuple(layer.inverse(there)) == pytest.approx((3.3, 2.2, 0.5), abs=1e-8)
    both = mm.cell_map_from_cad_face(lids, cells=(3, 3, 1), height=-1)
    assert len(both.maps) == 2 and mm.simple_cubic_plate(both, wall_thickness=9).evaluate(
        1, 1, upper.centroid.z - 0.5) < 0
    assert model.to_node().evaluate(0, 0, side.centroid.z) < 0
    # The square around the disc has corners at 5 sqrt(2), where the disc has no cells.
    corner = (4.8, 4.8, upper.centroid.z + 0.5)
    for trim, sign in (("none", -1), ("boundary", 1)):
        square = mm.cell_map_from_cad_face(upper, cells=(3, 3, 1), height=1, trim=trim)
        assert sign * mm.simple_cubic_plate(square, wall_thickness=9).evaluate(*corner) > 0

    class Shape:  # what is used of a shape of CadQuery
        def exportStep(self, path):
            model.write_step(path)
    assert len(pv.CADModel.from_cadquery(Shape()).faces) == 3
    with pytest.raises(TypeError, match="CadQuery"):
        pv.CADModel.from_cadquery(3)
    with pytest.raises(FileNotFoundError):
        pv.CADModel.from_step("nothing.step")


# The bottom and the top of that cylinder are parallel planes, 20 mm apart.
def test_cells_reach_from_one_cad_face_to_another():
    model = pv.CADModel.from_step(pathlib.Path(__file__).parents[1] / "cad" / "cylinder.step")
    (lower,), (upper,) = (model.select_faces(normal=(0, 0, z), min_dot=0.9) for z in (-1, 1))
    start = lower.centroid.z
    cells = mm.cell_map_between_cad_faces(lower, upper, cells=(4, 4, 2))
    for x, y, z in ((1, 2, 3), (-2, 0.5, 11), (0, -3, 19)):
        place = cells.inverse((x, y, start + z))
        assert place.z == pytest.approx(z / 10, abs=1e-6)
        assert sorted((min(place.x, 4 - place.x), min(place.y, 4 - place.y))) == pytest.approx(
            sorted((2 - abs(x) / 2.5, 2 - abs(y) / 2.5)), abs=0.01)  # 2.5 mm long; directions are those of the face
    assert abs(cells.jacobian_determinant((2.2, 1.7, 0.5))) == pytest.approx(2.5 * 2.5 * 10, rel=0.01)
    assert tuple(cells.inverse(cells.forward((1.5, 2.5, 0.5)))) == pytest.approx((1.5, 2.5, 0.5), abs=1e-8)
    same = pv.CellMap.between_cad_faces(upper, lower, (4, 4, 2))
    assert same.inverse((1, 2, start + 3)).z == pytest.approx(1.7, abs=1e-6)
    # A patch of a mesh above the top.
    disc = [(0, 0, start + 26)] + [(3 * math.cos(k * math.pi / 16), 3 * math.sin(k * math.pi / 16), start + 26) for k in range(32)]
    patch = pv.TriangleMeshSurface(disc, [(0, 1 + k, 1 + (k + 1) % 32) for k in range(32)])
    both = mm.cell_map_between_surfaces(upper, patch, cells=(2, 2, 1))
    assert both.inverse((0.4, 0.3, start + 23)).z == pytest.approx(0.5, abs=1e-3)
    (side,) = model.select_faces(surface_type="cylinder")
    with pytest.raises(RuntimeError, match="cell_map_between_cad_faces"):
        mm.cell_map_between_cad_faces(lower, side, cells=(4, 4, 2))
    with pytest.raises(ValueError, match="auto_align=False"):
        mm.cell_map_between_cad_faces(lower, upper, cells=(4, 4, 2), flip_u=True)
    with pytest.raises(TypeError, match="two CADFaces"):
        mm.cell_map_between_cad_faces(lower, patch, cells=(4, 4, 2))
    with pytest.raises(pv.MissingFeature, match="flip_u"):
        mm.cell_map_between_cad_faces(lower, upper, cells=(4, 4, 2), first_origin=(0, 0, 0))


def test_rims_run_along_borders():
    cells = mm.cell_map_from_surface(pv.TriangleMeshSurface(*sheet(), u_axis_hint=(1, 0, 0)), cells=(4, 4, 1), height=2)
    band = mm.rim(cells, width=1.5)
    for x, inside in ((1.4, True), (1.6, False), (14.4, False), (14.6, True)):
        assert (band.evaluate(x, 8, 1) < 0) == inside
        assert (band.evaluate(8, x, 1) < 0) == inside
    assert band.evaluate(1, 8, 2.1) > 0
    with pytest.raises(ombre.DesignError, match="no surface with a border"):
        mm.rim(mm.rectangular_cell_map((pv.Vec3(0, 0, 0), pv.Vec3(9, 9, 9)), cells=(3, 3, 3)), width=1).evaluate(0, 0, 0)


cylinder = str(pathlib.Path(__file__).parent.parent / "cad" / "cylinder.step")  # radius 5, 20 mm high


def test_points_of_maps_on_surfaces():
    """A cylinder of radius 5 and height 20; 8 cells are the whole way round, and a cell is 1 high."""
    side = next(face for face in pv.CADModel.from_step(cylinder).select_faces(surface_type="cylinder"))
    around = mm.cell_map_from_cad_face(side, cells=(8, 2, 1), height=1)
    for place, wanted in [((0, 0, 0.5), (5.5, 0, 0)), ((2, 1, 0.5), (0, 5.5, 10)), ((8, 2, 1), (6, 0, 20)), ((4, 2, 0), (-5, 0, 20))]:
        assert numpy.allclose(list(around.forward(pv.Vec3(*place))), wanted, atol=5e-3), place  # of its triangles
    square = mm.cell_map_from_surface(pv.TriangleMeshSurface(*sheet(side=10.0)), cells=(3, 3, 1), height=1.5)
    assert numpy.allclose(list(square.forward(pv.Vec3(1.5, 1.5, 0.5))), [5, 5, 0.75], atol=1e-6)
    with pytest.raises(RuntimeError, match=r"no point at \(-5, 0, 0\) of its map"):
        square.forward(pv.Vec3(-5, 0, 0))


@pytest.mark.parametrize("height", [1.0, -1.0])
def test_reports_of_maps_count_cells(height):
    side = next(face for face in pv.CADModel.from_step(cylinder).select_faces(surface_type="cylinder"))
    report = mm.cell_map_from_cad_face(side, cells=(8, 2, 1), height=height).validate()
    assert report.valid and (report.active_element_count, report.inverted_cell_count, report.trimmed_element_count) == (16, 0, 0)
    # A cell is an eighth of the way round at radius 5 to 6, or to 4, by 10 by 1.
    radii = sorted((5.0, 5 + height))
    least, most = sorted((abs(report.minimum_jacobian_determinant), abs(report.maximum_jacobian_determinant)))
    assert radii[0] <= least * 8 / (20 * math.pi) <= most * 8 / (20 * math.pi) <= radii[1]
    assert (report.minimum_jacobian_determinant > 0) == (height > 0)


def test_faces_that_do_not_exist_are_errors():
    model = pv.CADModel.from_step(cylinder)
    with pytest.raises(ValueError, match="expected plane, cylinder, .*, found 'cylindre'"):
        model.select_faces(surface_type="cylindre")
    with pytest.raises(ValueError, match="there is no face 999; the model has 3"):
        model.select_faces(indices=[999])

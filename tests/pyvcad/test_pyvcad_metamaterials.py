"""Lattices in the cells of maps: densities, places and values that mathematics gives."""
import math

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_metamaterials as mm


def box(n=3, side=9.0):
    return mm.rectangular_cell_map((pv.Vec3(0, 0, 0), pv.Vec3(side, side, side)), cells=(n, n, n))


def share(node, low, high, count=40):
    """The share of a box that is inside, by points off all planes of symmetry."""
    axes = [a + (b - a) * (numpy.arange(count) + off) / count for a, b, off in zip(low, high, (0.31, 0.43, 0.57))]
    points = numpy.stack(numpy.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return float((node._design().distance(points) <= 0).mean())


# Areas in a cell of side one by Schroeder-Turk, Fogden, Hyde 2006, and the Euler characteristics of the surfaces in it.
@pytest.mark.parametrize("name, area, euler", [("gyroid", 3.0915, -8), ("schwarz_p", 2.3451, -4), ("schwarz_d", 3.8378, -16)])
def test_walls_of_surfaces_have_the_volume_of_steiners_formula(name, area, euler):
    t = 0.05
    wall = getattr(mm, name)(box(3), wall_thickness=3 * t)
    expected = area * t + 2 * math.pi * euler * t ** 3 / 12
    assert share(wall, (0, 0, 0), (9, 9, 9), 90) == pytest.approx(expected, rel=0.04)  # as docs/user/lattices.md promises
    assert wall.evaluate(-0.1, 4, 4) > 0  # it is cut to the region of the map


def test_all_surfaces_and_their_sides():
    cells = box(2, 8.0)
    for name in mm.TPMS_NAMES:
        wall = mm.tpms(cells, name, wall_thickness=0.4)
        assert 0.08 < share(wall, (0, 0, 0), (8, 8, 8)) < 0.6, name
    half = mm.gyroid(cells, mode="solid")
    assert share(half, (0, 0, 0), (8, 8, 8)) == pytest.approx(0.5, abs=0.01)
    more = mm.schwarz_p(cells, mode="solid", level=0.5)
    assert share(more, (0, 0, 0), (8, 8, 8)) > 0.6
    with pytest.raises(TypeError, match="wall_thickness=0.5"):
        mm.gyroid(cells)
    with pytest.raises(ValueError, match="expected one of gyroid"):
        mm.tpms(cells, "giroid", wall_thickness=1)


# Lengths of struts in a cell of side one: 3, 4 sqrt 3, 6 sqrt 2, 12 sqrt 2, 6 sqrt 2 and 4 sqrt 3.
@pytest.mark.parametrize("name, length", [("cubic", 3), ("bcc", 4 * 3 ** 0.5), ("fcc", 6 * 2 ** 0.5), ("octet", 12 * 2 ** 0.5),
                                          ("kelvin", 6 * 2 ** 0.5), ("diamond", 4 * 3 ** 0.5)])
def test_thin_struts_fill_their_length_times_their_section(name, length):
    lattice = getattr(mm, name)(box(2, 8.0), beam_radius=0.16)
    thin = math.pi * 0.04 ** 2 * length
    # Joints overlap, so that the share is a little less: by a few radii of each strut's length.
    assert 0.82 * thin < share(lattice, (0, 0, 0), (8, 8, 8), 100) < 1.01 * thin


def test_a_graph_of_ones_own_is_the_cell_of_that_name():
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    own = mm.graph_lattice(box(), pv.GraphUnitCell([(0.5, 0.5, 0.5), *corners], [(0, n) for n in range(1, 9)]), 0.4)
    known = mm.bcc(box(), 0.4)
    points = numpy.random.default_rng(1).uniform(0, 9, (400, 3))
    assert numpy.allclose(own._design().distance(points), known._design().distance(points), atol=1e-9)


def test_struts_without_mirror_planes_reach_into_the_neighbours():
    # A single diagonal per cell, whose ends meet the next cell's: the distance to the line x = y = z.
    diagonal = mm.graph_lattice(box(), pv.GraphUnitCell([(0, 0, 0), (1, 1, 1)], [(0, 1)]), beam_radius=0.5)
    off = numpy.array([1.0, -1.0, 0.0]) * (0.4 / 2 ** 0.5)
    assert diagonal.evaluate(*(numpy.array([3.0, 3.0, 3.0]) + off)) == pytest.approx(-0.1, abs=1e-9)
    assert diagonal.evaluate(*(numpy.array([4.4, 4.4, 4.4]) + off)) == pytest.approx(-0.1, abs=1e-9)
    # Along the border of cells an edge is half in each of four; all of them have it, though one lists it.
    upright = mm.graph_lattice(box(), pv.GraphUnitCell([(0, 0, 0), (0, 0, 1)], [(0, 1)]), beam_radius=0.5)
    for x, y in ((3.3, 3), (2.7, 3), (3, 2.7), (3, 3.3)):
        assert upright.evaluate(x, y, 4.2) == pytest.approx(-0.2, abs=1e-9)


def test_joints_have_a_radius_of_their_own():
    plain, jointed = mm.bcc(box(), 0.3), mm.bcc(box(), 0.3, node_radius=0.8)
    assert plain.evaluate(4.5, 4.5, 5.2) > 0 > jointed.evaluate(4.5, 4.5, 5.2)
    assert jointed.evaluate(3, 3, 3.7) == pytest.approx(-0.1, abs=1e-9)
    with pytest.raises(ombre.DesignError, match="no map of cells"):
        ombre.lattice("bcc", (5, 5, 5), 0.3, joint=0.5)


def test_plates_fill_what_the_planes_leave():
    assert share(mm.simple_cubic_plate(box(), wall_thickness=0.3), (0, 0, 0), (9, 9, 9), 60) == pytest.approx(
        1 - 0.9 ** 3, abs=2e-3)
    both = mm.cubic_octet_plate(box(), 0.3, 0.2)
    octet = (4.5, 4.5 + 0.05, 4.5)  # near a plane u + v + w = whole number + 1/2: not one of the octet
    assert both.evaluate(*octet) > 0 and both.evaluate(3.1, 4, 4.4) < 0 and both.evaluate(3.5, 3.5, 5.02) < 0


def test_reentrant_hexagons_have_the_walls_of_their_angle():
    ratio = mm.reentrant_hex_prism_reference_aspect_ratio(angle_degrees=-30, rib_ratio=2)
    assert ratio == pytest.approx(math.cos(math.pi / 6) / 1.5)
    u, v = 3 * ratio, 3.0  # the slanted walls are 1 mm long and the others 2
    cells = mm.rectangular_cell_map((pv.Vec3(0, 0, 0), pv.Vec3(4 * u, 4 * v, 2)), cells=(4, 4, 1))
    honeycomb = mm.reentrant_honeycomb(cells, wall_thickness=0.1, angle_degrees=-30, rib_ratio=2)
    # A cell of u v has two walls of length 2 and four of length 1, which overlap where three meet at 60 or 120 degrees.
    walls = 0.1 * (2 * 2 + 4 * 1) / (u * v)
    assert share(honeycomb, (0, 0, 0), (4 * u, 4 * v, 2), 80) == pytest.approx(walls, rel=0.06)


def test_thickness_follows_fields_of_the_map():
    cells = box()
    graded = mm.simple_cubic_plate(cells, cells.logical_position.x.map_range(0, 3, 0.4, 1.0))
    # The wall at z = 3 is 0.7 thick at x = 4.5, and 0.9 at x = 7.5.
    assert graded.evaluate(4.5, 4.5, 3.34) < 0 < graded.evaluate(4.5, 4.5, 3.36)
    assert graded.evaluate(7.5, 4.5, 3.44) < 0 < graded.evaluate(7.5, 4.5, 3.46)
    struts = mm.cubic(cells, beam_radius=0.3 + 0.1 * cells.w_field)
    assert struts.evaluate(3 + 0.44, 3, 4.5) < 0 < struts.evaluate(3 + 0.46, 3, 4.5)


def test_thickness_alternates_from_cell_to_cell():
    cells = box()
    odd = pv.DerivedFloatAttribute("(i + j + k) % 2", {"i": cells.cell_index.x, "j": cells.cell_index.y, "k": cells.cell_index.z})
    walls = mm.simple_cubic_plate(cells, 0.2 + 0.4 * odd)
    assert walls.evaluate(1.5, 1.5, 0.2) > 0 > walls.evaluate(1.5, 1.5, 3.2)


def test_attributes_take_places_of_the_map():
    cells = box()
    lattice = mm.gyroid(cells, mode="solid", level=9)  # all of the box
    lattice.set_attribute("across", pv.FloatAttribute("x"), coordinates="map")
    lattice.set_attribute("inside", pv.FloatAttribute("10*z"), coordinates="cell")
    lattice.set_attribute("number", pv.FloatAttribute("x + 10*y + 100*z"), coordinates="cell_index")
    lattice.set_attribute("colour", pv.Vec4Attribute("x", 0, 0, 1), coordinates="map")
    _, samples = lattice.sample(4.5, 1.5, 7.5)
    assert samples.get_sample("across") == pytest.approx(0.5) and samples.get_sample("inside") == pytest.approx(5)
    assert samples.get_sample("number") == pytest.approx(201) and samples.get_sample("colour")[0] == pytest.approx(0.5)
    with pytest.raises(ValueError, match='"map", "cell" or "cell_index"'):
        lattice.set_attribute("a", pv.FloatAttribute(1), coordinates="world")
    phase, index = cells.unit_cell_phase.sample(4, 5, 8.5), cells.cell_index.sample(4, 5, 8.5)
    assert phase == pytest.approx([1 / 3, 2 / 3, 8.5 / 3 - 2]) and index == pytest.approx([1, 1, 2])


def test_struts_have_attributes_and_materials_of_their_own():
    red, blue = pv.default_materials.id("red"), pv.default_materials.id("blue")
    lattice = mm.cubic(box(), beam_radius=0.4)
    lattice.set_attribute("modulus", pv.FloatAttribute(10))
    upright = lattice.struts.where(lambda strut: abs(strut.direction.z) > 0.9)
    assert len(upright) == 8  # the halves of four edges of the cell
    upright.set_attribute("modulus", pv.FloatAttribute("200 + z"))
    assert lattice.sample(3, 3, 4.5)[1].get_sample("modulus") == pytest.approx(204.5)
    assert lattice.sample(4.5, 3, 3)[1].get_sample("modulus") == pytest.approx(10)
    cell = pv.GraphUnitCell([(0.5, 0.5, 0), (0.5, 0.5, 1), (0, 0.5, 0.5), (1, 0.5, 0.5)], [(0, 1), (2, 3)],
                            edge_tags=[7, 8], material_tags=[red, blue])
    cross = mm.graph_lattice(box(), cell, 0.3)
    cross.struts.with_tag(8).set_attribute("tag", pv.FloatAttribute(8))
    assert cross.distribution(1.5, 1.5, 0.5) == {red: 1.0} and cross.distribution(0.5, 1.5, 1.5) == {blue: 1.0}
    assert cross.sample(0.5, 1.5, 1.5)[1].get_sample("tag") == 8
    assert set(cross.material_list()) >= {red, blue}


def test_position_along_struts_and_depth_in_walls_are_values():
    lattice = mm.bcc(box(), beam_radius=0.3)
    lattice.set_attribute("along", lattice.component_parameter)
    quarter = [4.5 + 0.5 * 1.5] * 3  # from the centre of a cell to its corner
    assert lattice.sample(*quarter)[1].get_sample("along") == pytest.approx(0.5, abs=1e-6)
    walls = mm.gyroid(box(), wall_thickness=0.6)
    walls.shell.set_attribute("depth", pv.FloatAttribute("-d"))
    distance, samples = walls.sample(3, 3, 3)  # on the middle surface
    assert samples.get_sample("depth") == pytest.approx(-distance) and distance == pytest.approx(-0.3)


def test_cells_change_from_one_surface_into_another():
    cells = box(2, 8.0)
    weight = mm.ramp(0, 8, axis="x")
    mixed = mm.tpms(cells, pv.ImplicitUnitCell.mixed("gyroid", "schwarz_p", weight), wall_thickness=0.5)
    # On the planes x = 0 and x = 8 it is one of them: with the weight w the function is (1 - w) g + w p.
    middle = (4.0, 1.0, 2.5)
    u, v, w = (2 * math.pi * c / 4 for c in middle)
    g = math.sin(u) * math.cos(v) + math.sin(v) * math.cos(w) + math.sin(w) * math.cos(u)
    p = math.cos(u) + math.cos(v) + math.cos(w)
    wall = mm.tpms(cells, pv.ImplicitUnitCell.mixed("gyroid", "schwarz_p", weight), mode="solid", level=(g + p) / 2 + 1e-3)
    other = mm.tpms(cells, pv.ImplicitUnitCell.mixed("gyroid", "schwarz_p", weight), mode="solid", level=(g + p) / 2 - 1e-3)
    assert wall.evaluate(*middle) < 0 < other.evaluate(*middle)
    for constant, name in ((0.0, "gyroid"), (1.0, "schwarz_p")):
        pure = mm.tpms(cells, pv.ImplicitUnitCell.mixed("gyroid", "schwarz_p", constant), wall_thickness=0.5)
        points = numpy.random.default_rng(2).uniform(0.5, 7.5, (50, 3))
        known = mm.tpms(cells, name, wall_thickness=0.5)
        assert numpy.allclose(pure._design().distance(points), known._design().distance(points), atol=2e-3)
    assert 0.1 < share(mixed, (0, 0, 0), (8, 8, 8)) < 0.5


def test_functions_and_formulas_are_cells():
    by_formula = pv.ImplicitUnitCell("cos(2*pi*u) + cos(2*pi*v) + cos(2*pi*w)", name="own")
    by_function = pv.ImplicitUnitCell(lambda u, v, w: sum(math.cos(2 * math.pi * c) for c in (u, v, w)))
    known = mm.schwarz_p(box(), wall_thickness=0.4)
    points = numpy.random.default_rng(3).uniform(0.5, 8.5, (30, 3))
    expected = known._design().distance(points)
    assert by_formula.validate_periodicity() and by_function.validate_periodicity()
    assert not pv.ImplicitUnitCell("u + v").validate_periodicity()
    for cell, tolerance in ((by_formula, 1e-9), (by_function, 2e-3)):
        assert numpy.allclose(mm.tpms(box(), cell, wall_thickness=0.4)._design().distance(points), expected, atol=tolerance)


def test_bodies_are_mixed_by_weights_and_regions():
    left, right = pv.Sphere(pv.Vec3(0, 0, 0), 4), pv.Sphere(pv.Vec3(0, 0, 0), 8)
    left.set_attribute("density", pv.FloatAttribute(1))
    right.set_attribute("density", pv.FloatAttribute(3))
    both = mm.mix(left, right, 0.25)
    assert both.evaluate(5, 0, 0) == pytest.approx(0, abs=1e-9)  # 0.75 * 1 + 0.25 * -3
    assert both.sample(1, 0, 0)[1].get_sample("density") == pytest.approx(1.5)
    region = pv.RectPrism(pv.Vec3(-10, 0, 0), pv.Vec3(20, 40, 40))  # all below x = 0
    banded = mm.mix(left, right, region=region, half_width=2.0)
    assert banded.evaluate(-5, 0, 0) == pytest.approx(1) and banded.evaluate(6, 0, 0) == pytest.approx(-2)
    assert banded.evaluate(0, 6, 0) == pytest.approx(0, abs=1e-9)  # the middle of the band
    # Struts turn into walls; where one has all the weight, it is unchanged.
    cells = box(3, 12.0)
    struts, walls = mm.bcc(cells, beam_radius=0.5), mm.gyroid(cells, wall_thickness=0.6)
    whole = mm.mix(struts, walls, mm.ramp(4, 8, axis="x"))
    points = numpy.random.default_rng(4).uniform((0, 0, 0), (12, 12, 12), (300, 3))
    for only, kept in ((struts, points[:, 0] < 4), (walls, points[:, 0] > 8)):
        assert (whole._design().distance(points[kept]) == only._design().distance(points[kept])).all()
    with pytest.raises(TypeError, match="either a weight"):
        mm.mix(left, right)


def test_ramps():
    line = mm.ramp(2, 6, axis="y")
    assert [line.sample(0, y, 0) for y in (0, 3, 9)] == pytest.approx([0, 0.25, 1])
    assert mm.ramp(2, 6, axis="z", smooth=True).sample(0, 0, 3) == pytest.approx(3 / 16 - 2 / 64)
    along = mm.ramp(0, 3, axis="u", coordinates=box().logical_position)
    assert along.sample(4.5, 0, 0) == pytest.approx(0.5)


def test_maps_of_pipes_and_balls_go_there_and_back():
    pipe = mm.cylindrical_cell_map(center=pv.Vec3(1, 2, 3), inner_radius=8, outer_radius=10, height=20, axis=pv.Vec3(0, 1, 0),
                                   reference_direction=pv.Vec3(0, 0, 1), cells=(12, 4, 2))
    ball = mm.spherical_cell_map(inner_radius=8, outer_radius=12, latitude_bounds_degrees=(-30, 60), cells=(8, 3, 2))
    for cells in (pipe, ball):
        place = (2.3, 1.7, 0.6)
        assert cells.inverse(cells.forward(place)) == pytest.approx(place, abs=1e-9)
        report = cells.validate()
        assert report.valid and report.inverted_cell_count == 0 and report.active_element_count == math.prod(cells.cells)
    # A cell of the pipe is r dphi, 5 and 1 mm long.
    r, step = 8 + 0.6, 2 * math.pi / 12
    assert sorted(pipe.principal_stretches((2.3, 1.7, 0.6))) == pytest.approx(sorted([r * step, 5, 1]))
    assert pipe.jacobian_determinant((2.3, 1.7, 0.6)) == pytest.approx(r * step * 5)
    x, y, z = pipe.forward((3, 0, 0))  # a quarter around the axis y from z: towards x
    assert (x, y, z) == pytest.approx((1 + 8, 2 - 10, 3))
    sized = mm.cylindrical_cell_map(inner_radius=8, outer_radius=10, height=20, arc_count=12, axial_cell_size=6,
                                    radial_cell_size=1)
    assert sized.cells == (12, 4, 2) and sized.periodic_axes == "u"
    cells = mm.rectangular_cell_map((pv.Vec3(0, 0, 0), pv.Vec3(10, 9, 4)), cell_size=pv.Vec3(4, 3, 5))
    assert cells.cells == (3, 3, 1) and cells.bounds[1] == pv.Vec3(10, 9, 4)
    vector = mm.rectangular_cell_map((pv.Vec3(0, 0, 0), pv.Vec3(8, 8, 8)), cells=(2, 2, 2)).to_cell_frame(pv.Vec3Attribute(1, 2, 0))
    assert vector.sample(1, 1, 1) == pytest.approx([0.25, 0.5, 0])
    with pytest.raises(TypeError, match="either cells or their size"):
        mm.rectangular_cell_map((pv.Vec3(0, 0, 0), pv.Vec3(1, 1, 1)))


def test_struts_around_a_pipe_lie_on_its_circles():
    pipe = mm.cylindrical_cell_map(inner_radius=8, outer_radius=10, height=20, cells=(12, 4, 1))
    rings = mm.cubic(pipe, beam_radius=0.3)
    for degrees in (0, 15, 40, 200):
        x, y = 8.2 * math.cos(math.radians(degrees)), 8.2 * math.sin(math.radians(degrees))
        assert rings.evaluate(x, y, 5.0) < 0, degrees
    assert rings.evaluate(9 * math.cos(0.2), 9 * math.sin(0.2), 2.5) > 0


# Whole numbers of the new map lie at equal steps of the integral of 1/(1 + s), if a cell is 1 + s of its own lengths long.
def test_spacing_follows_a_scale():
    cells, c = box(3, 9.0), 0.8
    closer = mm.warp_cell_map(cells, u_scale=cells.u_field.map_range(0, 3, 0, c))
    for k in (0, 1, 2, 3):
        border = 9 * ((1 + c) ** (k / 3) - 1) / c
        assert closer.inverse((border, 4, 4)) == pytest.approx([k, 4 / 3, 4 / 3], abs=1e-4)
    assert closer.forward((1, 1, 1)) == pytest.approx((9 * ((1 + c) ** (1 / 3) - 1) / c, 3, 3), abs=1e-3)
    walls = mm.simple_cubic_plate(closer, 0.2)
    border = 9 * ((1 + c) ** (2 / 3) - 1) / c
    assert walls.evaluate(border, 4.5, 4.5) == pytest.approx(-0.1, abs=2e-3)
    # A scale that changes across, too: s = c v/3 is the same along u, so borders along u stay.
    across = mm.warp_cell_map(cells, u_scale=pv.FloatAttribute("x*y/200"))
    y = 6.0
    k = across.inverse((4.0, y, 4.0))[0]
    assert k == pytest.approx(3 * math.log(1 + 4 * y / 200) / math.log(1 + 9 * y / 200), abs=1e-6)
    with pytest.raises(ValueError, match="above -1"):
        mm.warp_cell_map(cells, v_scale=pv.FloatAttribute("-y"))


def test_lattices_fill_shapes_and_are_cut_by_them():
    ball = pv.Sphere(pv.Vec3(4.5, 4.5, 4.5), 4)
    infill = pv.Union(0.0, [pv.Intersection(ball, mm.gyroid(box(), wall_thickness=0.4)), pv.Shell(0.5, ball)])
    assert infill.evaluate(4.5, 4.5, 0.6) < 0 and infill.evaluate(8.9, 8.9, 8.9) > 0
    two = pv.CellMapCollection([box(), mm.rectangular_cell_map((pv.Vec3(20, 0, 0), pv.Vec3(29, 9, 9)), cells=(3, 3, 3))])
    joined = mm.bcc(two, 0.4)
    assert joined.evaluate(4.5, 4.5, 4.5) < 0 and joined.evaluate(24.5, 4.5, 4.5) < 0
    copy = joined.clone()
    assert copy.evaluate(4.5, 4.5, 4.5) == joined.evaluate(4.5, 4.5, 4.5)


def test_cells_of_struts_are_counted():
    bcc = mm.properties.characterize_graph_cell("bcc", cell_size=4.0, beam_radius=0.25)
    assert (bcc.node_count, bcc.strut_count, bcc.component_count, bcc.cycle_rank) == (9, 8, 1, 0)
    assert bcc.degree_histogram == {1: 8, 8: 1} and bcc.mean_length == pytest.approx(2 * 3 ** 0.5)
    assert bcc.mean_aspect_ratio == pytest.approx(2 * 3 ** 0.5 / 0.5)
    assert bcc.mean_slenderness_ratio == pytest.approx(4 * bcc.mean_aspect_ratio)


def test_points_keep_their_distance_and_fill_the_body():
    ball = pv.Sphere(pv.Vec3(1, 2, 3), 6)
    points = mm.sample_points_in_host(ball, spacing=2.0, seed=4, boundary_clearance=0.5)
    again = mm.sample_points_in_host(ball, spacing=2.0, seed=4, boundary_clearance=0.5)
    array = numpy.array(points)
    assert numpy.array_equal(array, numpy.array(again)) and points.candidate_count == len(points) + points.rejected_count
    gaps = numpy.linalg.norm(array[:, None] - array[None], axis=2) + 99 * numpy.eye(len(array))
    assert gaps.min() >= 2.0 and numpy.linalg.norm(array - (1, 2, 3), axis=1).max() <= 5.5
    # No place is farther than the distance from all points once no point fits; a few candidates find such places last.
    inside = numpy.random.default_rng(9).normal(size=(2000, 3))
    inside *= (5.5 * numpy.random.default_rng(8).uniform(size=(2000, 1)) ** (1 / 3)) / numpy.linalg.norm(inside, axis=1)[:, None]
    nearest = numpy.linalg.norm(inside[:, None] + (1, 2, 3) - array[None], axis=2).min(axis=1)
    assert (nearest > 2.0).mean() < 0.01
    dense = mm.sample_points_in_host(pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(10, 10, 10)), density=0.2, seed=1)
    assert len(dense) == 200
    graded = mm.sample_points_in_host(pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(20, 8, 8)), spacing=pv.FloatAttribute("2.5 + x/10"))
    x = numpy.array(graded)[:, 0]
    assert (x < 0).sum() > 1.5 * (x > 0).sum()
    with pytest.raises(TypeError, match="either a spacing or a density"):
        mm.sample_points_in_host(ball)


def test_struts_lie_between_scattered_points():
    block = pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(10, 10, 10))
    points = mm.sample_points_in_host(block, spacing=3.0, seed=2)
    array = numpy.array(points)
    edges = mm.delaunay_graph_lattice(block, points, beam_thickness=0.6)
    assert all(edges.evaluate(*p) <= 0 for p in array.tolist())
    cells = mm.voronoi_graph_lattice(block, points, beam_thickness=0.6, node_radius=0.5)
    low, high = cells.bounding_box()
    assert max(*high) <= 5 + 1e-6 and min(*low) >= -5 - 1e-6
    # An edge of Voronoi cells is as far from three points as from any other.
    edge = ombre.voronoi_edges(array)[0]
    middle = edge.mean(axis=0)
    distances = numpy.sort(numpy.linalg.norm(array - middle, axis=1))
    assert distances[2] - distances[0] < 1e-6
    if numpy.abs(middle).max() < 4.5:
        assert cells.evaluate(*middle.tolist()) == pytest.approx(-0.3, abs=1e-6)


# Eight points around the middle have the axes as the edges of their cells. In the plane z = 0, the point (s, s, 0) is s away
# from two axes and s sqrt(2) from the third: with the radius 0.5 and the fillet 1 the surface is at s = 0.831.
def test_seams_of_random_struts_have_fillets():
    block = pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(8, 8, 8))
    points = [pv.Vec3(x, y, z) for x in (-2, 2) for y in (-2, 2) for z in (-2, 2)]
    sharp = mm.voronoi_graph_lattice(block, points, beam_thickness=1)
    round_ = mm.voronoi_graph_lattice(block, points, beam_thickness=1, member_blend_radius=1.0)
    s = 0.83
    assert sharp.evaluate(s, s, 0) == pytest.approx(s - 0.5)
    known = 1 - math.sqrt(2 * (1.5 - s) ** 2 + (1.5 - s * math.sqrt(2)) ** 2)
    assert round_.evaluate(s, s, 0) == pytest.approx(known)
    assert round_.evaluate(3, 0.6, 0) == pytest.approx(sharp.evaluate(3, 0.6, 0)) == pytest.approx(0.1)
    with pytest.raises(pv.MissingFeature, match="graph lattices"):
        mm.voronoi_plate_lattice(block, points, 0.6, member_blend_radius=0.5)
    with pytest.raises(ValueError):
        mm.delaunay_graph_lattice(block, points, 0.6, member_blend_radius=-1)


def test_missing_names_say_what_to_write_instead():
    with pytest.raises(pv.MissingFeature, match="reentrant_honeycomb"):
        mm.plate_lattice(None, wall_thickness=1)
    with pytest.raises(AttributeError, match="did you mean 'octet'"):
        mm.octett


def test_bodies_are_characterized():
    # A block with a hole: a handle, and areas of both.
    block = pv.Difference(pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(8, 8, 4)), pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(4, 4, 8)))
    found = mm.properties.characterize(block, voxel_size=0.25)
    assert found.solid_volume == pytest.approx(192, rel=1e-3) and found.relative_density == pytest.approx(0.75, rel=1e-3)
    assert found.surface_area == pytest.approx(2 * 48 + 4 * 32 + 4 * 16, rel=2e-3)
    assert found.interface_area == pytest.approx(4 * 16, rel=2e-3) and (found.genus, found.solid_component_count) == (1, 1)
    assert found.cross_sections["z"].mean_area_fraction == pytest.approx(0.75)
    assert found.cross_sections["x"].maximum_area_fraction == pytest.approx(1)
    gyroid = mm.properties.characterize(mm.gyroid(box(1, 6.0), wall_thickness=0.9), voxel_size=0.2, periodic_axes="xyz")
    assert gyroid.euler_characteristic == -8 and gyroid.genus is None


def test_walls_lie_between_scattered_points():
    host = pv.Sphere(pv.Vec3(0, 0, 0), 6)
    points = [(0, 0, -2), (0, 0, 2), (0, 40, 0), (40, 0, 0), (-40, -40, 0), (0, 0, 50)]
    walls = mm.voronoi_plate_lattice(host, points, wall_thickness=0.6)
    for z, inside in ((0.29, True), (0.31, False), (-0.29, True), (-0.31, False)):
        assert (walls.evaluate(1, 1, z) < 0) == inside
    assert walls.evaluate(5.8, 0, 2) > 0
    skin = mm.voronoi_plate_lattice(host, points, 0.6, boundary="closed")
    assert skin.evaluate(0, 3.55, 4.55) < 0 < skin.evaluate(0, 3, 4)
    faces = mm.delaunay_plate_lattice(host, points, 0.6)
    assert faces.evaluate(0, 0, -2) < 0
    with pytest.raises(ValueError, match='"open" or "closed"'):
        mm.voronoi_graph_lattice(host, points, 0.6, boundary="shut")


def test_struts_go_from_the_middles_of_triangles_to_their_corners():
    # Four points around a fifth: four tetrahedra with ten faces, one of which is the triangle of the first three.
    points = [(0, 0, 0), (12, 0, 0), (0, 12, 0), (0, 0, 12), (2, 2, 2)]
    host = pv.RectPrism.FromMinAndMax(pv.Vec3(-2, -2, -2), pv.Vec3(14, 14, 14))
    lattice = mm.delaunay_graph_lattice(host, points, 0.6, mode="vertex_centroid")
    assert lattice.evaluate(4, 4, 0) < 0  # the middle of that triangle
    assert lattice.evaluate(8, 2, 0) < 0 and lattice.evaluate(2, 2, 0) < 0  # half way to its corners
    assert lattice.evaluate(6, 0, 0) > 0  # the middle of an edge
    with pytest.raises(pv.MissingFeature, match='boundary="open"'):
        mm.delaunay_graph_lattice(host, points, 0.6, mode="vertex_centroid", boundary="closed")
    with pytest.raises(pv.MissingFeature, match="voronoi_graph_lattice"):
        mm.delaunay_graph_lattice(host, points, 0.6, mode="dual")


# Struts run along the surface where it is as near to a second point as to the first.
def test_closed_struts_run_along_the_surface():
    host = pv.Sphere(pv.Vec3(0, 0, 0), 6)
    seeds = numpy.array(mm.sample_points_in_host(host, spacing=3, seed=4))
    rim = mm.voronoi_graph_lattice(host, seeds, beam_thickness=0.6, boundary="closed")._design()
    ways = numpy.random.default_rng(2).normal(size=(4000, 3))
    places = 5.95 * ways / numpy.linalg.norm(ways, axis=1, keepdims=True)
    away = numpy.linalg.norm(places[:, None] - seeds[None], axis=2)
    order = numpy.argsort(away, axis=1)[:, :2]
    near, next_ = (numpy.take_along_axis(away, order, axis=1)[:, n] for n in range(2))
    between = numpy.linalg.norm(seeds[order[:, 0]] - seeds[order[:, 1]], axis=1)
    from_wall = (next_ ** 2 - near ** 2) / (2 * between)
    inside = rim.distance(places) <= 0
    assert (from_wall < 0.25).sum() > 50 and inside[from_wall < 0.25].all()
    assert not inside[from_wall > 0.6].all()


def test_many_bodies_are_mixed():
    balls = [pv.Sphere(pv.Vec3(0, 0, 0), r) for r in (2, 4, 9)]
    mixed = mm.mix_many(balls, [1, 2, 1])
    assert mixed.evaluate(0, 0, 6) == pytest.approx(6 - (2 + 8 + 9) / 4)
    with pytest.raises(ValueError, match="a weight for each body"):
        mm.mix_many(balls, [1, 2])

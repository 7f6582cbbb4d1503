"""Trees of pyvcad that change after they were queried, and their copies."""
import copy
import pickle

import numpy

import pyvcad as pv
from pyvcad_parts import ball


def test_changes_count_at_once():
    parts = pv.Union(False, [ball(1)])
    root = pv.Translate(10, 0, 0, parts)
    other = pv.Translate(0, 0, 0, ball(7))
    assert root.evaluate(0, 0, 0) == 9
    assert other.evaluate(0, 0, 0) == -7
    parts.add_child(pv.Sphere(-5, 0, 0, 1))
    assert root.evaluate(0, 0, 0) == 4
    root.set_child(ball(3))
    assert root.evaluate(0, 0, 0) == 7
    parts.add_child(ball(100))  # no longer below
    assert root.evaluate(0, 0, 0) == 7
    assert other.evaluate(0, 0, 0) == -7


def test_many_changes():
    inner = pv.Translate(0, 0, 0, ball(1))
    root = pv.Scale(1, 1, 1, pv.Union(False, [inner]))
    for radius in range(1, 200):
        inner.set_child(ball(radius))
        assert root.evaluate(0, 0, 0) == -radius


def test_changes_below_shared_nodes_count_everywhere():
    shared = pv.Union(False, [ball(1)])
    roots = [pv.Translate(x, 0, 0, shared) for x in (5, 10)]
    assert [root.evaluate(0, 0, 0) for root in roots] == [4, 9]
    shared.add_child(ball(2))
    assert [root.evaluate(0, 0, 0) for root in roots] == [3, 8]


def test_sides_of_a_difference_change():
    node = pv.Difference()
    node.set_left(ball(5))
    node.set_right(ball(2))
    assert node.evaluate(0, 0, 0) == 2
    node.set_right(ball(1))
    assert node.evaluate(0, 0, 0) == 1
    assert node.left().type() == "Sphere"


def test_clones_are_apart():
    inner = pv.Union(False, [ball(1)])
    root = pv.Translate(10, 0, 0, inner)
    twin = root.clone()
    inner.add_child(ball(5))
    assert (root.evaluate(0, 0, 0), twin.evaluate(0, 0, 0)) == (5, 9)
    twin.child().add_child(ball(3))
    assert (root.evaluate(0, 0, 0), twin.evaluate(0, 0, 0)) == (5, 7)


def test_copies_of_python_are_apart_too():
    root = pv.Translate(10, 0, 0, pv.Union(False, [ball(1)]))
    assert root.evaluate(0, 0, 0) == 9
    twins = [copy.deepcopy(root), pickle.loads(pickle.dumps(root))]
    root.child().add_child(ball(5))
    assert [node.evaluate(0, 0, 0) for node in (root, *twins)] == [5, 9, 9]


def test_what_a_node_was_made_with_can_change_afterwards():
    center = pv.Vec3(0, 0, 0)
    node = pv.Sphere(center, 1)
    center.x = 50
    assert node.evaluate(0, 0, 0) == -1


def test_children():
    a, b = ball(1), ball(2)
    union = pv.Union(False, [a])
    union.add_child(b)
    assert union.num_children() == 2
    assert union.child(1) is b
    assert union.children() == [a, b]
    assert pv.Translate().child() is None


def test_a_hundred_thousand_struts():
    corners = numpy.random.default_rng(1).uniform(0, 100, (100_000, 3)).tolist()
    lattice = pv.GraphLattice([(c, [c[0] + 1, c[1], c[2]]) for c in corners], 0.1, 1)
    assert lattice.evaluate(*corners[77_777]) <= -0.1 + 1e-9

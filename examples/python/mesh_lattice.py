# A mesh filled with struts between random points: Delaunay edges that stay inside, each graded by its length from
# yellow (short) to magenta (long), inside of a clear body. After Algorithm 1 of Wade et al. 2025.
import itertools
import pathlib

import numpy
import ombre
from scipy.spatial import Delaunay

count = int(ombre.option("points", 600))
most = int(ombre.option("struts", 3289))
radius = 0.2  # mm

body = ombre.mesh(pathlib.Path(__file__).resolve().parent.parent / "models" / "gear.stl", "clear")
low, high = body.bounds
points = numpy.random.default_rng(5).uniform(low, high, (20 * count, 3))
points = points[body.distance(points) < -2 * radius][:count]

simplices = Delaunay(points).simplices
pairs = numpy.concatenate([simplices[:, pair] for pair in itertools.combinations(range(4), 2)])
edges = numpy.unique(numpy.sort(pairs, axis=1), axis=0)
start, end = points[edges[:, 0]], points[edges[:, 1]]

# Those that leave the mesh are pruned, and the longest, which would have most of the colours for themselves.
along = numpy.linspace(0, 1, 40)[:, None]
stays = body.inside(start[:, None] + along * (end - start)[:, None]).all(axis=1)
length = numpy.linalg.norm(end - start, axis=1)
stays &= length < numpy.quantile(length[stays], 0.95)
start, end, length = start[stays][:most], end[stays][:most], length[stays][:most]

share = (length - length.min()) / (length.max() - length.min())
struts = [ombre.strut(a, b, radius, caps="round").grade({"yellow": 1 - s, "magenta": s})
          for a, b, s in zip(start.tolist(), end.tolist(), share.tolist())]
lattice = ombre.union(struts, materials="first")
root = ombre.union(lattice, body, materials="first")

"""Growth laws: how time and memory grow with a quantity, as the exponent of a fitted power."""
import dataclasses
import json
import math

import jobs
import measure

CUBE = jobs.centred((20, 20, 20))

# For each size: edges of the solid in voxels, edge of the mixtures, edge and heights of the tall box.
SCALES = {
    "tiny": ((16, 32, 64), 16, 64, (16, 64)),
    "quick": ((128, 256, 512, 1024), 160, 1024, (64, 256, 1024)),
    "paper": ((256, 512, 1024, 2048), 512, 2048, (256, 1024, 4096)),
}
MATERIALS = (2, 4, 8, 16, 64)
CELLS = (1, 2, 5, 10, 20, 50)  # of a lattice along each axis


@dataclasses.dataclass
class Law:
    name: str
    of: str
    points: list  # (quantity, figure)
    wanted: str

    def exponent(self):
        return fit(self.points)


def fit(points):
    """The slope of log figure over log quantity, by least squares."""
    xs, ys = [math.log(x) for x, _ in points], [math.log(y) for _, y in points]
    x_mean, y_mean = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - x_mean) * (y - y_mean) for x, y in zip(xs, ys)) / sum((x - x_mean)**2 for x in xs)


def _seconds(programs_of, job, arguments, limits, scratch):
    """Runs a job on one thread, removes its files, and returns its result."""
    design = scratch / "growth.vcad"
    job.write(design)
    return measure.ours(programs_of.ombre, design, job, job.voxels, 1, limits, scratch, arguments)


def solid(programs_of, size, limits, scratch):
    points = []
    for n in SCALES[size][0]:
        job = jobs.Job("sphere", lambda: "sphere(10);", *CUBE, (n, n, n))
        points.append((n, _seconds(programs_of, job, [], limits, scratch)["seconds"]))
    return Law("homogeneous sphere of n^3 voxels", "seconds over n", points, "about 2: its surface")


def mixed(count):
    """All of the materials everywhere, in shares that differ from place to place."""
    formulas = [f"1 + {0.04 * math.cos(k):.4f}*x + {0.04 * math.sin(k):.4f}*y" for k in range(count)]
    return _grade(formulas)


def layered(count):
    """Two of the materials at each place: each one fades into the next along x."""
    formulas = [f"max(0, 1 - abs((x + 10)*{(count - 1) / 20:.6f} - {k}))" for k in range(count)]
    return _grade(formulas)


def _grade(formulas):
    texts = ", ".join(f'"{f}"' for f in formulas)
    names = ", ".join(f'"m{k}"' for k in range(len(formulas)))
    return f"fgrade([{texts}], [{names}]) cube(20);"


def materials(programs_of, size, limits, scratch, body, name, wanted, shape=(1, 1, 1)):
    grid = tuple(math.ceil(SCALES[size][1] * share) for share in shape)
    points = []
    for count in MATERIALS:
        file = scratch / "materials.json"
        file.write_text(json.dumps({"materials": [{"name": f"m{k}", "r": k, "g": 255 - k, "b": 3 * k}
                                                  for k in range(count)]}))
        job = jobs.Job(name, lambda: body(count), *CUBE, grid)
        seconds = _seconds(programs_of, job, ["--materials", file], limits, scratch)["seconds"]
        points.append((count, seconds / math.prod(grid) * 1e9))
    return Law(name, "nanoseconds a voxel over materials", points, wanted)


def memory(programs_of, size, limits, scratch):
    points = []
    edge, heights = SCALES[size][2:]
    for layers in heights:
        job = jobs.Job("cube", lambda: "cube(20);", *CUBE, (edge, edge, layers))
        points.append((layers, _seconds(programs_of, job, [], limits, scratch)["peak_bytes"] / 1e6))
    return Law(f"memory, layers of {edge} x {edge} voxels", "peak MB over layers", points, "0")


def struts(rows):
    points = [(count, row["ours"][0]["seconds"]) for row in rows for count in jobs.STRUTS + jobs.MORE_STRUTS
              if row["job"] == f"{count:,} struts"]
    return Law("struts in one cube", "seconds over struts", points, "0.1 or less: 2 times for 1,000 times as many")


def tiles(programs_of, size, limits, scratch):
    n = SCALES[size][1]
    points = []
    for cells in CELLS:
        job = jobs.Job("tile", lambda: jobs.tiled(cells), *jobs.centred((40, 40, 40)), (n, n, n))
        points.append((8 * cells**3, _seconds(programs_of, job, [], limits, scratch)["seconds"]))
    return Law("struts of a tiled cell in one cube", "seconds over struts", points, "0.1 or less")


def laws(programs_of, size, rows, limits, scratch):
    """Yields the laws one after the other, as they are measured."""
    yield solid(programs_of, size, limits, scratch)
    by_struts = struts(rows)
    if len(by_struts.points) > 1:
        yield by_struts
    yield tiles(programs_of, size, limits, scratch)
    yield materials(programs_of, size, limits, scratch, mixed, "materials in each voxel", "1 or less")
    # So many voxels along x that tiles hold few of them.
    yield materials(programs_of, size, limits, scratch, layered, "materials in the design, two in each voxel", "near 0",
                    (16, 1, 1 / 16))
    yield memory(programs_of, size, limits, scratch)

"""Meshes beside OpenVDB's volume-to-mesh, on grids of the same cells."""
import dataclasses
import json
import math
import random

import programs
from table import Table, seconds


@dataclasses.dataclass(frozen=True)
class Surface:
    name: str
    body: str
    side: float  # of the cube that holds it, mm
    volume: float = None  # mm3, where mathematics says it


def _struts(count):
    rng = random.Random(1)
    corner = lambda: tuple(round(rng.uniform(-9, 9), 3) for _ in range(3))
    return "union() {" + " ".join(f"strut({corner()}, {corner()}, 0.4);" for _ in range(count)) + "}"


SURFACES = [
    Surface("sphere", "sphere(9);", 20, 4 / 3 * math.pi * 9 ** 3),
    Surface("tilted box", "rotate(33, 12, 7) rectprism(10, 11, 9);", 20, 990),
    Surface("gyroid", 'intersection() { cube(16); function("sin(pi/4*x)*cos(pi/4*y) + sin(pi/4*y)*cos(pi/4*z) + '
                      'sin(pi/4*z)*cos(pi/4*x)"); }', 20, 16 ** 3 / 2),
    Surface("30 struts", _struts(30), 20),
]

CELLS = {"tiny": 32, "quick": 256, "paper": 512}  # along a side


def surface_table():
    return Table(("mesh", 12), ("cells", 6), ("ours, 2 threads\ns", 15), ("peak\nMB", 5), ("triangles", 10),
                 ("of all cells", 12), ("volume\nerror", 9), ("sampling + OpenVDB\ns", 18), ("triangles\n ", 10),
                 ("with adaptivity\n0.01", 15), ("volume\nerror", 9))


def error(found, surface):
    return "-" if surface.volume is None else f"{found / surface.volume - 1:.1e}"


def ours(ombre, surface, design, cell, scratch, more=()):
    done = programs.run([ombre.path, "mesh", design, "-o", scratch / "out.stl", "--force", "--json", "--threads", 2,
                         "--cell", cell, "--tolerance", f"{cell / 4:.6f}", *more])
    told = [json.loads(line) for line in done.output.splitlines()]
    (bodies,) = [event["bodies"] for event in told if event["event"] == "bodies"]
    return done, sum(b["triangles"] for b in bodies), sum(b["volume_mm3"] for b in bodies)


def beside(ombre, program, design, cell, scratch):
    """Seconds of both steps, triangles, triangles with adaptivity, volume."""
    grid = scratch / "out.vdb"
    sampled = programs.run([ombre.path, "voxels", design, "-o", grid, "--what", "distance", "--voxel", cell,
                            "--force", "--threads", 2, "-q"])
    all_of_it = json.loads(programs.run([program, grid, "0"]).output)
    fewer = json.loads(programs.run([program, grid, "0.01"]).output)
    return sampled.seconds, all_of_it, fewer["triangles"]


def row(table, ombre, program, surface, size, scratch):
    cell = round(surface.side / CELLS[size], 6)
    design = scratch / "surface.vcad"
    half = surface.side / 2
    # The voxels of the grid are the cells.
    design.write_text(f"root((-{half}, -{half}, -{half}), ({half}, {half}, {half}), (1, 1, 1)) {{ {surface.body} }}\n")
    done, triangles, volume = ours(ombre, surface, design, cell, scratch)
    _, full, _ = ours(ombre, surface, design, cell, scratch, ["--keep-all"])
    cells = [surface.name, f"{CELLS[size]}^3", seconds(done.seconds), f"{done.peak_bytes / 1e6:,.0f}",
             f"{triangles:,}", f"{full:,}", error(volume, surface)]
    figures = {"name": surface.name, "seconds": done.seconds, "peak_bytes": done.peak_bytes, "triangles": triangles,
               "full_triangles": full, "volume_mm3": volume, "volume": surface.volume}
    if program:
        sampling, vdb, fewer = beside(ombre, program, design, cell, scratch)
        cells += [f"{seconds(sampling)} + {seconds(vdb['seconds'])}", f"{vdb['triangles']:,}", f"{fewer:,}",
                  error(vdb["volume_mm3"], surface)]
        figures["openvdb"] = dict(vdb, sampling_seconds=sampling, adaptive_triangles=fewer)
    table.row(*cells)
    return figures


def measure(ombre, program, size, scratch):
    print()
    table = surface_table()
    return [row(table, ombre, program, surface, size, scratch) for surface in SURFACES]

"""The jobs of the suite: designs in their boxes, with the voxels and the times that the papers state."""
import dataclasses
import math
import pathlib
import random
import typing

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Stratasys J750: 600 x 300 dpi, layers of 27 micrometres (mm).
J750 = (25.4 / 600, 25.4 / 300, 0.027)
# Table 3 of the 2023 paper samples every node on this grid.
TABLE_3 = (2048, 2048, 4096)

# Voxels a job at most; None: what the paper states.
SIZES = {"tiny": 40**3, "quick": 128_000_000, "paper": None}

STRUTS = (3, 30, 300, 3_000, 30_000)
MORE_STRUTS = (100_000, 1_000_000)


@dataclasses.dataclass(frozen=True)
class Job:
    name: str
    body: typing.Callable[[], str]  # the design without its root, called where it is written
    lo: tuple  # the box that is sampled, mm
    hi: tuple
    voxels: tuple  # as in the paper
    paper: tuple = None  # its seconds on 16 threads: evaluation, writing
    counts: str = "none"  # what the baseline must count alike: none, inside, or each material
    published: bool = True  # whether the published method has its nodes

    def grid(self, size):
        """Voxels along each axis, in the proportions of the paper's."""
        most = SIZES[size]
        shrink = 1 if most is None else min(1, (most / math.prod(self.voxels)) ** (1 / 3))
        return tuple(max(1, round(n * shrink)) for n in self.voxels)

    def pitch(self, grid):
        """The text for --voxel, with exact quotients."""
        return ",".join(f"{hi - lo:.6f}/{n}" for lo, hi, n in zip(self.lo, self.hi, grid))

    def write(self, path):
        corners = ", ".join("(" + ", ".join(f"{c:.6f}" for c in corner) + ")" for corner in (self.lo, self.hi))
        path.write_text(f"root({corners}, (1, 1, 1)) {{\n{self.body()}\n}}\n")


def centred(size):
    return tuple(-s / 2 for s in size), tuple(s / 2 for s in size)


def printed(size):
    """The voxels of a box at the resolution of a J750."""
    return tuple(round(s / p) for s, p in zip(size, J750))


# Fig. A.20: the cells shrink along x.
GYROID = ("sin(w*x)*cos(w*y) + sin(w*y)*cos(w*z) + sin(w*z)*cos(w*x)"
          .replace("w", "((2*pi)/(-0.06304347*x + 1.55))"))
# Eqs 2 and 3.
GRADE = '["1/(1 + exp(x))", "1 - 1/(1 + exp(x))"], ["red", "blue"]'

# A ball of two materials, and the kernel of 10 x 10 x 1 equal weights of Fig. 8.
HALVES = ('intersection(materials="first") { union() { translate(-5, 0, 0) rectprism((10, 20, 20), "red"); '
          'translate(5, 0, 0) rectprism((10, 20, 20), "blue"); } sphere(10); }')
KERNEL = "[for (i = [1:10]) [for (j = [1:10]) [1]]]"

# Fig. A.19.
ACTUATOR = """
fgrade(["0.2", "sin(4.5*z + 1.57) - 0.1",
        "100*(sin(atan(50*sin(4.5*z - 1.57) - 60)) + 1) - rho*sin(phic) + 0.1"], ["blue", "cyan", "yellow"], "thresh")
  function("0.5*(rho*sin(phic) - 0.5)^4 + (rho*sin(phic + 0.5*pi))^4
            + 0.5*(sin(atan(100*sin(4.5*z - 1.57) - 60)) + 1)*(sin(atan(20*sin(phic))) + 1) - 1", "red");
"""

# Several formulas and booleans, graded from foot to rim, in the size of Fig. 13(d).
MUG = """
module slab(formula, low, high) function(formula, cyan, min=(-40, -40, low), max=(65, 40, high));
fgrade(["z/90", "1 - z/90"], ["cyan", "magenta"])
  difference() {
    union() {
      slab("rho - (31.5 - 4*sin(pi*z/90)^2)", 0, 90);
      slab("hypot((hypot((x - 31.5)/27, (z - 45)/30) - 1)*27, y) - 6", 0, 90);
    }
    slab("rho - (28 - 4*sin(pi*z/90)^2)", 5, 91);
    slab("hypot(rho - 33, z - 8) - 2.5", 5, 11);
  }
"""


def struts(count, side=40.0):
    """Random struts in a cube, each mixed of yellow (the shortest) and magenta by its length, as in the 2025
    paper's study. Lengths follow the edges of a Delaunay mesh of so many edges (seven a point), and struts
    stay slender."""
    chance = random.Random(20251)
    usual = 1.5 * (7 * side**3 / count) ** (1 / 3)
    shortest, longest = 0.5 * min(usual, 0.6 * side), 1.5 * min(usual, 0.6 * side)
    lines = ["union() {"]
    while len(lines) <= count:
        start = [chance.uniform(-side / 2, side / 2) for _ in range(3)]
        length = chance.uniform(shortest, longest)
        along = [chance.gauss(0, 1) for _ in range(3)]
        end = [s + length * a / math.hypot(*along) for s, a in zip(start, along)]
        if max(map(abs, end)) > side / 2:
            continue
        share = (length - shortest) / (longest - shortest)
        a, b = (", ".join(f"{c:.4f}" for c in point) for point in (start, end))
        lines.append(f'fgrade(["{share:.4f}", "{1 - share:.4f}"], ["magenta", "yellow"]) '
                     f'strut(({a}), ({b}), {min(0.3, usual / 20):.4f});')
    return "\n".join(lines + ["}"])


def struts_job(count):
    return Job(f"{count:,} struts", lambda: struts(count), *centred((40, 40, 40)), (1000, 1000, 1000))


def table_3(data):
    cube, screwdriver = centred((20, 20, 20)), centred((22, 144, 22))
    gyroid = f'intersection() {{ translate(0, 0, 1) rectprism((46, 10, 4), "red"); function("{GYROID}", "red"); }}'
    return [
        Job("sphere", lambda: "sphere(10);", *cube, TABLE_3, (35, 248), "materials"),
        Job("cube", lambda: "cube(20);", *cube, TABLE_3, (44, 241), "materials"),
        Job("mesh", lambda: f'mesh("{data}/screwdriver.stl");', *screwdriver, TABLE_3, (163, 251)),
        Job("F-rep", lambda: gyroid, (-23, -5, -1), (23, 5, 3), TABLE_3, (584, 248), "materials"),
        Job("grade", lambda: f"fgrade({GRADE}) sphere(10);", *cube, TABLE_3, (1147, 223), "inside"),
        Job("halves", lambda: HALVES, *cube, TABLE_3, published=False),
        Job("convolve", lambda: f"convolve({KERNEL}) {{ {HALVES} }}", *cube, TABLE_3, (62, 250), published=False),
    ]


def table_4(data):
    text, screwdriver, mug = (140, 7, 28), (22, 144, 22), (96, 63, 90)
    graded_text = f'fgrade(["0.5 + x/140", "0.5 - x/140"], ["red", "blue"]) mesh("{data}/text.stl");'
    graded_screwdriver = (f'fgrade(["-y/72", "1 - abs(y/72)", "y/72"], ["magenta", "cyan", "yellow"]) '
                          f'mesh("{data}/screwdriver.stl");')
    return [
        Job("text", lambda: graded_text, *centred(text), printed(text), (21, 7)),
        Job("screwdriver", lambda: graded_screwdriver, *centred(screwdriver), printed(screwdriver), (97, 15)),
        # 4 x 4 x 6.3 mm as the paper prints it; Table 4 has it 12 times as large.
        Job("actuator", lambda: ACTUATOR, (-2, -2, -3.1415), (2, 2, 3.1415), printed((48, 48, 75)), (251, 41),
            "materials"),
        Job("mug", lambda: MUG, (-31.5, -31.5, 0), (64.5, 31.5, 90), printed(mug), (836, 120), "inside"),
    ]


def tiled(cells, side=40.0):
    """Body-centred cells in a cube, so many along each axis; the same share of the cube is solid."""
    size = side / cells
    return (f"intersection(materials=\"first\") {{ tile() lattice(\"bcc\", ({size}, {size}, {size}), {size / 12}); "
            f"cube({side}); }}")


def copied(cells, side=40.0):
    """Body-centred cells in a cube, made of copies of their struts."""
    size = side / cells
    return (f"n = {cells}; s = {size};\n"
            "at = [for (i = [0:n - 1], j = [0:n - 1], k = [0:n - 1]) s*[i - (n - 1)/2, j - (n - 1)/2, k - (n - 1)/2]];\n"
            "half = [for (x = [-1, 1], y = [-1, 1], z = [-1, 1]) s/2*[x, y, z]];\n"
            "intersection(materials=\"first\") {\n"
            f"  union() for (p = at, h = half) strut(p, p + h, {size / 12}, caps=\"round\");\n"
            f"  cube({side});\n}}")


def balls(count, options, side=40.0):
    """Balls of two materials in a cube, which take up a tenth of it."""
    chance = random.Random(31)
    radius = (0.1 * side**3 / count / (4 / 3 * math.pi)) ** (1 / 3)
    lines = [f"union({options(radius)}) {{"]
    for n in range(count):
        at = ", ".join(f"{chance.uniform(-side / 2, side / 2):.4f}" for _ in range(3))
        lines.append(f'translate({at}) sphere({radius:.4f}, "{("red", "blue")[n % 2]}");')
    return "\n".join(lines + ["}"])


def lattices(cells=10, parts=10_000):
    cube, voxels = centred((40, 40, 40)), (1000, 1000, 1000)
    return [
        Job("tile", lambda: tiled(cells), *cube, voxels, published=False),
        Job("its copies", lambda: copied(cells), *cube, voxels, published=False),
        Job(f"{parts:,} smooth", lambda: balls(parts, lambda r: f"blend={r / 2}"), *cube, voxels, published=False),
        Job(f"{parts:,} sharp", lambda: balls(parts, lambda r: ""), *cube, voxels, published=False),
    ]


def values():
    """Cubes of two materials whose share is a value; the first, whose share is a number, costs what the mixture alone does."""
    leaf = ROOT / "examples" / "models" / "leaf.png"
    shares = {
        "half and half": "0.5",
        "noise": "noise(size=4)",
        "noise, octaves": "noise(size=8, octaves=3)",
        "table": 'table([[-20, 0], [-10, 0.8], [0, 0.3], [10, 0.4], [20, 1]], "x", mode="cubic")',
        "texture": f'texture("{leaf}", 40).value',
        "path distance": "path_distance([for (n = [0:100]) 18*[cos(25*n)*n/100, sin(25*n)*n/100, n/50 - 1]]) / 20",
    }
    cube, voxels = centred((40, 40, 40)), (1000, 1000, 1000)
    return [Job(f"value: {name}", lambda share=share: f"cube(40, mix(red, blue, {share}));", *cube, voxels, published=False)
            for name, share in shares.items()]


def cells():
    """A gyroid in a layer 6 mm thick of about 32,000 mm3: flat, around a pipe, and on a mesh of 1,080 triangles."""
    head = ROOT / "examples" / "models" / "head.off"
    maps = {
        "flat box": "box_cells((6, 6, 6), min=(-36.6, -36.6, 20), max=(36.6, 36.6, 26))",
        "pipe": "cylinder_cells(20, 26, 37, size=(6, 6, 6), origin=(0, 0, 24))",
        "mesh patch": f'surface_cells("{head}", (6, 6, 6), height=6)',
    }
    lo, hi, voxels = (-45, -36, 4), (45, 36, 44), (1410, 1128, 627)
    return [Job(f"cells: {name}", lambda on=on: f'tpms("gyroid", map={on}, thickness=0.6, material="red");', lo, hi, voxels,
                published=False)
            for name, on in maps.items()]


def depths(data):
    """Two materials by the distance to the nearest of 96,800 triangles."""
    graded = f'fgrade(["1 + d/4", "-d/4"], ["magenta", "gray"]) mesh("{data}/bumpy_ball.stl");'
    return [Job("depth in a mesh", lambda: graded, *centred((51, 51, 51)), (255, 255, 255), published=False)]


def all_jobs(data, size, full=False):
    counts = STRUTS + (MORE_STRUTS if full else ())
    tiny = size == "tiny"
    if tiny:
        counts = STRUTS[:3]
    return (table_3(data) + table_4(data) + [struts_job(count) for count in counts]
            + (lattices(3, 200) if tiny else lattices()) + values() + cells() + depths(data))

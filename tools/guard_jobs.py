"""What the guard runs: the designs, and the table of jobs for each kind of design."""
import dataclasses
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))
import program  # noqa: E402
import run_cases  # noqa: E402
import run_errors  # noqa: E402

# ---- the jobs


@dataclasses.dataclass(frozen=True)
class Job:
    """Commands that run one after another, from a design to its outputs.

    In a command {design} stands for the design's file with its definitions, {small} for the same with fewer parts where
    that is needed, {own} for the options that the design's first lines ask for, {out} for an empty folder, and the other
    names for lengths and points (`values` below). "> FILE" at the end writes the standard output to a file.
    """
    name: str  # its kind and, after a hyphen, which of them
    sources: str  # of designs, as in the names that `designs` gives them
    commands: tuple
    quick: bool = False
    internal: bool = False  # A form inside the compiler, which may change while all outputs stay.

    @property
    def kind(self):
        return self.name.partition("-")[0]


def job(name, sources, *commands, **options):
    return Job(name, sources, commands, **options)


EVERY = "examples python cases nodes meshes"
MANY = "examples cases nodes"
JOBS = [
    job("emit-ast", "examples cases nodes corpus", "ombre slice {design} --emit ast", quick=True),
    job("emit-tree", EVERY + " corpus", "ombre slice {design} --emit tree", quick=True),
    job("emit-json", EVERY + " corpus", "ombre slice {design} --emit json", quick=True),
    job("emit-program", EVERY, "ombre slice {design} --emit program", internal=True),
    job("emit-stats", EVERY, "ombre slice {design} --emit stats", internal=True),
    # The designs' own options, at which their tests judge them, and wrong designs.
    job("slice-own", "cases", "ombre slice {design} {own} -o {out}/layers", quick=True),
    job("slice-error", "errors", "ombre slice {design} {own} -o {out}/layers", quick=True),
    job("slice-coarse", "corpus", "ombre slice {design} --voxel 1 -o {out}/layers", quick=True),
    job("slice-plan", EVERY, "ombre slice {design} --voxel {fine} --dry-run --json"),
    job("slice-indexed", EVERY, "ombre slice {design} --voxel {voxel} --format indexed -o {out}/layers", quick=True),
    job("slice-json", MANY, "ombre slice {design} --emit json > {out}/design.json",
        "ombre slice {out}/design.json --voxel {voxel} -o {out}/layers"),
    job("slice-rgba", EVERY, "ombre slice {design} --voxel {voxel} --format rgba --dither blue-noise --seed 7 "
        "-o {out}/layers"),
    job("slice-diffusion", MANY, "ombre slice {design} --voxel {voxel} --format gray --dither diffusion -o {out}/layers"),
    job("slice-threshold", MANY, "ombre slice {design} --voxel {voxel} --format mask --dither threshold -o {out}/layers"),
    job("slice-reference", MANY, "ombre slice {design} --voxel {voxel} --evaluator reference -o {out}/layers"),
    job("slice-oblong", MANY, "ombre slice {design} --voxel {voxel},{coarse},{fine} --json -o {out}/layers"),
    job("slice-fine", "examples", "ombre slice {design} --voxel {fine} -o {out}/layers"),
    job("slice-piece", "examples", "ombre slice {design} --voxel {voxel} --layers 5:9 -o {out}/layers"),
    job("slice-resumed", "examples", "ombre slice {design} --voxel {voxel} --layers :9 -o {out}/layers",
        "ombre slice {design} --voxel {voxel} --resume -o {out}/layers"),
    job("slice-printer", "examples", "ombre slice {design} --printer j750 --voxel {voxel} --place center -o {out}/layers"),
    job("sheet", "examples", "ombre slice {design} --voxel {voxel} -o {out}/layers",
        "ombre sheet {out}/layers --count 6 -o {out}/sheet.png"),
    job("layer-middle", EVERY, "ombre layer {design} --voxel {fine} --z {z} -o {out}/layer.png", quick=True),
    job("layer-box", "examples", "ombre layer {design} --voxel {fine} --index -3 --box {rectangle} --format rgba "
        "-o {out}/layer.png"),
    job("voxels-materials", EVERY, "ombre voxels {design} --voxel {voxel} -o {out}/grid.npy"),
    job("voxels-distance", EVERY, "ombre voxels {design} --voxel {voxel} --what distance -o {out}/grid.nrrd", quick=True),
    job("voxels-gzip", "examples", "ombre voxels {design} --voxel {coarse} --what distance,fractions --gzip "
        "-o {out}/grid.nrrd"),
    job("voxels-fractions", MANY, "ombre voxels {design} --voxel {voxel} --what fractions -o {out}/grid.raw"),
    job("voxels-reference", "examples", "ombre voxels {design} --voxel {coarse} --what distance,fractions "
        "--evaluator reference -o {out}/grid.npy"),
    job("voxels-box", "examples", "ombre voxels {design} --voxel {fine} --what distance --box {box} -o {out}/grid.npy"),
    job("voxels-vdb", MANY, "ombre voxels {design} --voxel {voxel} -o {out}/grid.vdb"),
    job("voxels-nvdb", "examples", "ombre voxels {design} --voxel {voxel} -o {out}/grid.nvdb"),
    job("mesh-stl", EVERY, "ombre mesh {small} --tolerance {tolerance} -o {out}/part.stl", quick=True),
    job("mesh-materials", MANY, "ombre mesh {small} --tolerance {tolerance} --by materials -o {out}/part.3mf"),
    job("mesh-bands", "examples", "ombre mesh {small} --tolerance {tolerance} --bands 3 --flavour prusa "
        "--setting fill_density=10%..60% -o {out}/part.3mf"),
    job("mesh-bambu", "examples", "ombre mesh {small} --tolerance {tolerance} --by materials --flavour bambu "
        "-o {out}/part.3mf"),
    job("mesh-off", "examples", "ombre mesh {small} --tolerance {tolerance} --keep-all -o {out}/part.off"),
    *(job(f"mesh-{ending}", "examples", "ombre mesh {small} --tolerance {tolerance} --by materials -o {out}/part." + ending)
      for ending in ("obj", "ply", "amf", "glb")),
    job("contours-svg", MANY, "ombre contours {small} --tolerance {tolerance} --layer-height {height} --by materials "
        "-o {out}/layers"),
    job("contours-cli", "examples", "ombre contours {small} --tolerance {tolerance} --layer-height {height} "
        "-o {out}/part.cli",
        quick=True),
    job("contours-bands", "examples", "ombre contours {small} --tolerance {tolerance} --z {z} --bands 3 -o {out}/layer.svg"),
    job("render-iso", EVERY, "ombre render {design} --size 120x90 -o {out}/picture.png", quick=True),
    job("render-cut", MANY, "ombre render {design} --size 120x90 --cut x={x} --view right -o {out}/picture.png"),
    job("render-slice", MANY, "ombre render {design} --size 120x90 --slice z={z} --background transparent "
        "-o {out}/picture.png"),
    job("render-box", "examples", "ombre render {design} --size 120x90 --aa 1 --box {box} --background gray "
        "-o {out}/picture.png"),
    job("render-perspective", "examples", "ombre render {design} --size 120x90 --perspective 50 --zoom 1.5 "
        "-o {out}/picture.png"),
    job("render-frames", "examples", "ombre render {design} --size 80x60 --frames 3 -o {out}/picture.png"),
    job("render-annotated", "examples", "ombre render {design} --size 320x240 --annotate -o {out}/picture.png"),
    job("probe", EVERY, "ombre probe {design} --at={centre} --at={corner} --at={aside} --at={above} --at={outside} --json",
        quick=True),
    # The same commands inside of Python.
    job("module-slice", "python", "python3 -m ombre slice {design} --voxel {voxel} -o {out}/layers", quick=True),
    job("module-mesh", "python", "python3 -m ombre mesh {small} --tolerance {tolerance} -o {out}/part.3mf"),
    job("module-mistake", "python", "python3 -m ombre render {design} --view behind -o {out}/picture.png"),
]

# What the program says without a design.
COMMANDS = "slice layer render voxels mesh contours sheet probe nodes printers materials completion run".split()
SPEECH = [("version", "--version"), ("help", "--help"), *((f"help-{c}", f"{c} --help") for c in COMMANDS),
          ("nodes", "nodes"), ("nodes-json", "nodes --json"), ("nodes-markdown", "nodes --markdown"),
          ("printers", "printers"), ("printers-j750", "printers j750"), ("materials", "materials"),
          *((f"completion-{shell}", f"completion {shell}") for shell in ("bash", "zsh", "fish"))]
JOBS += [job(f"say-{name}", "program", f"ombre {words}", quick=True) for name, words in SPEECH]


# ---- the designs


@dataclasses.dataclass(frozen=True)
class Design:
    name: str  # of its source, and what it is there
    file: str  # as seen from its folder
    folder: pathlib.Path
    text: str = ""  # of a design that the guard writes; its file is then in {designs}
    defines: tuple = ()
    fewer: tuple = ()  # further definitions, for jobs that would take minutes
    own: tuple = ()
    quick: bool = True

    @property
    def source(self):
        return self.name.partition("/")[0]


TESTS, EXAMPLES = ROOT / "tests", ROOT / "examples"
CORPUS = TESTS / "fuzz" / "corpus"
# Fewer struts than it is meant to have, as in the tests.
DEFINES = {"mesh_lattice": ("-D", "points=60", "-D", "struts=200")}
# Their meshes take a minute at any tolerance.
FEWER = {"organic_lattice": ("-D", "n=2"), "voronoi_foam": ("-D", "count=40")}


def found(source, base, *patterns):
    """(name, path) of the files below a folder."""
    return [(f"{source}/{path.relative_to(base)}", path) for pattern in patterns for path in sorted(base.glob(pattern))]


def examples():
    return [Design(name, path.name, path.parent, fewer=FEWER.get(path.stem, ()))
            for name, path in found("examples", EXAMPLES, "*.vcad")]


def python_designs():
    paths = found("python", EXAMPLES / "python", "*.py") + found("python", TESTS / "python", "listings/*.py")
    return [Design(name, path.name, path.parent, defines=DEFINES.get(path.stem, ())) for name, path in paths]


def cases():
    return [Design(name, path.name, path.parent, own=tuple(run_cases.expectations(path)[0]), quick=i % 4 == 0)
            for i, (name, path) in enumerate(found("cases", TESTS / "cases", "*/*.vcad"))]


def errors():
    return [Design(name, path.name, path.parent, own=tuple(run_errors.directives(path)[0]))
            for name, path in found("errors", TESTS / "errors", "*.vcad", "*.json")]


def corpus():
    paths = found("corpus", CORPUS, "language_fuzz/*.vcad", "design_fuzz/*.json")
    return [Design(name, path.name, path.parent, quick=i % 4 == 0) for i, (name, path) in enumerate(paths)]


def mesh_files():
    """A design for each mesh file among the fuzzers' first inputs; many are damaged."""
    paths = found("meshes", CORPUS, "mesh_*_fuzz/*", "amf_fuzz/*", "three_mf_fuzz/*")
    return [Design(name, name.replace("/", "_") + ".vcad", path.parent, text=f"mesh({json.dumps(path.name)});\n", quick=False)
            for name, path in paths]


def node_examples(ombre):
    """The examples of the reference, whose files are those of examples/."""
    listed = program.run([ombre, "nodes", "--json"]).stdout.splitlines()
    return [Design(f"nodes/{node['name']}", f"{node['name']}.vcad", EXAMPLES, text=node["example"] + "\n", quick=False)
            for node in map(json.loads, listed)]


def designs(ombre):
    return [Design("program/ombre", "", ROOT), *examples(), *python_designs(), *node_examples(ombre), *mesh_files(), *cases(),
            *corpus(), *errors()]


def jobs_of(design, quick):
    return [each for each in JOBS if design.source in each.sources.split() and (not quick or each.quick and design.quick)]


# ---- a folder of cases, each with a command line of its own


def given_command(case):
    """The commands of a case's expect.txt, as those of a job: what follows "command ...:" in its first line.
    Times and variables in front are left out; -o names stay, since a case runs in a copy of its folder."""
    match = re.match(r"command[^:]*: (.*)", (case / "expect.txt").read_text(encoding="utf-8"))
    if not match:
        return ()
    return tuple(re.sub(r"^(time |\w+=\S+ )*", "", command.strip()) for command in match[1].split(";"))


def given_cases(folder):
    """(name, folder, commands) of those that have a command."""
    cases_of = [(f"given/{path.parent.name}", path.parent, given_command(path.parent))
                for path in sorted(folder.glob("*/expect.txt"))]
    return [each for each in cases_of if each[2]]


# ---- lengths and points, which follow from a design's box


def short(value):
    return f"{value:.3g}" if abs(value) >= 1e-3 else f"{value:.6f}"


def values(box):
    """What stands for the names in commands: lengths by the box's longest side, points in its frame."""
    low, high = box[:3], box[3:]
    longest = max(b - a for a, b in zip(low, high))

    def at(x, y, z):
        return ",".join(short(a + share * (b - a)) for a, b, share in zip(low, high, (x, y, z)))

    x, _, z = at(0.47, 0.5, 0.53).split(",")
    return {"voxel": short(longest / 60), "coarse": short(longest / 35), "fine": short(longest / 110),
            "tolerance": short(longest / 60), "height": short((high[2] - low[2]) / 6), "x": x, "z": z,
            "rectangle": ",".join(at(0.2, 0.3, 0).split(",")[:2] + at(0.7, 0.8, 0).split(",")[:2]),
            "box": at(0.2, 0.3, 0.25) + "," + at(0.7, 0.8, 0.75), "centre": at(0.5, 0.5, 0.5), "corner": at(0, 0, 0),
            "aside": at(0.37, 0.61, 0.43), "above": at(0.5, 0.45, 0.97), "outside": at(1.2, 0.3, 0.5)}


USUAL_BOX = (-10, -10, -10, 10, 10, 10)  # of a design without a box, which is wrong or endless


def measured_box(stats):
    """Of what `ombre slice --emit stats` prints."""
    number = r"(-?[\d.]+(?:e[-+]?\d+)?)"
    corner = rf"\({number}, {number}, {number}\)"
    match = re.search(rf"^bounds +{corner} to {corner} mm$", stats, re.M)
    box = tuple(float(each) for each in match.groups()) if match else USUAL_BOX
    return box if any(a < b for a, b in zip(box[:3], box[3:])) else USUAL_BOX

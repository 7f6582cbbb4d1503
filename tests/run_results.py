#!/usr/bin/env python3
"""Results of simulations as values of designs, run as a user would.

    python3 tests/run_results.py build/dev/apps/ombre/ombre
"""
import json

import program
from program import expect, near

RED = {"modulus_mpa": 2850, "poissons_ratio": 0.39}
PULL = {"materials": {"red": RED},
        "supports": [{"on": "xmin", "fix": "x"}, {"on": "ymin", "fix": "y"}, {"on": "zmin", "fix": "z"}],
        "loads": [{"on": "zmax", "pressure_mpa": -100}]}
STRAIN = 100 / 2850


class Folder(program.Folder):
    def solve(self):
        """A block of 10 mm, pulled along z by 100 MPa."""
        self.write("cube.vcad", "rectprism((10, 10, 10), red);")
        self.write("pull.json", PULL)
        self.run("fea", "cube.vcad", "--study", "pull.json", "--cell", "2.5", "--solve", "-o", "cube.vtu")

    def voxels(self, design, pitch):
        """How many there are of each material."""
        lines = self.run("slice", design, "--voxel", pitch, "-o", "job", "--force", "--json").stdout.splitlines()
        event = next(event for event in map(json.loads, lines) if event["event"] == "done")
        return {material["name"]: material["voxels"] for material in event["materials"]}

    def attributes(self, design, *points):
        """The attributes of a design at points."""
        self.write("probed.vcad", design)
        places = [word for p in points for word in ("--at", ",".join(map(str, p)))]
        lines = self.run("probe", "probed.vcad", *places, "--json").stdout.splitlines()
        return [event["attributes"] for event in map(json.loads, lines) if "attributes" in event]


def own_results_are_read_back(folder):
    """Hooke's law makes the displacement linear in space."""
    folder.solve()
    points = [(0, 0, 0), (1, -2, 3), (-4.9, 4.9, 4.9), (0.1, 0.2, -4.7)]
    found = folder.attributes('''
        move = results("cube.vtu", "displacement");
        attribute("mx", move.vector.x) attribute("mz", move.vector.z) attribute("len", move.magnitude)
        attribute("zz", results("cube.vtu", "stress", component="zz").value)
        attribute("mises", results("cube.vtu", "von_mises").value)
        attribute("in", move.inside) cube(10);''', *points)
    expect(len(found) == len(points), str(found))
    for (x, y, z), values in zip(points, found):
        mx, my, mz = -0.39 * STRAIN * (x + 5), -0.39 * STRAIN * (y + 5), STRAIN * (z + 5)
        near(values["mx"], mx, 1e-6, "the displacement along x")
        near(values["mz"], mz, 1e-6, "the displacement along z")
        near(values["len"], (mx * mx + my * my + mz * mz) ** 0.5, 1e-6, "the displacement")
        near(values["zz"], 100, 1e-3, "the stress")
        near(values["mises"], 100, 1e-3, "von Mises' stress")
        expect(values["in"] == 1, "not inside")


def outside_is_as_requested(folder):
    folder.solve()
    design = 'attribute("a", results("cube.vtu", "displacement", component="z"{}).value) translate(0, 0, 5) {{ cube(10); }}'
    top = STRAIN * 10
    for rule, wanted in ((', outside="nearest"', top), (', outside="value", otherwise=7', 7),
                         (', outside="nearest", within=4', top)):
        found = folder.attributes(design.format(rule), (0, 0, 8))[0]["a"]
        near(found, wanted, 1e-6, rule)
    folder.write("mixed.vcad", 'cube(12, mix(red, blue, results("cube.vtu", "von_mises").value / 200));')
    reported = folder.run("slice", "mixed.vcad", "--voxel", "0.5", "-o", "mixed").stderr
    expect("is not a finite number" in reported, reported)
    folder.write("mixed.vcad", 'cube(12, mix(red, blue, results("cube.vtu", "von_mises", outside="nearest").value / 200));')
    reported = folder.run("slice", "mixed.vcad", "--voxel", "0.5", "-o", "mixed", "--force").stderr
    expect("finite" not in reported, reported)


def the_mesh_is_a_solid(folder):
    folder.solve()
    folder.write("solid.vcad", 't = results("cube.vtu", "displacement").vector.z / %r;\n'
                 'fgrade([1 - t, t], [red, blue]) { mesh("cube.vtu"); }' % (10 * STRAIN))
    counts = folder.voxels("solid.vcad", "0.5")
    expect(sum(counts.values()) == 8000, str(counts))
    # Half of the voxels, by draws with odds that rise from 0 to 1.
    near(counts["blue"], 4000, 150, "the voxels of blue")


def coverage_is_reported(folder):
    """A block of twice the length of the cube of the mesh lies in it by a half; a cube moved by 2.5 mm along each axis
    has (3/4)^3 of its volume there, unless its results move along."""
    folder.solve()
    mixed = 'mix(red, blue, results("cube.vtu", "von_mises", outside="nearest").value / 200)'

    def info(design, *arguments):
        folder.write("covered.vcad", design)
        return folder.run("info", "covered.vcad", *arguments).stdout

    def shares(design):
        events = map(json.loads, info(design, "--json").splitlines())
        found = next(event["results"] for event in events if event["event"] == "design")
        expect(all(mesh["file"].endswith("cube.vtu") for mesh in found), str(found))
        return [mesh["share_in_mesh"] for mesh in found]

    expect(shares("cube(10, red);") == [], "a design without results")
    near(shares(f"rectprism((20, 10, 10), {mixed});")[0], 0.5, 1e-9, "a half")
    near(shares(f"rectprism((10, 10, 10), {mixed});")[0], 1, 1e-9, "all of it")
    near(shares(f"translate(20, 0, 0) rectprism((10, 10, 10), {mixed});")[0], 1, 1e-9, "results that move along")
    corner = shares('attribute("s", results("cube.vtu", "von_mises").value) '
                    'translate(2.5, 2.5, 2.5) rectprism((10, 10, 10), red);')
    near(corner[0], 0.75**3, 0.02, "a corner")
    reported = info(f"rectprism((20, 10, 10), {mixed});")
    expect("cube.vtu  about 50 % of the design's volume lies in the mesh" in reported, reported)


def bytes_do_not_depend_on_threads(folder):
    folder.solve()
    folder.write("graded.vcad", 'r = results("cube.vtu", "displacement", outside="nearest");\n'
                 'sphere(7, mix(red, blue, r.magnitude));')
    for threads in ("1", "3"):
        folder.run("slice", "graded.vcad", "--voxel", "0.25", "-o", f"t{threads}", "--threads", threads)
    folder.run("slice", "graded.vcad", "--voxel", "0.25", "-o", "tr", "--evaluator", "reference")
    layers = sorted(p.name for p in (folder.path / "t1").glob("*.png"))
    expect(len(layers) == 56, str(len(layers)))
    for other in ("t3", "tr"):
        for name in layers:
            expect((folder.path / "t1" / name).read_bytes() == (folder.path / other / name).read_bytes(), f"{other} {name}")


def calculix_is_read(folder):
    """CalculiX' own solution of a pulled brick, where it is installed."""
    folder.solve()
    folder.run("fea", "cube.vcad", "--study", "pull.json", "--cell", "5", "-o", "part.inp")
    try:
        solved = program.run(["ccx", "-i", "part"], cwd=folder.path)
    except FileNotFoundError:
        return
    expect(solved.returncode == 0, solved.stdout[-500:])
    found = folder.attributes('attribute("a", results("part.frd", "displacement").vector.z) '
                              'attribute("s", results("part.frd", "von_mises").value) cube(10);', (1, 2, 3))[0]
    near(found["a"], STRAIN * 8, 1e-5, "the displacement")
    near(found["s"], 100, 1e-2, "the stress")


def tables_are_read(folder):
    folder.write("tet.inp", "*NODE\n1,0,0,0\n2,10,0,0\n3,0,10,0\n4,0,0,10\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n")
    folder.write("tet.csv", "node,dx,dy,dz\n1,0,0,0\n2,1,0,0\n3,0,2,0\n4,0,0,3\n")
    found = folder.attributes('r = results("tet.inp", values="tet.csv"); attribute("v", r.vector) '
                              'attribute("l", r.value) cube(10);', (1, 2, 3))[0]
    vector = found["v"] if "v" in found else [found["v.x"], found["v.y"], found["v.z"]]
    for got, wanted in zip(vector, (0.1, 0.4, 0.9)):
        near(got, wanted, 1e-12, "a displacement")
    near(found["l"], (0.01 + 0.16 + 0.81) ** 0.5, 1e-12, "the length")
    folder.write("points.csv", "x,y,z,t\n0,0,0,10\n4,0,0,20\n")
    found = folder.attributes('attribute("t", results("points.csv").value) '
                              'attribute("n", results("points.csv", between="nearest").value) cube(10);', (1, 0, 0))[0]
    near(found["t"], (10 + 20 / 9) / (1 + 1 / 9), 1e-12, "the mean")
    near(found["n"], 10, 0, "the nearest")


def grid(side, value):
    """A .vtu of one brick from the origin, with a value at its corners."""
    array = '<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="ascii">{}</DataArray>'.format
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    points = " ".join(str(side * x) for corner in corners for x in corner)
    return (f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid><Piece NumberOfPoints="8" '
            f'NumberOfCells="1"><PointData>{array("Float64", "heat", 1, f"{value} " * 8)}</PointData>'
            f'<Points>{array("Float64", "Points", 3, points)}</Points>'
            f'<Cells>{array("Int64", "connectivity", 1, "0 1 2 3 4 5 6 7")}{array("Int64", "offsets", 1, 8)}'
            f'{array("UInt8", "types", 1, 12)}</Cells></Piece></UnstructuredGrid></VTKFile>')


def steps_are_chosen(folder):
    """Steps of a collection are sorted by time. A step is another mesh where its file has changed."""
    folder.write("first.vtu", grid(2, 5))
    folder.write("second.vtu", grid(3, 7))
    sets = "".join(f'<DataSet timestep="{time}" file="{name}.vtu"/>' for time, name in ((9, "second"), (1, "first")))
    folder.write("all.pvd", f'<VTKFile type="Collection"><Collection>{sets}</Collection></VTKFile>')
    for step, heat in ((0, 7), (1, 5), (2, 7)):
        found = folder.attributes(f'attribute("heat", results("all.pvd", step={step}).value) cube(2);', (0.5, 0.5, 0.5))
        near(found[0]["heat"], heat, 1e-9, f"the value in step {step}")
    for step, side in ((0, 3), (1, 2), (2, 3)):
        folder.write("solid.vcad", f'mesh("all.pvd", red, step={step});')
        expect(folder.voxels("solid.vcad", "0.5") == {"red": (2 * side)**3}, f"the voxels of step {step}")
    pictures = []
    for step in (1, 2):
        folder.run("render", "all.pvd", "--step", step, "--by", "heat", "--range", "0,10", "--size", "60x60", "-o",
                   f"step{step}.png")
        pictures.append((folder.path / f"step{step}.png").read_bytes())
    expect(pictures[0] != pictures[1], "pictures of two steps")
    folder.write("first.vtu", grid(1, 5))
    folder.write("solid.vcad", 'mesh("all.pvd", red, step=1);')
    expect(folder.voxels("solid.vcad", "0.5") == {"red": 8}, "the voxels of a step that has changed")
    folder.write("solid.vcad", 'mesh("all.pvd", red, step=3);')
    said = folder.run("slice", "solid.vcad", "--voxel", "0.5", "-o", "none", status=1).stderr
    expect("there is no step 3; the file has 2 steps: 1 (time 1), 2 (time 9)" in said, said)


def cubes_of_vtkhdf(folder, h5py, name, steps, shared_mesh=False):
    """Writes cubes of these sides as steps, each in two pieces: bricks one above the other, with the value of the step."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    written = steps[:1] if shared_mesh else steps
    with h5py.File(folder.path / name, "w") as file:
        group = file.create_group("VTKHDF")
        group.attrs["Version"] = [2, 0]
        group.attrs["Type"] = "UnstructuredGrid" if shared_mesh else b"UnstructuredGrid"
        points = [[x * side, y * side, (z + above) * side / 2] for side, _ in written for above in (0, 1)
                  for x, y, z in corners]
        count = 2 * len(written)
        for array, numbers in (("NumberOfPoints", [8] * count), ("NumberOfCells", [1] * count),
                               ("NumberOfConnectivityIds", [8] * count), ("Points", points),
                               ("Connectivity", list(range(8)) * count), ("Offsets", [0, 8] * count),
                               ("Types", [12] * count)):
            group[array] = numbers
        values = [value for _, value in steps for _ in range(16)]
        group["PointData/heat"] = values
        group["PointData/wide"] = [[value] * 12 for value in values]
        group["CellData/move [mm]"] = [[n, 2 * n, 3 * n] for n in range(count)]
        if len(steps) == 1:
            return
        times = group.create_group("Steps")
        times.attrs["NSteps"] = len(steps)
        times["Values"] = [0.5 * (n + 1) for n in range(len(steps))]
        far = 0 if shared_mesh else 1
        times["PartOffsets"] = [far * 2 * n for n in range(len(steps))]
        times["NumberOfParts"] = [2] * len(steps)
        times["PointOffsets"] = [far * 16 * n for n in range(len(steps))]
        times["CellOffsets"] = [[far * 2 * n] for n in range(len(steps))]
        times["ConnectivityIdOffsets"] = [[far * 16 * n] for n in range(len(steps))]
        times["PointDataOffsets/heat"] = [16 * n for n in range(len(steps))]
        times["PointDataOffsets/wide"] = [16 * n for n in range(len(steps))]


def vtkhdf_is_read(folder):
    try:
        import h5py
    except ImportError:
        return "skipped: h5py is not installed"
    cubes_of_vtkhdf(folder, h5py, "one.vtkhdf", [(2, 5)])
    result = program.run([folder.ombre, "info", "one.vtkhdf", "--json"], cwd=folder.path)
    if "OMBRE_HDF5" in result.stderr + result.stdout:
        return "skipped: built without HDF5"

    def info(name, *arguments):
        return next(event for event in folder.events("info", name, *arguments) if "fields" in event)
    found = info("one.vtkhdf")
    expect(found["nodes"] == 16 and found["elements"] == {"C3D8": 2} and found["step_times"] == [], str(found))
    expect(found["bounds_mm"] == [0, 0, 0, 2, 2, 2], str(found))
    near(found["volume_mm3"], 8, 1e-9, "the volume")
    expect({field["name"]: field["ranges"] for field in found["fields"]} ==
           {"heat": [[5, 5]], "move": [[0, 1], [0, 2], [0, 3]]}, str(found["fields"]))
    expect(found["left_out"] == [{"what": "fields of more than 9 numbers (wide)", "count": 1}], str(found["left_out"]))
    for name, shared, sides in (("steps.hdf", False, (2, 3)), ("shared.hdf", True, (2, 2))):
        cubes_of_vtkhdf(folder, h5py, name, [(2, 5), (3, 7)], shared)
        for arguments, side, heat in (((), sides[1], 7), (("--step", "1"), sides[0], 5), (("--step", "2"), sides[1], 7)):
            found = info(name, *arguments)
            expect(found["bounds_mm"] == [0, 0, 0, side, side, side] and found["step_times"] == [0.5, 1], str(found))
            expect(found["fields"][0]["ranges"] == [[heat, heat]] and found["elements"] == {"C3D8": 2}, str(found))
        folder.write("solid.vcad", f'mesh("{name}", red, step=1);')
        expect(folder.voxels("solid.vcad", "0.5") == {"red": (2 * sides[0])**3}, "the voxels of a step")
    with h5py.File(folder.path / "shared.hdf", "r+") as file:
        del file["VTKHDF/Steps/NumberOfParts"]
    said = folder.run("info", "shared.hdf", status=1).stderr
    expect("the steps share pieces" in said, said)
    with h5py.File(folder.path / "steps.hdf", "r+") as file:
        del file["VTKHDF/Steps/NumberOfParts"]
    expect(info("steps.hdf", "--step", "1")["bounds_mm"] == [0, 0, 0, 2, 2, 2], "the pieces of a step")
    return wrong_vtkhdf(folder, h5py)


def wrong_vtkhdf(folder, h5py):
    """Files that are no grid, or not whole, are errors that name what is wrong; so are numbers in other files."""
    def image(group):
        group.attrs["Type"] = b"ImageData"

    def replace(array, numbers):
        def change(group):
            del group[array]
            group[array] = numbers
        return change

    def elsewhere(group):
        del group["Points"]
        layout = h5py.VirtualLayout(shape=(16, 3), dtype="f8")
        layout[:] = h5py.VirtualSource("other.h5", "points", shape=(16, 3))
        group.create_virtual_dataset("Points", layout)

    def polyhedron(group):
        group["Types"][0] = 42
    for change, wanted in ((image, "no unstructured grid but \"ImageData\""),
                           (replace("Offsets", [0, 8, 8, 16]), "begin with 8, not 0"),
                           (replace("Types", [12]), "\"Types\": it has 1 rows"),
                           (replace("Types", [12, 25]), "cell 0 has not the 20 nodes of its type"),
                           (replace("Types", [12, 26]), "of VTK's type 26"),
                           (replace("Connectivity", [0, 1, 2, 3, 4, 5, 6, 8] * 2), "names point 8; there are 8"),
                           (replace("PointData/heat", [1, 2]), "\"PointData/heat\": it has 2 rows"),
                           (replace("NumberOfPoints", [8, -8]), "expected counts, found -8"),
                           (replace("NumberOfPoints", [8, 2**40]), "\"Points\": it has 16 rows"),
                           (elsewhere, "lie in other files"), (polyhedron, "no faces of polyhedra")):
        cubes_of_vtkhdf(folder, h5py, "wrong.vtkhdf", [(2, 5)])
        with h5py.File(folder.path / "wrong.vtkhdf", "r+") as file:
            change(file["VTKHDF"])
        said = folder.run("info", "wrong.vtkhdf", status=1).stderr
        expect(wanted in said and "wrong.vtkhdf" in said, said)
    return ""


def results_are_described(folder):
    folder.solve()
    text = folder.run("info", "cube.vtu").stdout
    for line in ("nodes     125, from (-5, -5, -5) to (5, 5, 5) mm", "elements  64 C3D8", "von Mises stress, MPa, of elements: 100"):
        expect(line in text, text)
    event = json.loads(folder.run("info", "cube.vtu", "--json").stdout.splitlines()[0])
    moves = next(field for field in event["fields"] if field["name"] == "displacement")
    near(moves["ranges"][2][1], 10 * STRAIN, 1e-6, "the greatest displacement")
    expect(moves["of"] == "nodes" and moves["unit"] == "mm" and event["elements"] == {"C3D8": 64}, str(event))


def results_are_drawn(folder):
    """Ten times the displacement makes the block 10 + 100*strain mm high, and narrower."""
    folder.solve()
    folder.run("render", "cube.vtu", "--by", "von_mises", "--legend", "--size", "200x150", "-o", "stress.png")
    folder.run("render", "cube.vtu", "--by", "displacement", "--deform", "10", "--size", "200x150", "-o", "moved.png")
    pictures = [(folder.path / name).read_bytes() for name in ("stress.png", "moved.png")]
    expect(pictures[0][:4] == pictures[1][:4] == b"\x89PNG" and pictures[0] != pictures[1], "no pictures")
    folder.write("moved.vcad", 'mesh("cube.vtu", red, deform=10);')
    count = sum(folder.voxels("moved.vcad", "0.25").values())
    wanted = (10 + 100 * STRAIN) * (10 - 39 * STRAIN) ** 2
    near(count / 64, wanted, 0.03 * wanted, "the volume")
    for arguments in (("render", "cube.vcad", "--deform", "2"), ("render", "cube.vcad", "--step", "2"), ("render", "cube.vtu", "--by", "heat")):
        expect("error" in folder.run(*arguments, "-o", "never.png", status=1).stderr, str(arguments))
    expect(not (folder.path / "never.png").exists(), "a picture is left")


def wrong_use_is_reported(folder):
    folder.solve()

    def error(design, status=1):
        folder.write("wrong.vcad", design + "\ncube(10, mix(red, blue, r.value));")
        return folder.run("slice", "wrong.vcad", "--voxel", "1", "-o", "never", status=status).stderr
    for call, what in ((("none.vtu",), "none.vtu"), (("cube.vtu",), 'has the fields "displacement", "nodal von Mises stress"'),
                       (("cube.vtu", "heat"), '"heat"'), (("cube.vtu", "s"), '"s"'),
                       (("cube.vtu", "stress"), 'write component="xx"'),
                       (("cube.vtu", "von_mises", "x"), "leave component out"),
                       (("cube.vtu", "displacement", "w"), "it has x, y, z"),
                       (("cube.vcad", "a"), "cube.vcad")):
        reported = error("r = results(%s);" % ", ".join(json.dumps(word) for word in call))
        expect(what in reported and "wrong.vcad:1:5" in reported, reported)
    expect("outside=\"nearest\"" in error('r = results("cube.vtu", "von_mises", within=2);'), "within")
    data = (folder.path / "cube.vtu").read_bytes()
    for size in (100, 600, len(data) // 2, len(data) - 3000):
        (folder.path / "cut.vtu").write_bytes(data[:size])
        expect("cut.vtu" in error('r = results("cut.vtu", "von_mises");'), "a file that is cut off")
    expect(not (folder.path / "never").exists(), "a folder is left")


CHECKS = [own_results_are_read_back, outside_is_as_requested, the_mesh_is_a_solid, coverage_is_reported,
          bytes_do_not_depend_on_threads, calculix_is_read, tables_are_read, steps_are_chosen, vtkhdf_is_read, results_are_described,
          results_are_drawn, wrong_use_is_reported]


if __name__ == "__main__":
    raise SystemExit(program.main(Folder, program.named(CHECKS)))

#!/usr/bin/env python3
"""Voxel grids, run as a user would and read by programs that are not ours.

    python3 tests/run_voxels.py build/dev/apps/ombre/ombre
"""
import gzip
import json
import math
import re
import shutil
import signal
import struct
import subprocess

import processes
import program
from program import expect

try:
    import numpy
except ImportError:
    numpy = None

BALL = 'fgrade(["0.5 + z/10", "0.5 - z/10"], ["red", "blue"]) { sphere(5); }'


class Grid(program.Folder):
    """A folder with a design in it."""

    FILES = {"ball.vcad": BALL}

    def voxels(self, out, *arguments, **options):
        return self.run("voxels", "ball.vcad", "-o", out, *arguments, **options)

    def floats(self, name):
        data = (self.path / name).read_bytes()
        return struct.unpack(f"<{len(data) // 4}f", data)


def nrrd(path):
    """Header fields and numbers of a file."""
    header, data = path.read_bytes().split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in header.decode().splitlines()[1:] if ": " in line and ":=" not in line)
    return fields, gzip.decompress(data) if fields["encoding"] == "gzip" else data


def materials_are_those_of_slices(grid):
    grid.voxels("ball.raw", "--voxel", "0.4", "--seed", "7", "--dither", "blue-noise")
    grid.run("slice", "ball.vcad", "-o", "slices", "--voxel", "0.4", "--seed", "7", "--dither", "blue-noise")
    about = json.loads((grid.path / "ball.raw.json").read_text())
    nx, ny, nz = about["dimensions"]
    data = (grid.path / "ball.raw").read_bytes()
    expect(len(data) == nx * ny * nz, "wrong size")
    counts = {m["name"]: data.count(m["id"]) for m in about["materials"]}
    job = json.loads((grid.path / "slices/job.json").read_text())
    expected = {m["name"]: m["voxels"] for m in job["totals"]["materials"]}
    expect(counts == expected, f"{counts}, slices have {expected}")


def distances_are_mathematics(grid):
    grid.voxels("ball.raw", "--voxel", "0.4", "--what", "distance")
    about = json.loads((grid.path / "ball.raw.json").read_text())
    expect(about["distance"] == "exact" and about["data_type"] == "float32", str(about))
    values = iter(grid.floats("ball.raw"))
    (nx, ny, nz), step, origin = about["dimensions"], about["spacing_mm"], about["origin_mm"]
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                place = [o + s * n for o, s, n in zip(origin, step, (i, j, k))]
                expect(abs(next(values) - (math.hypot(*place) - 5)) < 1e-5, f"at {place}")


def numpy_reads_them(grid):
    if numpy is None:
        return "skipped: no NumPy"
    grid.voxels("ball.npy", "--voxel", "0.4,0.5,0.8")
    ids = numpy.load(grid.path / "ball.npy")
    expect(ids.shape == (13, 20, 25) and ids.dtype == numpy.uint8, f"{ids.shape} {ids.dtype}")
    grid.voxels("part.npy", "--voxel", "0.4,0.5,0.8", "--what", "fractions")
    red, blue = numpy.load(grid.path / "part_red.npy"), numpy.load(grid.path / "part_blue.npy")
    expect(red.dtype == numpy.float32, str(red.dtype))
    expect(numpy.allclose(red + blue, ids != 0), "fractions do not sum to one inside")
    heights = -5 + 0.8 * (numpy.arange(13) + 0.5)
    expect(numpy.allclose(red[1:12, 10, 12], 0.5 + heights[1:12] / 10, atol=1e-6), str(red[:, 10, 12]))
    return ""


def nrrd_is_in_millimetres(grid):
    grid.voxels("ball.nrrd", "--voxel", "0.5", "--what", "distance")
    grid.voxels("zip.nrrd", "--voxel", "0.5", "--what", "distance", "--gzip")
    (plain, data), (zipped, unzipped) = nrrd(grid.path / "ball.nrrd"), nrrd(grid.path / "zip.nrrd")
    expect(data == unzipped and len(data) == 4 * 20 ** 3, "the numbers differ")
    expect(zipped["encoding"] == "gzip" and plain["encoding"] == "raw", "wrong encoding")
    expect(plain["sizes"] == "20 20 20" and plain["type"] == "float", str(plain))
    expect(plain["space directions"] == "(0.5,0,0) (0,0.5,0) (0,0,0.5)", str(plain))
    expect(plain["space origin"] == "(-4.75,-4.75,-4.75)", str(plain))


TYPED = """attribute("modulus", "100 + x") attribute("fibre", ["x", "y", 1]) attribute("color_rgba", "#ff8000")
  attribute("tissue", mix(red, blue, "0.5 + z/10")) sphere(5, green);"""


def vti(path):
    """Header and arrays of a file of VTK image data, by a reader of its own: [(name, components)] -> numbers."""
    data = path.read_bytes()
    begin = data.index(b'<AppendedData encoding="raw">\n_') + len(b'<AppendedData encoding="raw">\n_')
    header = data[:begin].decode()
    arrays = {}
    for text in re.findall(r"<DataArray [^>]*>", header):
        fields = dict(re.findall(r'(\w+)="([^"]*)"', text))
        at = begin + int(fields["offset"])
        size = struct.unpack_from("<Q", data, at)[0]
        code, width = ("f", 4) if fields["type"] == "Float32" else ("B", 1)
        arrays[fields["Name"]] = (int(fields.get("NumberOfComponents", 1)),
                                  struct.unpack_from(f"<{size // width}{code}", data, at + 8))
    return header, arrays


def image_data_holds_all_grids(grid):
    (grid.path / "ball.vcad").write_text(TYPED, encoding="utf-8")
    what = "materials,fractions,distance,attributes"
    grid.voxels("ball.vti", "--voxel", "0.5,0.5,1", "--what", what)
    header, arrays = vti(grid.path / "ball.vti")
    expect('WholeExtent="0 20 0 20 0 10" Origin="-5 -5 -5" Spacing="0.5 0.5 1"' in header, header)
    expect([(name, c) for name, (c, _) in arrays.items()] == [("material", 1), ("distance", 1), ("green", 1), ("tissue", 2),
           ("color_rgba", 4), ("fibre", 3), ("modulus", 1)], str(header))
    for n in range(20 * 20 * 10):
        x, y, z = -4.75 + 0.5 * (n % 20), -4.75 + 0.5 * (n // 20 % 20), -4.5 + n // 400
        inside = math.hypot(x, y, z) <= 5
        wanted = {"material": [2 if inside else 0], "distance": [math.hypot(x, y, z) - 5], "green": [float(inside)],
                  "modulus": [100 + x if inside else 0], "fibre": [x, y, 1] if inside else [0, 0, 0],
                  "color_rgba": [1, 128 / 255, 0, 1] if inside else [0] * 4,
                  "tissue": [0.5 - z / 10, 0.5 + z / 10] if inside else [0, 0]}
        for name, values in wanted.items():
            size, numbers = arrays[name]
            found = numbers[n * size:(n + 1) * size]
            near = len(found) == len(values) and all(abs(a - b) < 1e-5 for a, b in zip(found, values))
            expect(near, f"{name} at {(x, y, z)}: {found}, expected {values}")
    grid.voxels("again.vti", "--voxel", "0.5,0.5,1", "--what", what, "--threads", "1")
    expect((grid.path / "again.vti").read_bytes() == (grid.path / "ball.vti").read_bytes(), "threads show")
    grid.voxels("part.raw", "--voxel", "0.5,0.5,1", "--what", "materials,fibre.y")
    expect(grid.floats(next(name for name in grid.names() if name.startswith("part_fibre") and name.endswith(".raw")))
           == arrays["fibre"][1][1::3], "dense files differ")


def attributes_come_back(grid):
    """Numbers, vectors, colours and mixtures, through files of grids and back as values of a design, are what they were."""
    (grid.path / "ball.vcad").write_text(TYPED, encoding="utf-8")
    names = ["modulus", "fibre.x", "fibre.y", "fibre.z", "color_rgba.r", "color_rgba.a", "tissue.red", "tissue.blue"]
    parts = {"x": 0, "y": 1, "z": 2, "r": 0, "a": 3, "red": 0, "blue": 1}
    points = [(x, y, z) for x in (-3.25, 0.25, 2.75) for y in (-1.75, 1.25) for z in (-2.5, 0.5)]
    at = ["--at=" + ",".join(map(repr, point)) for point in points]

    def values_of(design):
        reported = program.run([grid.ombre, "probe", design, "--json", *at], cwd=grid.path)
        expect(reported.returncode == 0, reported.stdout + reported.stderr)
        found = [json.loads(line) for line in reported.stdout.splitlines()]
        return [event["attributes"] for event in found if event["event"] == "point"]

    def source(ending, name):
        whole, _, part = name.partition(".")
        if ending == "vti":
            channel = f", channel={parts[part]}" if part else ""
            return f'volume("typed.vti", series="{whole}"{channel})'
        if ending == "vdb":
            return f'volume("typed.vdb", series="{name}")'
        return f'volume("typed_{name.replace(".", "_")}.npy")'

    direct = values_of("ball.vcad")
    grid.voxels("typed.vti", "--voxel", "0.5,0.5,1", "--what", "attributes")
    grid.voxels("typed.npy", "--voxel", "0.5,0.5,1", "--what", "attributes")
    endings = ["vti", "npy"]
    sparse = program.run(grid.command("voxels", "ball.vcad", "-o", "typed.vdb", "--voxel", "0.5,0.5,1", "--what",
                                      "attributes"), cwd=grid.path)
    if "without OpenVDB" not in sparse.stderr:
        expect(sparse.returncode == 0, sparse.stderr)
        endings.append("vdb")
    for ending in endings:
        text = "".join(f'attribute("v{n}", {source(ending, name)}.nearest) ' for n, name in enumerate(names))
        (grid.path / "back.vcad").write_text(text + "cube(10);\n", encoding="utf-8")
        for point, wanted, found in zip(points, direct, values_of("back.vcad")):
            for n, name in enumerate(names):
                expect(abs(found[f"v{n}"] - wanted[name]) < 1e-5,
                       f".{ending}: {name} at {point}: {found[f'v{n}']}, expected {wanted[name]}")


def scans_are_resampled_and_cropped(grid):
    """Numbers of a scan that are linear in space are so on other voxels too; the nearest voxel's are whole."""
    count, step, origin = (10, 8, 6), (1.0, 1.5, 2.0), (-4.0, -5.0, -5.0)
    values = [2 * (origin[0] + i * step[0]) + 3 * (origin[1] + j * step[1]) - (origin[2] + k * step[2])
              for k in range(count[2]) for j in range(count[1]) for i in range(count[0])]
    (grid.path / "scan.raw").write_bytes(struct.pack(f"<{len(values)}f", *values))
    (grid.path / "scan.raw.json").write_text(json.dumps({
        "data_type": "float32", "byte_order": "little", "dimensions": count, "spacing_mm": step, "origin_mm": origin}))
    grid.run("voxels", "scan.raw", "-o", "small.raw", "--voxel", "0.5", "--box=-2,-2,-2,2,1,2")
    about = json.loads((grid.path / "small.raw.json").read_text())
    nx, ny, nz = about["dimensions"]
    found, first = grid.floats("small.raw"), about["origin_mm"]
    expect(8 <= nx <= 9 and 6 <= ny <= 7 and 8 <= nz <= 9, f"dimensions {nx} {ny} {nz}")
    for n, value in enumerate(found):
        x, y, z = first[0] + n % nx * 0.5, first[1] + n // nx % ny * 0.5, first[2] + n // nx // ny * 0.5
        expect(abs(value - (2 * x + 3 * y - z)) < 1e-4, f"{value} at {(x, y, z)}")
    grid.run("voxels", "scan.raw", "-o", "labels.raw", "--voxel", "0.5", "--what", "nearest", "--box=-2,-2,-2,2,1,2")
    expect(set(grid.floats("labels.raw")) <= {struct.unpack("<f", struct.pack("<f", v))[0] for v in values}, "other numbers")
    error = grid.run("voxels", "scan.raw", "-o", "c.raw", status=1).stderr
    expect("--voxel 1" in error and "ombre info scan.raw" in error, error)


def vtk_reads_image_data(grid):
    """With VTK where there is one: pip install vtk. Its classes come from the package of its own names."""
    try:
        from vtkmodules.vtkIOXML import vtkXMLImageDataReader
    except ImportError:
        return "skipped: no VTK"
    (grid.path / "ball.vcad").write_text(TYPED, encoding="utf-8")
    grid.voxels("ball.vti", "--voxel", "0.5", "--what", "materials,distance,attributes")
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(grid.path / "ball.vti"))
    reader.Update()
    image = reader.GetOutput()
    expect(image.GetBounds() == (-5, 5, -5, 5, -5, 5), str(image.GetBounds()))
    cells = image.GetCellData()
    modulus, fibre = cells.GetArray("modulus"), cells.GetArray("fibre")
    place = [0.0] * 3
    for cell in range(0, image.GetNumberOfCells(), 37):
        image.GetCell(cell).GetCentroid(place)
        if math.hypot(*place) > 5:
            continue
        expect(abs(modulus.GetTuple1(cell) - 100 - place[0]) < 1e-4, f"modulus at {place}")
        expect(all(abs(a - b) < 1e-5 for a, b in zip(fibre.GetTuple3(cell), (place[0], place[1], 1))), f"fibre at {place}")
    return ""


def boxes_are_cut_out(grid):
    grid.voxels("ball.raw", "--voxel", "0.5", "--box", "0,0,0,1,2,4.99")
    about = json.loads((grid.path / "ball.raw.json").read_text())
    expect(about["dimensions"] == [2, 4, 10] and about["origin_mm"] == [0.25, 0.25, 0.25], str(about))
    beside = grid.voxels("b.raw", "--box", "9,9,9,10,10,10", status=1).stderr
    expect("is beside the part, which lies from -5,-5,-5 to 5,5,5 mm" in beside, beside)
    empty = grid.voxels("b.raw", "--voxel", "0.5", "--box", "4.6,4.6,4.6,5,5,5").stderr
    expect("no voxel's centre is inside" in empty, empty)


def slips_get_remedies(grid):
    for arguments, message in [(["b.stl"], "let it end in .npy, .nrrd, .raw, .vti, .vdb or .nvdb"),
                               (["b"], "does not say a format"),
                               (["b.raw", "--gzip"], "--gzip is for .nrrd files"),
                               (["b.raw", "--what", "colour"], "the design has no attribute"),
                               (["b.raw", "--what", "distance,"], "write materials, fractions, distance, attributes"),
                               (["b.raw", "--box", "1,2,3"], "write for example --box")]:
        error = grid.voxels(*arguments, status=1).stderr
        expect(message in error, f"{arguments}: {error}")


def files_are_kept(grid):
    (grid.path / "ball.raw.json").write_text("mine")
    error = grid.voxels("ball.raw", status=2).stderr
    expect("ball.raw.json exists already" in error, error)
    grid.voxels("ball.raw", "--force")
    error = grid.voxels("ball.raw", status=2).stderr
    expect("ball.raw exists already" in error, error)
    error = grid.voxels("missing/ball.npy", status=2).stderr
    expect("the folder is missing" in error, error)
    error = grid.voxels("huge.npy", "--voxel", "0.0005", status=2).stderr
    expect("the disk of" in error and "--voxel" in error, error)
    expect(grid.names() == ["ball.raw", "ball.raw.json", "ball.vcad"], str(grid.names()))


def interrupts_leave_nothing(grid):
    for name in ["ball.npy", "ball.vdb"]:
        job = subprocess.Popen(grid.command("voxels", "ball.vcad", "-o", name, "--what", "distance", "--voxel", "0.01",
                                            "--threads", "1", "--force"),
                               cwd=grid.path, env=program.environment(), stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        processes.wait_until(lambda: job.poll() is not None or (grid.path / (name + ".part")).exists(), f"{name} is begun")
        job.send_signal(signal.SIGINT)
        error = job.communicate(timeout=program.PATIENCE_S)[1]
        if "without OpenVDB" in error:
            continue
        expect(job.returncode == 130, f"status {job.returncode}: {error}")
        expect(grid.names() == ["ball.vcad"], str(grid.names()))


def sparse_files_are_the_same_on_any_threads(grid):
    for ending in [".vdb", ".nvdb"]:
        made = set()
        for threads in ["1", "3"]:
            result = program.run(grid.command("voxels", "ball.vcad", "-o", "b" + ending, "--voxel", "0.25", "--force",
                                              "--threads", threads), cwd=grid.path)
            if "without OpenVDB" in result.stderr:
                return "skipped: no OpenVDB"
            expect(result.returncode == 0, result.stderr)
            made.add((grid.path / ("b" + ending)).read_bytes())
        expect(len(made) == 1, f"{ending} depends on threads")
    return ""


def openvdb_prints_the_same(grid):
    """By OpenVDB's own program: voxels whose centres are inside, and three voxels on both sides of the surface."""
    if not shutil.which("vdb_print"):
        return "skipped: no vdb_print"
    made = program.run(grid.command("voxels", "ball.vcad", "-o", "ball.vdb", "--voxel", "0.5"), cwd=grid.path)
    if "without OpenVDB" in made.stderr:
        return "skipped: no OpenVDB"
    expect(made.returncode == 0, made.stderr)
    reported = program.run(["vdb_print", "-l", "ball.vdb"], cwd=grid.path)
    expect(reported.returncode == 0, reported.stderr)
    found = {}
    for text in reported.stdout.split("Name: ")[1:]:
        box = re.search(r"Bounding box of active voxels: *(.*)", text)[1]
        found[text.splitlines()[0]] = (re.search(r"class: (.*)", text)[1], box, re.search(r"voxel size: (.*)", text)[1])
    expect(found == {"distance": ("level set", "[-3, -3, -3] -> [22, 22, 22]", "0.5"),
                     "red": ("fog volume", "[0, 0, 0] -> [19, 19, 19]", "0.5"),
                     "blue": ("fog volume", "[0, 0, 0] -> [19, 19, 19]", "0.5")}, str(found))
    return ""


CHECKS = [materials_are_those_of_slices, distances_are_mathematics, numpy_reads_them, nrrd_is_in_millimetres, image_data_holds_all_grids, attributes_come_back, scans_are_resampled_and_cropped, vtk_reads_image_data,
          boxes_are_cut_out, slips_get_remedies, files_are_kept, interrupts_leave_nothing,
          sparse_files_are_the_same_on_any_threads, openvdb_prints_the_same]


if __name__ == "__main__":
    raise SystemExit(program.main(Grid, program.named(CHECKS)))

#!/usr/bin/env python3
"""Results of simulations beside VTK and meshio: files that they write in all of their variants.

Each file is the same (numbers of nodes and solid elements, box, volume, ranges of fields, values inside elements), refused
with a message, or different, which is never right. Libraries that are not installed are named and passed over; with
--install FOLDER they are put into a virtual environment there, by pip.

    python3 tests/results_beside_vtk.py build/release/apps/ombre/ombre [--install FOLDER]
"""
import argparse
import collections
import concurrent.futures
import importlib
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import warnings

import other_libraries

PACKAGES = ("vtk", "meshio", "h5py", "numpy")
FLAT = set(range(0, 10)) | {21, 22, 23, 28, 30, 34, 35, 36, 68, 69, 70}
GRADIENT = (2.0, 3.0, 5.0)


def linear(point):
    """The field of nodes, which every element interpolates exactly."""
    return 1 + sum(a * x for a, x in zip(GRADIENT, point))


class Comparison:
    def __init__(self, name, ombre, folder):
        self.name, self.ombre, self.folder = name, ombre, folder
        self.counts, self.reasons, self.waiting = collections.Counter(), collections.Counter(), []

    def run(self, *arguments):
        return subprocess.run([self.ombre, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def add(self, path, expected, step=0):
        """Compares a file with what it must hold; `expected` has the members of info, and "at": points with values."""
        self.waiting.append((path.name, expected, step))

    def finish(self):
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for (name, _, step), (outcome, what) in zip(self.waiting, pool.map(lambda w: self.compare(*w), self.waiting)):
                self.counts[outcome] += 1
                if outcome == "different":
                    print(f"DIFFERENT {self.name}: {name}{f' step {step}' if step else ''}: {what}")
                elif outcome == "refused":
                    self.reasons[what] += 1
        total = sum(self.counts.values())
        print(f"{self.name}: {total} files, {self.counts['same']} the same, {self.counts['refused']} refused with a "
              f"message, {self.counts['different']} different")
        for reason, count in self.reasons.most_common():
            print(f"    {count} refused: {reason}")
        return self.counts["different"]

    def compare(self, name, expected, step):
        chosen = ["--step", step] if step else []
        result = self.run("info", name, "--json", *chosen)
        if result.returncode != 0:
            errors = [event.get("message", "") for event in map(json.loads, result.stdout.splitlines())
                      if event.get("severity", event.get("event")) == "error"]
            said = (errors or [result.stderr]) [0].splitlines()
            return ("refused", re.sub(r"\d+", "N", said[0].replace(name, "FILE"))[:110]) if said and said[0] else ("different", "no message")
        found = next(event for event in map(json.loads, result.stdout.splitlines())
                     if event["event"] in ("results", "volume"))
        problem = self.problem_of(found, expected) or self.problem_inside(name, expected, step)
        return ("different", problem) if problem else ("same", "")

    @staticmethod
    def problem_of(found, expected):
        if "least" in expected:
            got = (found["size"], found["least"], found["greatest"])
            wanted = (expected["size"], expected["least"], expected["greatest"])
            return "" if close(flat(got), flat(wanted)) else f"{got}, not {wanted}"
        elements = sum(found["elements"].values())
        if "nodes" in expected and found["nodes"] != expected["nodes"]:
            return f"{found['nodes']} nodes, not {expected['nodes']}"
        if "elements" in expected and elements != expected["elements"]:
            return f"{elements} elements, not {expected['elements']}"
        if not close(found["bounds_mm"], expected["bounds_mm"]):
            return f"the box {found['bounds_mm']}, not {expected['bounds_mm']}"
        if elements and expected["volume_mm3"] and not close([found["volume_mm3"]], [expected["volume_mm3"]]):
            return f"the volume {found['volume_mm3']}, not {expected['volume_mm3']}"
        ranges = {field["name"]: field["ranges"] for field in found["fields"]}
        for field, wanted in expected.get("ranges", {}).items():
            if not close(flat(ranges.get(field, [])), flat(wanted)):
                return f"the field {field} from {ranges.get(field)}, not {wanted}"
        return ""

    def problem_inside(self, name, expected, step):
        """Compares the values of both fields in the middle of some elements."""
        if not expected.get("at"):
            return ""
        design = self.folder / f"{name}.{step}.vcad"
        chosen = f", step={step}" if step else ""
        fields = "".join(f'attribute("{field}", results("{name}", "{field}"{chosen}).value) '
                         for field in expected["at"][0][1])
        design.write_text(fields + "rectprism((1000, 1000, 1000));", encoding="utf-8")
        places = [word for point, _ in expected["at"] for word in ("--at", ",".join(map(repr, point)))]
        result = self.run("probe", design.name, *places, "--json")
        events = [event["attributes"] for event in map(json.loads, result.stdout.splitlines()) if "attributes" in event]
        if result.returncode != 0 or len(events) != len(expected["at"]):
            return f"no values: {result.stdout[-300:]} {result.stderr[-300:]}"
        for values, (point, wanted) in zip(events, expected["at"]):
            if not close([values[field] for field in wanted], list(wanted.values())):
                return f"{values} at {point}, not {wanted}"
        return ""


def flat(nested):
    for item in nested:
        if isinstance(item, (list, tuple)):
            yield from flat(item)
        else:
            yield item


def close(found, wanted):
    found, wanted = list(found), list(wanted)
    return len(found) == len(wanted) and all(
        a is not None and b is not None and abs(a - b) <= 2e-6 * max(1, abs(b)) for a, b in zip(found, wanted))


class Grids:
    """Grids of VTK, one for each type of cells, moved by a map that keeps straight lines."""

    def __init__(self, vtk, numpy):
        self.vtk, self.numpy = vtk, numpy

    def of_type(self, cell_type, order=1, blocks=(2, 2, 1)):
        source = self.vtk.vtkCellTypeSource()
        source.SetCellType(cell_type)
        source.SetCellOrder(order)
        source.SetBlocksDimensions(*blocks)
        source.SetOutputPrecision(1)
        source.Update()
        return self.finished(source.GetOutput(), is_turned=cell_type != self.vtk.VTK_VOXEL)

    def of_polyhedra(self):
        """The cells of a grid of bricks as polyhedra, and bricks behind them."""
        vtk = self.vtk
        bricks, grid = self.of_type(vtk.VTK_HEXAHEDRON, blocks=(2, 2, 2)), vtk.vtkUnstructuredGrid()
        grid.SetPoints(bricks.GetPoints())
        for n in range(bricks.GetNumberOfCells()):
            cell, faces = bricks.GetCell(n), vtk.vtkIdList()
            if n % 3 == 2:
                grid.InsertNextCell(cell.GetCellType(), cell.GetPointIds())
                continue
            faces.InsertNextId(cell.GetNumberOfFaces())
            for face in map(cell.GetFace, range(cell.GetNumberOfFaces())):
                faces.InsertNextId(face.GetNumberOfPoints())
                for corner in range(face.GetNumberOfPoints()):
                    faces.InsertNextId(face.GetPointId(corner))
            grid.InsertNextCell(vtk.VTK_POLYHEDRON, faces)
        return self.finished(grid, is_turned=False)

    def finished(self, grid, is_turned):
        """With fields: f is linear in space, v is a vector, c is the number of a cell."""
        vtk, numpy = self.vtk, self.numpy
        points = numpy.array([grid.GetPoint(n) for n in range(grid.GetNumberOfPoints())], float).reshape(-1, 3)
        if is_turned:
            points = points @ numpy.array([[2, 0.25, 0], [0, 1.5, 0.5], [0.125, 0, 1]]) + [1, -2, 3]
        made = vtk.vtkUnstructuredGrid()
        made.DeepCopy(grid)
        for data in (made.GetPointData(), made.GetCellData()):
            data.Initialize()
        moved = vtk.vtkPoints()
        moved.SetDataTypeToDouble()
        for point in points:
            moved.InsertNextPoint(*point)
        made.SetPoints(moved)
        self.set_field(made.GetPointData(), "f", [linear(point) for point in points])
        self.set_field(made.GetPointData(), "v", points * [1, -1, 2])
        self.set_field(made.GetCellData(), "c", numpy.arange(made.GetNumberOfCells(), dtype="f4") + 10)
        return made

    def set_field(self, data, name, values):
        from vtk.util.numpy_support import numpy_to_vtk
        array = numpy_to_vtk(self.numpy.asarray(values), deep=1)
        array.SetName(name)
        data.AddArray(array)

    def expected(self, *grids, points_differ=False):
        """What info must say of these grids together."""
        vtk, numpy = self.vtk, self.numpy
        points, at, volume, solids, has_polyhedra = [], [], 0.0, 0, False
        cells = []
        for grid in grids:
            sizes = vtk.vtkCellSizeFilter()
            sizes.SetInputData(grid)
            sizes.Update()
            volumes = sizes.GetOutput().GetCellData().GetArray("Volume")
            points += [grid.GetPoint(n) for n in range(grid.GetNumberOfPoints())]
            numbers = grid.GetCellData().GetArray("c")
            for n in range(grid.GetNumberOfCells()):
                kind = grid.GetCellType(n)
                if kind in FLAT:
                    continue
                solids += 1
                has_polyhedra = has_polyhedra or kind == vtk.VTK_POLYHEDRON
                volume += abs(volumes.GetValue(n))
                cells.append(numbers.GetValue(n))
                corners = grid.GetCell(n).GetPoints()
                middle = numpy.mean([corners.GetPoint(k) for k in range(corners.GetNumberOfPoints())], axis=0)
                at.append((tuple(map(float, middle)), {"f": linear(middle), "c": numbers.GetValue(n)}))
        points = numpy.array(points)
        ranges = {"f": [span(linear(p) for p in points)],
                  "v": [span(points[:, axis] * factor) for axis, factor in enumerate((1, -1, 2))]}
        if cells:
            ranges["c"] = [span(cells)]
        result = {"bounds_mm": [*points.min(axis=0), *points.max(axis=0)], "volume_mm3": volume, "at": at[:6]}
        if not has_polyhedra:  # whose points in the middle are nodes too
            result |= {"nodes": len(points), "elements": solids, "ranges": ranges}
        return result


def span(values):
    values = [float(value) for value in values]
    return [min(values), max(values)]


def named_grids(grids):
    """Grids of all types of cells that have one, by name."""
    vtk = grids.vtk
    plain = ("TETRA", "VOXEL", "HEXAHEDRON", "WEDGE", "PYRAMID", "QUADRATIC_TETRA", "QUADRATIC_HEXAHEDRON",
             "QUADRATIC_WEDGE", "QUADRATIC_PYRAMID", "TRIQUADRATIC_HEXAHEDRON", "TRIANGLE", "QUAD", "LINE",
             "PENTAGONAL_PRISM", "HEXAGONAL_PRISM", "QUADRATIC_TRIANGLE")
    curved = ("LAGRANGE_TETRAHEDRON", "LAGRANGE_HEXAHEDRON", "LAGRANGE_WEDGE", "LAGRANGE_QUADRILATERAL",
              "BEZIER_TETRAHEDRON", "BEZIER_HEXAHEDRON")
    found = {}
    wanted = [(name, 1) for name in plain] + list(itertools.product(curved, (1, 2, 3)))
    for name, order in wanted:
        grid = grids.of_type(getattr(vtk, "VTK_" + name), order)
        if grid.GetNumberOfCells() > 0:
            found[f"{name.lower()}_{order}"] = grid
    found["polyhedra"] = grids.of_polyhedra()
    together = vtk.vtkAppendFilter()
    for name in ("tetra_1", "hexahedron_1", "wedge_1", "pyramid_1", "triangle_1"):
        if name in found:
            together.AddInputData(shifted(grids, found[name], 20 * together.GetNumberOfInputConnections(0)))
    together.Update()
    found["mixed"] = grids.finished(together.GetOutput(), is_turned=False)
    return found


def shifted(grids, grid, by):
    copy = grids.vtk.vtkUnstructuredGrid()
    copy.DeepCopy(grid)
    points = copy.GetPoints()
    for n in range(points.GetNumberOfPoints()):
        x, y, z = points.GetPoint(n)
        points.SetPoint(n, x + by, y, z)
    return grids.finished(copy, is_turned=False)


COMPRESSORS = {"none": None, "zlib": "vtkZLibDataCompressor", "lz4": "vtkLZ4DataCompressor", "lzma": "vtkLZMADataCompressor"}


def xml_variants():
    for mode, packed in itertools.product(("ascii", "binary", "base64", "raw"), COMPRESSORS):
        if mode == "ascii" and packed != "none":
            continue
        for header, order in itertools.product((32, 64), ("little", "big")):
            yield mode, packed, header, order


def write_xml(vtk, writer, data, path, variant):
    mode, packed, header, order = variant
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary}.get(mode, writer.SetDataModeToAppended)()
    writer.SetEncodeAppendedData(mode == "base64")
    compressor = COMPRESSORS[packed]
    writer.SetCompressor(getattr(vtk, compressor)() if compressor else None)
    writer.SetBlockSize(4096)
    (writer.SetHeaderTypeToUInt32 if header == 32 else writer.SetHeaderTypeToUInt64)()
    (writer.SetByteOrderToLittleEndian if order == "little" else writer.SetByteOrderToBigEndian)()
    writer.Write()
    return path


def with_vtk_xml(modules, comparison):
    grids = Grids(modules["vtk"], modules["numpy"])
    vtk = grids.vtk
    for name, grid in named_grids(grids).items():
        expected = grids.expected(grid)
        variants = list(xml_variants()) if name in ("tetra_1", "mixed", "polyhedra") else [
            ("ascii", "none", 32, "little"), ("binary", "zlib", 32, "little"), ("raw", "lz4", 64, "little"),
            ("base64", "lzma", 64, "big"), ("raw", "none", 64, "little")]
        for variant in variants:
            path = comparison.folder / f"{name}_{'_'.join(map(str, variant))}.vtu"
            comparison.add(write_xml(vtk, vtk.vtkXMLUnstructuredGridWriter(), grid, path, variant), expected)
    pieces_and_collections(grids, comparison)


def pieces_and_collections(grids, comparison):
    """Grids in pieces and steps, by files that name others."""
    vtk = grids.vtk
    parts = [shifted(grids, grids.of_type(vtk.VTK_HEXAHEDRON), by) for by in (0, 30)]
    for n, part in enumerate(parts):
        for packed in COMPRESSORS:
            write_xml(vtk, vtk.vtkXMLUnstructuredGridWriter(), part, comparison.folder / f"part_{n}_{packed}.vtu",
                      ("raw", packed, 64, "little"))
    both = {key: value for key, value in grids.expected(*parts).items()}
    for packed in COMPRESSORS:
        names = [f"part_{n}_{packed}.vtu" for n in range(2)]
        pieces = "".join(f'<Piece Source="{name}"/>' for name in names)
        path = comparison.folder / f"pieces_{packed}.pvtu"
        path.write_text(f'<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid GhostLevel="0">{pieces}'
                        "</PUnstructuredGrid></VTKFile>", encoding="utf-8")
        comparison.add(path, both)
        sets = "".join(f'<DataSet timestep="{time}" part="{part}" file="{name}"/>' for time, part, name in
                       ((0.5, 0, names[0]), (2, 0, names[0]), (2, 1, names[1]), (1, 0, names[1])))
        path = comparison.folder / f"steps_{packed}.pvd"
        path.write_text(f'<VTKFile type="Collection"><Collection>{sets}</Collection></VTKFile>', encoding="utf-8")
        for step, expected in ((0, both), (1, grids.expected(parts[0])), (2, grids.expected(parts[1])), (3, both)):
            comparison.add(path, expected, step)


def with_vtk_images(modules, comparison):
    vtk, numpy = modules["vtk"], modules["numpy"]
    from vtk.util.numpy_support import numpy_to_vtk
    values = numpy.random.default_rng(4).normal(size=7 * 6 * 5)
    for kind in ("u1", "i2", "i4", "f4", "f8"):
        image = vtk.vtkImageData()
        image.SetDimensions(7, 6, 5)
        image.SetSpacing(0.5, 0.75, 2)
        numbers = (values * 40 + 100).astype(kind)
        array = numpy_to_vtk(numbers, deep=1)
        array.SetName("a")
        image.GetPointData().AddArray(array)
        expected = {"size": [7, 6, 5], "least": float(numbers.min()), "greatest": float(numbers.max())}
        for variant in xml_variants():
            path = comparison.folder / f"{kind}_{'_'.join(map(str, variant))}.vti"
            comparison.add(write_xml(vtk, vtk.vtkXMLImageDataWriter(), image, path, variant), expected)


def with_vtkhdf(modules, comparison):
    grids = Grids(modules["vtk"], modules["numpy"])
    vtk = grids.vtk
    from vtkmodules.vtkIOHDF import vtkHDFWriter

    def write(data, name, level):
        path = comparison.folder / name
        writer = vtkHDFWriter()
        writer.SetInputDataObject(data)
        writer.SetFileName(str(path))
        writer.SetCompressionLevel(level)
        writer.Write()
        return path
    found = named_grids(grids)
    for (name, grid), level in itertools.product(found.items(), (0, 5)):
        comparison.add(write(grid, f"{name}_{level}.vtkhdf", level), grids.expected(grid))
    for name in ("hexahedron_1", "polyhedra"):
        parts = [shifted(grids, found[name], by) for by in (0, 30, 60)]
        together = vtk.vtkPartitionedDataSet()
        for n, part in enumerate(parts):
            together.SetPartition(n, part)
        comparison.add(write(together, f"parts_{name}.hdf", 0), grids.expected(*parts))
    for name, moves in (("moving", 30), ("still", 0)):
        path = comparison.folder / f"{name}.vtkhdf"
        steps = [shifted(grids, found["mixed"], moves * n) for n in range(3)]
        write_steps(vtk, vtkHDFWriter(), steps, path)
        for step in range(4):
            comparison.add(path, grids.expected(steps[step - 1]), step)


def write_steps(vtk, writer, steps, path):
    from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
    pipeline = vtk.vtkStreamingDemandDrivenPipeline

    class Steps(VTKPythonAlgorithmBase):
        def __init__(self):
            super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkUnstructuredGrid")

        def RequestInformation(self, request, inputs, outputs):
            times = [0.5 * n for n in range(len(steps))]
            outputs.GetInformationObject(0).Set(pipeline.TIME_STEPS(), times, len(times))
            outputs.GetInformationObject(0).Set(pipeline.TIME_RANGE(), [times[0], times[-1]], 2)
            return 1

        def RequestData(self, request, inputs, outputs):
            time = outputs.GetInformationObject(0).Get(pipeline.UPDATE_TIME_STEP())
            made = vtk.vtkUnstructuredGrid.GetData(outputs, 0)
            made.ShallowCopy(steps[round(2 * time)])
            made.GetInformation().Set(vtk.vtkDataObject.DATA_TIME_STEP(), time)
            return 1
    source = Steps()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(str(path))
    writer.SetWriteAllTimeSteps(True)
    writer.Write()


MESHIO_TYPES = {"tetra_1": "tetra", "hexahedron_1": "hexahedron", "wedge_1": "wedge", "pyramid_1": "pyramid",
                "quadratic_tetra_1": "tetra10", "quadratic_hexahedron_1": "hexahedron20", "triangle_1": "triangle",
                "triquadratic_hexahedron_1": "hexahedron27"}


def with_meshio(modules, comparison):
    meshio, numpy, grids = modules["meshio"], modules["numpy"], Grids(modules["vtk"], modules["numpy"])
    found = named_grids(grids)
    meshes = {}
    for name, kind in MESHIO_TYPES.items():
        if name not in found:
            continue
        grid = found[name]
        points = numpy.array([grid.GetPoint(n) for n in range(grid.GetNumberOfPoints())])
        cells = numpy.array([[grid.GetCell(n).GetPointId(k) for k in range(grid.GetCell(n).GetNumberOfPoints())]
                             for n in range(grid.GetNumberOfCells())])
        numbers = numpy.arange(len(cells), dtype=float) + 10
        meshes[name] = meshio.Mesh(points, [(kind, cells)], {"f": numpy.array([linear(p) for p in points]),
                                                             "v": points * [1, -1, 2]}, {"c": [numbers]})
    for name, mesh in meshes.items():
        expected = grids.expected(found[name])
        for form in ("XML", "HDF"):
            path = comparison.folder / f"{name}_{form}.xdmf"
            meshio.xdmf.write(str(path), mesh, data_format=form)
            comparison.add(path, expected)
        for binary, packed in ((False, None), (True, None), (True, "zlib"), (True, "lzma")):
            path = comparison.folder / f"{name}_{binary}_{packed}.vtu"
            meshio.vtu.write(str(path), mesh, binary=binary, compression=packed)
            comparison.add(path, expected)
        path = comparison.folder / f"{name}.inp"
        try:
            meshio.abaqus.write(str(path), mesh)
        except Exception:  # meshio has no name for this type
            continue
        comparison.add(path, {key: value for key, value in expected.items() if key not in ("at", "ranges")})
    steps_by_meshio(meshio, meshes["hexahedron_1"], grids.expected(found["hexahedron_1"]), comparison)


def steps_by_meshio(meshio, mesh, expected, comparison):
    for form in ("XML", "HDF"):
        path = comparison.folder / f"series_{form}.xdmf"
        before = os.getcwd()
        os.chdir(comparison.folder)  # meshio writes the numbers into the working directory
        try:
            with meshio.xdmf.TimeSeriesWriter(path.name, data_format=form) as writer:
                writer.write_points_cells(mesh.points, mesh.cells)
                for n in range(3):
                    writer.write_data(float(n), point_data={"f": mesh.point_data["f"] * (n + 1)},
                                      cell_data={"c": mesh.cell_data["c"]})
        finally:
            os.chdir(before)
        for step in range(4):
            factor = step or 3
            scaled = dict(expected, ranges={"f": [[factor * x for x in expected["ranges"]["f"][0]]],
                                            "c": expected["ranges"]["c"]},
                          at=[(point, {"f": factor * values["f"], "c": values["c"]}) for point, values in expected["at"]])
            comparison.add(path, scaled, step)


WORK = (("VTK's .vtu, .pvtu and .pvd", ("vtk", "numpy"), with_vtk_xml), ("VTK's .vti", ("vtk", "numpy"), with_vtk_images),
        ("VTK's .vtkhdf", ("vtk", "numpy"), with_vtkhdf), ("meshio", ("vtk", "numpy", "meshio", "h5py"), with_meshio))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("ombre", type=pathlib.Path, help="the program")
    other_libraries.add_option(parser)
    given = parser.parse_args()
    if given.install:
        other_libraries.use(given.install, PACKAGES)
    warnings.simplefilter("ignore")
    different = 0
    for name, needed, work in WORK:
        try:
            modules = {module: importlib.import_module(module) for module in needed}
        except ImportError as error:
            print(f"{name}: {error.name} is not installed")
            continue
        with tempfile.TemporaryDirectory() as folder:
            comparison = Comparison(name, given.ombre.resolve(), pathlib.Path(folder))
            work(modules, comparison)
            different += comparison.finish()
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""What `ombre info` says of the files that designs read.

    python3 tests/run_info.py build/dev/apps/ombre/ombre
"""
import json
import math
import struct

import program
from program import expect, near

CORNERS = [(x, y, z) for z in (0, 3) for y in (0, 4) for x in (0, 2)]
BLOCK = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2),
         (1, 3, 7), (1, 7, 5)]


def off(triangles):
    """A file of a block of 2 x 4 x 3 mm, or of some of its triangles."""
    lines = ["OFF", f"{len(CORNERS)} {len(triangles)} 0"]
    lines += [" ".join(map(str, corner)) for corner in CORNERS]
    return "\n".join(lines + ["3 " + " ".join(map(str, triangle)) for triangle in triangles]) + "\n"


class Folder(program.Folder):
    def info(self, name):
        return next(event for event in self.events("info", name) if event.get("file") == name)


def meshes_are_described(folder):
    folder.write("block.off", off(BLOCK))
    found = folder.info("block.off")
    expect(found["triangles"] == 12 and found["closed"], found)
    near(found["volume_mm3"], 24, 1e-9, "the volume")
    near(found["area_mm2"], 52, 1e-9, "the area")
    expect(found["bounds_mm"] == [0, 0, 0, 2, 4, 3], found)
    expect("24 mm3" in folder.run("info", "block.off").stdout, "no volume in the text")
    folder.write("open.off", off(BLOCK[1:]))
    found = folder.info("open.off")
    expect(not found["closed"] and found["open_edges"] == 3, found)
    expect("no: 3 open edges" in folder.run("info", "open.off").stdout, "no open edges in the text")
    inward = [(a, c, b) for a, b, c in BLOCK]
    folder.write("inward.off", off(inward))
    expect("face inward" in folder.run("info", "inward.off").stdout, "nothing of the side")


def drawings_are_described(folder):
    folder.write("a.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm" viewBox="0 0 9 9">'
                          '<path fill-rule="evenodd" d="M0 0h6v5h-6zM1 1h2v2h-2z"/><text>a</text></svg>')
    lines = folder.events("info", "a.svg")
    found = next(event for event in lines if event["event"] == "drawing")
    expect(found["regions"] == 1 and found["holes"] == 1, found)
    near(found["area_mm2"], 26, 1e-6, "the area")
    expect("1 texts" in folder.run("info", "a.svg").stderr, "nothing of the text")
    square = "".join(f"0\nLINE\n8\ncut\n10\n{a}\n20\n{b}\n11\n{c}\n21\n{d}\n"
                     for a, b, c, d in ((0, 0, 3, 0), (3, 0, 3, 3), (3, 3, 0, 3), (0, 3, 0, 0)))
    folder.write("a.dxf", f"0\nSECTION\n2\nENTITIES\n{square}0\nENDSEC\n0\nEOF\n")
    found = folder.info("a.dxf")
    near(found["area_mm2"], 9, 1e-6, "the area")
    expect(found["layers"] == ["cut"], found)
    folder.write("b.dxf", "AutoCAD Binary DXF\r\n")
    expect("binary form" in folder.run("info", "b.dxf", status=1).stderr, "no error of a binary file")


def tables_are_described(folder):
    folder.write("a.csv", "x,y\n1,5\n3,-2\n")
    found = folder.info("a.csv")
    expect(found["rows"] == 2 and found["columns"] == 2 and found["ranges"] == [[1, 3], [-2, 5]], found)


def images_are_described(folder):
    rows = b"".join(bytes(row) + bytes(2) for row in ([0, 0, 255] * 2, [255, 0, 0] * 2))
    header = struct.pack("<2sIHHIIiiHHIIiiII", b"BM", 54 + len(rows), 0, 0, 54, 40, 2, 2, 1, 24, 0, len(rows), 0, 0, 0, 0)
    (folder.path / "a.bmp").write_bytes(header + rows)
    found = folder.info("a.bmp")
    expect(found["width"] == 2 and found["height"] == 2, found)
    expect(sorted(found["colours"]) == [["#0000FF", 2], ["#FF0000", 2]], found)


def described_cad(folder, name):
    """What is said of a CAD file, or nothing if this program cannot read them."""
    result = program.run([folder.ombre, "info", program.TESTS / "cad" / name, "--json"], cwd=folder.path)
    if program.WITHOUT_CAD in result.stdout + result.stderr:
        return None
    return next(event for event in map(json.loads, result.stdout.splitlines()) if event["event"] == "cad")


def cad_files_are_described(folder):
    found = described_cad(folder, "base_and_pin.step")
    if not found:
        return
    expect(found["solid_count"] == 2 and len(found["solids"]) == 2 and found["unit"] == "millimetre", found)
    near(found["solids"][1]["volume_mm3"], 125.663706, 1e-3, "the volume of the pin")
    expect(all(solid["faces"] > 0 for solid in found["solids"]), found)


def faces_of_cad_files_are_described(folder):
    """A cylinder of radius 5 between z = 0 and 20: its side, and two lids."""
    found = described_cad(folder, "cylinder.step")
    if not found:
        return
    faces = sorted(found["solids"][0]["surfaces"], key=lambda face: (face["kind"], face["center"][2]))
    expect([face["kind"] for face in faces] == ["cylinder", "plane", "plane"], faces)
    for face, area, height, normal in zip(faces, (200 * math.pi, 25 * math.pi, 25 * math.pi), (10, 0, 20), (0, -1, 1)):
        near(face["area_mm2"], area, 1e-3 * area, "the area of a face")
        expect(abs(face["center"][2] - height) < 1e-6 and abs(face["normal"][2] - normal) < 1e-6, face)
    expect(faces[0]["box"][0][2] == 0 and faces[0]["box"][1][2] == 20, faces)


DECK = """*NODE, NSET=all
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
*ELEMENT, TYPE=C3D4, ELSET=Body
1, 1, 2, 3, 4
*ELEMENT, TYPE=S3, ELSET=skin
2, 1, 2, 3
*NSET, NSET=Held
1, 2
*SURFACE, NAME=under
Body, S1
"""


def sets_of_decks_are_described(folder):
    folder.write("a.inp", DECK)
    found = next(event for event in folder.events("info", "a.inp") if event["event"] == "results")
    expect(found["sets"] == [{"name": "all", "of": "nodes", "count": 4}, {"name": "Held", "of": "nodes", "count": 2},
                             {"name": "Body", "of": "elements", "count": 1},
                             {"name": "skin", "of": "elements", "count": 1},
                             {"name": "under", "of": "sides", "count": 1}], found["sets"])
    expect(found["left_out"] == [{"what": "shells without a thickness (*SHELL SECTION)", "count": 1}],
           found["left_out"])
    expect(found["step_times"] == [] and found["step"] is None, found)
    text = folder.run("info", "a.inp").stdout
    expect("Held: 2 nodes" in text and "under: 1 sides" in text, text)
    folder.write("a.csv", "node,t\n1,5\n2,6\n3,7\n4,8\n")
    found = next(event for event in folder.events("info", "a.inp", "--values", "a.csv") if "fields" in event)
    expect(found["fields"][0]["ranges"] == [[5, 8]], found["fields"])


def frd(*blocks):
    """A file of CalculiX with one tetrahedron, and fields as (name, time, step, value at all nodes)."""
    lines = ["    1C", "    2C" + " " * 30 + "1"]
    lines += [f" -1{n + 1:10}" + "".join(f"{x:12.5E}" for x in p)
              for n, p in enumerate([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])]
    lines += [" -3", "    3C" + " " * 30 + "1", " -1         1    3    0    1", " -2" + "".join(f"{n:10}" for n in (1, 2, 3, 4)),
              " -3"]
    for name, time, step, value in blocks:
        lines += [f"  100CL  101{time:12.5E}           4                     0{step:5}           1",
                  f" -4  {name:8}    1    1", " -5  T           1    1    0    0"]
        lines += [f" -1{n:10}{value:12.5E}" for n in (1, 2, 3, 4)] + [" -3"]
    return "\n".join(lines + [" 9999", ""])


def steps_of_results_are_chosen(folder):
    """Without a choice each field is that of the last step that has it, and says so."""
    folder.write("a.frd", frd(("NDTEMP", 0.5, 1, 3), ("ERROR", 0.5, 1, 1), ("NDTEMP", 2, 2, 4)))
    found = folder.info("a.frd")
    expect(found["step_times"] == [0.5, 2] and found["step"] is None, found)
    expect({field["name"]: (field["step"], field["ranges"][0][0]) for field in found["fields"]} ==
           {"temperature": (2, 4), "error": (1, 1)}, found["fields"])
    found = next(event for event in folder.events("info", "a.frd", "--step", "1") if "fields" in event)
    expect(found["step"] == 1 and [field["ranges"][0] for field in found["fields"]] == [[3, 3], [1, 1]], found)
    text = folder.run("info", "a.frd").stdout
    expect("2: 1 (time 5.00000E-01), 2 (time 2.00000E+00); each field is of the last one that has it" in text, text)
    expect("error, of nodes, of step 1" in text, text)
    expect("there is no step 3" in folder.run("info", "a.frd", "--step", "3", status=1).stderr, "a step too many")
    folder.write("a.off", off(BLOCK))
    expect("--step is for results" in folder.run("info", "a.off", "--step", "1", status=1).stderr, "a step of a mesh")


def choices_of_volumes_are_taken(folder):
    """A NaN, and one of two channels, as volume() takes them."""
    header = "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: little\nspacings: 1 1 1\n\n"
    (folder.path / "a.nrrd").write_bytes(header.encode() + struct.pack("<2f", float("nan"), 5))
    expect("NaN" in folder.run("info", "a.nrrd", status=2).stderr, "no error of a NaN")
    found = next(event for event in folder.events("info", "a.nrrd", "--nan", "-1") if event["event"] == "volume")
    expect(found["least"] == -1 and found["greatest"] == 5, found)


def maps_on_surfaces_are_reported(folder):
    """The upper side of a block, 2 mm by 4 mm, is laid out as it is."""
    folder.write("block.off", off(BLOCK))
    folder.write("cells.vcad", 'm = surface_cells("block.off", count=(2, 4, 1), height=3, normal=(0, 0, 1));\n'
                 'tpms("gyroid", map=m, thickness=0.2);\n')
    (report,) = folder.info("cells.vcad")["reports"]
    expect(report["node"] == "surface_cells" and report["line"] == 1, report)
    expect(report["report"].startswith("2 x 4 x 3 mm, 2 x 4 x 1 cells"), report)
    expect("volumes of cells are 3 to 3 mm^3" in report["report"], report)
    expect("stretched by 1 to 1;" in folder.run("info", "cells.vcad").stdout, "no report in the text")


def maps_are_reported(folder):
    """Cells of a pipe are as long around as their share of the circle: 2 pi r / 16 between the radii 12 and 18, else 5 and 6 mm. Cells
    whose lengths grow along x by u = x - x^2/64 have the volume 1/(1 - x/32)."""
    folder.write("pipe.vcad", "p = cylinder_cells(12, 18, 40, count=(16, 8, 1));\n"
                 'tpms("gyroid", map=p, thickness=0.5, material="red");')
    (pipe,) = folder.info("pipe.vcad")["maps"]
    around = 2 * math.pi / 16
    expect((pipe["node"], pipe["line"]) == ("cylinder_cells", 1) and pipe["points"] > 500, pipe)
    expect(30 * 12 * around <= pipe["volume_mm3"]["least"] < 30 * 12.6 * around, pipe)
    expect(30 * 17.4 * around < pipe["volume_mm3"]["greatest"] <= 30 * 18 * around, pipe)
    x, y, _ = pipe["volume_mm3"]["greatest_at"]
    expect(abs(math.hypot(x, y) * 30 * around - pipe["volume_mm3"]["greatest"]) < 1e-9, "the volume is not that of its place")
    least = 12 * around  # around, at the inner wall; along the axis cells are 5 mm long, outward 6 mm
    expect(least <= pipe["stretch_mm"]["least"] < 1.05 * least and abs(pipe["stretch_mm"]["greatest"] - 18 * around) < 0.3, pipe)
    expect(6 / 5 < pipe["aspect"]["greatest"] < 18 / 12, pipe)
    folder.write("graded.vcad", "m = formula_cells(u=\"x - x^2/64\", v=\"y\", w=\"z\", region=cube(8));\n"
                 'tpms("gyroid", map=m, thickness=0.1, material="red");')
    (graded,) = folder.info("graded.vcad")["maps"]
    for end in ("least", "greatest"):
        place = graded["volume_mm3"][f"{end}_at"][0]
        expect(abs(graded["volume_mm3"][end] - 1 / (1 - place / 32)) < 1e-9, graded)
    expect(abs(graded["aspect"]["greatest"] - 1 / (1 - 4 / 32)) < 0.01, graded)
    expect("times as long in one direction as in another" in folder.run("info", "graded.vcad").stdout, "no map in the text")



CHECKS = [meshes_are_described, drawings_are_described, tables_are_described, images_are_described,
          cad_files_are_described, faces_of_cad_files_are_described, sets_of_decks_are_described, steps_of_results_are_chosen,
          choices_of_volumes_are_taken, maps_on_surfaces_are_reported, maps_are_reported]


if __name__ == "__main__":
    raise SystemExit(program.main(Folder, program.named(CHECKS)))

#!/usr/bin/env python3
"""Colours of files with textures: glTF, 3MF and OBJ, which this script writes itself.

    python3 tests/run_textures.py build/dev/apps/ombre/ombre [NAME...]
"""
import base64
import io
import json
import struct
import zipfile
import zlib

import PIL.Image
import PIL.ImageOps
import program
from program import expect, near

# Two pixels by two, the top row first: red and green above blue and yellow.
PIXELS = [[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 0)]]
# A square of 10 mm in the plane z = 0, on which the image lies; v runs upwards.
CORNERS = [(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0)]
PLACES = [(0, 0), (1, 0), (1, 1), (0, 1)]
TRIANGLES = [(0, 1, 2), (0, 2, 3)]
# Where the middles of the pixels lie.
MIDDLES = {(2.5, 7.5): (1, 0, 0), (7.5, 7.5): (0, 1, 0), (2.5, 2.5): (0, 0, 1), (7.5, 2.5): (1, 1, 0)}


def png(rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    pixels = b"".join(b"\0" + bytes(part for pixel in row for part in pixel) for row in rows)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b"")


def jpeg(picture=PIXELS, side=16, **options):
    """The pixels as squares of `side` stored pixels; whole blocks come back within two levels."""
    rows = [[tuple(pixel) for pixel in row for _ in range(side)] for row in picture for _ in range(side)]
    image = PIL.Image.new("RGB", (len(rows[0]), len(rows)))
    image.putdata([pixel for row in rows for pixel in row])
    file = io.BytesIO()
    image.save(file, "JPEG", quality=100, **{"subsampling": 0, **options})
    return file.getvalue()


def gltf(image=True, colours=None, factor=None, uri=None, content=None, **members):
    """The JSON and the buffer of the square, in metres with y upwards: (x, y, z) mm is (x, z, -y) / 1000."""
    buffer, views, accessors = b"", [], []

    def add(data, **accessor):
        nonlocal buffer
        views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
        buffer += data + b"\0" * (-len(data) % 4)
        if accessor:
            accessors.append({"bufferView": len(views) - 1, **accessor})
        return len(views) - 1
    add(b"".join(struct.pack("<fff", x / 1000, z / 1000, -y / 1000) for x, y, z in CORNERS),
        componentType=5126, count=4, type="VEC3")
    attributes = {"POSITION": 0}
    material = {"pbrMetallicRoughness": {}}
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}]}
    if image:
        # v runs downwards in glTF.
        add(b"".join(struct.pack("<ff", u, 1 - v) for u, v in PLACES), componentType=5126, count=4, type="VEC2")
        attributes["TEXCOORD_0"] = len(accessors) - 1
        document["images"] = [{"bufferView": add(content or png(PIXELS))} if uri is None else {"uri": uri}]
        document["textures"] = [{"source": 0}]
        material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
    if colours:
        add(b"".join(struct.pack("<BBBB", *colour) for colour in colours), componentType=5121, normalized=True, count=4,
            type="VEC4")
        attributes["COLOR_0"] = len(accessors) - 1
    if factor:
        material["pbrMetallicRoughness"]["baseColorFactor"] = factor
    add(b"".join(struct.pack("<HHH", *triangle) for triangle in TRIANGLES), componentType=5123, count=6, type="SCALAR")
    document.update(meshes=[{"primitives": [{"attributes": attributes, "indices": len(accessors) - 1, "material": 0}]}],
                    materials=[material], accessors=accessors, bufferViews=views, buffers=[{"byteLength": len(buffer)}],
                    **members)
    return document, buffer


def glb(document, buffer):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(buffer), 0x004E4942) + buffer
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def three_mf(path, properties, triangle, image=png(PIXELS)):
    """A package with the square, closed below at z = -10 so that it is a solid, too."""
    vertices = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in CORNERS + [(5, 5, -10)])
    sides = "".join(f'<triangle v1="{a}" v2="4" v3="{b}"/>' for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)))
    model = ('<?xml version="1.0"?><model unit="millimeter" '
             'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" '
             'xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02">'
             f'<resources>{properties}<object id="9" type="model"><mesh><vertices>{vertices}</vertices><triangles>'
             + "".join(triangle(*corners) for corners in TRIANGLES) + sides +
             '</triangles></mesh></object></resources><build><item objectid="9"/></build></model>')
    types = ('<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
             '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
    relations = ('<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                 '<Relationship Target="/3D/a.model" Id="r" '
                 'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("[Content_Types].xml", types)
        archive.writestr("_rels/.rels", relations)
        archive.writestr("3D/a.model", model)
        archive.writestr("3D/Textures/image.png", image)


def colours_at(folder, file, points):
    folder.write("design.vcad", f'attribute("color_rgb", surface_colour("{file}").colour) rectprism((40, 40, 40));')
    at = [argument for x, y in points for argument in ("--at", f"{x},{y},0")]
    return [[event["attributes"][f"color_rgb.{axis}"] for axis in "xyz"]
            for event in folder.events("probe", "design.vcad", *at) if event["event"] == "point"]


def expect_colours(folder, file, wanted, tolerance=1e-6):
    for point, colour in zip(wanted, colours_at(folder, file, wanted)):
        for part, value in zip("rgb", range(3)):
            near(colour[value], wanted[point][value], tolerance, f"{part} of {file} at {point}")


def write_bytes(folder, name, data):
    (folder.path / name).write_bytes(data)


def complaint(folder, design="design.vcad"):
    """What is said of a design that cannot be read."""
    result = program.run(folder.command("probe", design, "--at", "0,0,0"), cwd=folder.path)
    expect(result.returncode in (1, 2), f"status {result.returncode}: {result.stderr}")
    return result.stderr


def srgb(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def gltf_has_its_texture(folder):
    document, buffer = gltf()
    write_bytes(folder, "square.glb", glb(document, buffer))
    expect_colours(folder, "square.glb", MIDDLES)
    # Halfway between the middles of two pixels lies their mean.
    expect_colours(folder, "square.glb", {(5, 7.5): (0.5, 0.5, 0)})
    data = "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()
    document["buffers"][0]["uri"] = data
    folder.write("square.gltf", document)
    expect_colours(folder, "square.gltf", MIDDLES)


def jpeg_lies_on_meshes(folder):
    """Plain, progressive and with colours of fewer pixels, in each of the formats that have textures."""
    kinds = {"plain": {}, "progressive": {"progressive": True}, "fewer": {"subsampling": 2}}
    for name, options in kinds.items():
        write_bytes(folder, f"{name}.glb", glb(*gltf(content=jpeg(**options))))
        expect_colours(folder, f"{name}.glb", MIDDLES, 2.5 / 255)
    three_mf(folder.path / "jpeg.3mf", textured_3mf(), corners_by(2), jpeg())
    expect_colours(folder, "jpeg.3mf", MIDDLES, 2.5 / 255)
    folder.write("square.obj", f"mtllib square.mtl\n{obj_vertices()}usemtl picture\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n")
    folder.write("square.mtl", "newmtl picture\nmap_Kd square.jpg\n")
    write_bytes(folder, "square.jpg", jpeg())
    expect_colours(folder, "square.obj", MIDDLES, 2.5 / 255)
    whole = jpeg()
    # A texture stays as it is stored, whatever the camera noted: its coordinates count stored pixels.
    write_bytes(folder, "square.jpg", jpeg(exif=orientation(6)))
    expect_colours(folder, "square.obj", MIDDLES, 2.5 / 255)
    folder.write("design.vcad", 'attribute("color_rgb", surface_colour("square.obj").colour) cube(4);')
    for broken, words in ((whole[:len(whole) // 2], "as a JPEG image: Premature end"), (whole[:2], "is neither a PNG nor"),
                          (whole[:-2], "as a JPEG image: Premature end")):
        write_bytes(folder, "square.jpg", broken)
        said = complaint(folder)
        expect(words in said and "square.jpg" in said, f"{words!r} is not in {said}")
    file = io.BytesIO()
    PIL.Image.new("CMYK", (8, 8)).save(file, "JPEG")
    write_bytes(folder, "square.jpg", file.getvalue())
    expect("save it in RGB" in complaint(folder), "inks are taken as colours")


def orientation(number):
    exif = PIL.Image.Exif()
    exif[274] = number
    return exif


def photographs_lie_as_they_are_seen(folder):
    """As Pillow turns them, for each of the eight orientations; also as heights."""
    picture = [[(255, 0, 0), (0, 255, 0), (255, 255, 255)], [(0, 0, 255), (255, 255, 0), (0, 0, 0)]]
    for number in range(1, 9):
        data = jpeg(picture, 16, exif=orientation(number))
        write_bytes(folder, "photograph.jpg", data)
        seen = PIL.ImageOps.exif_transpose(PIL.Image.open(io.BytesIO(data))).convert("RGB")
        columns, rows = seen.width // 16, seen.height // 16
        places = [(column, row) for column in range(columns) for row in range(rows)]
        folder.write("design.vcad", f"""
            picture = texture("photograph.jpg", {columns});
            attribute("color_rgb", picture.colour) attribute("bright", picture.value) rectprism((40, 40, 40));""")
        folder.write("plate.vcad", f'relief("photograph.jpg", {columns}, 10, 1);')
        at = [part for column, row in places
              for part in ("--at", f"{column + 0.5 - columns / 2},{rows / 2 - row - 0.5},0")]
        points = [event for event in folder.events("probe", "design.vcad", *at) if event["event"] == "point"]
        for (column, row), point in zip(places, points):
            wanted = seen.getpixel((16 * column + 8, 16 * row + 8))
            for axis, value in zip("xyz", wanted):
                near(point["attributes"][f"color_rgb.{axis}"], value / 255, 2.5 / 255, f"{axis} at {column}, {row}")
        # At z = 6 the plate is where the brightness is more than a half.
        tops = [argument for column, row in places for argument in
                ("--at", f"{column + 0.5 - columns / 2},{rows / 2 - row - 0.5},6")]
        inside = [event["inside"] for event in folder.events("probe", "plate.vcad", *tops) if event["event"] == "point"]
        for (column, row), is_inside in zip(places, inside):
            red, green, blue = seen.getpixel((16 * column + 8, 16 * row + 8))
            expect(is_inside == (0.299 * red + 0.587 * green + 0.114 * blue > 127.5), f"height at {column}, {row}")


def gltf_takes_files_beside_it(folder):
    """Its buffer and its image in files with escaped names, read as parts of it: by a mesh, too, and in bundles."""
    (folder.path / "scan/maps").mkdir(parents=True)
    document, buffer = gltf(uri="maps/our%20image.jpg")
    document["buffers"][0]["uri"] = "numbers%231.bin"
    document["images"].append({"uri": "normals.png"})  # which no base colour uses
    document["textures"].append({"source": 1})
    document["materials"][0]["normalTexture"] = {"index": 1}
    folder.write("scan/square.gltf", document)
    write_bytes(folder, "scan/numbers#1.bin", buffer)
    write_bytes(folder, "scan/maps/our image.jpg", jpeg())
    expect_colours(folder, "scan/square.gltf", MIDDLES, 2.5 / 255)
    folder.run("bundle", "design.vcad", "-o", "design.ombre")
    with zipfile.ZipFile(folder.path / "design.ombre") as archive:
        names = archive.namelist()
    for part in ("scan/square.gltf", "scan/numbers#1.bin", "scan/maps/our image.jpg"):
        expect(any(name.endswith(part) for name in names), f"{part} is not among {names}")
    said = folder.run("info", "scan/square.gltf").stdout
    expect("10" in said, said)
    # Another content of the buffer is another mesh: here one of half the size.
    half = b"".join(struct.pack("<f", value / 2) for value in struct.unpack("<12f", buffer[:48]))
    write_bytes(folder, "scan/numbers#1.bin", half + buffer[48:])
    expect_colours(folder, "scan/square.gltf", {(x / 2, y / 2): colour for (x, y), colour in MIDDLES.items()}, 2.5 / 255)

    def wrong(words, uri=None, image=None):
        changed = json.loads(json.dumps(document))
        if uri is not None:
            changed["buffers"][0]["uri"] = uri
        if image is not None:
            changed["images"][0]["uri"] = image
        folder.write("scan/wrong.gltf", changed)
        for script in ('attribute("color_rgb", surface_colour("scan/wrong.gltf").colour) cube(4);',
                       *(['mesh("scan/wrong.gltf");'] if uri is not None else [])):
            folder.write("wrong.vcad", script)
            said = complaint(folder, "wrong.vcad")
            expect(words in said, f"{words!r} is not in {said}")
    wrong("scan/numbers.bin", uri="numbers.bin")
    wrong("scan/maps", uri="maps")
    wrong("is no path relative to it", uri="/etc/passwd")
    wrong("is no path relative to it", uri="file:///etc/passwd")
    wrong("is no path relative to it", uri="https://example.org/a.bin")
    wrong("is no path relative to it", uri="numbers%2.bin")
    wrong("is no path relative to it", uri="%00")
    wrong("is no path relative to it", uri="")
    write_bytes(folder, "scan/short.bin", buffer[:-1])
    wrong('shorter than its "byteLength"', uri="short.bin")
    write_bytes(folder, "scan/short.bin", b"")
    wrong('shorter than its "byteLength"', uri="short.bin")
    wrong("scan/maps/other.jpg", image="maps/other.jpg")
    wrong("is no path relative to it", image="/dev/zero")
    folder.write("plain.scad", 'import("scan/square.gltf");')
    expect("lie in another file" in complaint(folder, "plain.scad"), "OpenSCAD's import reads other files")


def gltf_multiplies_in_linear_light(folder):
    """A factor of 0.25 leaves a quarter of the light; colours of vertices are linear, too."""
    write_bytes(folder, "dim.glb", glb(*gltf(factor=[0.25, 1, 1, 1])))
    expect_colours(folder, "dim.glb", {(2.5, 7.5): (srgb(0.25), 0, 0), (7.5, 2.5): (srgb(0.25), 1, 0)})
    grey = [(51, 102, 204, 255)] * 4
    write_bytes(folder, "grey.glb", glb(*gltf(image=False, colours=grey)))
    expect_colours(folder, "grey.glb", {(3, 3): [srgb(part / 255) for part in grey[0][:3]]})
    write_bytes(folder, "plain.glb", glb(*gltf(image=False, factor=[0.5, 0, 1, 1])))
    expect_colours(folder, "plain.glb", {(3, 3): (srgb(0.5), 0, 1)}, 1 / 255)


def gltf_nodes_move_meshes(folder):
    """Turned by 90 degrees about its y axis, which is our z, and moved by 20 mm along x."""
    half = 0.5 ** 0.5
    document, buffer = gltf()
    document["nodes"] = [{"children": [1], "translation": [0.02, 0, 0]}, {"mesh": 0, "rotation": [0, half, 0, half]}]
    write_bytes(folder, "moved.glb", glb(document, buffer))
    # (x, y) goes to (20 - y, x).
    expect_colours(folder, "moved.glb", {(20 - y, x): colour for (x, y), colour in MIDDLES.items()})


def what_gltf_lacks_is_said(folder):
    document, buffer = gltf()

    def wrong(change, words, data=None):
        changed = json.loads(json.dumps(document))
        change(changed)
        write_bytes(folder, "wrong.glb", data or glb(changed, buffer))
        folder.write("design.vcad", 'attribute("color_rgb", surface_colour("wrong.glb").colour) cube(4);')
        said = complaint(folder)
        expect(words in said, f"{words!r} is not in {said}")
    wrong(lambda d: d.update(extensionsRequired=["KHR_draco_mesh_compression"]), "the extension KHR_draco_mesh_compression")
    wrong(lambda d: d["accessors"][0].update(count=5), "reaches beyond its buffer view")
    wrong(lambda d: d["accessors"][0].update(count=-1), "is no whole number")
    wrong(lambda d: d["meshes"][0]["primitives"][0]["attributes"].pop("TEXCOORD_0"), "no texture coordinates TEXCOORD_0")
    wrong(lambda d: d["nodes"][0].update(children=[0]), "is placed twice")
    wrong(lambda d: d["scenes"][0].update(nodes=[7]), 'no such entry in "nodes"')
    wrong(lambda d: d["bufferViews"][0].update(byteLength=1e9), "reaches beyond its buffer")
    wrong(lambda d: d["images"][0].update(uri="image.jpg") or d["images"][0].pop("bufferView"), "image.jpg")
    wrong(lambda d: d.update(asset={"version": "1.0"}), "no glTF of version 2")
    wrong(lambda d: None, "ends in a chunk", glb(document, buffer)[:-8])
    wrong(lambda d: None, "is neither a PNG nor a JPEG image", glb(document, gltf()[1].replace(b"\x89PNG", b"GIF8")))
    wrong(lambda d: None, "as a JPEG image", glb(document, gltf()[1].replace(b"\x89PNG", b"\xff\xd8\xff\xe0")))


def textured_3mf():
    places = "".join(f'<m:tex2coord u="{u}" v="{v}"/>' for u, v in PLACES)
    return ('<m:texture2d id="1" path="/3D/Textures/image.png" contenttype="image/png"/>'
            f'<m:texture2dgroup id="2" texid="1">{places}</m:texture2dgroup>')


def corners_by(resource):
    return lambda a, b, c: f'<triangle v1="{a}" v2="{b}" v3="{c}" pid="{resource}" p1="{a}" p2="{b}" p3="{c}"/>'


def obj_vertices():
    return "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS) + "".join(f"vt {u} {v}\n" for u, v in PLACES)


def three_mf_textures_and_colours_of_corners(folder):
    texture = textured_3mf()
    three_mf(folder.path / "textured.3mf", texture, corners_by(2))
    expect_colours(folder, "textured.3mf", MIDDLES)
    colours = "".join(f'<m:color color="#{text}"/>' for text in ("000000", "FF0000", "FFFF00", "00FF00"))
    three_mf(folder.path / "shaded.3mf", f'<m:colorgroup id="3">{colours}</m:colorgroup>', corners_by(3))
    # The four colours are linear in x and y: red rises with x, green with y.
    expect_colours(folder, "shaded.3mf", {(x, y): (x / 10, y / 10, 0) for x, y in ((1, 3), (6, 2), (5, 5), (8, 9))})
    folder.write("solid.vcad", 'mesh("textured.3mf");')
    said = folder.run("probe", "solid.vcad", "--at", "5,5,-1").stderr
    expect("has textures or shaded triangles, which do not become materials" in said, said)
    wrong = texture.replace('texid="1"', 'texid="4"')
    three_mf(folder.path / "wrong.3mf", wrong, corners_by(2))
    folder.write("design.vcad", 'attribute("color_rgb", surface_colour("wrong.3mf").colour) cube(4);')
    said = complaint(folder)
    expect("names a texture that is not before it" in said, said)


def obj_takes_its_materials(folder):
    folder.write("square.obj", f"mtllib colours.mtl\n{obj_vertices()}usemtl picture\nf 1/1 2/2 3/3\nusemtl plain\nf 1/1 3/3 4/4\n")
    folder.write("colours.mtl", "newmtl picture\nKd 0.8 0.8 0.8\nmap_Kd -clamp on maps\\image.png\nnewmtl plain\nKd 0.25 0.5 1\n")
    (folder.path / "maps").mkdir()
    write_bytes(folder, "maps/image.png", png(PIXELS))
    # The first triangle lies below the diagonal.
    expect_colours(folder, "square.obj", {(7.5, 2.5): (1, 1, 0), (2.5, 7.5): (0.25, 0.5, 1)})
    (folder.path / "maps/image.png").unlink()
    folder.write("design.vcad", 'attribute("color_rgb", surface_colour("square.obj").colour) cube(4);')
    said = complaint(folder)
    expect("image.png" in said, said)
    (folder.path / "colours.mtl").unlink()
    said = complaint(folder)
    expect("which do not lie beside it" in said and "have no colours" in said, said)


def meshes_come_back(folder):
    """What Ombre writes as .glb it reads again, in place and in size."""
    folder.write("box.vcad", 'translate(3, 4, 5) rectprism((2, 4, 6), "red");')
    folder.run("mesh", "box.vcad", "-o", "box.glb")
    folder.write("again.vcad", 'mesh("box.glb");')
    events = folder.events("probe", "again.vcad", "--at", "3.9,5.9,7.9", "--at", "4.1,5.9,7.9")
    inside, outside = (event["inside"] for event in events if event["event"] == "point")
    expect(inside and not outside, "the box is elsewhere")


CHECKS = program.named((gltf_has_its_texture, gltf_takes_files_beside_it, jpeg_lies_on_meshes,
                        photographs_lie_as_they_are_seen, gltf_multiplies_in_linear_light, gltf_nodes_move_meshes,
                        what_gltf_lacks_is_said, three_mf_textures_and_colours_of_corners, obj_takes_its_materials,
                        meshes_come_back))

if __name__ == "__main__":
    raise SystemExit(program.main(program.Folder, CHECKS))

#!/usr/bin/env python3
"""Volumes and images written by other libraries (nibabel, Pillow) and by hand, read through Python.

    PYTHONPATH=build/release/python python3 tests/run_scans.py
"""
import base64
import gzip
import struct
import subprocess
import sys
import zlib

import nibabel
import numpy as np
import PIL.Image
import pydicom

import ombre

from scans import SHAPE, SPACING, centres, compare, expect, fails, phantom, run, values_at, write_series


def wrong_volumes_are_errors(folder):
    """What scanners and programs leave behind, each with a message and little memory."""
    write_series(folder / "movie")
    data = pydicom.dcmread(folder / "movie" / "7_0.dcm")
    data.file_meta.TransferSyntaxUID = "1.2.840.10008.1.2.4.102"  # MPEG-4, of which the pixels are none
    data.PixelData = pydicom.encaps.encapsulate([b"no video"])
    data["PixelData"].is_undefined_length = True
    data.save_as(folder / "movie" / "7_0.dcm", write_like_original=False)
    fails(folder / "movie", "cannot be read", "7_0.dcm")
    header = ("NRRD0004\ntype: {kind}\ndimension: 3\nsizes: {sizes}\nendian: little\nencoding: {encoding}\n"
              "spacings: {spacings}\n\n")
    whole = {"kind": "int16", "sizes": "2 2 2", "encoding": "raw", "spacings": "1 1 1"}
    for change, words in (({"spacings": "1 -1 1"}, "must be positive"), ({"spacings": "1 1e9 1"}, "are possible"),
                          ({"spacings": "1 0 1"}, "are possible"), ({"sizes": "0 2 2"}, "an axis of 0 voxels"),
                          ({"sizes": "10000 10000 1000", "encoding": "gzip"}, "GiB of memory, and"),
                          ({"sizes": "2000000 2000000 2000"}, "more than 1 TiB"),
                          ({"sizes": "10000 10000 1000"}, "is cut off")):
        (folder / "wrong.nrrd").write_bytes(header.format(**{**whole, **change}).encode() + bytes(16))
        fails(folder / "wrong.nrrd", words)
    numbers = np.ones((2, 2, 2), "<f4")
    numbers[1, 0, 1] = np.nan
    np.save(folder / "nan.npy", numbers)
    fails(folder / "nan.npy", "1 value that is NaN", "voxel (1, 0, 1)", "nan=0", options=", spacing=(1, 1, 1)")
    for kernel, words in (("[[[0]]]", "kernel"), ("[for (i=[1:300]) [for (j=[1:300]) [for (k=[1:300]) i*j+k]]]", "")):
        try:
            ombre.load_text(f"convolve({kernel}) cube(2);").voxels(voxel=0.5)
        except (ombre.DesignError, ombre.MachineError) as error:
            expect(words in str(error) and len(str(error)) < 2000, str(error))
        else:
            raise AssertionError(f"the kernel {kernel} was taken")


def palettes_are_labels(folder):
    """Pascal VOC and Cityscapes hold labels as indices of a palette."""
    labels = np.arange(24).reshape(4, 6) % 5
    picture = PIL.Image.fromarray(labels.astype(np.uint8), "P")
    picture.putpalette([0, 0, 0, 128, 0, 0, 0, 128, 0, 128, 128, 0, 0, 0, 128])
    (folder / "labels").mkdir()
    for number in range(3):
        picture.save(folder / "labels" / f"{number}.png")
    picture.save(folder / "labels.tif")
    points = np.array([[x, y, 0] for x in range(6) for y in range(4)], float)
    expected = [labels[3 - int(y), int(x)] for x, y, _ in points]
    for path in (folder / "labels", folder / "labels.tif"):
        found = values_at(path, points, ', spacing=(1, 1, 1), between="nearest"', "nearest")
        expect((found == expected).all(), f"{path}: {found}")
    fails(folder / "labels", "it has a palette", "label=1", options=", spacing=(1, 1, 1)")


def nifti_affines_are_honoured(folder):
    rng = np.random.default_rng(3)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    affine = np.eye(4)
    affine[:3, :3] = turn @ np.diag(SPACING)
    affine[:3, 3] = (4, -5, 6)
    for name, kind in (("a.nii", np.int16), ("b.nii.gz", np.int16), ("c.nii", np.float32), ("d.nii.gz", np.float64)):
        nibabel.save(nibabel.Nifti1Image(phantom().astype(kind), affine), folder / name)
        compare(folder / name, affine, tolerance=1e-5)
    nibabel.save(nibabel.Nifti2Image(phantom(), affine), folder / "e.nii")
    compare(folder / "e.nii", affine, tolerance=1e-5)
    nibabel.save(nibabel.Nifti1Pair(phantom(), affine), folder / "f.img")
    compare(folder / "f.hdr", affine, tolerance=1e-5)
    image = nibabel.Nifti1Image(phantom(), None)
    image.set_qform(affine, 1)
    image.set_sform(None, 0)
    image.header.set_slope_inter(0.25, 7)
    nibabel.save(image, folder / "g.nii")
    stored = nibabel.load(folder / "g.nii")
    compare(folder / "g.nii", stored.affine, voxels=stored.get_fdata(), tolerance=1e-4)
    big = nibabel.Nifti1Image(phantom().astype(">i2"), affine, nibabel.Nifti1Header(endianness=">"))
    nibabel.save(big, folder / "h.nii")
    compare(folder / "h.nii", affine, tolerance=1e-5)
    nibabel.save(nibabel.Nifti1Image(np.zeros((*SHAPE, 3), np.int16), affine), folder / "time.nii")
    fails(folder / "time.nii", "has 3 values in each voxel, or volumes in time", "channel=0, up to 2")
    times = np.stack([phantom(), 2 * phantom(), -phantom()], axis=-1)
    nibabel.save(nibabel.Nifti1Image(times, affine), folder / "times.nii.gz")
    compare(folder / "times.nii.gz", affine, ", channel=1", 2 * phantom(), tolerance=1e-5)
    compare(folder / "times.nii.gz", affine, ", channel=2", -phantom(), tolerance=1e-5)
    fails(folder / "times.nii.gz", "has no channel 3; 0 to 2 are there", options=", channel=3")
    whole = (folder / "a.nii").read_bytes()
    (folder / "cut.nii").write_bytes(whole[:-1])
    fails(folder / "cut.nii", "is cut off")
    (folder / "cut.nii.gz").write_bytes(gzip.compress(whole)[:-30])
    fails(folder / "cut.nii.gz", "damaged or cut off")


def meta_images_are_read(folder):
    header = ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
              "CompressedData = {packed}\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 1 2 3\n"
              "CenterOfRotation = 0 0 0\nElementSpacing = 0.5 0.75 3\nDimSize = 12 10 6\nElementType = MET_SHORT\n"
              "ElementDataFile = {file}\n")
    numbers = phantom().transpose(2, 1, 0).astype("<i2").tobytes()
    affine = np.array([[0, -0.75, 0, 1], [0.5, 0, 0, 2], [0, 0, 3, 3], [0, 0, 0, 1.0]])
    (folder / "a.mha").write_bytes(header.format(packed=False, file="LOCAL").encode() + numbers)
    (folder / "b.mha").write_bytes(header.format(packed=True, file="LOCAL").encode() + zlib.compress(numbers))
    (folder / "c.mhd").write_text(header.format(packed=False, file="c.raw"))
    (folder / "c.raw").write_bytes(numbers)
    for name in ("a.mha", "b.mha", "c.mhd"):
        compare(folder / name, affine)
    both = np.stack([phantom(), -phantom()], axis=-1).transpose(2, 1, 0, 3).astype("<i2").tobytes()
    two = header.replace("DimSize", "ElementNumberOfChannels = 2\nDimSize").format(packed=False, file="LOCAL")
    (folder / "two.mha").write_bytes(two.encode() + both)
    compare(folder / "two.mha", affine, ", channel=1", -phantom())
    fails(folder / "two.mha", "has 2 values in each voxel")
    (folder / "d.mhd").write_text(header.format(packed=False, file="nowhere.raw"))
    fails(folder / "d.mhd", "nowhere.raw, which is not there")
    (folder / "e.mha").write_text("ObjectType = Image\nNDims = 3\nDimSize = 1 2\nElementDataFile = LOCAL\n")
    fails(folder / "e.mha", "without 3 numbers")


def arrays_are_volumes(folder):
    affine = np.eye(4)
    affine[:3, :3] = [[0, -0.75, 0], [0.5, 0, 0.3], [0, 0, 3]]
    affine[:3, 3] = (1, 2, 3)
    voxels = phantom()
    points = centres(affine)
    for kind in (np.int16, np.float64, np.int64, ">i4"):
        value = ombre.volume(voxels.transpose(2, 1, 0).astype(kind), affine=affine)
        part = ombre.attribute(ombre.rectprism((2000, 2000, 2000)), "v", value.nearest)
        found = part.design().attribute("v", points)
        expect(np.abs(found - voxels.reshape(-1)).max() == 0, f"array of {kind}")
    inside = ombre.volume_solid(np.ones((4, 4, 4), bool), "red", spacing=(1, 2, 3), origin=(0.5, 1, 1.5))
    expect(np.allclose(inside.design().bounds, [(0, 0, 0), (4, 8, 12)], atol=1e-6), f"bounds {inside.design().bounds}")
    for wrong in (np.zeros((3, 3)), np.zeros((2, 2, 2), complex)):
        try:
            ombre.volume(wrong, spacing=(1, 1, 1))
        except (TypeError, ValueError):
            continue
        raise AssertionError("a wrong array was taken")


def stack_affine():
    """Of images with the spacing given: rows count from the top, the first voxel's centre is at the origin."""
    return np.diag([*SPACING, 1.0])


def tiff_by_parts(channels, tile=None):
    """An image of TIFF 6.0 without compression, low byte first: each channel by itself, in strips of a row or in tiles."""
    height, width = channels[0].shape
    parts = []
    for channel in channels:
        if tile is None:
            parts += [row.astype("<u2").tobytes() for row in channel]
            continue
        for top in range(0, height, tile):
            for left in range(0, width, tile):
                whole = np.zeros((tile, tile), "<u2")
                piece = channel[top:top + tile, left:left + tile]
                whole[:piece.shape[0], :piece.shape[1]] = piece
                parts.append(whole.tobytes())
    data, offsets = b"", []
    for part in parts:
        offsets.append(8 + len(data))
        data += part
    lists = {"offsets": struct.pack(f"<{len(parts)}I", *offsets), "sizes": struct.pack(f"<{len(parts)}I", *map(len, parts)),
             "bits": struct.pack(f"<{len(channels)}H", *[16] * len(channels))}
    places = {}
    for name, text in lists.items():
        places[name] = 8 + len(data)
        data += text + b"\0" * (len(text) % 2)
    def entry(tag, kind, count, value):
        return struct.pack("<HHII", tag, kind, count, value)
    entries = [entry(256, 4, 1, width), entry(257, 4, 1, height), entry(258, 3, len(channels), places["bits"]),
               entry(259, 3, 1, 1), entry(262, 3, 1, 2), entry(277, 3, 1, len(channels)), entry(284, 3, 1, 2)]
    if tile is None:
        entries += [entry(273, 4, len(parts), places["offsets"]), entry(278, 4, 1, 1),
                    entry(279, 4, len(parts), places["sizes"])]
    else:
        entries += [entry(322, 4, 1, tile), entry(323, 4, 1, tile), entry(324, 4, len(parts), places["offsets"]),
                    entry(325, 4, len(parts), places["sizes"])]
    entries.sort(key=lambda e: struct.unpack_from("<H", e))
    return (b"II*\0" + struct.pack("<I", 8 + len(data)) + data + struct.pack("<H", len(entries)) + b"".join(entries) +
            bytes(4))


def tiles_and_planes_are_read(folder):
    numbers = np.random.default_rng(9).integers(0, 65536, (3, 37, 53))
    affine = np.diag([0.5, 0.75, 3, 1.0])
    for tile in (None, 16):
        (folder / "parts.tif").write_bytes(tiff_by_parts(numbers, tile))
        for c in range(3):
            wanted = np.flipud(numbers[c]).T[:, :, None]
            i, j, k = np.indices(wanted.shape)
            points = (np.stack([i, j, k, np.ones(wanted.shape)], axis=-1).reshape(-1, 4) @ affine.T)[:, :3]
            found = values_at(folder / "parts.tif", points, f", spacing={SPACING}, channel={c}")
            expect((found == wanted.ravel()).all(), f"channel {c} in tiles of {tile}")


def stacks_of_images_are_read(folder):
    grey = (phantom() + 1000).astype(np.uint16)
    place = f", spacing={SPACING}"
    layers = [np.flipud(grey[:, :, k].T) for k in range(SHAPE[2])]
    for packing in (None, "tiff_lzw", "tiff_adobe_deflate", "packbits"):
        pages = [PIL.Image.fromarray(layer) for layer in layers]
        pages[0].save(folder / f"pages_{packing}.tif", save_all=True, append_images=pages[1:], compression=packing)
        compare(folder / f"pages_{packing}.tif", stack_affine(), place, grey)
    floats = [PIL.Image.fromarray((0.5 * layer).astype(np.float32)) for layer in layers]
    floats[0].save(folder / "floats.tif", save_all=True, append_images=floats[1:])
    compare(folder / "floats.tif", stack_affine(), place, 0.5 * grey)
    bytes_ = (grey // 16).astype(np.uint8)
    small = [PIL.Image.fromarray(np.flipud(bytes_[:, :, k].T)) for k in range(SHAPE[2])]
    for kind in ("tif", "bmp", "png"):
        (folder / kind).mkdir()
        for k, image in enumerate(small):
            image.save(folder / kind / f"layer{k}.{kind}")
        compare(folder / kind, stack_affine(), place, bytes_)
        coloured = folder / f"coloured_{kind}"
        coloured.mkdir()
        for k, image in enumerate(small):
            PIL.Image.merge("RGB", [image, small[0], small[k - 1]]).save(coloured / f"layer{k}.{kind}")
        compare(coloured, stack_affine(), place + ", channel=0", bytes_)
        compare(coloured, stack_affine(), place + ", channel=2", np.roll(bytes_, 1, axis=2))
        fails(coloured, "in colour; choose one of its values by channel=0", options=place)
    whole = (folder / "pages_tiff_lzw.tif").read_bytes()
    (folder / "cut.tif").write_bytes(whole[:len(whole) // 2])
    fails(folder / "cut.tif", "cannot be read", options=place)
    (folder / "cut.bmp").write_bytes((folder / "bmp" / "layer0.bmp").read_bytes()[:-20])
    fails(folder / "cut.bmp", "is cut off", options=place)
    fails(folder / "tif", "does not say how large its voxels are")


def vti(values, form, packed=False, order="LittleEndian", where="PointData"):
    """Image data as the VTK User's Guide describes them ("VTK XML file formats")."""
    nx, ny, nz = values.shape if where == "PointData" else (n + 1 for n in values.shape)
    turned = values.transpose(2, 1, 0).astype(values.dtype.newbyteorder("<" if order == "LittleEndian" else ">"))
    raw, word = turned.tobytes(), "<u4" if order == "LittleEndian" else ">u4"
    number = lambda *n: np.array(n, word).tobytes()
    if packed:
        size = 256
        blocks = [raw[n:n + size] for n in range(0, len(raw), size)]
        small = [zlib.compress(block) for block in blocks]
        head = number(len(blocks), size, len(blocks[-1]) % size, *map(len, small))
        parts = [head, b"".join(small)]
    else:
        parts = [number(len(raw)) + raw]
    inside = {"ascii": " ".join(str(v) for v in turned.ravel()),
              "binary": "".join(base64.b64encode(part).decode() for part in parts), "appended": ""}[form]
    compressor = ' compressor="vtkZLibDataCompressor"' if packed else ""
    kind = {"i2": "Int16", "f4": "Float32"}[values.dtype.str[1:]]
    offset = ' offset="0"' if form == "appended" else ""
    text = (f'<?xml version="1.0"?>\n<VTKFile type="ImageData" version="0.1" byte_order="{order}"{compressor}>\n'
            f'<ImageData WholeExtent="1 {nx} 0 {ny - 1} 0 {nz - 1}" Origin="1 2 3" Spacing="0.5 0.75 3">\n'
            f'<Piece Extent="1 {nx} 0 {ny - 1} 0 {nz - 1}"><{where}>\n'
            f'<DataArray type="{kind}" Name="ct" format="{form}"{offset}>{inside}</DataArray>\n'
            f'</{where}></Piece></ImageData>\n').encode()
    if form == "appended":
        text += b'<AppendedData encoding="raw">_' + b"".join(parts) + b"</AppendedData>\n"
    return text + b"</VTKFile>\n"


def vtk_images_are_read(folder):
    affine = np.diag([*SPACING, 1.0])
    affine[:3, 3] = (1.5, 2, 3)
    for form in ("ascii", "binary", "appended"):
        for packed in (False, True) if form != "ascii" else (False,):
            for order in ("LittleEndian", "BigEndian"):
                for kind in (np.int16, np.float32):
                    (folder / "a.vti").write_bytes(vti(phantom().astype(kind), form, packed, order))
                    compare(folder / "a.vti", affine)
    cells = affine.copy()
    cells[:3, 3] += 0.5 * np.array(SPACING)
    (folder / "cells.vti").write_bytes(vti(phantom(), "appended", where="CellData"))
    compare(folder / "cells.vti", cells)
    whole = vti(phantom(), "appended")
    (folder / "cut.vti").write_bytes(whole[:-200])
    fails(folder / "cut.vti", "cut off")
    (folder / "wrong.vti").write_bytes(whole.replace(b'Extent="1', b'Extent="one', 2))
    fails(folder / "wrong.vti", "cannot be read")


def heat_is_read_back(path, what):
    """A field that is linear in space, in a file of two fields, which the design must name."""
    part = ombre.load_text('root((-5, -5, -5), (5, 5, 5), (0.25, 0.25, 0.5)) attribute("heat", "x + 2*y") sphere(4);')
    part.write_voxels(path, what="distance,heat")
    points = np.random.default_rng(4).uniform(-2.2, 2.2, (200, 3))
    heat = values_at(path, points, ', series="heat"')
    expect(np.abs(heat - points[:, 0] - 2 * points[:, 1]).max() < 1e-5, f"values of {path.name}")
    fails(path, f"holds several {what}s", "distance", "heat")
    fails(path, f'no {what} "cold"', options=', series="cold"')


def image_data_of_ours_are_read_back(folder):
    heat_is_read_back(folder / "ball.vti", "array")


def voxels_may_be_counted(folder):
    np.save(folder / "a.npy", phantom().transpose(2, 1, 0))
    compare(folder / "a.npy", np.eye(4), ', space="index"')
    both = np.stack([phantom(), -phantom()], axis=-1).transpose(2, 1, 0, 3)
    np.save(folder / "both.npy", both)
    compare(folder / "both.npy", np.eye(4), ', space="index", channel=1', -phantom())


def facts_and_pictures_name_nobody(folder):
    write_series(folder / "ct")
    result = subprocess.run([sys.executable, "-m", "ombre", "info", folder / "ct", "--picture", folder / "planes.png"],
                            capture_output=True, text=True)
    expect(result.returncode == 0, result.stderr)
    picture = (folder / "planes.png").read_bytes()
    for reported in (result.stdout.encode(), result.stderr.encode(), picture):
        expect(b"Doe" not in reported and b"12345" not in reported, "a patient is named")
    expect("12 x 10 x 6 voxels" in result.stdout, result.stdout)
    image = np.asarray(PIL.Image.open(folder / "planes.png").convert("L")).astype(float)
    # 6 x 7.5 x 18 mm: 480 pixels are 18 mm.
    expect(image.shape == (480, 160 + 8 + 160 + 8 + 200), f"a picture of {image.shape}")
    least, greatest = np.sort(phantom().ravel())[[3, -4]]
    voxel = lambda i, j, k: 255 * np.clip((phantom()[i, j, k] - least) / (greatest - least), 0, 1)
    for i, j in ((0, 0), (11, 9), (3, 7)):  # in the first plane, the third axis in its middle
        found = image[199 - int(20 * (j + 0.5)), int((i + 0.5) * 160 / 12)]
        expect(abs(found - voxel(i, j, 3)) < 4, f"pixel ({i}, {j}) is {found}, not {voxel(i, j, 3)}")
    labels = np.zeros((4, 5, 6), np.uint8)
    labels[1], labels[2, 2] = 7, 3
    np.save(folder / "labels.npy", labels)
    facts = ombre.volume_info(folder / "labels.npy")
    expect(facts["labels"] == [[0, 4 * 30 - 30 - 6], [3, 6], [7, 30]], facts["labels"])
    try:
        ombre.volume_info(folder / "labels.npy", picture=folder / "planes.png")
    except ombre.MachineError as error:
        expect("planes.png" in str(error), str(error))
    else:
        raise AssertionError("a picture was replaced")


def large_files_stay_on_disk(folder):
    """A raw NRRD of 300 MiB takes far less memory than that; what it says is right."""
    shape = (512, 512, 600)
    header = ("NRRD0004\ntype: int16\ndimension: 3\nsizes: %d %d %d\nendian: little\nencoding: raw\n"
              "space directions: (0.5,0,0) (0,0.5,0) (0,0,1)\nspace dimension: 3\nspace origin: (0,0,0)\n\n" % shape)
    with open(folder / "large.nrrd", "wb") as file:
        file.write(header.encode())
        for k in range(shape[2]):
            file.write(np.full(shape[:2], k - 300, "<i2").tobytes())
    (folder / "part.vcad").write_text('volume_solid("large.nrrd", "red", level=0);')
    script = ("import resource, ombre; d = ombre.load('part.vcad'); print(d.bounds); print(resource.getrusage("
              "resource.RUSAGE_SELF).ru_maxrss, open('/proc/self/status').read().split('RssAnon:')[1].split()[0])")
    result = subprocess.run([sys.executable, "-c", script], cwd=folder, capture_output=True, text=True)
    expect(result.returncode == 0, result.stderr)
    anonymous = int(result.stdout.split()[-1]) / 1024
    expect(anonymous < 150, f"{anonymous:.0f} MiB are taken")
    points = np.array([[10.0, 20.0, 450.0], [0.0, 0.0, 1.25], [255.0, 255.0, 599.0]])
    expect(np.allclose(values_at(folder / "large.nrrd", points), points[:, 2] - 300), "values of a large file")


def write_segmentation(path, layers, segments, has_numbers=True):
    """As 3D Slicer writes them: layers of labels (x, y, z), and (name, label, layer, colour) of each segment."""
    shape, voxels = layers[0].shape, np.stack(layers)
    is_layered = len(layers) > 1
    lines = ["NRRD0004", "# Complete NRRD file format specification at:", "type: unsigned char",
             f"dimension: {3 + is_layered}", "space: left-posterior-superior",
             "sizes: " + (f"{len(layers)} " if is_layered else "") + "%d %d %d" % shape,
             "space directions: " + ("none " if is_layered else "") + "(0.5,0,0) (0,0.75,0) (0,0,3)",
             "kinds: " + ("list " if is_layered else "") + "domain domain domain", "encoding: gzip", "space origin: (1,2,3)"]
    for n, (name, label, layer, colour) in enumerate(segments):
        lines += [f"Segment{n}_ID:=Segment_{n + 1}", f"Segment{n}_Name:={name}", f"Segment{n}_Color:=%g %g %g" % colour]
        if has_numbers:
            lines += [f"Segment{n}_LabelValue:={label}", f"Segment{n}_Layer:={layer}"]
    lines += ["Segmentation_ContainedRepresentationNames:=Binary labelmap|Closed surface|", "", ""]
    path.write_bytes("\n".join(lines).encode() + gzip.compress(voxels.ravel(order="F").tobytes()))


def segments_have_names_and_colours(folder):
    x, y, z = np.indices(SHAPE)
    bone, kidney, cyst = x < 4, (x >= 4) & (y > 6), (x >= 2) & (x < 6) & (z > 3)  # the last overlaps both
    colours = {"bone": (0.945, 0.839, 0.569), "left kidney": (0.725, 0.4, 0.325), "Zyste é": (0, 1, 0.2)}
    wanted = {"bone": bone, "left kidney": kidney, "Zyste é": cyst}
    places = np.array([1, 2, 3]) + np.stack([x, y, z], -1).reshape(-1, 3) * [0.5, 0.75, 3]
    one = (1 * bone + 5 * kidney).astype(np.uint8)
    of = lambda *named: [(name, label, layer, colours[name]) for name, label, layer in named]
    write_segmentation(folder / "one.seg.nrrd", [one], of(("bone", 1, 0), ("left kidney", 5, 0)))
    write_segmentation(folder / "two.seg.nrrd", [one, cyst.astype(np.uint8)],
                       of(("bone", 1, 0), ("left kidney", 5, 0), ("Zyste é", 1, 1)))
    write_segmentation(folder / "old.seg.nrrd", [bone.astype(np.uint8), kidney.astype(np.uint8), cyst.astype(np.uint8)],
                       of(("bone", 1, 0), ("left kidney", 1, 1), ("Zyste é", 1, 2)), has_numbers=False)
    for file in ("one", "two", "old"):
        path = folder / f"{file}.seg.nrrd"
        facts = ombre.volume_info(path)["segments"]
        expect([s["name"] for s in facts] == list(wanted)[:2 if file == "one" else 3], f"{file}: {facts}")
        for segment in facts:
            mask, colour = wanted[segment["name"]], colours[segment["name"]]
            expect(segment["voxels"] == mask.sum(), f"{file}: {segment} has {mask.sum()} voxels")
            expect(segment["colour"] == "#" + "".join(f"{int(255 * c + 0.5):02x}" for c in colour), f"{file}: {segment}")
            for name in (segment["name"], segment["id"]):
                design = ombre.load_text(f'volume_solid("{path}", "red", segment="{name}");')
                expect((design.inside(places) == mask.ravel()).all(), f"{file}: other voxels in {name}")
    result = subprocess.run([sys.executable, "-m", "ombre", "info", folder / "two.seg.nrrd"], capture_output=True, text=True)
    expect(f"left kidney  5      0      #b96653  {kidney.sum()}" in result.stdout, result.stdout + result.stderr)
    whole = (folder / "two.seg.nrrd").read_bytes()
    for key, right, wrong in (("LabelValue", b"LabelValue:=5", b"LabelValue:=-5"), ("Layer", b"Layer:=1", b"Layer:=x")):
        (folder / f"{key}.seg.nrrd").write_bytes(whole.replace(right, wrong, 1))
        fails(folder / f"{key}.seg.nrrd", "_" + key)


def sparse_grids_are_read(folder):
    heat_is_read_back(folder / "ball.vdb", "grid")
    whole = (folder / "ball.vdb").read_bytes()
    (folder / "cut.vdb").write_bytes(whole[:len(whole) // 2])
    fails(folder / "cut.vdb", "cut.vdb")


if __name__ == "__main__":
    run([wrong_volumes_are_errors, palettes_are_labels, nifti_affines_are_honoured, meta_images_are_read, arrays_are_volumes,
         tiles_and_planes_are_read, stacks_of_images_are_read, vtk_images_are_read, image_data_of_ours_are_read_back,
         voxels_may_be_counted, facts_and_pictures_name_nobody, large_files_stay_on_disk,
         segments_have_names_and_colours, sparse_grids_are_read])

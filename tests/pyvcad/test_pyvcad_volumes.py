"""Volumes of pyvcad 3: scans, grids of OpenVDB, coloured images, and colours for Hounsfield units."""
import pathlib
import struct
import zlib

import numpy
import pytest

import ombre
import pyvcad as pv
import pyvcad_medical as med

red, blue = pv.default_materials.id("red"), pv.default_materials.id("blue")


def write_scan(folder, slope=1.0, intercept=-1000.0):
    """Six slices of 12 x 10 pixels of 0.5 x 0.75 x 3 mm, from (-3, 7, -20) on: 10 i + 100 j + 1000 k as stored."""
    pydicom = pytest.importorskip("pydicom")
    folder.mkdir()
    for k in range(6):
        meta = pydicom.dataset.FileMetaDataset()
        meta.MediaStorageSOPClassUID = pydicom.uid.CTImageStorage
        meta.MediaStorageSOPInstanceUID = pydicom.uid.generate_uid()
        meta.TransferSyntaxUID = pydicom.uid.ExplicitVRLittleEndian
        data = pydicom.dataset.FileDataset("slice", {}, file_meta=meta, preamble=b"\0" * 128)
        data.is_little_endian, data.is_implicit_VR = True, False
        data.SOPClassUID, data.SOPInstanceUID = meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID
        data.PatientName, data.Modality, data.SeriesInstanceUID, data.SeriesNumber = "Doe^Jane", "CT", "1.2.3", 1
        data.StudyInstanceUID, data.InstanceNumber = "1.2", k + 1
        data.ImagePositionPatient, data.ImageOrientationPatient = [-3.0, 7.0, -20.0 + 3 * k], [1, 0, 0, 0, 1, 0]
        data.PixelSpacing, data.SliceThickness = [0.75, 0.5], 3.0
        data.Rows, data.Columns, data.SamplesPerPixel = 10, 12, 1
        data.PhotometricInterpretation = "MONOCHROME2"
        data.BitsAllocated, data.BitsStored, data.HighBit, data.PixelRepresentation = 16, 16, 15, 0
        data.RescaleSlope, data.RescaleIntercept = slope, intercept
        j, i = numpy.indices((10, 12))
        data.PixelData = (10 * i + 100 * j + 1000 * k).astype("<u2").tobytes()
        data.save_as(folder / f"{k}.dcm", write_like_original=False)
    return folder


def test_scans_say_what_they_hold(tmp_path, capsys):
    scan = pv.DICOMLoader(str(write_scan(tmp_path / "ct")))
    assert scan.get_dimensions() == (12, 10, 6) and scan.get_voxel_size() == (0.5, 0.75, 3)
    assert scan.get_min_max_hu() == (-1000, 110 + 900 + 5000 - 1000)
    assert (scan.get_rescale_slope(), scan.get_rescale_intercept()) == (1, -1000)
    low, high = scan.get_bounding_box()
    assert low == (-3.25, 7 - 0.375, -21.5) and high == (2.75, 7 + 7.5 - 0.375, -3.5)
    volume = scan.as_volume()
    assert volume.grid_type() == "float" and volume.bounding_box() == (low, high)
    # Voxel (4, 3, 2), and half way to its neighbour along z.
    assert volume.sample(-1, 9.25, -14) == pytest.approx(40 + 300 + 2000 - 1000)
    assert volume.sample(-1, 9.25, -12.5) == pytest.approx(40 + 300 + 2500 - 1000)
    med.imaging.print_loaded_dicom_info(scan)
    reported = capsys.readouterr().out
    assert "12 x 10 x 6 voxels" in reported and "Doe" not in reported


def test_given_values_go_before_those_of_the_files(tmp_path):
    folder = str(write_scan(tmp_path / "ct", slope=2.0))
    scan = pv.DICOMLoader(folder, center=True, rescale_slope=0.5, rescale_intercept=10, slice_thickness=1.5,
                          x_pixel_spacing=1.0)
    assert scan.get_voxel_size() == (1, 0.75, 1.5)
    low, high = scan.get_bounding_box()
    assert low == (-6, -3.75, -4.5) and high == (6, 3.75, 4.5)
    assert scan.get_min_max_hu() == (10, 0.5 * (110 + 900 + 5000) + 10)
    assert scan.as_volume().sample(-5.5, -3.375, -3.75 + 1.5) == pytest.approx(0.5 * 1000 + 10)


def test_values_of_a_scan_become_attributes_and_colours(tmp_path):
    volume = pv.DICOMLoader(str(write_scan(tmp_path / "ct"))).as_volume()
    part = pv.RectPrism.FromMinAndMax(*volume.bounding_box())
    part.set_attribute(pv.DefaultAttributes.HU, pv.FloatAttribute(volume))
    assert part.get_attribute("hu").is_volume_backed() and part.get_attribute("hu").volume_type_name() == "float"
    assert pv.TreeSampler(part, pv.Vec3(0.5, 0.75, 3)).as_float_array("hu")[4, 3, 2] == 1340
    entries = med.color_maps.create_linear_gradient_hu_map(-1000, 5010, palette="jet", steps=4,
                                                           opacity_function=lambda t: t)
    coloured = pv.AttributeModifier(pv.LookupTableConverter(["hu"], ["color_rgba"], entries), part)
    grid = pv.TreeSampler(coloured, pv.Vec3(0.5, 0.75, 3)).as_vec4_array("color_rgba")
    assert numpy.allclose(grid[0, 0, 0], [*med.color_maps.get_color_palette("jet")[32], 0.125], atol=1e-6)
    dense = pv.RectPrism.FromMinAndMax(*volume.bounding_box())
    dense.set_attribute("density", pv.DerivedFloatAttribute("1 + h/1000", {"h": pv.FloatAttribute(volume)}))
    values = pv.TreeSampler(dense, pv.Vec3(0.5, 0.75, 3)).as_float_array("density")
    assert values[4, 3, 2] == pytest.approx(2.34)


def test_grids_of_openvdb(tmp_path):
    part = ombre.load_text('root((-5, -5, -5), (5, 5, 5), (0.25, 0.25, 0.25)) attribute("heat", "x + 2*y") sphere(4);')
    part.write_voxels(tmp_path / "ball.vdb", what="distance,heat")
    heat = pv.vdb_loader.load_float_volume(str(tmp_path / "ball.vdb"), "heat")
    assert heat.sample(1, 0.5, -2) == pytest.approx(2, abs=1e-5)
    moved = pv.vdb_loader.load_float_volume(str(tmp_path / "ball.vdb"), "heat", center=True)
    low, high = moved.bounding_box()
    assert numpy.allclose(numpy.add(low, high), 0, atol=1e-9)
    solid = pv.SignedDistanceField(str(tmp_path / "ball.vdb"), "distance")
    assert solid.volume(0.1) == pytest.approx(4 / 3 * numpy.pi * 64, rel=0.01)
    assert pv.SignedDistanceField(pv.vdb_loader.load_float_volume(str(tmp_path / "ball.vdb"), "distance")).volume(
        0.1) == pytest.approx(4 / 3 * numpy.pi * 64, rel=0.01)
    with pytest.raises(ValueError, match="expected 3 values in each voxel"):
        pv.vdb_loader.load_vec3s_volume(str(tmp_path / "ball.vdb"), "heat")
    with pytest.raises(FileNotFoundError, match="there is no nowhere.vdb"):
        pv.vdb_loader.load_float_volume("nowhere.vdb", "heat")


def png(path, rgba):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = b"".join(b"\0" + row.tobytes() for row in rgba)
    header = struct.pack(">IIBBBBB", rgba.shape[1], rgba.shape[0], 8, 6, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) +
                     chunk(b"IEND", b""))


def test_coloured_images(tmp_path):
    pixels = numpy.random.default_rng(5).integers(0, 256, (3, 4, 5, 4), dtype=numpy.uint8)  # z, rows, columns
    (tmp_path / "stack").mkdir()
    for k, image in enumerate(pixels):
        png(tmp_path / "stack" / f"layer_{k}.png", image)
    loader = pv.PNGLoader.FromStack(str(tmp_path / "stack"), pv.Vec3(0.5, 1, 2), pv.PNGColorMode.COLOR_RGBA)
    volume = loader.as_rgba_volume()
    assert volume.bounding_box() == ((0, 0, 0), (2.5, 4, 6)) and volume.grid_type() == "vec4s"
    # Column 3, row 1 from the top, layer 2.
    assert volume.sample(3.5 * 0.5, 2.5, 5) == pytest.approx(tuple(pixels[2, 1, 3] / 255))
    part = pv.RectPrism.FromMinAndMax(*volume.bounding_box())
    part.set_attribute("color_rgba", pv.Vec4Attribute(volume))
    grid = pv.TreeSampler(part, pv.Vec3(0.5, 1, 2)).as_vec4_array("color_rgba")
    assert numpy.allclose(grid, numpy.flip(pixels, 1).transpose(2, 1, 0, 3) / 255, atol=1e-6)
    image = pv.PNGLoader.FromImage(str(tmp_path / "stack" / "layer_0.png"), pv.Vec3(0.5, 1, 2), 7.0,
                                   pv.PNGColorMode.COLOR_RGB, center=True)
    flat = image.as_rgb_volume()
    assert flat.bounding_box() == ((-1.25, -2, -3.5), (1.25, 2, 3.5))
    assert flat.sample(-1, 1.5, 3) == flat.sample(-1, 1.5, -3) == pytest.approx(tuple(pixels[0, 0, 0, :3] / 255))
    with pytest.raises(ValueError, match="COLOR_RGBA"):
        image.as_rgba_volume()


def test_palettes_and_opacities():
    maps = med.color_maps
    assert maps.get_color_palette("grayscale")[0] == (0, 0, 0) and maps.raw_color_palettes["grayscale"][-1] == (1, 1, 1)
    jet = numpy.array(maps.get_color_palette("jet"))
    # MATLAB's: dark blue, blue, cyan, yellow, red, dark red.
    assert numpy.allclose(jet[[0, 255]], [(0, 0, 0.5), (0.5, 0, 0)]) and numpy.allclose(jet[96], (0, 1, 1), atol=0.02)
    assert maps.sigmoid_opacity_base(0.5, k=12, x0=0.5) == 0.5
    assert maps.sigmoid_opacity_base(1, k=4, x0=0.5) == pytest.approx(1 / (1 + numpy.exp(-2)))
    entries = maps.create_linear_gradient_hu_map(-200, 800, steps=10)
    assert [e.input_low for e in entries] == pytest.approx(list(range(-200, 800, 100)))
    assert entries[-1].input_high == pytest.approx(800)
    with pytest.raises(ValueError, match="there is no palette 'sunset'"):
        maps.get_color_palette("sunset")
    with pytest.raises(ValueError, match="lo below hi"):
        maps.create_linear_gradient_hu_map(5, 5)

#!/usr/bin/env python3
"""Scans and images written by other libraries (pydicom, GDCM's tools, nibabel, Pillow), read through Python.

    PYTHONPATH=build/release/python python3 tests/run_scans.py
"""
import base64
import gzip
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

import nibabel
import numpy as np
import PIL.Image
import pydicom
import pydicom.uid

import ombre

SPACING = (0.5, 0.75, 3.0)  # mm along columns, rows and slices
SHAPE = (12, 10, 6)  # x, y, z


def expect(truth, message):
    if not truth:
        raise AssertionError(message)


def phantom():
    """Numbers of 16 bits, in which each voxel differs from its neighbours, with a head, a nose and a left ear."""
    x, y, z = np.indices(SHAPE)
    return (-1000 + 37 * x + 101 * y + 211 * z + 500 * (x > 8) * (y < 3)).astype(np.int16)


def values_at(path, points, options="", output="value"):
    design = ombre.load_text(f"""attribute("v", volume("{path}"{options}).{output}) rectprism((2000, 2000, 2000));""")
    return design.attribute("v", points)


def centres(affine):
    i, j, k = np.indices(SHAPE)
    index = np.stack([i, j, k, np.ones(SHAPE)], axis=-1).reshape(-1, 4)
    return (index @ np.asarray(affine).T)[:, :3]


def compare(path, affine, options="", voxels=None, tolerance=1e-6):
    voxels = phantom() if voxels is None else voxels
    for output in ("value", "nearest"):
        found = values_at(path, centres(affine), options, output)
        difference = np.abs(found - voxels.reshape(-1)).max()
        expect(difference <= tolerance * 4000, f"{path} {output}: off by {difference}")


def fails(path, *words, options=""):
    try:
        values_at(path, np.zeros((1, 3)), options)
    except ombre.DesignError as error:
        for word in words:
            expect(word in str(error), f"{word!r} is not in {error}")
        return
    raise AssertionError(f"{path} was read")


def write_slice(path, pixels, position, series, number, orientation=(1, 0, 0, 0, 1, 0), slope=1, intercept=0, frames=0):
    meta = pydicom.dataset.FileMetaDataset()
    meta.MediaStorageSOPClassUID = pydicom.uid.CTImageStorage
    meta.MediaStorageSOPInstanceUID = pydicom.uid.generate_uid()
    meta.TransferSyntaxUID = pydicom.uid.ExplicitVRLittleEndian
    data = pydicom.dataset.FileDataset(str(path), {}, file_meta=meta, preamble=b"\0" * 128)
    data.is_little_endian, data.is_implicit_VR = True, False
    data.SOPClassUID, data.SOPInstanceUID = meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID
    data.PatientName, data.PatientID = "Doe^Jane", "12345"
    data.Modality, data.SeriesInstanceUID, data.SeriesNumber = "CT", series[1], series[0]
    data.StudyInstanceUID = "1.2.3"
    data.InstanceNumber = number
    data.ImagePositionPatient = [float(v) for v in position]
    data.ImageOrientationPatient = list(orientation)
    data.PixelSpacing = [SPACING[1], SPACING[0]]
    data.SliceThickness = SPACING[2]
    data.Rows, data.Columns = pixels.shape[-2:]
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    data.BitsAllocated, data.BitsStored, data.HighBit, data.PixelRepresentation = 16, 16, 15, 1
    data.RescaleSlope, data.RescaleIntercept = slope, intercept
    data.PixelData = pixels.astype("<i2").tobytes()
    data.save_as(str(path), write_like_original=False)


ORIGIN = (-3.0, 7.0, -20.0)  # LPS
SERIES = (7, "1.2.826.0.1.7")


def write_series(folder, voxels=None, series=SERIES, skip=(), **options):
    folder.mkdir(exist_ok=True)
    voxels = phantom() if voxels is None else voxels
    # Names are in another order than places.
    for k in range(SHAPE[2]):
        if k in skip:
            continue
        place = (ORIGIN[0], ORIGIN[1], ORIGIN[2] + SPACING[2] * k)
        write_slice(folder / f"{series[0]}_{(5 * k) % 7}.dcm", voxels[:, :, k].T, place, series, k + 1, **options)
    return folder


def lps_affine():
    affine = np.diag([*SPACING, 1.0])
    affine[:3, 3] = ORIGIN
    return affine


def series_are_read_in_their_places(folder):
    compare(write_series(folder / "ct"), lps_affine())
    turned = lps_affine()
    turned[:2] *= -1
    compare(folder / "ct", turned, ", space=\"RAS\"")


def packed_series_are_the_same(folder):
    plain = write_series(folder / "plain")
    for flag in ("--rle", "--jpegls", "--j2k", "--jpeg", "--raw"):
        packed = folder / f"packed{flag}"
        packed.mkdir()
        for file in plain.iterdir():
            subprocess.run(["gdcmconv", flag, file, packed / file.name], check=True, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
        compare(packed, lps_affine())


def scales_are_applied(folder):
    compare(write_series(folder / "scaled", slope=0.5, intercept=-100), lps_affine(), voxels=0.5 * phantom() - 100)


def oblique_series_are_read(folder):
    c, s = np.cos(0.4), np.sin(0.4)
    across, down = np.array([c, s, 0]), np.array([-s * 0.8, c * 0.8, 0.6])
    normal = np.cross(across, down)
    (folder / "oblique").mkdir()
    for k in range(SHAPE[2]):
        place = np.array(ORIGIN) + SPACING[2] * k * normal
        write_slice(folder / "oblique" / f"{k}.dcm", phantom()[:, :, k].T, place, SERIES, k, (*across, *down))
    affine = np.eye(4)
    affine[:3, 0], affine[:3, 1], affine[:3, 2] = SPACING[0] * across, SPACING[1] * down, SPACING[2] * normal
    affine[:3, 3] = ORIGIN
    compare(folder / "oblique", affine, tolerance=1e-5)


def of_several_series_one_is_chosen(folder):
    write_series(folder / "mixed")
    other = np.flip(phantom(), 0)
    write_series(folder / "mixed", other, (8, "1.2.826.0.1.8"))
    fails(folder / "mixed", "holds 2 series", "series 7: CT, 6 files of 12 x 10", 'series="7"')
    fails(folder / "mixed", 'no series "9"', options=', series="9"')
    compare(folder / "mixed", lps_affine(), ', series="8"', other)
    compare(folder / "mixed", lps_affine(), ', series="1.2.826.0.1.7"')


def missing_slices_are_an_error(folder):
    fails(write_series(folder / "gap", skip=(2,)), "lacks 1 slice between")
    fails(write_series(folder / "gaps", skip=(2, 3)), "lacks 2 slices between")


def slices_that_come_twice_are_left_out(folder):
    write_series(folder / "twice")
    write_slice(folder / "twice" / "again.dcm", phantom()[:, :, 2].T, (ORIGIN[0], ORIGIN[1], ORIGIN[2] + 2 * SPACING[2]),
                SERIES, 99)
    compare(folder / "twice", lps_affine())


def what_is_no_image_is_passed_over(folder):
    write_series(folder / "notes")
    (folder / "notes" / "readme.txt").write_text("not a scan")
    compare(folder / "notes", lps_affine())
    (folder / "none").mkdir()
    (folder / "none" / "readme.txt").write_text("not a scan")
    fails(folder / "none", "holds no DICOM images")
    (folder / "empty").mkdir()
    fails(folder / "empty", "is empty")


def broken_files_are_errors(folder):
    good = (write_series(folder / "whole") / "7_0.dcm").read_bytes()
    for n, broken in enumerate((good[:-40], good[:300], good[:132])):
        one = folder / f"broken{n}"
        one.mkdir()
        (one / "a.dcm").write_bytes(broken)
        fails(one, str(one))


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
    whole = (folder / "two.seg.nrrd").read_bytes()
    for key, right, wrong in (("LabelValue", b"LabelValue:=5", b"LabelValue:=-5"), ("Layer", b"Layer:=1", b"Layer:=x"),
                              ("Color", b"Color:=0.9", b"Color:=7.9")):
        (folder / f"{key}.seg.nrrd").write_bytes(whole.replace(right, wrong, 1))
        fails(folder / f"{key}.seg.nrrd", "_" + key)


def sparse_grids_are_read(folder):
    part = ombre.load_text('root((-5, -5, -5), (5, 5, 5), (0.25, 0.25, 0.5)) attribute("heat", "x + 2*y") sphere(4);')
    part.write_voxels(folder / "ball.vdb", what="distance,heat")
    points = np.random.default_rng(4).uniform(-2.2, 2.2, (200, 3))
    heat = values_at(folder / "ball.vdb", points, ', series="heat"')
    expect(np.abs(heat - points[:, 0] - 2 * points[:, 1]).max() < 1e-5, "values of a sparse grid")
    fails(folder / "ball.vdb", "holds several grids", "distance", "heat")
    fails(folder / "ball.vdb", 'no grid "cold"', options=', series="cold"')
    whole = (folder / "ball.vdb").read_bytes()
    (folder / "cut.vdb").write_bytes(whole[:len(whole) // 2])
    fails(folder / "cut.vdb", "cut.vdb")


def main():
    checks = [series_are_read_in_their_places, packed_series_are_the_same, scales_are_applied, oblique_series_are_read,
              of_several_series_one_is_chosen, missing_slices_are_an_error, slices_that_come_twice_are_left_out,
              what_is_no_image_is_passed_over, broken_files_are_errors, wrong_volumes_are_errors, nifti_affines_are_honoured,
              meta_images_are_read, arrays_are_volumes, files_of_many_frames_are_read, tiles_and_planes_are_read, stacks_of_images_are_read,
              vtk_images_are_read, image_data_of_ours_are_read_back, voxels_may_be_counted,
              facts_and_pictures_name_nobody, large_files_stay_on_disk, segments_have_names_and_colours,
              sparse_grids_are_read]
    for check in checks:
        with tempfile.TemporaryDirectory() as scratch:
            check(pathlib.Path(scratch))
        print("ok", check.__name__.replace("_", " "))


if __name__ == "__main__":
    main()

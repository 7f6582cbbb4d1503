#!/usr/bin/env python3
"""Series of DICOM files written by pydicom and packed by GDCM's tools, read through Python.

    PYTHONPATH=build/release/python python3 tests/run_dicom.py
"""
import subprocess

import numpy as np

from scans import ORIGIN, SERIES, SHAPE, SPACING, compare, fails, lps_affine, phantom, run, write_series, write_slice


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


if __name__ == "__main__":
    run([series_are_read_in_their_places, packed_series_are_the_same, scales_are_applied, oblique_series_are_read,
         of_several_series_one_is_chosen, missing_slices_are_an_error, slices_that_come_twice_are_left_out,
         what_is_no_image_is_passed_over, broken_files_are_errors])

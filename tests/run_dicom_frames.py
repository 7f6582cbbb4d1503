#!/usr/bin/env python3
"""DICOM files of many frames, doses, segmentations, phases and padding, written by pydicom, read through Python.

    PYTHONPATH=build/release/python python3 tests/run_dicom_frames.py
"""
import numpy as np
import pydicom
import pydicom.datadict
import pydicom.encaps
import pydicom.uid

from scans import ORIGIN, SHAPE, SPACING, compare, expect, fails, lps_affine, phantom, run, values_at, write_series

ENHANCED_CT, DOSE = "1.2.840.10008.5.1.4.1.1.2.1", "1.2.840.10008.5.1.4.1.1.481.2"
SEGMENTATION, CAPTURE = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.7"


def item(name, **members):
    """A data set with a sequence of one item."""
    inner, outer = pydicom.Dataset(), pydicom.Dataset()
    for key, value in members.items():
        setattr(inner, key, value)
    setattr(outer, name, [inner])
    return outer


def image(kind, modality, frames, syntax=pydicom.uid.ExplicitVRLittleEndian, bits=16, signed=1):
    meta = pydicom.dataset.FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.TransferSyntaxUID = kind, syntax
    meta.MediaStorageSOPInstanceUID = pydicom.uid.generate_uid()
    data = pydicom.dataset.FileDataset("x", {}, file_meta=meta, preamble=b"\0" * 128)
    data.is_little_endian = syntax != pydicom.uid.ExplicitVRBigEndian
    data.is_implicit_VR = syntax == pydicom.uid.ImplicitVRLittleEndian
    data.SOPClassUID, data.SOPInstanceUID = kind, meta.MediaStorageSOPInstanceUID
    data.Modality, data.SeriesInstanceUID, data.StudyInstanceUID = modality, "1.2.826.0.1.9", "1.2.3"
    data.Rows, data.Columns = SHAPE[1], SHAPE[0]
    if frames:
        data.NumberOfFrames = frames
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    data.BitsAllocated, data.BitsStored, data.HighBit, data.PixelRepresentation = bits, bits, bits - 1, signed
    return data


def place(k):
    return [ORIGIN[0], ORIGIN[1], ORIGIN[2] + SPACING[2] * k]


def share_measures(data):
    shared = item("PixelMeasuresSequence", PixelSpacing=[SPACING[1], SPACING[0]], SliceThickness=SPACING[2])
    shared.update(item("PlaneOrientationSequence", ImageOrientationPatient=[1, 0, 0, 0, 1, 0]))
    data.SharedFunctionalGroupsSequence = [shared]


def slices(voxels):
    return voxels.transpose(2, 1, 0)


def save(data, path):
    data.save_as(str(path), write_like_original=False)
    return path


def enhanced(path, order=range(SHAPE[2]), slopes=None, syntax=pydicom.uid.ExplicitVRLittleEndian):
    data = image(ENHANCED_CT, "CT", len(list(order)), syntax)
    share_measures(data)
    groups, pixels = [], []
    for n, k in enumerate(order):
        group = item("PlanePositionSequence", ImagePositionPatient=place(k))
        slope = slopes[n] if slopes else 1
        group.update(item("PixelValueTransformationSequence", RescaleIntercept=0, RescaleSlope=slope, RescaleType="HU"))
        groups.append(group)
        pixels.append(slices(phantom())[k])
    data.PerFrameFunctionalGroupsSequence = groups
    data.PixelData = np.array(pixels).astype("<i2").tobytes()
    return save(data, path)


def frames_lie_where_their_groups_say(folder):
    compare(enhanced(folder / "plain.dcm"), lps_affine())
    compare(enhanced(folder / "shuffled.dcm", (3, 0, 5, 1, 4, 2)), lps_affine())
    compare(enhanced(folder / "back.dcm", range(SHAPE[2] - 1, -1, -1)), lps_affine())
    compare(enhanced(folder / "implicit.dcm", syntax=pydicom.uid.ImplicitVRLittleEndian), lps_affine())
    compare(enhanced(folder / "deflated.dcm", syntax=pydicom.uid.DeflatedExplicitVRLittleEndian), lps_affine())
    fails(enhanced(folder / "gap.dcm", (0, 1, 2, 4, 5)), "lacks 1 slice between", "(frame 4)", "regular=true")


def each_frame_has_its_slope(folder):
    slopes = [1, 2, 0.5, 1, 4, 1]
    enhanced(folder / "slopes.dcm", slopes=slopes)
    compare(folder / "slopes.dcm", lps_affine(), voxels=phantom() * np.array(slopes))


def one_frame_is_as_thick_as_it_says(folder):
    enhanced(folder / "one.dcm", (2,))
    affine = lps_affine()
    affine[2, 3] += 2 * SPACING[2]
    found = values_at(folder / "one.dcm", np.array([[ORIGIN[0], ORIGIN[1], affine[2, 3] + 0.49 * SPACING[2]],
                                                    [ORIGIN[0], ORIGIN[1], affine[2, 3] + 0.51 * SPACING[2]]]),
                      ", outside=7777", "nearest")
    expect(found[0] == phantom()[0, 0, 2] and found[1] == 7777, found)


def dose(path, syntax, bits, offsets):
    data = image(DOSE, "RTDOSE", SHAPE[2], syntax, bits, 0)
    data.ImagePositionPatient, data.ImageOrientationPatient = place(0), [1, 0, 0, 0, 1, 0]
    data.PixelSpacing = [SPACING[1], SPACING[0]]
    data.GridFrameOffsetVector, data.DoseGridScaling = offsets, 0.25
    order = ">" if syntax == pydicom.uid.ExplicitVRBigEndian else "<"
    data.PixelData = slices(phantom() + 2000).astype(f"{order}u{bits // 8}").tobytes()
    data["PixelData"].VR = "OW"
    return save(data, path)


def doses_are_scaled_in_both_byte_orders(folder):
    expected = 0.25 * (phantom() + 2000.0)
    relative = [SPACING[2] * k for k in range(SHAPE[2])]
    for syntax in (pydicom.uid.ExplicitVRLittleEndian, pydicom.uid.ImplicitVRLittleEndian,
                   pydicom.uid.ExplicitVRBigEndian):
        for bits in (16, 32):
            compare(dose(folder / "dose.dcm", syntax, bits, relative), lps_affine(), voxels=expected)
    # Offsets may also be positions along z.
    absolute = [ORIGIN[2] + offset for offset in relative]
    compare(dose(folder / "dose.dcm", pydicom.uid.ExplicitVRLittleEndian, 32, absolute), lps_affine(), voxels=expected)


def segmentation(path, parts, kind="BINARY"):
    """Frames of (segment, slice, mask), with names and colours."""
    data = image(SEGMENTATION, "SEG", len(parts), bits=1, signed=0)
    data.SegmentationType = kind
    share_measures(data)
    data.SegmentSequence = []
    for number, (name, lab) in enumerate((("bone", (65535, 32896, 32896)), ("skin", None)), 1):
        segment = pydicom.Dataset()
        segment.SegmentNumber, segment.SegmentLabel = number, name
        if lab:
            segment.RecommendedDisplayCIELabValue = list(lab)
        data.SegmentSequence.append(segment)
    groups = []
    for number, k, mask in parts:
        group = item("PlanePositionSequence", ImagePositionPatient=place(k))
        group.update(item("SegmentIdentificationSequence", ReferencedSegmentNumber=number))
        groups.append(group)
    data.PerFrameFunctionalGroupsSequence = groups
    bits = np.concatenate([mask.T.reshape(-1) for _, _, mask in parts])
    packed = np.packbits(bits.astype(np.uint8), bitorder="little").tobytes()
    data.PixelData = packed + b"\0" * (len(packed) % 2)
    return save(data, path)


def segmentations_are_labels(folder):
    x, y = np.indices(SHAPE[:2])
    left, right = x < 4, x > 8
    labels = np.zeros(SHAPE, np.int16)
    # The slices 2 and 4 have no frame, and the frames are in no order.
    parts = [(2, 5, right), (1, 0, left), (1, 1, left), (2, 1, right), (1, 3, left)]
    for number, k, mask in parts:
        labels[:, :, k][mask] = number
    path = segmentation(folder / "seg.dcm", parts)
    compare(path, lps_affine(), voxels=labels)
    overlapping = segmentation(folder / "over.dcm", parts + [(1, 5, x > 6)])
    fails(overlapping, "segments that overlap, the numbers 2 and 1")
    fails(segmentation(folder / "part.dcm", parts, "FRACTIONAL"), "fractions")


def jpeg_2000_keeps_signs(folder):
    try:
        from openjpeg.utils import encode_array
    except ImportError:
        print("openjpeg is not there: JPEG 2000 is not tried")
        return
    for signed in (0, 1):
        # The encoder needs at least 32 pixels along each side.
        voxels = (phantom() + (0 if signed else 1200)).repeat(4, 0).repeat(4, 1)
        data = image(ENHANCED_CT, "CT", SHAPE[2], pydicom.uid.JPEG2000Lossless, 16, signed)
        data.Rows, data.Columns = voxels.shape[1], voxels.shape[0]
        share_measures(data)
        data.PerFrameFunctionalGroupsSequence = [item("PlanePositionSequence", ImagePositionPatient=place(k))
                                                 for k in range(SHAPE[2])]
        frames = [encode_array(np.ascontiguousarray(plane).astype("i2" if signed else "u2"), photometric_interpretation=2,
                               bits_stored=13) for plane in slices(voxels)]
        data.PixelData = pydicom.encaps.encapsulate([bytes(frame) for frame in frames])
        data["PixelData"].is_undefined_length = True
        save(data, folder / f"j2k{signed}.dcm")
        points = np.stack(np.indices(voxels.shape), axis=-1).reshape(-1, 3).astype(float)
        found = values_at(folder / f"j2k{signed}.dcm", points, ", space=\"index\"", "nearest")
        expect((found == voxels.reshape(-1)).all(), f"signed {signed}: off by {np.abs(found - voxels.reshape(-1)).max()}")


def any_preamble_may_come_first(folder):
    write_series(folder / "one")
    path = folder / "one" / "7_0.dcm"
    good = path.read_bytes()
    for number, head in enumerate((b"II*\0\x08\0\0\0", b"MM\0*\0\0\0\x08", b"NRRD0004", b"\x89PNG\r\n\x1a\n", b"\x1f\x8b")):
        other = folder / f"head{number}.dcm"
        other.write_bytes(head + bytes(128 - len(head)) + good[128:])
        found = values_at(other, np.array([place(0)]), output="nearest")
        expect(found[0] == phantom()[0, 0, 0], found)


def folders_in_folders_are_searched(folder):
    write_series(folder / "plain")
    deep = folder / "disc" / "A" / "B"
    deep.mkdir(parents=True)
    for number, file in enumerate(sorted((folder / "plain").iterdir())):
        target = deep / file.name if number % 2 else deep.parent / file.name
        target.write_bytes(file.read_bytes())
    (folder / "disc" / "preview.png").write_bytes(b"\x89PNG")
    compare(folder / "disc", lps_affine())
    directory = image("1.2.840.10008.1.3.10", "OT", 0)
    for name in ("Rows", "Columns", "SamplesPerPixel"):
        delattr(directory, name)
    save(directory, folder / "disc" / "DICOMDIR")
    compare(folder / "disc", lps_affine())
    compare(folder / "disc" / "DICOMDIR", lps_affine())


def pictures_are_set_aside(folder):
    write_series(folder / "ct")
    for number, (kind, types) in enumerate(((CAPTURE, ["DERIVED", "SECONDARY"]),
                                            ("1.2.840.10008.5.1.4.1.1.2", ["ORIGINAL", "PRIMARY", "LOCALIZER"]))):
        data = image(kind, "CT", 0)
        data.ImageType, data.SeriesInstanceUID = types, f"1.2.3.4.{number}"
        data.PixelData = bytes(2 * SHAPE[0] * SHAPE[1])
        save(data, folder / "ct" / f"aside{number}.dcm")
    compare(folder / "ct", lps_affine())


def change(folder, **changes):
    """Changes the elements of each file by functions of its number."""
    for file in folder.iterdir():
        data = pydicom.dcmread(file)
        for name, function in changes.items():
            value = function(data.InstanceNumber - 1)
            if name.startswith("PixelPadding"):
                data.add_new(pydicom.datadict.tag_for_keyword(name), "SS", value)
            else:
                setattr(data, name, value)
        data.save_as(file)
    return folder


def phases_are_chosen(folder):
    for name in ("TemporalPositionIdentifier", "TriggerTime", "EchoTime"):
        both = folder / name
        both.mkdir()
        for phase in range(2):
            one = change(write_series(folder / f"{name}{phase}", phantom() + 100 * phase), **{name: lambda k: phase + 1})
            for file in one.iterdir():
                (both / f"{phase}{file.name}").write_bytes(file.read_bytes())
        fails(both, "holds 2 volumes at the same places", "phase=1:", "phase=2:", "choose one by phase=1, up to 2")
        fails(both, "has no phase 3", options=", phase=3")
        for phase in range(2):
            compare(both, lps_affine(), f", phase={phase + 1}", phantom() + 100 * phase)


def steps_may_be_rounded(folder):
    rounded = change(write_series(folder / "rounded"),
                     ImagePositionPatient=lambda k: [ORIGIN[0], ORIGIN[1], round(ORIGIN[2] + SPACING[2] * k + (k % 2) * 0.05, 2)])
    found = values_at(rounded, np.array([place(3)]), output="nearest")
    expect(found[0] == phantom()[0, 0, 3], found)
    fails(change(write_series(folder / "jump"), ImagePositionPatient=lambda k: [ORIGIN[0] + 4 * (k == 3), *place(k)[1:]]),
          "jump sideways", "mm beside the line")


def uneven_slices_are_resampled_on_request(folder):
    heights = [0, 1, 2, 4, 5, 6]
    uneven = change(write_series(folder / "uneven"),
                    ImagePositionPatient=lambda k: [ORIGIN[0], ORIGIN[1], ORIGIN[2] + heights[k]])
    fails(uneven, "lacks 1 slice between", "regular=true")
    points = np.array([[ORIGIN[0], ORIGIN[1], ORIGIN[2] + h] for h in (0, 2, 3, 6)])
    first = phantom()[0, 0].astype(float)
    expected = [first[0], first[2], (first[2] + first[3]) / 2, first[5]]
    found = values_at(uneven, points, ", regular=true")
    expect(np.abs(found - expected).max() < 1e-3, f"{found} {expected}")


def padding_is_outside(folder):
    voxels = phantom()
    voxels[0:2] = -2000
    padded = change(write_series(folder / "padded", voxels), PixelPaddingValue=lambda k: -2000)
    compare(padded, lps_affine(), ", outside=-7", np.where(voxels == -2000, -7, voxels))
    voxels[0] = -2010
    wide = change(write_series(folder / "wide", voxels), PixelPaddingValue=lambda k: -2010,
                  PixelPaddingRangeLimit=lambda k: -2000)
    compare(wide, lps_affine(), ", outside=-7", np.where(voxels <= -2000, -7, voxels))


def torn_files_print_no_assertion(folder):
    good = enhanced(folder / "good.dcm").read_bytes()
    for size in range(140, len(good), 397):
        (folder / "torn.dcm").write_bytes(good[:size])
        fails(folder / "torn.dcm", "torn.dcm")


if __name__ == "__main__":
    run([frames_lie_where_their_groups_say, each_frame_has_its_slope, one_frame_is_as_thick_as_it_says,
         doses_are_scaled_in_both_byte_orders, segmentations_are_labels, jpeg_2000_keeps_signs,
         any_preamble_may_come_first, folders_in_folders_are_searched, pictures_are_set_aside, phases_are_chosen,
         steps_may_be_rounded, uneven_slices_are_resampled_on_request, padding_is_outside,
         torn_files_print_no_assertion])

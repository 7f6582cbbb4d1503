"""A phantom as a series of DICOM files, and how scans are compared with it, for the tests that read scans."""
import pathlib
import tempfile

import numpy as np
import pydicom
import pydicom.uid

import ombre

SPACING = (0.5, 0.75, 3.0)  # mm along columns, rows and slices
SHAPE = (12, 10, 6)  # x, y, z
ORIGIN = (-3.0, 7.0, -20.0)  # LPS
SERIES = (7, "1.2.826.0.1.7")


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


def run(checks):
    """Runs each check in a folder of its own, and prints its name."""
    for check in checks:
        with tempfile.TemporaryDirectory() as scratch:
            check(pathlib.Path(scratch))
        print("ok", check.__name__.replace("_", " "))

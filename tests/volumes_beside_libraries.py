#!/usr/bin/env python3
"""Volumes beside the libraries that other programs use: their own test files, and files that they write.

Each file is the same (shape, spacing and all numbers), refused with a message, or different, which is never right. Libraries
that are not installed are named and passed over; with --install FOLDER they are put into a virtual environment there, by
pip.

    PYTHONPATH=build/release/python python3 tests/volumes_beside_libraries.py [--install FOLDER]
"""
import argparse
import collections
import importlib
import itertools
import pathlib
import re
import sys
import tempfile
import warnings

import other_libraries

PACKAGES = ("numpy", "nibabel", "pydicom[basic]", "pynrrd", "tifffile", "SimpleITK")
MOST_VOXELS = 2_000_000


np = ombre = None  # imported once the libraries are there


def quoted(path):
    return str(path).replace("\\", "\\\\").replace('"', '\\"')


def numbers(path, shape, options):
    """All numbers of a file, by the indices of their voxels."""
    index = np.stack(np.meshgrid(*(np.arange(n, dtype=float) for n in shape), indexing="ij"), axis=-1).reshape(-1, 3)
    design = ombre.load_text(f'attribute("v", volume("{quoted(path)}", space="index"{options}).nearest) '
                             "rectprism((100000, 100000, 100000));")
    return design.attribute("v", index).reshape(shape)


class Comparison:
    def __init__(self, name):
        self.name, self.counts, self.reasons = name, collections.Counter(), collections.Counter()

    def compare(self, path, reference, spacing=None, options="", label=None):
        """Compares a file with an array of shape (x, y, z), and the lengths of its voxels in mm."""
        label = label or pathlib.Path(path).name
        try:
            found = numbers(path, reference.shape, options)
        except (ombre.DesignError, ombre.MachineError) as error:
            self.refuse(str(error))
            return
        scale = max(1.0, float(np.nan_to_num(np.abs(reference), posinf=0).max()))
        same = np.abs(found - reference).max() <= 1e-5 * scale
        if same and spacing is not None:
            channel = 0 if "channel=0" in options else None
            same = self.has_lengths(path, reference.shape, spacing, channel)
        self.counts["same" if same else "different"] += 1
        if not same:
            print(f"DIFFERENT {self.name}: {label}, by up to {np.abs(found - reference).max()}")

    @staticmethod
    def has_lengths(path, shape, spacing, channel):
        try:
            info = ombre.volume_info(path, channel=channel)
        except (ombre.DesignError, ombre.MachineError):
            return True  # the options of the design chose what to read
        steps = [float(np.linalg.norm(step)) for step in info.get("steps_mm", [])]
        return [int(n) for n in info["size"]] == list(shape) and (not steps or np.allclose(steps, spacing, rtol=1e-4))

    def refuse(self, message):
        self.counts["refused"] += 1
        self.reasons[re.sub(r'"[^"]*/[^"]*"', "FILE", message.splitlines()[0]).split(" FILE ", 1)[-1][:100]] += 1

    def report(self):
        total = sum(self.counts.values())
        print(f"{self.name}: {total} files, {self.counts['same']} the same, {self.counts['refused']} refused with a "
              f"message, {self.counts['different']} different")
        for reason, count in self.reasons.most_common():
            print(f"    {count} refused: {reason}")


def with_nibabel(nibabel, comparison, _):
    for path in sorted((pathlib.Path(nibabel.__file__).parent / "tests" / "data").glob("*")):
        if not path.name.endswith((".nii", ".nii.gz", ".hdr")):
            continue
        try:
            image = nibabel.load(path)
            values, affine = np.asarray(image.get_fdata(), float), image.affine
        except Exception:  # a file that the library refuses says nothing
            continue
        options = ", channel=0" if values.ndim > 3 and values[..., 0].size < values.size else ""
        while values.ndim > 3:
            values = values[..., 0]
        while values.ndim < 3:
            values = values[..., np.newaxis]
        if values.size > MOST_VOXELS:
            continue
        if np.isnan(values).any():
            values, options = np.nan_to_num(values, nan=-1), options + ", nan=-1"
        comparison.compare(path, values, nibabel.affines.voxel_sizes(affine), options)


def with_pydicom(pydicom, comparison, _):
    for path in sorted((pathlib.Path(pydicom.__file__).parent / "data").rglob("*.dcm")):
        try:
            data = pydicom.dcmread(path)
            pixels = np.asarray(data.pixel_array, float)
            positions, slopes = places(data)
        except Exception:
            continue
        if data.SamplesPerPixel != 1:
            comparison.compare(path, np.full((1, 1, 1), np.inf))  # colours are refused
            continue
        if pixels.ndim == 2:
            pixels = pixels[np.newaxis]
        if pixels.size > MOST_VOXELS:
            continue
        if data.Modality == "SEG":
            labels = [group.SegmentIdentificationSequence[0].ReferencedSegmentNumber
                      for group in data.PerFrameFunctionalGroupsSequence][:len(pixels)]
            pixels = pixels * np.array(labels)[:, np.newaxis, np.newaxis]
        options = ""
        if "PixelPaddingValue" in data:
            options = f", outside={slopes[0][0] * data.PixelPaddingValue + slopes[0][1]}"
        pixels = np.array([slope * plane + intercept for plane, (slope, intercept) in zip(pixels, slopes)])
        if positions is not None and len(positions) == len(pixels):
            pixels = pixels[np.argsort(positions, kind="stable")]
        comparison.compare(path, pixels.transpose(2, 1, 0), None, options)


def places(data):
    """Heights of the frames of a file, and their scales."""
    count = int(data.get("NumberOfFrames", 1))
    plain = (float(data.get("RescaleSlope", data.get("DoseGridScaling", 1))), float(data.get("RescaleIntercept", 0)))
    if "PerFrameFunctionalGroupsSequence" not in data:
        offsets = data.get("GridFrameOffsetVector")
        return (np.array(offsets, float) if offsets else None), [plain] * count
    shared, heights, slopes = data.SharedFunctionalGroupsSequence[0], [], []
    for frame in data.PerFrameFunctionalGroupsSequence:
        def group(name, frame=frame):
            return frame.get(name, shared.get(name))
        turn = group("PlaneOrientationSequence")[0].ImageOrientationPatient
        normal = np.cross(turn[:3], turn[3:])
        heights.append(float(normal @ np.array(group("PlanePositionSequence")[0].ImagePositionPatient, float)))
        scale = group("PixelValueTransformationSequence")
        slopes.append((float(scale[0].RescaleSlope), float(scale[0].RescaleIntercept)) if scale else plain)
    return np.array(heights), slopes


def made_array(kind, shape=(5, 4, 3)):
    rng = np.random.default_rng(8)
    if np.dtype(kind).kind == "f":
        return rng.normal(size=shape).astype(kind)
    limits = np.iinfo(kind)
    return rng.integers(max(limits.min, -(2**40)), min(limits.max, 2**40), size=shape, endpoint=True).astype(kind)


KINDS = ("u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f4", "f8")


def with_nrrd(nrrd, comparison, folder):
    directions = np.array([[0.5, 0, 0], [0, 0, 0.75], [0, -2, 0]])
    for kind, encoding, order in itertools.product(KINDS, ("raw", "gzip", "ascii", "bzip2"), ("little", "big")):
        values = made_array(kind)
        path = folder / f"{kind}_{encoding}_{order}.nrrd"
        header = {"encoding": encoding, "endian": order, "space": "left-posterior-superior",
                  "space directions": directions, "space origin": [1, 2, 3]}
        nrrd.write(str(path), values.astype(np.dtype(kind).newbyteorder("<" if order == "little" else ">")), header)
        stored = nrrd.read(str(path))[0]
        comparison.compare(path, stored.astype(float), np.linalg.norm(directions, axis=1))
    for key in ("spacings", "space directions"):
        values = made_array("i2")
        given = {"spacings": [1.5, 2, 3], "space directions": np.full((3, 3), np.nan)}[key]
        header = {key: given} | ({"space": "LPS"} if key != "spacings" else {})
        path = folder / f"only_{key.replace(' ', '_')}.nrrd"
        nrrd.write(str(path), values, header)
        comparison.compare(path, values.astype(float), [1.5, 2, 3] if key == "spacings" else None)


def with_tifffile(tifffile, comparison, folder):
    for kind, byteorder in itertools.product(("u1", "u2", "f4"), ("<", ">")):
        stack = made_array(kind, (2, 3, 2, 4, 5))  # frames, slices, channels, rows, columns
        path = folder / f"imagej_{kind}_{ord(byteorder)}.tif"
        tifffile.imwrite(path, stack, imagej=True, byteorder=">", resolution=(2, 4), metadata={
            "axes": "TZCYX", "spacing": 3, "unit": "mm"})
        for frame, channel in itertools.product(range(2), range(2)):
            comparison.compare(path, upwards(stack[frame, :, channel]), [0.5, 0.25, 3],
                               f", channel={channel}, phase={frame + 1}")
    for axes, shape in (("TCZYX", (2, 3, 4, 4, 5)), ("TZCYX", (2, 4, 3, 4, 5)), ("CTZYX", (3, 2, 4, 4, 5)),
                        ("ZCTYX", (4, 3, 2, 4, 5)), ("CZTYX", (3, 4, 2, 4, 5)), ("ZTCYX", (4, 2, 3, 4, 5))):
        stack = made_array("u2", shape)
        path = folder / f"{axes}.ome.tif"
        tifffile.imwrite(path, stack, ome=True, metadata={
            "axes": axes, "PhysicalSizeX": 500, "PhysicalSizeXUnit": "\u00b5m", "PhysicalSizeY": 0.25,
            "PhysicalSizeYUnit": "mm", "PhysicalSizeZ": 3000})
        ordered = np.moveaxis(stack, [axes.index("T"), axes.index("C"), axes.index("Z")], [0, 1, 2])
        for frame, channel in itertools.product(range(2), range(3)):
            comparison.compare(path, upwards(ordered[frame, channel]), [0.5, 0.25, 3],
                               f", channel={channel}, phase={frame + 1}")
    for kind, compression in itertools.product(("u1", "i1", "u2", "i2", "u4", "i4", "f2", "f4", "f8", "u8", "i8"),
                                               (None, "zlib")):
        stack = made_array(kind, (3, 4, 5))
        path = folder / f"plain_{kind}_{compression}.tif"
        tifffile.imwrite(path, stack, compression=compression, photometric="minisblack", metadata=None)
        comparison.compare(path, upwards(stack))


def upwards(stack):
    """Slices of rows from the top, as (x, y, z) with y upwards."""
    return stack[:, ::-1].transpose(2, 1, 0).astype(float)


def with_simpleitk(sitk, comparison, folder):
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    for kind, ending, packed in itertools.product(KINDS, (".mha", ".nrrd", ".nii", ".nii.gz", ".mhd", ".nhdr"), (0, 1)):
        values = made_array(kind, (3, 4, 5))
        image = sitk.GetImageFromArray(values)
        image.SetSpacing((0.5, 0.75, 2))
        image.SetOrigin((3, -4, 5))
        image.SetDirection(turn.reshape(-1).tolist())
        path = folder / f"{kind}_{packed}{ending}"
        sitk.WriteImage(image, str(path), useCompression=bool(packed))
        comparison.compare(path, values.transpose(2, 1, 0).astype(float), [0.5, 0.75, 2])


LIBRARIES = (("nibabel", with_nibabel), ("pydicom", with_pydicom), ("nrrd", with_nrrd), ("tifffile", with_tifffile),
             ("SimpleITK", with_simpleitk))


def main():
    global np, ombre
    parser = argparse.ArgumentParser()
    other_libraries.add_option(parser)
    given = parser.parse_args()
    if given.install:
        other_libraries.use(given.install, PACKAGES)
    warnings.simplefilter("ignore")
    np, ombre = importlib.import_module("numpy"), importlib.import_module("ombre")
    different = 0
    for name, work in LIBRARIES:
        try:
            library = importlib.import_module(name)
        except ImportError:
            print(f"{name}: not installed")
            continue
        comparison = Comparison(name)
        with tempfile.TemporaryDirectory() as folder:
            work(library, comparison, pathlib.Path(folder))
        comparison.report()
        different += comparison.counts["different"]
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())

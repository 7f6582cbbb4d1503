"""Describes volumes."""
import os

from ._commands import run


def volume_info(path, series=None, channel=None, picture=None, force=False, phase=None, nan=None, regular=False):
    """The description of a volume: the members that `ombre info --json` prints, such as "size" (voxels along its axes),
    "steps_mm" and "origin_mm" (where it says its lengths), "space", "least", "greatest", "histogram", "labels" and, of
    segmentations, "segments".

    >>> import ombre, numpy
    >>> from ombre._volumes import stored
    >>> ombre.volume_info(stored(numpy.zeros((2, 3, 4))))["size"]
    [4.0, 3.0, 2.0]

    Args:
        path: a file, or a folder of DICOM files or images.
        series: of several DICOM series the number or UID, of several grids the name.
        channel: of several values in each voxel which one, counted from 0.
        picture: writes a picture of the three planes in the middle there.
        force: replaces a picture that is there.
        phase: of several volumes at the same place the number of one, counted from 1.
        nan: the value in place of NaN (no number); without it NaN is an error.
        regular: resamples slices of a scan at uneven distances to even ones.
    """
    options = {"volume": True, "series": series, "channel": channel, "picture": picture, "force": force, "phase": phase,
               "nan": nan, "regular": regular}
    report, _ = run("info", {"file": os.fspath(path)}, options)
    return dict(report)

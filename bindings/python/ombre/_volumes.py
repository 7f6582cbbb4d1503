"""Arrays in place of volume files."""
import atexit
import functools
import hashlib
import os
import pathlib
import shutil
import tempfile

import numpy

_types = {"u1": "uint8", "i1": "int8", "u2": "uint16", "i2": "int16", "u4": "uint32", "i4": "int32", "f4": "float",
          "f8": "double"}


@functools.lru_cache(maxsize=None)
def _folder():
    """A folder that lasts as long as the process."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="ombre-volumes-"))
    owner = os.getpid()
    atexit.register(lambda: os.getpid() == owner and shutil.rmtree(folder, ignore_errors=True))
    return folder


def is_array(value):
    return hasattr(value, "__array__") and not isinstance(value, (str, bytes))


def _numbers(array):
    values = numpy.asarray(array)
    if values.ndim != 3:
        raise ValueError(f"a volume is an array of three dimensions (z, y, x); this one has {values.ndim}")
    if values.dtype == bool:
        values = values.astype(numpy.uint8)
    if values.dtype.kind in "iu" and values.dtype.itemsize == 8:
        least, greatest = values.min(initial=0), values.max(initial=0)
        if least < -2**31 or greatest >= 2**31:
            raise ValueError("a volume's whole numbers have at most 32 bits; give floats")
        values = values.astype(numpy.int32)
    if values.dtype.newbyteorder("=").str[1:] not in _types:
        raise TypeError(f"a volume holds whole numbers or floats, not {values.dtype}")
    return numpy.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))


def _vector(values):
    return "(" + ",".join(repr(float(v)) for v in values) + ")"


def stored(array, affine=None):
    """The path of a file that holds the array, which has the shape (z, y, x), for as long as the process runs. `affine`
    (3 x 4 or 4 x 4) takes the indices (i, j, k) along x, y and z to mm."""
    values = _numbers(array)
    header = f"NRRD0004\ntype: {_types[values.dtype.str[1:]]}\ndimension: 3\n"
    if affine is not None:
        matrix = numpy.asarray(affine, dtype=float)
        if matrix.shape not in ((3, 4), (4, 4)):
            raise ValueError(f"an affine map is a matrix of 3 x 4 or 4 x 4 numbers, not of {matrix.shape}")
        directions = " ".join(_vector(matrix[:3, n]) for n in range(3))
        header += f"space dimension: 3\nspace directions: {directions}\nspace origin: {_vector(matrix[:3, 3])}\n"
    header += "sizes: %d %d %d\nencoding: raw\nendian: little\n\n" % values.shape[::-1]
    content = hashlib.sha256(header.encode())
    content.update(values.data if values.size else b"")
    path = _folder() / f"{content.hexdigest()[:24]}.nrrd"
    if not path.exists():
        part = path.with_suffix(".part")
        with open(part, "wb") as file:
            file.write(header.encode())
            file.write(values.data)
        part.replace(path)
    return str(path)

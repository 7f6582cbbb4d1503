"""A small PNG decoder: gray and indexed images of 1 to 8 bits and RGBA of 8, not interlaced."""
import struct
import zlib

GRAY, INDEXED, RGBA = 0, 3, 6


class Image:
    """Rows of (r, g, b, a), the top one first; pixels a metre along x and y, or None."""

    def __init__(self, data):
        if data[:8] != b"\x89PNG\r\n\x1a\n":
            raise ValueError("not a PNG")
        self.pixels_per_metre = None
        palette, alpha, packed, at = [], b"", b"", 8
        while at < len(data):
            length, kind = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 8:at + 8 + length]
            if zlib.crc32(kind + body) != struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0]:
                raise ValueError(f"wrong checksum of {kind}")
            at += 12 + length
            if kind == b"IHDR":
                self.width, self.height, self.depth, self.colour_type, _, _, interlaced = struct.unpack(">IIBBBBB", body)
                if interlaced:
                    raise ValueError("interlaced")
            elif kind == b"PLTE":
                palette = [tuple(body[i:i + 3]) for i in range(0, len(body), 3)]
            elif kind == b"tRNS":
                alpha = body
            elif kind == b"pHYs":
                x, y, unit = struct.unpack(">IIB", body)
                self.pixels_per_metre = (x, y) if unit == 1 else None
            elif kind == b"IDAT":
                packed += body
        if self.colour_type == GRAY:
            most = (1 << self.depth) - 1
            palette = [(255 * value // most,) * 3 for value in range(most + 1)]
        self.palette = [colour + (alpha[i] if i < len(alpha) else 255,) for i, colour in enumerate(palette)]
        self.rows = [self._colours(row) for row in self._unfiltered(zlib.decompress(packed))]

    def _unfiltered(self, data):
        bits = self.depth * (4 if self.colour_type == RGBA else 1)
        step, length = max(1, bits // 8), (self.width * bits + 7) // 8
        if len(data) != self.height * (length + 1):
            raise ValueError("wrong amount of pixels")
        before = bytes(length)
        for start in range(0, len(data), length + 1):
            method, row = data[start], bytearray(data[start + 1:start + 1 + length])
            for i in range(length) if method else ():
                left = row[i - step] if i >= step else 0
                corner = before[i - step] if i >= step else 0
                row[i] = (row[i] + _guess(method, left, before[i], corner)) & 255
            before = bytes(row)
            yield before

    def _colours(self, row):
        if self.colour_type == RGBA:
            return [tuple(row[i:i + 4]) for i in range(0, len(row), 4)]
        each = 8 // self.depth
        mask = (1 << self.depth) - 1
        indices = [row[x // each] >> (8 - self.depth * (x % each + 1)) & mask for x in range(self.width)]
        return [self.palette[i] for i in indices]


def _guess(method, left, up, corner):
    if method == 1:
        return left
    if method == 2:
        return up
    if method == 3:
        return (left + up) // 2
    distances = [abs(left + up - corner - value) for value in (left, up, corner)]
    return (left, up, corner)[distances.index(min(distances))]


def read(path):
    with open(path, "rb") as file:
        return Image(file.read())

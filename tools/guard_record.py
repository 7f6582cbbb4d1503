"""A record of what a build writes: a text file of hashes, and beside it an archive of the outputs themselves."""
import dataclasses
import hashlib
import pathlib
import zipfile

FORMAT = "# ombre guard, version 1"


@dataclasses.dataclass(frozen=True)
class Line:
    """One output: all files of a job, or what it said."""
    hash: str
    size: int
    status: str
    shape: str  # "output", or "internal" for what may change while the outputs stay


class Record:
    """Lines by "DESIGN JOB PART", boxes of designs, and the folder of given cases."""

    def __init__(self):
        self.lines, self.boxes, self.cases = {}, {}, None

    def write(self, path):
        text = [FORMAT, *([f"# cases {self.cases}"] if self.cases else [])]
        text += [f"# box {name} " + " ".join(map(repr, box)) for name, box in sorted(self.boxes.items())]
        text += [f"{name}  {line.hash}  {line.size}  {line.status}  {line.shape}" for name, line in sorted(self.lines.items())]
        path.write_text("\n".join(text) + "\n", encoding="utf-8")

    @staticmethod
    def read(path):
        record = Record()
        first, *lines = path.read_text(encoding="utf-8").splitlines() or [""]
        if first != FORMAT:
            raise ValueError(f"{path} is not a record of the guard: its first line is not \"{FORMAT}\"")
        for line in lines:
            if line.startswith("# cases "):
                record.cases = pathlib.Path(line[len("# cases "):])
            elif line.startswith("# box "):
                _, _, name, *box = line.split()
                record.boxes[name] = tuple(map(float, box))
            else:
                name, digest, size, status, shape = line.split("  ")
                record.lines[name] = Line(digest, int(size), status, shape)
        return record


class Store:
    """Contents by their hashes, each once, in an archive."""

    def __init__(self, path, mode="r"):
        self.archive = zipfile.ZipFile(path, mode, zipfile.ZIP_DEFLATED, compresslevel=1)
        self.known = set(self.archive.namelist())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.archive.close()

    def add(self, content):
        digest = hash_of(content)
        if digest not in self.known:
            self.known.add(digest)
            self.archive.writestr(zipfile.ZipInfo(digest), content, zipfile.ZIP_DEFLATED, 1)
        return digest

    def get(self, digest):
        return self.archive.read(digest)


def archive_of(path):
    return path.with_name(path.name + ".zip")


def hash_of(content):
    return hashlib.sha256(content).hexdigest()


def listing(files):
    """A text of the names, hashes and sizes of files, by which a set of files is known."""
    return "".join(f"{hash_of(content)} {len(content)} {name}\n" for name, content in sorted(files.items())).encode()


def hashes_of(listing_text):
    """Hashes by name."""
    rows = (line.split(" ", 2) for line in listing_text.decode().splitlines())
    return {name: digest for digest, _, name in rows}

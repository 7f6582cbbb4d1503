"""Designs in the studio: one server for a person's scripts, in which the last design that was shown appears."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.parse
import urllib.request

_idle_seconds = 600  # the server ends by itself when nobody uses it
_start_seconds = 30
_largest_file = 8 << 20  # limit of the studio


def _folder():
    """A folder of this person's own, in which the design lies and the server notes its address."""
    path = pathlib.Path(tempfile.gettempdir()) / f"ombre-show-{os.getuid()}"
    path.mkdir(mode=0o700, exist_ok=True)
    status = path.lstat()
    if not path.is_dir() or path.is_symlink() or status.st_uid != os.getuid() or status.st_mode & 0o077:
        raise OSError(f"{path} is not a folder of this user alone; remove it")
    return path


def _is_alive(url):
    """Does the server of this address answer to its token?"""
    address = urllib.parse.urlsplit(url)
    token = urllib.parse.parse_qs(address.query).get("token", [""])[0]
    request = urllib.request.Request(f"http://{address.netloc}/api", method="HEAD",
                                     headers={"Authorization": f"Bearer {token}"})
    try:
        with urllib.request.build_opener(urllib.request.ProxyHandler({})).open(request, timeout=5) as answer:
            return answer.status == 200
    except (OSError, urllib.error.URLError, ValueError):
        return False


def _known(note):
    try:
        url = json.loads(note.read_text(encoding="utf-8"))["url"]
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return url if _is_alive(url) else None


def _command():
    program = os.environ.get("OMBRE_PROGRAM")
    return [program] if program else [sys.executable, "-m", "ombre"]


def _start(design, note, idle_seconds):
    """Starts a server that outlives this program; its address."""
    package = str(pathlib.Path(os.path.abspath(__file__)).parent.parent)  # links stay: the compiled part lies beside them
    environment = dict(os.environ)
    environment["PYTHONPATH"] = os.pathsep.join(filter(None, [package, environment.get("PYTHONPATH")]))
    events = note.with_suffix(".events")
    with open(events, "w", encoding="utf-8") as output, open(os.devnull, "rb") as nothing:
        process = subprocess.Popen([*_command(), "studio", str(design), "--json", "--no-browser", "--idle",
                                    str(idle_seconds)],
                                   stdin=nothing, stdout=output, stderr=subprocess.STDOUT, env=environment,
                                   start_new_session=True)
    end = time.monotonic() + _start_seconds
    while time.monotonic() < end:
        for line in events.read_text(encoding="utf-8").splitlines():
            if line.startswith("{") and "url" in line:
                note.write_text(line, encoding="utf-8")
                return json.loads(line)["url"]
        if process.poll() is not None:
            raise OSError(f"the studio did not start: {events.read_text(encoding='utf-8').strip()}")
        time.sleep(0.02)
    process.kill()
    raise OSError(f"the studio did not start within {_start_seconds} s")


def show_in_studio(design, idle_seconds=_idle_seconds):
    """Puts a design before the studio; its address, and whether the server was there already. Raises OSError where the
    studio cannot start or the design is too large for it."""
    text = design.to_json()
    if len(text) > _largest_file:
        raise OSError("the design is too large for the studio")
    folder = _folder()
    file, note = folder / "shown.json", folder / "studio.note"
    pending = folder / "shown.part"
    pending.write_text(text, encoding="utf-8")
    pending.replace(file)  # a page that shows the file takes the change
    url = _known(note)
    return (url, True) if url else (_start(file, note, idle_seconds), False)

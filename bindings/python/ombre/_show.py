"""Pictures on the screen."""
import base64
import html
import os
import struct
import sys
import tempfile
import webbrowser

_page = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<style>
body {{ margin: 0; font: 14px sans-serif; text-align: center; color: #444; }}
img {{ cursor: grab; max-width: 100%; touch-action: none; user-select: none; }}
</style></head><body>
<img id="view" draggable="false" alt="{title}">
<p>{title} &mdash; drag, or use the arrow keys, to turn it</p>
<script>
const frames = [{frames}];
const view = document.getElementById("view");
let at = 0, from = null;
function turn(steps) {{
  at = ((at + steps) % frames.length + frames.length) % frames.length;
  view.src = "data:image/png;base64," + frames[at];
}}
view.onpointerdown = e => {{ from = e.clientX; view.setPointerCapture(e.pointerId); }};
view.onpointerup = () => {{ from = null; }};
view.onpointermove = e => {{
  const steps = from === null ? 0 : Math.trunc((from - e.clientX) / 15);
  if (steps) {{ turn(steps); from = e.clientX; }}
}};
document.onkeydown = e => turn(e.key === "ArrowLeft" ? -1 : e.key === "ArrowRight" ? 1 : 0);
turn(0);
</script></body></html>
"""


def pictures_in(data):
    """The PNG files that follow each other in the bytes."""
    pictures, begin, place = [], 0, 0
    while place < len(data):
        if place == begin:
            place += 8  # the signature
        size, kind = struct.unpack(">I4s", data[place:place + 8])
        place += 12 + size  # length, kind and checksum besides
        if kind == b"IEND":
            pictures.append(data[begin:place])
            begin = place
    return pictures


def viewer_page(pictures, title):
    """A page that holds pictures from all around a part, and turns it as one drags."""
    frames = ",\n".join('"' + base64.b64encode(picture).decode("ascii") + '"' for picture in pictures)
    return _page.format(title=html.escape(title), frames=frames)


def _in_notebook():
    return "ipykernel" in sys.modules


def _has_display():
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def _write(path, data):
    with open(path, "wb") as file:
        file.write(data)
    print(f"written to {path}", file=sys.stderr)


def _open_studio(design):
    """False where a page has to do: without the studio, and for designs that it cannot open."""
    from ._errors import DesignError
    from ._studio import show_in_studio
    try:
        url, _ = show_in_studio(design)
    except (OSError, DesignError):
        return False
    # The address has a token, which others would see in the arguments of the browser.
    with tempfile.NamedTemporaryFile("w", prefix="ombre_", suffix=".html", delete=False, encoding="utf-8") as file:
        file.write(f'<!doctype html><meta http-equiv="refresh" content="0; url={html.escape(url)}">\n')
    webbrowser.open("file://" + file.name)
    print(f"the studio shows it at {url}", file=sys.stderr)
    return True


def show(design, path=None, **options):
    """Shows a design: in a notebook its picture, with a display the studio in the browser, else a file.

    `path`, or the environment variable OMBRE_RENDER, names a .png or .html file to write in any case. OMBRE_RENDER=studio
    starts the studio without a display too, and prints its address.
    """
    path = path or os.environ.get("OMBRE_RENDER")
    if path == "studio":
        from ._studio import show_in_studio
        print(f"the studio shows it at {show_in_studio(design)[0]}", file=sys.stderr)
        return None
    if path:
        is_page = str(path).lower().endswith((".html", ".htm"))
        return _write(path, design.view(**options).encode() if is_page else design.render(**options))
    if _in_notebook():
        from IPython.display import Image, display
        return display(Image(data=design.render(**options)))
    if not _has_display():
        return _write("ombre.png", design.render(**options))
    if not options and _open_studio(design):
        return None
    with tempfile.NamedTemporaryFile("w", prefix="ombre_", suffix=".html", delete=False, encoding="utf-8") as file:
        file.write(design.view(**options))
    webbrowser.open("file://" + file.name)
    return None

"""Pictures on the screen."""
import os
import shutil
import subprocess
import sys
import tempfile


def show_picture(png, path=None):
    """Shows a picture in a notebook, or by the system's viewer; without either, writes it to a file and says where."""
    if "ipykernel" in sys.modules:
        from IPython.display import Image, display
        return display(Image(data=png))
    path = path or os.environ.get("OMBRE_RENDER")
    opener = shutil.which("xdg-open") if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") else None
    if not path and not opener:
        path = "ombre.png"
    if path:
        with open(path, "wb") as file:
            file.write(png)
        print(f"written to {path}", file=sys.stderr)
        return None
    with tempfile.NamedTemporaryFile(prefix="ombre_", suffix=".png", delete=False) as file:
        file.write(png)
    subprocess.Popen([opener, file.name], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return None

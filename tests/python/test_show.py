"""Designs that scripts put before the studio, without a browser."""
import base64
import json
import re
import stat
import tempfile
import time
import urllib.parse

import ombre
import pytest

from ombre import _studio

ball = ombre.Design(ball=ombre.sphere(3, "red"))
block = ombre.Design(block=ombre.cube(4, "blue"))


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Of temporary files, so that no server of anybody else is met."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


def show(design):
    try:
        return _studio.show_in_studio(design, idle_seconds=6)
    except OSError as error:
        if "without the studio" in str(error):
            pytest.skip("the studio was not built")
        raise


def wait_for_end(url):
    while _studio._is_alive(url):  # for ever if it does not end, which the test runner ends
        time.sleep(0.1)


def test_a_server_shows_one_design_after_the_other_and_ends_by_itself(folder):
    url, was_there = show(ball)
    assert not was_there
    assert urllib.parse.urlsplit(url).hostname == "127.0.0.1"
    again, was_there = show(block)
    assert (again, was_there) == (url, True)
    [shown] = folder.glob("ombre-show-*/shown.json")
    assert json.loads(shown.read_text()) == json.loads(block.to_json())
    assert stat.S_IMODE(shown.parent.stat().st_mode) == 0o700
    wait_for_end(url)


def test_a_server_that_ended_is_started_again(folder):
    first, _ = show(ball)
    wait_for_end(first)
    second, was_there = show(ball)
    assert not was_there and second != first
    wait_for_end(second)


def test_a_token_is_needed(folder):
    url, _ = show(ball)
    assert not _studio._is_alive(url.replace("token=", "token=00"))
    wait_for_end(url)


def test_show_prints_the_address(folder, monkeypatch, capfd):
    monkeypatch.setenv("OMBRE_RENDER", "studio")
    url = show(ball)[0]
    ball.show()
    assert url in capfd.readouterr().err
    wait_for_end(url)


def test_a_folder_of_somebody_else_is_refused(folder):
    import os
    (folder / f"ombre-show-{os.getuid()}").mkdir(mode=0o755)
    with pytest.raises(OSError, match="not a folder of this user alone"):
        _studio.show_in_studio(ball)


def test_a_view_holds_a_picture_of_each_frame():
    part = block
    page = part.view(frames=3, size="40x30")
    frames = re.findall(r'"(iVBOR[^"]*)"', page)
    assert len(frames) == 3
    single = part.render(size="40x30")
    assert base64.b64decode(frames[0]) == single  # the first frame is the usual view
    assert len(set(frames)) == 3

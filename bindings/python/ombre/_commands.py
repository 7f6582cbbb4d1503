"""Jobs, with their options as keyword arguments."""
import decimal
import fractions
import functools
import json
import keyword
import os
import sys
import warnings

import numpy

from . import _core
from ._errors import CheckError, DesignError, DesignWarning, MachineError


def _keyword(name):
    """"layer-height": layer_height; "from": from_, since Python has the word for itself."""
    name = name.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


@functools.lru_cache(maxsize=None)
def options_of(kind):
    """{keyword: option} of a kind of jobs; an option has name, help, kind, takes, choices and so on."""
    for known in _core.jobs():
        if known["name"] == kind:
            return {_keyword(option["name"]): option for option in known["options"]}
    raise KeyError(kind)


def kind_for(path):
    """The kind of jobs that writes a file of this ending: "mesh" for part.stl; None where none does."""
    ending = os.path.splitext(path)[1].lower()
    return next((kind["name"] for kind in _core.jobs() if ending in kind["endings"]), None)


def endings():
    """The endings of files that jobs write, sorted: [".3mf", ".amf", ...]."""
    return sorted(ending for kind in _core.jobs() for ending in kind["endings"])


# Options that Python has in another way.
_own = {"design", "define", "emit", "output", "materials"}


def keywords_of(kind):
    return {name: option for name, option in options_of(kind).items() if name not in _own}


def length_text(value):
    """A length in mm as text that says no more digits than the number has; fractions are exact."""
    if isinstance(value, numpy.floating):
        return numpy.format_float_positional(value, trim="-")
    if isinstance(value, (str, int, decimal.Decimal, fractions.Fraction)):
        return str(value)
    return repr(float(value))


def _text(value):
    if isinstance(value, dict):
        return json.dumps(value)
    if isinstance(value, (list, tuple)) or hasattr(value, "tolist") and getattr(value, "ndim", 0) > 0:
        return ",".join(_text(v) for v in value)
    if isinstance(value, (float, numpy.floating)):
        return length_text(value)
    return os.fspath(value) if hasattr(value, "__fspath__") else str(value)


def members_of(kind, options):
    """{name: value} of a job's options: texts, lists of them, or True."""
    known = keywords_of(kind)
    members = {}
    for name, value in options.items():
        if name not in known:
            import difflib
            close = difflib.get_close_matches(name, known, 1)
            hint = f"did you mean {close[0]!r}?" if close else "it has " + ", ".join(sorted(known))
            raise TypeError(f"{kind} has no option {name!r}; {hint}")
        option = known[name]
        if value is None or value is False:
            continue
        if option["takes"] == "nothing":
            if value is not True:
                raise TypeError(f"{name} of {kind} is True or False, not {value!r}")
            members[option["name"]] = True
        elif option["takes"] == "several":
            if isinstance(value, dict):
                value = [f"{key}={_text(v)}" for key, v in value.items()]
            members[option["name"]] = [_text(element) for element in ([value] if isinstance(value, str) else value)]
        else:
            members[option["name"]] = _text(value)
    return members


class Report(dict):
    """The report of a job: the members of its last event, and all `events`."""

    def __init__(self, events):
        last = [e for e in events if e["event"] not in ("progress", "checking", "preparing", "message", "check")]
        super().__init__({k: v for event in last for k, v in event.items() if k != "event"})
        self.events = events


class Progress:
    """Shows the progress of a job: by tqdm if it is installed, by a function of the share that is done, or not at all."""

    def __init__(self, progress):
        self._report = progress if callable(progress) else None
        self._tqdm = self._find_tqdm() if progress is True else None
        self._bar = None
        self._is_plain = progress is True and self._tqdm is None

    @staticmethod
    def _find_tqdm():
        try:
            from tqdm.auto import tqdm
        except ImportError:
            return None
        return tqdm

    def update(self, event):
        """Shows a progress event, which counts voxels or steps."""
        unit = "steps" if "steps_done" in event else "voxels"
        done, total = event[unit + "_done"], event[unit + "_total"]
        if self._report:
            self._report(done / max(total, 1))
        elif self._tqdm is not None:
            if self._bar is None:
                self._bar = self._tqdm(unit=" " + unit, unit_scale=True)
            self._bar.total = total
            self._bar.update(done - self._bar.n)
        elif self._is_plain:
            print(f"\r{100 * done / max(total, 1):3.0f}%", end="", file=sys.stderr, flush=True)

    def close(self, is_complete=True):
        if self._bar is not None:
            if is_complete and self._bar.total:
                self._bar.update(self._bar.total - self._bar.n)
            self._bar.close()
        elif self._is_plain:
            print(file=sys.stderr)


def run(kind, own, options, design=None, progress=None):
    """Runs a job. `own` has members that are not keywords. Returns its report, and its text or bytes.

    Raises DesignError, MachineError, CheckError, KeyboardInterrupt.
    """
    members = {**own, **members_of(kind, options)}
    if design is not None:
        members["design"] = "design"
    events, data = _watched(kind, progress, lambda take: _core.run_job(kind, members, design, take))
    return Report(events), data


def voxel_grids(options, design, progress=None):
    """Returns [(kind of the numbers, array of the shape (z, y, x))] for the options of `ombre voxels`."""
    members = {"design": "design", "output": "memory", **members_of("voxels", options)}
    _, grids = _watched("voxels", progress, lambda take: _core.voxels(members, design, take))
    return [(about, numpy.frombuffer(numbers, dtype=about["data_type"]).reshape(
        [int(n) for n in reversed(about["dimensions"])])) for about, numbers in grids]


def _watched(kind, progress, work):
    """Runs a job; returns its events and its other results."""
    events = []
    shown = Progress(progress)

    def take(event):
        if event["event"] != "progress":
            events.append(event)
        else:
            shown.update(event)
    code = None
    try:
        code, data = work(take)
    finally:
        shown.close(code == 0)
    messages = [e for e in events if e["event"] == "message"]
    if code == 130:
        raise KeyboardInterrupt
    if code:
        raise _error(kind, code, messages, events)
    for message in messages:
        if message["severity"] == "warning":
            warnings.warn(_message_text(message), DesignWarning, stacklevel=4)
    return events, data


def _error(kind, code, messages, events):
    text = "\n".join(_message_text(m) for m in messages if m["severity"] != "warning" or code == 3)
    text = text or f"{kind} failed with code {code}"
    if code in (1, 3):
        error = {1: DesignError, 3: CheckError}[code](text, messages)
    else:
        error = MachineError(text)
        for message in messages:
            if message["severity"] == "error":
                error.code, error.values = message["code"], message["values"]
    if code == 3:
        error.checks = [{k: v for k, v in e.items() if k != "event"} for e in events if e["event"] == "check"]
    return error


def _message_text(message):
    place = f"{message['file']}:{message['line']:.0f}: " if "file" in message else ""
    hint = f"; {message['hint']}" if message.get("hint") else ""
    return place + message["message"] + hint

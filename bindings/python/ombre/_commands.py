"""Jobs: the commands of the command line, with their options as keyword arguments."""
import decimal
import fractions
import functools
import keyword
import os
import sys
import warnings

import numpy

from . import _core
from ._errors import CheckError, DesignError, DesignWarning, MachineError


def _keyword(option):
    """"--layer-height": layer_height; "--from": from_, since Python has the word for itself."""
    name = option.lstrip("-").replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


@functools.lru_cache(maxsize=None)
def options_of(command):
    """{keyword: option} of a command; an option has name, help, type, is_flag and is_list."""
    for known in _core.commands():
        if known["name"] == command:
            return {_keyword(o["name"]): o for o in known["options"] if o["name"].startswith("--")}
    raise KeyError(command)


# What Python has in another way.
_own = {"help", "quiet", "json", "define", "emit", "output", "materials"}


def keywords_of(command):
    return {name: option for name, option in options_of(command).items() if name not in _own}


def length_text(value):
    """A length in mm as text that says no more digits than the number has; fractions are exact."""
    if isinstance(value, numpy.floating):
        return numpy.format_float_positional(value, trim="-")
    if isinstance(value, (str, int, decimal.Decimal, fractions.Fraction)):
        return str(value)
    return repr(float(value))


def _text(value):
    if isinstance(value, (list, tuple)) or hasattr(value, "tolist") and getattr(value, "ndim", 0) > 0:
        return ",".join(_text(v) for v in value)
    if isinstance(value, (float, numpy.floating)):
        return length_text(value)
    return os.fspath(value) if hasattr(value, "__fspath__") else str(value)


def _arguments(command, options):
    known = keywords_of(command)
    arguments = []
    for name, value in options.items():
        if name not in known:
            import difflib
            close = difflib.get_close_matches(name, known, 1)
            hint = f"did you mean {close[0]!r}?" if close else "it has " + ", ".join(sorted(known))
            raise TypeError(f"{command} has no option {name!r}; {hint}")
        option = known[name]
        if value is None or value is False:
            continue
        if option["is_flag"]:
            if value is not True:
                raise TypeError(f"{name} of {command} is True or False, not {value!r}")
            arguments.append(option["name"])
        elif option["is_list"]:
            if isinstance(value, dict):
                value = [f"{key}={_text(v)}" for key, v in value.items()]
            for element in [value] if isinstance(value, str) else value:
                arguments += [f"{option['name']}={_text(element)}"]
        else:
            arguments += [f"{option['name']}={_text(value)}"]
    return arguments


class Report(dict):
    """What a job reported: the members of its last event, and all `events`."""

    def __init__(self, events):
        last = [e for e in events if e["event"] not in ("progress", "checking", "preparing", "message", "check")]
        super().__init__({k: v for event in last for k, v in event.items() if k != "event"})
        self.events = events


class _Progress:
    """Tells how far a job is: by tqdm where it is installed, by a function of the share that is done, or not at all."""

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

    def close(self, is_complete):
        if self._bar is not None:
            if is_complete and self._bar.total:
                self._bar.update(self._bar.total - self._bar.n)
            self._bar.close()
        elif self._is_plain:
            print(file=sys.stderr)


def run(command, arguments, options, design=None, progress=None):
    """Runs a command. Returns its report and what it would have written to stdout.

    Raises DesignError, MachineError, CheckError, KeyboardInterrupt.
    """
    events = []
    shown = _Progress(progress)

    def take(event):
        if event["event"] != "progress":
            events.append(event)
        else:
            shown.update(event)
    words = [command, *([] if design is None else ["design"]), *arguments, *_arguments(command, options)]
    code = None
    try:
        code, data = _core.run_command(words, design, take)
    finally:
        shown.close(code == 0)
    messages = [e for e in events if e["event"] == "message"]
    if code == 130:
        raise KeyboardInterrupt
    if code:
        text = "\n".join(_message_text(m) for m in messages if m["severity"] != "warning" or code == 3)
        text = text or f"{command} failed with code {code}"
        if code in (1, 3):
            error = {1: DesignError, 3: CheckError}[code](text, messages)
        else:
            error = MachineError(text)
            for message in messages:
                if message["severity"] == "error":
                    error.code, error.values = message["code"], message["values"]
        if code == 3:
            error.checks = [{k: v for k, v in e.items() if k != "event"} for e in events if e["event"] == "check"]
        raise error
    for message in messages:
        if message["severity"] == "warning":
            warnings.warn(_message_text(message), DesignWarning, stacklevel=3)
    return Report(events), data


def _message_text(message):
    place = f"{message['file']}:{message['line']:.0f}: " if "file" in message else ""
    hint = f"; {message['hint']}" if message.get("hint") else ""
    return place + message["message"] + hint

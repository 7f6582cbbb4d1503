"""The materials that solids name."""
import contextlib
import contextvars
import os

from . import _core

_default = None
_current = contextvars.ContextVar("ombre_materials", default=None)


class Materials:
    """A table of materials: ids, names, colours and whatever else its file says.

    Args:
        path: a .json file (see the guide), or nothing for the set that comes with Ombre.

    Used as a context, solids made within name its materials:

        with ombre.Materials("mine.json"):
            part = ombre.sphere(5, "agilus")
    """

    def __init__(self, path=None, _factory=None):
        self._factory = _factory or _core.Factory("" if path is None else os.fspath(path))
        self._entries = self._factory.materials

    @property
    def names(self):
        """Names by id; the first is void."""
        return [entry["name"] for entry in self._entries]

    def colour(self, name):
        """(red, green, blue, alpha), 0 to 255."""
        return self[name]["colour"]

    def __getitem__(self, key):
        for entry in self._entries:
            if key == entry["id"] or isinstance(key, str) and key.lower() == entry["name"].lower():
                return entry
        raise KeyError(f"there is no material {key!r}; there are {', '.join(self.names)}")

    def __contains__(self, key):
        try:
            return bool(self[key])
        except KeyError:
            return False

    def __len__(self):
        return len(self._entries)

    def __repr__(self):
        return f"Materials({', '.join(self.names)})"

    def use(self):
        """Solids made from here on name these materials."""
        _current.set(self._factory)
        return self

    def __enter__(self):
        stack = self.__dict__.setdefault("_tokens", [])
        stack.append(_current.set(self._factory))
        return self

    def __exit__(self, *_):
        _current.reset(self._tokens.pop())


def current_factory():
    global _default
    factory = _current.get()
    if factory is None:
        if _default is None:
            _default = _core.Factory("")
        factory = _default
    return factory


@contextlib.contextmanager
def setting(variable, value):
    """Within, the context variable has the value."""
    token = variable.set(value)
    try:
        yield
    finally:
        variable.reset(token)


def using(factory):
    """Within, solids name the materials of the factory."""
    return setting(_current, factory)


def data_folder():
    """The folder that holds the printers and materials that come with Ombre."""
    return _core.data_folder()


def palettes():
    """{name: nine colours from the least number to the greatest}, each red, green and blue from 0 to 255."""
    return _core.palettes()

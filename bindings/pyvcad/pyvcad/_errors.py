"""Exceptions, and how errors are reported."""
import ombre


class WrongValue(ValueError, RuntimeError):
    """An argument of a script is wrong; scripts of pyvcad expect a RuntimeError."""


class WrongDesign(ombre.DesignError, RuntimeError):
    """A node of a script is wrong; scripts of pyvcad expect a RuntimeError."""


class MissingFeature(NotImplementedError):
    """A script asks for what Ombre does not have yet."""


def missing(what: str, instead: str = "") -> MissingFeature:
    hint = f"; {instead}" if instead else ""
    return MissingFeature(f"{what}: Ombre does not have this yet{hint}")

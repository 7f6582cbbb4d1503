"""Exceptions, and how errors are reported."""


class MissingFeature(NotImplementedError):
    """A script asks for what Ombre does not have yet."""


def missing(what: str, instead: str = "") -> MissingFeature:
    hint = f"; {instead}" if instead else ""
    return MissingFeature(f"{what}: Ombre does not have this yet{hint}")

"""Values of attributes at one point."""
from __future__ import annotations

from typing import Any

from ._attributes import ReturnType
from ._vectors import Vec3, Vec4


class AttributeSamples:
    """Values of attributes at one point, by their names."""

    def __init__(self, values: dict[str, Any] | None = None) -> None:
        self._values = dict(values or {})

    def has_sample(self, name: str) -> bool:
        return name in self._values

    def get_sample(self, name: str) -> Any:
        if name not in self._values:
            raise RuntimeError(f"get_sample: there is no sample of {name!r} here")
        return self._values[name]

    def get_type(self, name: str) -> ReturnType:
        value = self.get_sample(name)
        return {Vec3: ReturnType.vec3, Vec4: ReturnType.vec4, dict: ReturnType.vfm_ptr}.get(type(value), ReturnType.dbl)

    def set_sample(self, name: str, value: Any) -> None:
        self._values[name] = value

"""h5py, which reads and writes HDF5 where it is installed."""
from __future__ import annotations

import importlib
from typing import Any


def h5py(what: str) -> Any:
    """The module. Raises ImportError, which says who needs it."""
    try:
        return importlib.import_module("h5py")
    except ImportError:
        raise ImportError(f"{what} needs h5py; install it with: pip install h5py (Debian: apt install python3-h5py)"
                          ) from None

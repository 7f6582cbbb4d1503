"""The older name of pyvcad_rendering."""
from pyvcad_rendering import Export, Render

__all__ = ["Render", "Export"]

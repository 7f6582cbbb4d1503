"""Another place of pyvcad: from libvcad import pyvcad."""
import pyvcad

__all__ = ["pyvcad"]

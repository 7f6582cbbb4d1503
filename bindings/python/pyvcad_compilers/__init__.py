"""Compilers of pyvcad's scripts: objects with compile() and setProgressCallback(f).

A callback gets the share that is done, 0 to 1.
"""
from ._compilers import (CrossSectionSlicer, DirectMaterialCompiler, GrayscaleCompiler, InpWriter, MeshCompiler)

__all__ = ["CrossSectionSlicer", "DirectMaterialCompiler", "GrayscaleCompiler", "InpWriter", "MeshCompiler"]

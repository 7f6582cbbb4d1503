"""Compilers of pyvcad's scripts: objects with compile() and setProgressCallback(f).

A callback gets the share that is done, 0 to 1.
"""
from pyvcad._missing import attribute_of
from pyvcad._texts import version

from ._attribute_compilers import VatCompiler, VdbCompiler
from ._compilers import CrossSectionSlicer, DirectMaterialCompiler, GrayscaleCompiler, MeshCompiler
from ._simulation import (InpWriter, SimulationBackend, SimulationCellType, SimulationCompiler,
                          SimulationCompilerSettings, SimulationHexMeshSettings, SimulationMeshKind, SimulationModel,
                          SimulationTetFixedMeshSettings)
from ._inkjet import (ColorInkjetCompiler, ColorInkjetExportMode, ColorPipeline, ColorPipelineOptions,
                      MaterialInkjetCompiler, MaterialInkjetExportMode)
from ._full_spectrum import FullSpectrumSlicerProjectCompiler
from ._material_vats import MultiMaterialVatCompiler, MultiMaterialVatOutputMode, MultiMaterialVatSystem
from ._myerson import MyersonCompiler
from ._slicer_projects import PrusaSlicerProjectCompiler

__all__ = ["ColorInkjetCompiler", "ColorInkjetExportMode", "ColorPipeline", "ColorPipelineOptions",
           "FullSpectrumSlicerProjectCompiler", "PrusaSlicerProjectCompiler",
           "MaterialInkjetCompiler", "MaterialInkjetExportMode", "MultiMaterialVatCompiler", "MultiMaterialVatOutputMode",
           "MultiMaterialVatSystem", "MyersonCompiler", "VatCompiler", "VdbCompiler",
           "CrossSectionSlicer", "DirectMaterialCompiler", "GrayscaleCompiler", "InpWriter", "MeshCompiler",
           "SimulationBackend", "SimulationCellType", "SimulationCompiler", "SimulationCompilerSettings",
           "SimulationHexMeshSettings", "SimulationMeshKind", "SimulationModel", "SimulationTetFixedMeshSettings", "version"]


def __getattr__(name: str) -> object:
    return attribute_of(__name__, __all__, name)

"""The interface of pyvcad, over Ombre: its scripts run unchanged. docs/user/pyvcad.md says what is different.

    import pyvcad as pv

    materials = pv.default_materials
    root = pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(10, 10, 10), materials.id("red"))
"""
from ._attributes import (Attribute, DefaultAttributes, DerivedFloatAttribute, FloatAttribute, Vec3Attribute,
                          Vec4Attribute, VolumeFractionsAttribute)
from ._bars import CapMode, Cone, PolygonRevolve, Strut
from ._beam_lattices import Ball, BallMode, Beam, BeamLattice
from ._cad import CADFace, CADModel
from ._colour_maps import ColorMap
from ._cell_maps import CellMap, CellMapCollection, TrimMode
from ._converters import (AttributeConverterBase, AttributeModifier, ExpressionConverter, InterpolationMode,
                          LookupTableConverter, LookupTableEntry, ScalarsToVec3Converter, ScalarsToVec4Converter,
                          Vec3ToScalarsConverter, VolumeFractionsExpressionConverter)
from ._enums import FontAspect, HorizontalAlignment, LatticeType, VerticalAlignment
from ._errors import MissingFeature
from ._filters import Blend, BoxKernel, Convolution, Convolve, CustomKernel, Voxels
from ._lattices import MappedGraphLattice, MappedImplicitLattice
from ._materials import MaterialDefs, default_materials, j750_materials, resources_path
from . import _diagrams  # noqa: F401  # gives nodes the method to_diagram
from ._missing import Map, attribute_of
from ._operations import (BBoxIntersection, BBoxUnion, ConformalMap, Difference, FGrade, Identity, Intersection, Mirror,
                          Offset, Rotate, Scale, Shell, Sum, Tile, Translate, Union)
from ._outlines import PolygonExtrude, Text
from ._probes import Probe, alignment_angles, probe_point, probe_ray, surface_normal
from ._reliefs import FunctionalHeightField, ImageHeightField, SurfaceReliefVolume
from ._resolvers import Vec4Mode, resolvers
from ._results import PointMap, SimulationField
from ._sampling import AttributeSamples, TreeSampler
from ._simulation.element_meshes import HexahedralMesh, TetrahedralMesh
from ._simulation.field_datasets import (CoverageFailure, FieldAssociation, FieldCoverage, FieldDomain, FieldMetadata,
                                         UnstructuredFieldDataset)
from ._simulation.simulation_model import SimulationCellType, SimulationModel
from ._simulation.xdmf_loader import XDMFFieldLoader
from ._solids import CAD, Cylinder, Function, GraphLattice, Mesh, RectPrism, SignedDistanceField, Sphere, Torus
from ._selections import MeshSelection
from ._supports import SupportAnalyzer, SupportAnalyzerParallel
from ._surfaces import TriangleMeshSurface
from ._textured_meshes import TexturedMesh
from ._texts import parse_vcad_text, version
from ._tree import Node
from ._triangles import SurfaceMesh
from ._unit_cells import GraphUnitCell, ImplicitUnitCell
from ._vectors import Vec2, Vec3, Vec4
from ._volumes import (DICOMLoader, FloatVolume, PNGColorMode, PNGLoader, Vec2sVolume, Vec3sVolume, Vec4sVolume,
                       vdb_loader)

__version__ = version()

__all__ = ["Attribute", "AttributeConverterBase", "AttributeModifier", "AttributeSamples", "DefaultAttributes",
           "DerivedFloatAttribute", "ExpressionConverter", "FloatAttribute", "InterpolationMode", "LookupTableConverter",
           "LookupTableEntry", "ScalarsToVec3Converter", "ScalarsToVec4Converter", "TreeSampler", "Vec3Attribute",
           "Vec3ToScalarsConverter", "Vec4Attribute", "Vec4Mode", "VolumeFractionsAttribute",
           "VolumeFractionsExpressionConverter", "resolvers", "BBoxIntersection", "Identity",
           "Mirror", "Torus", "CapMode", "Cone", "PolygonRevolve", "SurfaceMesh", "FontAspect", "HorizontalAlignment", "LatticeType", "VerticalAlignment", "MissingFeature", "MaterialDefs",
           "default_materials", "j750_materials", "resources_path", "CAD", "Blend", "BoxKernel", "Convolve", "CustomKernel", "ConformalMap", "Convolution",
           "Map", "Offset", "PointMap", "PolygonExtrude", "Shell", "SimulationField",
           "SupportAnalyzer", "SupportAnalyzerParallel", "Text", "Tile", "Voxels", "BBoxUnion",
           "Difference", "FGrade", "Intersection", "Rotate", "Scale", "Sum", "Translate", "Union", "Cylinder",
           "Function", "GraphLattice", "Mesh", "RectPrism", "Sphere", "Strut", "parse_vcad_text", "version", "Node",
           "Vec2", "Vec3", "Vec4", "DICOMLoader", "FloatVolume", "PNGColorMode", "PNGLoader", "Vec2sVolume",
           "Vec3sVolume", "Vec4sVolume", "vdb_loader", "SignedDistanceField", "CoverageFailure",
           "FieldAssociation", "FieldCoverage", "FieldDomain", "FieldMetadata", "HexahedralMesh", "SimulationCellType", "SimulationModel", "TetrahedralMesh",
           "UnstructuredFieldDataset", "XDMFFieldLoader", "CellMap", "CellMapCollection", "GraphUnitCell", "ImplicitUnitCell",
           "CADFace", "CADModel", "MappedGraphLattice", "MappedImplicitLattice", "MeshSelection", "TriangleMeshSurface", "TrimMode",
           "Ball", "BallMode", "Beam", "BeamLattice", "TexturedMesh", "ColorMap", "Probe", "alignment_angles", "probe_point", "probe_ray", "surface_normal", "FunctionalHeightField", "ImageHeightField", "SurfaceReliefVolume"]


def __getattr__(name: str) -> object:
    return attribute_of(__name__, __all__, name)

"""Helpers for scans in scripts of pyvcad.

    import pyvcad as pv
    import pyvcad_medical as med

    scan = pv.DICOMLoader("scan/")
    med.imaging.print_loaded_dicom_info(scan)
    entries = med.color_maps.create_linear_gradient_hu_map(-200, 800, palette="jet")
"""
from . import color_maps, imaging
from .color_maps import raw_color_palettes

__all__ = ["color_maps", "imaging", "raw_color_palettes"]

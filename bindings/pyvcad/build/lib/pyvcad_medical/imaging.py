"""Prints the contents of scans."""
from __future__ import annotations

from pyvcad import DICOMLoader

__all__ = ["print_loaded_dicom_info"]


def print_loaded_dicom_info(loader: DICOMLoader) -> None:
    """Prints size, lengths and values of a scan, and nothing that tells who the patient is."""
    if not isinstance(loader, DICOMLoader):
        raise TypeError(f"print_loaded_dicom_info: expected a DICOMLoader, found {type(loader).__name__}")
    columns, rows, slices = loader.get_dimensions()
    step = loader.get_voxel_size()
    low, high = loader.get_bounding_box()
    least, greatest = loader.get_min_max_hu()
    print(f"size       {columns} x {rows} x {slices} voxels\n"
          f"voxels     {step.x:g} x {step.y:g} x {step.z:g} mm\n"
          f"box        ({low.x:g}, {low.y:g}, {low.z:g}) to ({high.x:g}, {high.y:g}, {high.z:g}) mm\n"
          f"values     {least:g} to {greatest:g} HU\n"
          f"rescaling  slope {loader.get_rescale_slope():g}, intercept {loader.get_rescale_intercept():g}")

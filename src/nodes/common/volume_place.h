// The position of a grid of numbers from a file in a design.
#pragma once

#include "design/source_loader.h"
#include "design/spec.h"

namespace ombre::nodes {

struct VolumePlace {
  design::FilePath path;
  std::optional<Vec3> spacing, origin;
  design::Choice space = "file";
  std::string series;
  int voxel_channel = -1, phase = 0;
  bool is_regular = false;
  std::optional<double> nan;
  std::shared_ptr<const design::VolumeGrid> grid;  // read when the node is made
  int64_t segment_label = -1;                      // number of the chosen segment, read when the node is made
  Affine here_from_index, index_from_here;

 protected:
  // Reads the file. Returns false and adds diagnostics if that fails or information is missing. `wanted` holds what the
  // node asks for beyond the parameters here, such as a segment.
  bool read_volume(const design::Reader& reader, design::VolumeRequest wanted);
  int channel(const char* name) const;

  // Returns the parameters of T, which must derive from this class.
  template <class T>
  static std::vector<design::Parameter<T>> with_place(std::vector<design::Parameter<T>> others) {
    std::vector<design::Parameter<T>> all{
        {"path", &VolumePlace::path,
         "The file, or a folder of DICOM files or of images; relative to the script, then to the working directory",
         design::required()}};
    for (auto& parameter : others) all.push_back(std::move(parameter));
    all.emplace_back("spacing", &VolumePlace::spacing, "Size of a voxel; none: that of the file",
                     design::unit::positive_mm);
    all.emplace_back("origin", &VolumePlace::origin, "Centre of the first voxel; none: that of the file",
                     design::unit::mm);
    all.emplace_back("space", &VolumePlace::space,
                     "Coordinate system: the file's own; RAS or LPS, if the file states its own; or index, the voxels' "
                     "numbers from 0 along each axis, in mm",
                     design::one_of({"file", "RAS", "LPS", "index"}));
    all.emplace_back("series", &VolumePlace::series,
                     "Number or UID of one of several DICOM series in a folder, or name of one of several grids in a "
                     ".vdb or .vti file");
    all.emplace_back(
        "channel", &VolumePlace::voxel_channel,
        "Index of one of several values per voxel, from 0; -1: the only one, or the length of vectors in a .vdb file",
        design::from_to(-1, 100000));
    all.emplace_back("phase", &VolumePlace::phase,
                     "Number, from 1, of one of several volumes at the same place, such as the times of a scan; 0: the "
                     "only one",
                     design::from_to(0, 100000));
    all.emplace_back("nan", &VolumePlace::nan, "Value in place of NaN (no number) in the file; none: NaN is an error");
    all.emplace_back(
        "regular", &VolumePlace::is_regular,
        "Resamples slices of a scan at uneven distances, or with missing ones, linearly to even distances");
    return all;
  }

 private:
  Affine placed() const;
  bool turn(const design::Reader& reader);
};

}  // namespace ombre::nodes

// The options of `ombre info`.
#pragma once

#include <optional>
#include <string>

#include "options/option.h"

namespace ombre::jobs {

// Choices of what is described. Options have the names of the parameters of volume() and results().
struct InfoChoices {
  std::string file;
  int step = 0;               // number, from 1, of a step of results; 0: the last
  std::string values;         // the table of a deck's values, or the numbers of an .xdmf file; empty: none
  int phase = 0;              // number, from 1, of one of several volumes at the same place; 0: there is one
  std::optional<double> nan;  // in place of NaN in a volume
  bool is_regular = false;    // resamples slices of a scan at uneven distances
  std::string series;         // number or UID of one of several DICOM series, or name of one of several grids
  int channel = -1;           // index of one of several values in each voxel; -1: there is one
  std::string picture;        // file to write; empty: none
  bool as_volume = false;     // takes an image for a volume of one layer
  bool force = false;         // replaces an existing file

  static const options::Spec<InfoChoices>& options() {
    using namespace options;
    static const options::Spec<InfoChoices> spec{
        option("file", &InfoChoices::file, kind::file,
               "A volume: a folder of DICOM files or images, .dcm, .nii, .nrrd, .mha, .vdb, .vti, .tif, .npy, or raw "
               "numbers with a .json beside them; or a design, or a script: .scad; or results: .vtu, .pvd, .vtkhdf, "
               ".xdmf, .frd, .inp; or a mesh, "
               "a CAD file, a drawing, a table or an image",
               "FILE")
            .required(),
        option("--series", &InfoChoices::series, kind::text,
               "Number or UID of one of several DICOM series, or name of one of several grids", "NAME"),
        option("--channel", &InfoChoices::channel, kind::whole,
               "Number of one of several values in each voxel of a volume, counted from 0", "N")
            .between(0, 100000),
        option("--phase", &InfoChoices::phase, kind::whole,
               "Number of one of several volumes at the same place, such as the times of a scan, counted from 1", "N")
            .between(1, 100000),
        option("--nan", &InfoChoices::nan, kind::number, "Value in place of NaN (no number) in a volume", "NUMBER"),
        flag("--regular", &InfoChoices::is_regular,
             "Resample slices of a scan at uneven distances, or with missing ones, to even distances"),
        option("--step", &InfoChoices::step, kind::whole,
               "Number of one of several steps of results, counted from 1; without it the last", "N")
            .between(1, 1000000000),
        option("--values", &InfoChoices::values, kind::file,
               "Table with the values of an .inp file, or file with the numbers of an .xdmf file", "FILE"),
        option("--picture", &InfoChoices::picture, kind::file,
               "Write a picture of a volume to this file: the planes in its middle along x and y, x and z, y and z",
               "FILE"),
        flag("--volume", &InfoChoices::as_volume, "Describe an image as a volume of one layer"),
        flag("--force", &InfoChoices::force, "Replace an existing picture")};
    return spec;
  }
};

}  // namespace ombre::jobs

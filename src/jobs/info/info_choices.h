// The options of `ombre info`.
#pragma once

#include <string>

#include "options/option.h"

namespace ombre::jobs {

struct InfoChoices {
  std::string file;
  std::string series;      // number or UID of one of several DICOM series, or name of one of several grids
  int channel = -1;        // index of one of several values in each voxel; -1: there is one
  std::string picture;     // file to write; empty: none
  bool as_volume = false;  // takes an image for a volume of one layer
  bool force = false;      // replaces an existing file

  static const options::Spec<InfoChoices>& options() {
    using namespace options;
    static const options::Spec<InfoChoices> spec{
        option("file", &InfoChoices::file, kind::file,
               "A volume: a folder of DICOM files or images, .dcm, .nii, .nrrd, .mha, .vdb, .vti, .tif, .npy, or raw "
               "numbers with a .json beside them; or a design, or a script: .scad; or results: .vtu, .xdmf, .frd, "
               ".inp; or a mesh, "
               "a CAD file, a drawing, a table or an image",
               "FILE")
            .required(),
        option("--series", &InfoChoices::series, kind::text,
               "Number or UID of one of several DICOM series, or name of one of several grids", "NAME"),
        option("--channel", &InfoChoices::channel, kind::whole,
               "Number of one of several values in each voxel of a volume, counted from 0", "N")
            .between(0, 100000),
        option("--picture", &InfoChoices::picture, kind::file,
               "Write a picture of a volume to this file: the planes in its middle along x and y, x and z, y and z",
               "FILE"),
        flag("--volume", &InfoChoices::as_volume, "Describe an image as a volume of one layer"),
        flag("--force", &InfoChoices::force, "Replace an existing picture")};
    return spec;
  }
};

}  // namespace ombre::jobs

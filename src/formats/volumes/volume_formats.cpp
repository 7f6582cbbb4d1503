#include "formats/volumes/volume_formats.h"

#include <algorithm>

#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

bool is_nrrd(std::string_view bytes) { return bytes.starts_with("NRRD"); }
bool is_npy(std::string_view bytes) { return bytes.starts_with("\x93NUMPY"); }

// The description of numbers, which need not be there.
std::string description_beside(const std::string& path, std::string_view) { return path + ".json"; }

}  // namespace

std::span<const VolumeFormat> volume_formats() {
  static const std::vector<VolumeFormat> rows{
      {{"NRRD",
        {".nrrd", ".nhdr"},
        Content::volume,
        true,
        true,
        nullptr,
        "bzip2 and hexadecimal numbers; complex numbers and blocks; numbers in several files; spaces with time",
        "axis mins; measurement frames; thicknesses"},
       is_nrrd,
       read_nrrd,
       nrrd_data_path,
       nrrd_segments},
      {{"NumPy array",
        {".npy"},
        Content::volume,
        true,
        true,
        nullptr,
        "records; complex numbers; half floats; arrays of other than 3 or 4 axes"},
       is_npy,
       read_npy,
       description_beside},
      {{"NIfTI",
        {".nii", ".nii.gz", ".hdr"},
        Content::volume,
        true,
        false,
        nullptr,
        "colours; complex numbers; floats of 128 bits",
        "extensions; intents"},
       is_nifti,
       read_nifti,
       nifti_data_path},
      {{"MetaImage",
        {".mha", ".mhd"},
        Content::volume,
        true,
        false,
        nullptr,
        "numbers as text or in several files; objects other than images",
        "centres of rotation; anatomical orientations"},
       is_metaimage,
       read_metaimage,
       metaimage_data_path},
      {{"VTK image data",
        {".vti"},
        Content::volume,
        true,
        true,
        nullptr,
        "several pieces",
        "time; field data; arrays that are not chosen"},
       is_vti,
       read_vti},
      {{"raw numbers", {".raw"}, Content::volume, true, true}, nullptr, nullptr, description_beside},
  };
  return rows;
}

const VolumeFormat& format_of_volume(std::string_view bytes) {
  const auto rows = volume_formats();
  const auto found =
      std::ranges::find_if(rows, [&](const VolumeFormat& row) { return row.recognises && row.recognises(bytes); });
  return found == rows.end() ? rows.back() : *found;
}

}  // namespace ombre::formats

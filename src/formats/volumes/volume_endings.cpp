#include "formats/volumes/volume_endings.h"

#include <algorithm>
#include <string_view>

#include "base/text/text.h"

namespace ombre::formats {

bool has_volume_ending(const std::string& name) {
  constexpr std::string_view endings[] = {".nrrd", ".nhdr", ".nii", ".nii.gz", ".hdr", ".mha", ".mhd",
                                          ".vti",  ".vdb",  ".npy", ".raw",    ".dcm", ".tif", ".tiff"};
  const std::string lower = to_lower(name);
  return std::ranges::any_of(endings, [&](std::string_view ending) { return lower.ends_with(ending); });
}

}  // namespace ombre::formats

#include "base/text/file_ending.h"

#include "base/text/text.h"

namespace ombre {

std::string ending_of(const std::filesystem::path& path) { return to_lower(path.extension().string()); }

}  // namespace ombre

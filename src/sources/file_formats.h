// All formats of files that designs read or jobs write.
#pragma once

#include <string>
#include <vector>

#include "base/system/file_format.h"

namespace ombre::sources {

// Returns the formats, sorted by content.
const std::vector<FileFormat>& file_formats();

// True if a file of this name holds that, and is read.
bool is_read_as(const std::string& path, Content content);

}  // namespace ombre::sources

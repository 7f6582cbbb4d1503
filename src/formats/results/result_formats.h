// The formats of results and of meshes of elements: one table, whose rows are compared with a file's content.
#pragma once

#include <span>

#include "base/system/file_format.h"
#include "formats/results/results.h"

namespace ombre::formats {

struct ResultFormat {
  FileFormat file;
  bool has_elements = true;  // else points alone
  // `text` is the beginning of the file, without blanks.
  bool (*recognises)(std::string_view text) = nullptr;
  // Formats that have no second file refuse one. Throws DesignError, and diagnostics say why.
  Results (*read)(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                  Diagnostics& diagnostics) = nullptr;
  // Returns the names of other files, for formats that have them.
  std::vector<std::string> (*named)(std::string_view bytes, uint64_t step) = nullptr;
  bool names_beside_itself = false;  // names begin in the folder of the file that has them; else in that of the first
};

// A file that no other row recognises is read as the last one, a table of points.
std::span<const ResultFormat> result_formats();

}  // namespace ombre::formats

// Writes grids of several arrays as one file of VTK image data, layers in any order.
#pragma once

#include <string>
#include <string_view>

#include "export/output_file.h"
#include "formats/volumes/vti.h"

namespace ombre::exporting {

// A file that appears under its name when it is committed, and is removed otherwise. All functions throw Error.
class VtiFile {
 public:
  VtiFile(const std::string& path, formats::VtiGrid grid);

  // Writes numbers of an array from a layer on, as they are stored in memory.
  void write(size_t array, int64_t first_layer, std::string_view numbers);
  void close();
  void commit() { file_.commit(); }
  uint64_t bytes_written() const;

 private:
  formats::VtiGrid grid_;
  std::string header_;
  NewFile file_;
};

}  // namespace ombre::exporting

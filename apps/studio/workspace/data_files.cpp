#include "studio/workspace/data_files.h"

#include <array>

#include "base/text/file_ending.h"
#include "sources/file_formats.h"

namespace ombre::studio {

namespace fs = std::filesystem;

DataKind data_kind(const std::string& name) {
  if (sources::is_read_as(name, Content::volume)) return DataKind::scan;
  if (sources::is_read_as(name, Content::results)) return DataKind::results;
  if (sources::is_read_as(name, Content::table)) return DataKind::table;
  const bool is_model = sources::is_read_as(name, Content::mesh) || sources::is_read_as(name, Content::cad);
  return is_model ? DataKind::model : DataKind::none;
}

std::string_view name_of(DataKind kind) {
  constexpr std::array<std::string_view, 5> names{"", "scan", "results", "table", "model"};
  return names[static_cast<size_t>(kind)];
}

bool is_dicom_folder(const fs::path& folder) {
  constexpr int most_entries = 64;  // enough to detect a folder of DICOM files
  std::error_code error;
  int seen = 0;
  for (const fs::directory_iterator end; const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (ending_of(entry.path()) == ".dcm") return true;
    if (++seen >= most_entries) break;
  }
  return false;
}

}  // namespace ombre::studio

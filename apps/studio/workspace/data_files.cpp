#include "studio/workspace/data_files.h"

#include <algorithm>
#include <array>

#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "formats/volumes/volume_endings.h"

namespace ombre::studio {

namespace fs = std::filesystem;

DataKind data_kind(const std::string& name) {
  const std::string lower = to_lower(name);
  const auto ends_in_one_of = [&](const auto& endings) {
    return std::ranges::any_of(endings, [&](std::string_view ending) { return lower.ends_with(ending); });
  };
  constexpr std::array<std::string_view, 3> results{".vtu", ".xdmf", ".frd"};
  constexpr std::array<std::string_view, 1> tables{".csv"};
  if (formats::has_volume_ending(name)) return DataKind::scan;
  if (ends_in_one_of(results)) return DataKind::results;
  return ends_in_one_of(tables) ? DataKind::table : DataKind::none;
}

std::string_view name_of(DataKind kind) {
  constexpr std::array<std::string_view, 4> names{"", "scan", "results", "table"};
  return names[static_cast<size_t>(kind)];
}

bool is_dicom_folder(const fs::path& folder) {
  constexpr int most_entries = 64;  // number of entries after which the search for .dcm files ends
  std::error_code error;
  int seen = 0;
  for (const fs::directory_iterator end; const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (ending_of(entry.path()) == ".dcm") return true;
    if (++seen >= most_entries) break;
  }
  return false;
}

}  // namespace ombre::studio

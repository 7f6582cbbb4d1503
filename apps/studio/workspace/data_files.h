// Recognises files beside designs that the studio shows: scans, results of simulations, tables of numbers.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ombre::studio {

enum class DataKind : uint8_t { none, scan, results, table };

// Returns the kind of a file by the ending of its name. A folder of DICOM files is a scan too, but its name does not
// show it.
DataKind data_kind(const std::string& name);
// Returns "scan", "results" or "table", as requests have it; empty for none.
std::string_view name_of(DataKind kind);
// True if the folder holds a file that ends in .dcm.
bool is_dicom_folder(const std::filesystem::path& folder);

}  // namespace ombre::studio

// Files beside designs that the studio shows: scans, results of simulations, tables of numbers.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ombre::studio {

enum class DataKind : uint8_t { none, scan, results, table };

// By the ending of the name. A folder of DICOM files is a scan too, whose name does not say so.
DataKind data_kind(const std::string& name);
std::string_view name_of(DataKind kind);  // "scan", "results", "table"; empty: none
// Does the folder hold a file that ends in .dcm?
bool is_dicom_folder(const std::filesystem::path& folder);

// A script for `.vcad` that shows the file: its name there is `name`, and it lies at `path`. Of a scan, the solid from
// a level on; of results, the mesh with an attribute for each number, moved by its displacement. Throws Error for a
// file that cannot be read.
std::string script_for_scan(const std::string& name, const std::filesystem::path& path);
std::string script_for_results(const std::string& name, const std::filesystem::path& path);

}  // namespace ombre::studio

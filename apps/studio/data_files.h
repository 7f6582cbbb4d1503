// Files beside designs that the studio shows: scans, results of simulations, tables of numbers.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ombre::studio {

enum class DataKind : uint8_t { none, scan, results, table };

// Tells the kind of a file by the ending of its name. A folder of DICOM files is a scan too, but its name does not say
// so.
DataKind data_kind(const std::string& name);
// Returns "scan", "results" or "table", as requests have it; empty for none.
std::string_view name_of(DataKind kind);
// Returns whether the folder holds a file that ends in .dcm.
bool is_dicom_folder(const std::filesystem::path& folder);

// Each writes a `.vcad` script that shows the file, which the script calls `name` and which lies at `path`. The script
// for a scan shows the solid that has at least a level; the script for results shows the mesh, moved by its
// displacement, with an attribute for each number. They throw Error for a file that cannot be read.
std::string script_for_scan(const std::string& name, const std::filesystem::path& path);
std::string script_for_results(const std::string& name, const std::filesystem::path& path);

}  // namespace ombre::studio

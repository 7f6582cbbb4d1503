// Files beside designs that the studio shows: scans, results of simulations, tables of numbers, models.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ombre::studio {

// A model is a mesh or a CAD file.
enum class DataKind : uint8_t { none, scan, results, table, model };

// Returns the kind of a file by the ending of its name. A folder of DICOM files is a scan too, but cannot be detected
// by its name.
DataKind data_kind(const std::string& name);
// Returns the name used in requests: "scan", "results", "table" or "model"; empty for none.
std::string_view name_of(DataKind kind);
// Returns true if the folder contains a file that ends in .dcm.
bool is_dicom_folder(const std::filesystem::path& folder);

}  // namespace ombre::studio

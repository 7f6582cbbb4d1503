// Settings in .sl1 archives, from which vat printers read the layers of a job: as PrusaSlicer 2.5 writes them.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jobs/slice/slice_request.h"

namespace ombre::compile {

inline constexpr const char* sl1_ending = ".sl1";

// Adds a diagnostic for each reason why the archive cannot hold the layers of the job.
void check_sl1(const SliceRequest& request, const SourceRange& where, Diagnostics& diagnostics);

// Returns names and texts of the settings. `resin_mm3` is what the layers hold.
std::vector<std::pair<std::string, std::string>> sl1_files(const SliceRequest& request, double resin_mm3);
bool is_sl1_file(std::string_view name);

}  // namespace ombre::compile

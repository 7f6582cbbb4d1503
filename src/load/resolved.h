// Resolves properties that a design asks for into what a process needs: fractions of materials, or settings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "load/loaded.h"
#include "load/resolved_step.h"

namespace ombre::compile {

// Names of the calibrations of a job. Those that are chosen replace all others.
struct CalibrationNames {
  std::vector<std::string> chosen;       // names or paths, as options give them
  std::vector<std::string> listed = {};  // names or paths that the printer's profile and the materials file list
};

// Returns the calibrations that are chosen, or else those that are listed, each once. Returns nothing, and adds
// diagnostics, if one is unknown or wrong.
std::optional<std::vector<calibration::CalibrationPtr>> load_calibrations(const CalibrationNames& names,
                                                                          Diagnostics& diagnostics);

// Returns a step for job.json: names, citation, reach.
Data describe(const ResolvedStep& step);

struct Resolution {
  LoadedPtr loaded;  // the design with all that the steps give; values out of reach give the nearest that is reached
  std::vector<ResolvedStep> steps;
  std::vector<std::string> unusable;  // calibrations whose materials the design lacks, a sentence each
};

// True if solids of the design have other materials than that of solids without one.
bool names_materials(const design::Design& design);
// Returns the names of the design's attributes that are numbers, and "fractions" if it names materials.
std::vector<std::string> given_quantities(const design::Design& design);

enum class Unresolved : uint8_t { is_left, is_error };
// Resolves each of the needs, attributes or "fractions", that the design does not give itself. Needs to which no
// calibration leads are left, or are an error. Returns nothing, and adds diagnostics, if something is wrong, or several
// chains are equally short.
std::optional<Resolution> resolve(const LoadedPtr& loaded, const std::vector<calibration::CalibrationPtr>& calibrations,
                                  const std::vector<std::string>& needs, Unresolved unresolved,
                                  Diagnostics& diagnostics);

// Returns the name in the design's materials of the first of these, or nothing if it has none of them.
std::optional<std::string> material_among(const design::MaterialTable& table, const std::vector<std::string>& names);

}  // namespace ombre::compile

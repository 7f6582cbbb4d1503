// Resolves properties that a design asks for into what a process needs: fractions of materials, or settings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "load/loaded.h"
#include "load/resolved_step.h"
#include "voxel/printer.h"

namespace ombre::compile {

// Names of the calibrations of a job. Those that are chosen replace all others.
struct CalibrationNames {
  std::vector<std::string> chosen;       // names or paths, as options give them
  std::vector<std::string> listed = {};  // names or paths that the printer's profile or the materials file lists
};

// Returns the calibrations that are chosen, or else those that are listed, each once. Returns nothing, and adds
// diagnostics, if one is unknown or wrong.
std::optional<std::vector<calibration::CalibrationPtr>> load_calibrations(const CalibrationNames& names,
                                                                          Diagnostics& diagnostics);

// Returns a step for job.json: names, citation, reach.
Data describe(const ResolvedStep& step);
Data describe(const voxel::ValueStep& rounded);

struct Resolution {
  LoadedPtr loaded;  // the design with all that the steps give; values out of reach give the nearest that is reached
  std::vector<ResolvedStep> steps = {};
  std::vector<std::string> unusable = {};      // calibrations whose materials the design lacks, a sentence each
  std::vector<ResolvedStep> agreeing = {};     // steps from other attributes, which lead to the same
  std::vector<voxel::ValueStep> rounded = {};  // attributes of the design itself that the machine rounds
};

// True if solids of the design have other materials than that of solids without one.
bool names_materials(const design::Design& design);
// Returns the names of the design's attributes that are numbers, and "fractions" if it names materials.
std::vector<std::string> given_quantities(const design::Design& design);

enum class Unresolved : uint8_t { is_left, is_error };
// The process needs this of a design.
struct Needs {
  std::vector<std::string> needs;                // attributes or "fractions"
  std::vector<voxel::ValueStep> steps = {};      // what the machine rounds them to
  std::vector<std::string> deciding = {};        // attributes that chains begin with; empty: all
  Unresolved unresolved = Unresolved::is_error;  // needs to which no calibration leads
};

// Resolves each of the needs that the design does not give itself. Equally short chains are an error, with two
// exceptions: a colour by inks goes together with the share of one other material, and chains from different attributes
// may agree all over the part, within agreement_tolerance of the whole. Returns nothing, and adds diagnostics, if
// something is wrong.
std::optional<Resolution> resolve(const LoadedPtr& loaded, const std::vector<calibration::CalibrationPtr>& calibrations,
                                  const Needs& needs, Diagnostics& diagnostics);

inline constexpr double agreement_tolerance = 1e-3;

// Returns the name in the design's materials of the first of these, or nothing if it has none of them.
std::optional<std::string> material_among(const design::MaterialTable& table, const std::vector<std::string>& names);

}  // namespace ombre::compile

// Options that several kinds of jobs have: which design, on which voxels, in which images, with what of the machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compile/load.h"
#include "compile/sampling_rules.h"

namespace ombre::compile {

// Which design, and with what it is read.
struct DesignOptions {
  std::string design, materials;
  std::vector<std::string> definitions;
  std::optional<Vec3> rotate = {};  // degrees about x, then y, then z

  static const options::Spec<DesignOptions>& options();
};

// Which voxels.
struct SamplingOptions {
  std::string printer;  // a name or a path; empty: the generic one
  std::optional<options::Pitches> voxel, dpi;
  std::optional<Pitch> layer_height;
  SamplingRules rules;
  std::optional<voxel::Placement> place;
  bool tray = false;

  static const options::Spec<SamplingOptions>& options();
};

// Which images of them.
struct ImageOptions {
  std::optional<ImageFormat> format;
  std::string by;  // empty: images show materials
  std::optional<Interval> range;
  std::string bits = "8";

  static const options::Spec<ImageOptions>& options();
};

inline constexpr size_t usual_memory = size_t{2} << 30;

// How much of the machine a job may take, which decides no result.
struct WorkOptions {
  int threads = 0;  // 0: all cores
  size_t memory_bytes = usual_memory;

  // `memory` says what the memory is for, with a full stop left out.
  static options::Spec<WorkOptions> options(const std::string& memory);
  static options::Row<WorkOptions> threads_option();
};

// Nothing, and diagnostics, when there is no such printer. Throws options::WrongValue for what does not go together.
// `program` is for job.json: "ombre 0.1.0".
std::optional<PlanOptions> plan_options(const std::string& program, const SamplingOptions& sampling,
                                        const ImageOptions& images, Diagnostics& diagnostics);

}  // namespace ombre::compile

// The options by which plan_slice samples and draws a design.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "base/math/pitch.h"
#include "base/system/progress.h"
#include "design/sub_design_memory.h"
#include "jobs/common/sampling_rules.h"
#include "load/resolved.h"
#include "voxel/printer.h"

namespace ombre::compile {

struct ValueChoice {
  std::string of;  // a material, for its fraction, or an attribute
  // Values of black and white; nothing: the least and the greatest value inside, for a fraction or a mask 0 and 1.
  std::optional<Interval> range;
  int bits = 8;     // bits of a number: 8, 16, or 1 for a mask
  int samples = 0;  // above 0: no value, but the share of so many by so many points of a voxel that lie inside
};

// How a job resolves properties that the design asks for.
struct Resolving {
  CalibrationNames calibrations;
  std::vector<std::string> deciding = {};  // attributes that chains begin with; empty: all
  bool takes_nearest = false;  // values out of reach give the nearest that is reached; otherwise they are an error
};

struct PlanOptions : SamplingRules {
  std::string program;                        // "ombre 0.1.0", for job.json
  voxel::Printer printer;                     // gives the conventions of images
  bool printer_given = false;                 // if true, its pitch takes precedence over the design's own
  std::array<std::optional<Pitch>, 3> pitch;  // takes precedence over both, axis by axis
  voxel::EvaluatorOptions speed;              // how the evaluator works, but not which evaluator it is
  std::optional<ImageFormat> image;           // default: the printer's
  std::optional<voxel::Placement> place;      // default: the printer's; center: the build plate, the part in its middle
  bool whole_tray = false;                    // the build plate, the part where the design has it
  bool finds_short_periods = false;           // looks for formulas that repeat faster than voxels show
  int threads = 0;                            // threads that read the design; 0: all cores
  size_t memory_bytes = size_t{2} << 30;      // memory of the job
  const StopFlag* stop = nullptr;             // must live as long as the plan
  Progress* progress = nullptr;               // progress of planning, if that takes long
  // Memory that keeps values of stages that are computed as a whole, for other jobs; null: values are not kept. It must
  // outlive the plan.
  design::SubDesignMemory* memory = nullptr;
  std::optional<ValueChoice> value;    // shows this value instead of materials
  std::optional<Resolving> resolving;  // nothing: the design's materials and attributes are taken as they are
};

}  // namespace ombre::compile

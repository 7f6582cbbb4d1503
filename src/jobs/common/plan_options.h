// What decides how a design is sampled and drawn, as plan_slice takes it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/math/interval.h"
#include "base/math/pitch.h"
#include "base/system/progress.h"
#include "design/sub_design_memory.h"
#include "jobs/common/sampling_rules.h"
#include "voxel/printer.h"

namespace ombre::compile {

struct ValueChoice {
  std::string of;  // a material, for its fraction, or an attribute
  std::optional<Interval>
      range;     // from black to white; nothing: from the least to the greatest inside, of a fraction 0-1
  int bits = 8;  // of a pixel: 8 or 16
};

struct PlanOptions : SamplingRules {
  std::string program;                        // "ombre 0.1.0", for job.json
  voxel::Printer printer;                     // whose conventions hold
  bool printer_given = false;                 // then its pitch goes before the design's own
  std::array<std::optional<Pitch>, 3> pitch;  // goes before both, axis by axis
  voxel::EvaluatorOptions speed;              // how the evaluator works, but for which it is
  std::optional<ImageFormat> image;           // else the printer's
  std::optional<voxel::Placement> place;      // else the printer's; center: the build plate, the part in its middle
  bool whole_tray = false;                    // the build plate, the part where the design has it
  int threads = 0;                            // that read the design; 0: all cores
  size_t memory_bytes = size_t{2} << 30;      // of the job
  const StopFlag* stop = nullptr;             // must live as long as the plan
  Progress* progress = nullptr;               // of planning, where that takes long
  // Where stages that are computed as a whole keep their values for other jobs; null: nowhere. Must live as long, too.
  design::SubDesignMemory* memory = nullptr;
  std::optional<ValueChoice> value;  // shades of gray by this in place of materials
};

}  // namespace ombre::compile

// From a design file and the options of a command line to a slice request and its layers.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/error.h"
#include "base/pitch.h"
#include "compile/job_stages.h"
#include "compile/loaded.h"
#include "compile/slice_request.h"
#include "compile/value_layers.h"
#include "voxel/printer.h"

namespace ombre::compile {

// Null, and diagnostics, when the design is wrong. Throws Error for files that cannot be read.
LoadedPtr load_design(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics);

// The same of a design that is no file. `path` is the one that it would have: its ending says the language, and
// relative paths in the design begin in its folder.
LoadedPtr load_text(std::string text, const std::string& path, const LoadOptions& options, Diagnostics& diagnostics);

// The materials file at `path`, or the default set when it is empty.
std::optional<design::MaterialTable> load_materials(const std::string& path, Diagnostics& diagnostics);

// One intermediate form as text: "ast", "tree", "program", "stats", "json", "passes" for a table of the passes that a
// program goes through before it slices, or "program=after-NAME" for what one of them made.
const std::vector<std::string>& emit_forms();
std::string emit(const Loaded& loaded, const std::string& form);

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

struct Plan {
  SliceRequest request;
  RegionProducer regions;
  RegionProducer samples;  // what `regions` gives, or voxels that are as much work and do not need whole layers
  LayerProducer producer;  // of whole layers, by `regions`
  JobStagesPtr stages;     // to be prepared before layers are made
};

// Nothing, and diagnostics, when the design cannot be sliced so (does not fit, too many materials).
std::optional<Plan> plan_slice(const LoadedPtr& loaded, const PlanOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::compile

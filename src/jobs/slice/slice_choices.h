// The options of slice jobs, and of a single layer of one.
#pragma once

#include <optional>
#include <string>

#include "jobs/check/emit.h"
#include "jobs/common/calibration_options.h"
#include "jobs/common/job_options.h"
#include "jobs/common/shard_option.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

struct SliceChoices {
  DesignOptions design;
  SamplingOptions sampling;
  ImageOptions images;
  CalibrationOptions calibrations;
  std::string folder, layers;
  std::optional<Box> box;
  std::optional<stores::Shard> shard;
  WorkOptions work;
  bool force = false, resume = false, dry_run = false, strict = false, unchecked = false;
  std::string emit;

  static const options::Spec<SliceChoices>& options() {
    using namespace options;
    static const options::Spec<SliceChoices> spec{
        group(&SliceChoices::design, &SliceChoices::sampling, &SliceChoices::images, &SliceChoices::calibrations),
        option(
            "-o,--output", &SliceChoices::folder, kind::file,
            "Folder for the layers, or a .zip archive of them (default: a folder with the design's name and _slices)",
            "DIR"),
        option("--layers", &SliceChoices::layers, kind::text,
               "Write only these layers: a:b as in Python (b excluded), a:, :b or a", "A:B"),
        option("--box", &SliceChoices::box, kind::box,
               "Write only the voxels that touch this box; mm. Their materials and the names of their layers are\n"
               "those of the whole job",
               "X0,Y0,Z0,X1,Y1,Z1")
            .excludes({"--layers"}),
        option("--shard", &SliceChoices::shard, shard_kind,
               "Write only this share of the layers, for example 3/40, beside processes that write the others. With\n"
               "--resume instead, the shares are joined, and what is missing is written",
               "N/COUNT")
            .excludes({"--force", "--resume"}),
        group(&SliceChoices::work,
              WorkOptions::options("Most memory for layers in flight, with their images and what evaluating them takes "
                                   "(default 2G)")),
        flag("--force", &SliceChoices::force, "Replace the job in the folder, or write beside other files; those stay"),
        flag("--resume", &SliceChoices::resume, "Continue the job in the folder").excludes({"--force"}),
        flag("--dry-run", &SliceChoices::dry_run,
             "Estimate time and memory of the job from a few layers, and write nothing"),
        flag("--strict", &SliceChoices::strict, "End with exit code 3 as soon as a check fails"),
        flag("--unchecked", &SliceChoices::unchecked,
             "Leave out the quick look before the job, which warns of formulas that repeat faster than voxels show\n"
             "and of materials that may not be neighbours"),
        choice("--emit", &SliceChoices::emit, emit_forms(), "Print an intermediate form to stdout, and slice nothing",
               "FORM")};
    return spec;
  }
  // Returns the folder that was chosen, or one that has the design's name.
  std::string output_folder() const;
  FolderUse folder_use() const;
};

// Returns the layers that a value of --layers selects; nothing if it is empty. Throws options::WrongValue if it selects
// none.
std::optional<LayerRange> chosen_layers(const std::string& wanted, int64_t count);

// Returns the options for the plan of the same choices. Throws options::WrongValue when the layers are not among the
// plan's.
SliceOptions slice_options(const SliceChoices& choices, const Plan& plan);

struct LayerChoices {
  DesignOptions design;
  SamplingOptions sampling;
  ImageOptions images;
  CalibrationOptions calibrations;
  std::string output, index;
  std::optional<double> z_mm;
  std::optional<Box> box;
  WorkOptions work;
  bool force = false;

  static const options::Spec<LayerChoices>& options() {
    using namespace options;
    static const options::Spec<LayerChoices> spec{
        group(&LayerChoices::design, &LayerChoices::sampling, &LayerChoices::images, &LayerChoices::calibrations),
        option("-o,--output", &LayerChoices::output, kind::file,
               "The image to write, - for stdout (default: the names of the design and of the layer's file)", "FILE"),
        option("--z", &LayerChoices::z_mm, kind::height, "The layer at this height of the design; mm", "MM"),
        option("--index", &LayerChoices::index, kind::text, "The layer of this number: 0 is the lowest, -1 the highest",
               "N")
            .excludes({"--z"}),
        option("--box", &LayerChoices::box, kind::rectangle, "Only the pixels that touch this box; mm", "X0,Y0,X1,Y1"),
        group(&LayerChoices::work,
              WorkOptions::options("Most memory for the layer, its image and stages (default 2G)")),
        flag("--force", &LayerChoices::force, "Replace an existing image")};
    return spec;
  }
};

}  // namespace ombre::compile

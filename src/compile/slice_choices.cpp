#include "compile/slice_choices.h"

#include <filesystem>

#include "base/text.h"

namespace ombre::compile {

using options::choice;
using options::flag;
using options::group;
using options::option;
namespace kind = options::kind;

const options::Spec<SliceChoices>& SliceChoices::options() {
  static const options::Spec<SliceChoices> spec{
      group(&SliceChoices::design),
      group(&SliceChoices::sampling),
      group(&SliceChoices::images),
      option("-o,--output", &SliceChoices::folder, kind::file,
             "Folder for the layers (default: the design's name and _slices)", "DIR"),
      option("--layers", &SliceChoices::layers, kind::text,
             "Only these layers, a:b as in Python (b excluded), a:, :b or a", "A:B"),
      group(&SliceChoices::work,
            WorkOptions::options("Most memory for layers in flight, with their images and what evaluating them takes "
                                 "(default 2G)")),
      flag("--force", &SliceChoices::force, "Replace the job in the folder, or write beside other files; those stay"),
      flag("--resume", &SliceChoices::resume, "Continue the job in the folder").excludes({"--force"}),
      flag("--dry-run", &SliceChoices::dry_run, "Say what the job would take, from a few layers; write nothing"),
      flag("--strict", &SliceChoices::strict, "End with exit code 3 as soon as a check fails"),
      choice("--emit", &SliceChoices::emit, emit_forms(), "Print an intermediate form to stdout, and slice nothing",
             "FORM")};
  return spec;
}

std::string SliceChoices::output_folder() const {
  return folder.empty() ? std::filesystem::path(design.design).stem().string() + "_slices" : folder;
}

SliceOptions slice_options(const SliceChoices& choices, const Plan& plan) {
  SliceOptions options;
  options.folder = choices.output_folder();
  if (choices.force) options.use = FolderUse::replace;
  if (choices.resume) options.use = FolderUse::resume;
  options.threads = choices.work.threads;
  options.memory_bytes = choices.work.memory_bytes;
  options.strict = choices.strict;
  options.stages = plan.stages;
  if (choices.layers.empty()) return options;
  const int64_t count = plan.request.lattice.count[2];
  options.layers = parse_layer_range(choices.layers, count);
  if (!options.layers)
    throw options::WrongValue("--layers " + choices.layers + " selects none of the " +
                              format_count(static_cast<unsigned long long>(count)) +
                              " layers, which are 0:" + std::to_string(count) + "; write for example --layers 0:10");
  return options;
}

const options::Spec<LayerChoices>& LayerChoices::options() {
  static const options::Spec<LayerChoices> spec{
      group(&LayerChoices::design),
      group(&LayerChoices::sampling),
      group(&LayerChoices::images),
      option("-o,--output", &LayerChoices::output, kind::file,
             "The image to write, - for stdout (default: the names of the design and of the layer's file)", "FILE"),
      option("--z", &LayerChoices::z_mm, kind::height, "The layer at this height of the design; mm", "MM"),
      option("--index", &LayerChoices::index, kind::text, "The layer of this number: 0 is the lowest, -1 the highest",
             "N")
          .excludes({"--z"}),
      option("--box", &LayerChoices::box, kind::rectangle, "Only the pixels that touch this box; mm", "X0,Y0,X1,Y1"),
      group(&LayerChoices::work, WorkOptions::options("Most memory for the layer, its image and stages (default 2G)")),
      flag("--force", &LayerChoices::force, "Replace the image if it is there")};
  return spec;
}

}  // namespace ombre::compile

#include "compile/job_options.h"

#include "compile/find_printer.h"

namespace ombre::compile {

using options::choice;
using options::flag;
using options::group;
using options::option;
namespace kind = options::kind;

const options::Spec<SamplingRules>& SamplingRules::options() {
  static const options::Spec<SamplingRules> spec{
      choice("--dither", &SamplingRules::dither, voxel::dither_names(),
             "How a mixture becomes one material a voxel: stochastic (default), blue-noise, diffusion or threshold",
             "MODE"),
      choice("--evaluator", &SamplingRules::evaluator, voxel::evaluator_names(),
             "Who computes values: batch (default, floats, fast) or reference (double precision, slow)", "NAME"),
      option("--seed", &SamplingRules::seed, kind::seed,
             "Seed of the dithering (default 0); equal seeds give equal files", "N")};
  return spec;
}

const options::Spec<DesignOptions>& DesignOptions::options() {
  static const options::Spec<DesignOptions> spec{
      option("design", &DesignOptions::design, kind::file, "The design: a .vcad, .scad, .json, .ombre or .py file",
             "FILE")
          .required(),
      option("--materials", &DesignOptions::materials, kind::file, "Materials file (see: ombre materials)", "FILE"),
      options::list("-D,--define", &DesignOptions::definitions, kind::text,
                    "Set a variable of the design; may be repeated", "NAME=VALUE"),
      option("--rotate", &DesignOptions::rotate, kind::angles, "Turn the design about x, then y, then z; degrees",
             "X,Y,Z")};
  return spec;
}

const options::Spec<SamplingOptions>& SamplingOptions::options() {
  static const options::Spec<SamplingOptions> spec{
      option("--printer", &SamplingOptions::printer, kind::text, "Printer profile: a name, or the path of a .json file",
             "NAME"),
      option("--voxel", &SamplingOptions::voxel, kind::voxel, "Voxel size: one length, or x,y,z; mm", "X,Y,Z"),
      option("--dpi", &SamplingOptions::dpi, kind::dpi, "Resolution in dots per inch: x and y alike, x,y or x,y,z",
             "X,Y")
          .excludes({"--voxel"}),
      option("--layer-height", &SamplingOptions::layer_height, kind::layer_height, "Voxel size along z; mm", "MM"),
      group(&SamplingOptions::rules),
      choice("--place", &SamplingOptions::place, voxel::placement_names(),
             "Layers cover the design's own box, or the build plate with the part in its middle", "design|center"),
      flag("--tray", &SamplingOptions::tray, "Layers cover the printer's whole build box, the design where it stands")
          .excludes({"--place"})};
  return spec;
}

const options::Spec<ImageOptions>& ImageOptions::options() {
  static const options::Spec<ImageOptions> spec{
      choice("--format", &ImageOptions::format, voxel::image_format_names(),
             "Image format: rgba, indexed, gray or mask (default: the printer's)", "FORMAT"),
      option("--by,--gray,--grey", &ImageOptions::by, kind::text,
             "Images in shades of gray by an attribute or a material's fraction, black outside, in place of\n"
             "materials",
             "NAME"),
      option("--range", &ImageOptions::range, kind::range,
             "The values that are black and white (default: those of the design)", "LO,HI")
          .needs("--by"),
      choice("--bits", &ImageOptions::bits, {"8", "16"}, "Of a gray pixel: 8 (default, 256 shades) or 16 (65,536)",
             "8|16")
          .needs("--by")};
  return spec;
}

options::Row<WorkOptions> WorkOptions::threads_option() {
  return option("--threads", &WorkOptions::threads, kind::whole, "Threads (default: all cores); never changes a result",
                "N")
      .between(1, 1024);
}

options::Spec<WorkOptions> WorkOptions::options(const std::string& memory) {
  return {threads_option(), option("--memory", &WorkOptions::memory_bytes, kind::memory, memory, "SIZE")};
}

std::optional<PlanOptions> plan_options(const std::string& program, const SamplingOptions& sampling,
                                        const ImageOptions& images, Diagnostics& diagnostics) {
  const auto printer = find_printer(sampling.printer.empty() ? "generic" : sampling.printer, diagnostics);
  if (!printer) return std::nullopt;
  PlanOptions options;
  options.program = program;
  options.printer = *printer;
  options.printer_given = !sampling.printer.empty();
  if (sampling.voxel) options.pitch = *sampling.voxel;
  if (sampling.dpi) options.pitch = *sampling.dpi;
  if (sampling.layer_height) options.pitch[2] = *sampling.layer_height;
  static_cast<SamplingRules&>(options) = sampling.rules;
  options.image = images.format;
  options.place = sampling.place;
  options.whole_tray = sampling.tray;
  if (images.by.empty()) return options;
  if (images.format && images.format != ImageFormat::gray)
    throw options::WrongValue("--format " + voxel::to_text(*images.format) +
                              " holds materials; --by makes gray images: leave --format out");
  options.value = ValueChoice{images.by, images.range, images.bits == "16" ? 16 : 8};
  return options;
}

}  // namespace ombre::compile

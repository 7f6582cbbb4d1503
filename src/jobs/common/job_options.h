// Options that several kinds of jobs have: design, voxels, images, use of the machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "base/text/text.h"
#include "jobs/common/plan_options.h"
#include "jobs/common/sampling_rules.h"
#include "load/loaded.h"
#include "voxel/image_kinds.h"

namespace ombre::compile {

// Options that choose the design, and how it is read.
struct DesignOptions {
  std::string design = {}, materials = {};
  std::vector<std::string> material_map = {}, definitions = {};
  std::vector<std::string> needed = {};  // variables that the command sets later, so that a script must have them
  std::optional<Vec3> rotate = {};       // degrees about x, then y, then z

  static const options::Spec<DesignOptions>& options() {
    using namespace options;
    static const options::Spec<DesignOptions> spec{
        option("design", &DesignOptions::design, kind::file, "The design: a .vcad, .scad, .json, .ombre or .py file",
               "FILE")
            .required(),
        option("--materials", &DesignOptions::materials, kind::file, "Materials file (see: ombre materials)", "FILE"),
        options::list("--material-map", &DesignOptions::material_map, kind::text,
                      "A material for a name or a colour of an OpenSCAD script, or a JSON file of such pairs; may be "
                      "repeated",
                      "NAME=MATERIAL|FILE"),
        options::list("-D,--define", &DesignOptions::definitions, kind::text,
                      "Set a variable of the design; may be repeated", "NAME=VALUE"),
        option("--rotate", &DesignOptions::rotate, kind::angles, "Turn the design about x, then y, then z; degrees",
               "X,Y,Z")};
    return spec;
  }
  // Returns the options with which the design is loaded, without those of the session.
  LoadOptions load() const;
};

// Options that choose the voxels.
struct SamplingOptions {
  std::string printer;  // a name or a path; empty: the generic printer
  std::optional<options::Pitches> voxel, dpi;
  std::optional<Pitch> layer_height;
  SamplingRules rules;
  std::optional<voxel::Placement> place;
  bool tray = false;

  static const options::Spec<SamplingOptions>& options() {
    using namespace options;
    static const options::Spec<SamplingOptions> spec{
        option("--printer", &SamplingOptions::printer, kind::text,
               "Printer profile: a name, or the path of a .json file", "NAME"),
        option("--voxel", &SamplingOptions::voxel, kind::voxel, "Voxel size: one length, or x,y,z; mm", "X,Y,Z"),
        option("--dpi", &SamplingOptions::dpi, kind::dpi, "Resolution in dots per inch: x and y alike, x,y or x,y,z",
               "X,Y")
            .excludes({"--voxel"}),
        option("--layer-height", &SamplingOptions::layer_height, kind::layer_height, "Voxel size along z; mm", "MM"),
        group(&SamplingOptions::rules),
        choice("--place", &SamplingOptions::place, voxel::placement_names(),
               "Area of the layers: the design's own box, or the build plate with the part in its middle",
               "design|center"),
        flag("--tray", &SamplingOptions::tray,
             "Make layers of the printer's whole build box, with the design where it stands")
            .excludes({"--place"})};
    return spec;
  }
};

// Options that choose the images.
struct ImageOptions {
  std::optional<ImageFormat> format;
  std::string by;  // empty: images show materials
  std::optional<Interval> range;
  std::string bits = "8";
  int samples = 0;

  static const options::Spec<ImageOptions>& options() {
    using namespace options;
    static const options::Spec<ImageOptions> spec{
        choice("--format", &ImageOptions::format, voxel::image_format_names(),
               "Image format: " + words_text(voxel::image_format_names()) + " (default: the printer's)", "FORMAT"),
        option("--by,--gray,--grey", &ImageOptions::by, kind::text,
               "Show an attribute or a material's fraction instead of materials: a number in shades of gray,\n"
               "black outside, or a colour as it is",
               "NAME"),
        option("--range", &ImageOptions::range, kind::range,
               "Values of black and white (default: the range of the design; of fractions and masks 0,1)", "LO,HI")
            .needs("--by"),
        choice("--bits", &ImageOptions::bits, voxel::number_bits(),
               "Bits of a gray pixel: 8 (default, 256 shades), 16 (65,536), or 1 for a mask, white from the\n"
               "middle of the range on",
               "8|16|1")
            .needs("--by"),
        option("--antialias", &ImageOptions::samples, kind::whole,
               "Show in 255 shades how much of each pixel is inside, by N x N points half-way up the layer, whatever\n"
               "the material: for masks of vat printers",
               "N")
            .between(1, 16)
            .excludes({"--by"})};
    return spec;
  }
};

inline constexpr size_t usual_memory = size_t{2} << 30;

// Options that limit the use of the machine. They do not change results.
struct WorkOptions {
  int threads = 0;  // 0: all cores
  size_t memory_bytes = usual_memory;

  // `memory` describes the use of the memory, without a full stop.
  static options::Spec<WorkOptions> options(const std::string& memory) {
    using namespace options;
    return {threads_option(), option("--memory", &WorkOptions::memory_bytes, kind::memory, memory, "SIZE")};
  }
  static options::Row<WorkOptions> threads_option() {
    using namespace options;
    return option("--threads", &WorkOptions::threads, kind::whole,
                  "Threads (default: all cores); never changes a result", "N")
        .between(1, 1024);
  }
};

// Makes plan options. Returns nothing, and adds diagnostics, when there is no such printer. Throws options::WrongValue
// for options that exclude each other. `program` is the text for job.json: "ombre 0.1.0".
std::optional<PlanOptions> plan_options(const std::string& program, const SamplingOptions& sampling,
                                        const ImageOptions& images, Diagnostics& diagnostics);

}  // namespace ombre::compile

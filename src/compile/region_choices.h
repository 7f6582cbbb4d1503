// The options of jobs that cut a design into regions: outlines of layers, and meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compile/colour_map.h"
#include "compile/contour_job.h"
#include "compile/job_options.h"
#include "compile/mesh_job.h"
#include "formats/mesh_writers.h"

namespace ombre::compile {

// "0.25,0.5": numbers that rise.
std::vector<double> parse_borders(const std::string& text, const std::string& name);
inline constexpr options::Kind<std::vector<double>> rising_numbers_kind{"numbers", parse_borders};

struct RegionOptions {
  std::optional<double> tolerance_mm, cell_mm;
  std::string by;
  int bands = 0;  // 0: not chosen
  std::vector<double> borders;

  // `piece` is what a region becomes, "A body"; `usual` says the regions where none are chosen, and `usual_tolerance`
  // the tolerance.
  static options::Spec<RegionOptions> options(const std::string& piece, const std::string& usual,
                                              const std::string& usual_tolerance) {
    using namespace options;
    return {option("--tolerance", &RegionOptions::tolerance_mm, kind::length,
                   "Largest distance to the design's surface; mm (default: " + usual_tolerance + ")", "MM"),
            option("--cell", &RegionOptions::cell_mm, kind::length,
                   "Edge of the smallest cells; mm (default: 4 times the tolerance)", "MM"),
            option("--by", &RegionOptions::by, kind::text,
                   piece +
                       " for the whole, each of the materials or named parts, or bands of a material's fraction or "
                       "an attribute; of\nseveral, with commas, for each combination of their bands (default: " +
                       usual + ")",
                   "whole|materials|parts|NAME"),
            option("--bands", &RegionOptions::bands, kind::whole,
                   "Number of bands of equal width (default 4, of the fraction that varies most)", "N")
                .between(2, 1000),
            option("--borders", &RegionOptions::borders, rising_numbers_kind,
                   "Values between bands: fractions from 0 to 1, or the attribute's", "V1,V2,...")
                .excludes({"--bands"})};
  }
  bool are_chosen() const { return !by.empty() || bands > 0 || !borders.empty(); }
  // Throws options::WrongValue for what does not go together.
  RegionRequest request() const;
};

struct ContourChoices {
  DesignOptions design;
  std::string output;
  std::optional<Pitch> layer_height;
  std::optional<double> z_mm;
  RegionOptions regions;
  WorkOptions work;
  bool force = false;

  static const options::Spec<ContourChoices>& options() {
    using namespace options;
    static const options::Spec<ContourChoices> spec{
        group(&ContourChoices::design),
        option("-o,--output", &ContourChoices::output, kind::file,
               "The folder or file to write; a file's ending says the format", "FOLDER|FILE")
            .required(),
        option("--layer-height", &ContourChoices::layer_height, kind::layer_height,
               "Height of layers; mm (default: the design's own, else 0.1)", "MM"),
        option("--z", &ContourChoices::z_mm, kind::height, "Only one layer: what is cut at this height; mm", "MM"),
        group(&ContourChoices::regions,
              RegionOptions::options("An outline", "whole", "a thousandth of its longest side")),
        group(&ContourChoices::work, WorkOptions::options("Most memory for layers in flight and stages (default 2G)")),
        flag("--force", &ContourChoices::force, "Replace files that are there")};
    return spec;
  }
  ContourRequest request() const;
};

inline constexpr const char* usual_bodies =
    "materials, bands of mixtures; in .stl, .ply and .off, which hold no bodies, the whole";

struct MeshChoices {
  DesignOptions design;
  std::string output;
  RegionOptions regions;
  std::string colour_by, palette;
  std::optional<Interval> range;
  bool keep_all = false;
  formats::SlicerFlavour flavour = formats::SlicerFlavour::generic;
  std::vector<std::string> settings;
  bool beams = false;
  WorkOptions work{0, 2 * usual_memory};
  bool force = false;

  static const options::Spec<MeshChoices>& options() {
    using namespace options;
    static const options::Spec<MeshChoices> spec{
        group(&MeshChoices::design),
        option("-o,--output", &MeshChoices::output, kind::file,
               "The file to write; its ending says the format (default: the design's name and .3mf)", "FILE"),
        group(&MeshChoices::regions, RegionOptions::options("A body", usual_bodies,
                                                            "a thousandth of its longest side, up to five where "
                                                            "there would be many cells")),
        option("--colour-by,--color-by", &MeshChoices::colour_by, kind::text,
               "Colours of vertices by an attribute, or by the mixture: materials; not for .stl and .off",
               "materials|NAME"),
        choice("--palette", &MeshChoices::palette, palette_names(), "Of an attribute that is a number", "NAME")
            .needs("--colour-by"),
        option("--range", &MeshChoices::range, kind::range,
               "The values from the first colour to the last (default: those at the vertices)", "LO,HI")
            .needs("--colour-by"),
        flag("--keep-all", &MeshChoices::keep_all, "Keep the triangles of all cells, also where the surface is flat"),
        choice("--flavour,--flavor", &MeshChoices::flavour, {"generic", "prusa", "bambu"},
               "Whom a .3mf is for: generic (default), prusa or bambu", "SLICER"),
        options::list(
            "--setting", &MeshChoices::settings, kind::text,
            "A slicer's setting for the bodies: KEY=VALUE, KEY=FIRST..LAST from the first region to the last, "
            "or\nKEY=V1,V2,... one by one; may be repeated",
            "KEY=VALUE"),
        flag("--beams", &MeshChoices::beams, "Write struts and lattices as beams, where they can be; .3mf only"),
        group(&MeshChoices::work, WorkOptions::options("Most memory for the cells at the surface (default 4G)")),
        flag("--force", &MeshChoices::force, "Replace the file if it is there")};
    return spec;
  }
  MeshRequest request() const;
};

}  // namespace ombre::compile

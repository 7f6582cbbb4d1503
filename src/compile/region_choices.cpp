#include "compile/region_choices.h"

#include <algorithm>
#include <functional>

#include "base/text.h"
#include "compile/colour_map.h"

namespace ombre::compile {

using options::choice;
using options::flag;
using options::group;
using options::option;
namespace kind = options::kind;

namespace {

std::vector<double> parse_borders(const std::string& text, const std::string& name) {
  const std::vector<double> borders = options::parse_numbers(text);
  const bool rises = std::ranges::adjacent_find(borders, std::greater_equal<>()) == borders.end();
  if (!borders.empty() && rises) return borders;
  throw options::WrongValue(name + " " + text + " are not rising numbers; write for example " + name +
                            " 0.25,0.5,0.75");
}

constexpr options::Kind<std::vector<double>> rising_numbers_kind{"numbers", parse_borders};

}  // namespace

options::Spec<RegionOptions> RegionOptions::options(const std::string& piece) {
  return {option("--tolerance", &RegionOptions::tolerance_mm, kind::length,
                 "Largest distance to the design's surface; mm (default: a thousandth of its longest side)", "MM"),
          option("--cell", &RegionOptions::cell_mm, kind::length,
                 "Edge of the smallest cells; mm (default: 4 times the tolerance)", "MM"),
          option("--by", &RegionOptions::by, kind::text,
                 piece + " for each of the materials or named parts, or for bands of a material's fraction or an "
                         "attribute; of\nseveral, with commas, for each combination of their bands",
                 "materials|parts|NAME"),
          option("--bands", &RegionOptions::bands, kind::whole,
                 "Number of bands of equal width (default 4, of the fraction that varies most)", "N")
              .between(2, 1000),
          option("--borders", &RegionOptions::borders, rising_numbers_kind,
                 "Values between bands: fractions from 0 to 1, or the attribute's", "V1,V2,...")
              .excludes({"--bands"})};
}

RegionRequest RegionOptions::request() const {
  RegionRequest request;
  request.tolerance_mm = tolerance_mm;
  request.cell_mm = cell_mm;
  request.by_material = by == "materials";
  request.by_part = by == "parts";
  const bool has_bands = bands > 0 || !borders.empty();
  const bool is_without_bands = request.by_material || request.by_part;
  if (is_without_bands && has_bands)
    throw options::WrongValue("--by " + by +
                              " has no bands; leave out --bands and --borders, or name a material: --by red");
  if (!has_bands && (by.empty() || is_without_bands)) return request;
  const std::vector<std::string> names = split(by, ',');
  if (names.size() > 1 && !borders.empty())
    throw options::WrongValue("--borders are those of one value; with --by " + by +
                              " write --bands, the number for each");
  const auto bands_of = [&](const std::string& name) {
    return BandRequest{bands > 0 ? bands : 4, borders, std::string(trim(name))};
  };
  request.bands = bands_of(names.front());
  for (size_t n = 1; n < names.size(); ++n) request.crossed.push_back(bands_of(names[n]));
  return request;
}

const options::Spec<ContourChoices>& ContourChoices::options() {
  static const options::Spec<ContourChoices> spec{
      group(&ContourChoices::design),
      option("-o,--output", &ContourChoices::output, kind::file,
             "The folder or file to write; a file's ending says the format", "FOLDER|FILE")
          .required(),
      option("--layer-height", &ContourChoices::layer_height, kind::layer_height,
             "Height of layers; mm (default: the design's own, else 0.1)", "MM"),
      option("--z", &ContourChoices::z_mm, kind::height, "Only one layer: what is cut at this height; mm", "MM"),
      group(&ContourChoices::regions, RegionOptions::options("An outline")),
      group(&ContourChoices::work, WorkOptions::options("Most memory for layers in flight and stages (default 2G)")),
      flag("--force", &ContourChoices::force, "Replace files that are there")};
  return spec;
}

ContourRequest ContourChoices::request() const {
  return {regions.request(), layer_height, z_mm, work.threads, nullptr, work.memory_bytes};
}

const options::Spec<MeshChoices>& MeshChoices::options() {
  static const options::Spec<MeshChoices> spec{
      group(&MeshChoices::design),
      option("-o,--output", &MeshChoices::output, kind::file,
             "The file to write; its ending says the format (default: the design's name and .3mf)", "FILE"),
      group(&MeshChoices::regions, RegionOptions::options("A body")),
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
      options::list("--setting", &MeshChoices::settings, kind::text,
                    "A slicer's setting for the bodies: KEY=VALUE, KEY=FIRST..LAST from the first region to the last, "
                    "or\nKEY=V1,V2,... one by one; may be repeated",
                    "KEY=VALUE"),
      flag("--beams", &MeshChoices::beams, "Write struts and lattices as beams, where they can be; .3mf only"),
      group(&MeshChoices::work, WorkOptions::options("Most memory for the cells at the surface (default 4G)")),
      flag("--force", &MeshChoices::force, "Replace the file if it is there")};
  return spec;
}

MeshRequest MeshChoices::request() const {
  MeshRequest request{regions.request()};
  request.beams = beams;
  request.join_flat = !keep_all;
  request.threads = work.threads;
  request.memory_bytes = work.memory_bytes;
  return request;
}

}  // namespace ombre::compile

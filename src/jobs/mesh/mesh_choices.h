// The options of `ombre mesh`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/common/job_options.h"
#include "jobs/common/region_options.h"
#include "jobs/mesh/flavour_option.h"
#include "jobs/mesh/mesh_job.h"
#include "questions/colour_map.h"

namespace ombre::compile {

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
  int mix_layers = 0;  // 0: filaments are not mixed
  bool virtual_tools = false, height_ranges = false;
  bool beams = false;
  WorkOptions work{0, 2 * usual_memory};
  bool force = false;
  std::vector<std::string> given;  // all options that were set: "--bands=4"

  static const options::Spec<MeshChoices>& options() {
    using namespace options;
    static const options::Spec<MeshChoices> rows{
        group(&MeshChoices::design),
        option("-o,--output", &MeshChoices::output, kind::file,
               "The file to write; its ending says the format (default: the design's name and .3mf)", "FILE"),
        group(&MeshChoices::regions, RegionOptions::options("A body", usual_bodies,
                                                            "a thousandth of its longest side, up to five where "
                                                            "there would be many cells")),
        option("--colour-by,--color-by", &MeshChoices::colour_by, kind::text,
               "Colour vertices by an attribute, or by the mixture (materials); not for .stl and .off",
               "materials|NAME"),
        choice("--palette", &MeshChoices::palette, palette_names(), "Palette of an attribute that is a number", "NAME")
            .needs("--colour-by"),
        option("--range", &MeshChoices::range, kind::range,
               "Values of the first and the last colour (default: the range at the vertices)", "LO,HI")
            .needs("--colour-by"),
        flag("--keep-all", &MeshChoices::keep_all, "Keep the triangles of all cells, even where the surface is flat"),
        flavour_option(&MeshChoices::flavour),
        options::list(
            "--setting", &MeshChoices::settings, kind::text,
            "A slicer's setting for the bodies: KEY=VALUE, KEY=FIRST..LAST from the first region to the last, "
            "or\nKEY=V1,V2,... one by one; may be repeated",
            "KEY=VALUE"),
        option("--mix-layers", &MeshChoices::mix_layers, kind::whole,
               "Print bands of a mixture of two materials by changing their filaments from layer to layer, in cycles "
               "of at\nmost N layers (2 to 6)",
               "N")
            .between(2, 6),
        flag("--virtual-tools", &MeshChoices::virtual_tools,
             "Give each temperature and flow_rate of bands a tool, which sets them for the one nozzle; prusa, "
             "orca,\nsnapmaker"),
        flag("--height-ranges", &MeshChoices::height_ranges,
             "Write attributes that vary by height alone as ranges of heights of one body, not as bodies"),
        flag("--beams", &MeshChoices::beams, "Write struts and lattices as beams if possible; .3mf only"),
        group(&MeshChoices::work, WorkOptions::options("Most memory for the cells at the surface (default 4G)")),
        flag("--force", &MeshChoices::force, "Replace an existing file")};
    static const options::Spec<MeshChoices> spec = recorded(rows, &MeshChoices::given);
    return spec;
  }
  MeshRequest request() const;
};

}  // namespace ombre::compile

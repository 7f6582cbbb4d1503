// Writes Common Layer Interface files, version 2.0: outlines and hatches of all layers in one file, for machines that
// trace lines.
#pragma once

#include <optional>

#include "formats/drawings/hatches.h"
#include "formats/drawings/outlines.h"

namespace ombre::formats {

struct CliRules {
  bool is_binary = false;          // numbers of 32 bits behind the header, in place of text
  std::optional<HatchRule> hatch;  // nothing: outlines alone
};

// Returns the header. A file consists of a header, a layer without polygons at the height where the first layer begins,
// the layers in ascending order, and an end. Units are millimetres. Region 1 has the id 1.
std::string cli_header(const OutlineDocument& document, uint64_t layers, double bottom_mm, const CliRules& rules = {});
// Returns a layer, which has the number `layer`; `top_mm` is the height of its upper face. Polygons repeat their first
// point. Hatches follow the outlines of their region.
std::string cli_layer(double top_mm, const OutlinePolygons& polygons, const CliRules& rules = {}, int64_t layer = 0);
std::string cli_end(const CliRules& rules = {});

}  // namespace ombre::formats

// Makes programs that cut a design into regions: one body, a body for each material, or bands of a value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "base/math/run.h"
#include "design/design.h"
#include "surface/cells/partition.h"

namespace ombre::compile {

inline constexpr MaterialId void_material = 0;

struct RegionRule {
  enum class Kind : uint8_t {
    whole,      // one region: everything inside
    materials,  // a region for each material, where its fraction is the greatest
    parts,      // a region for each name of a part
    fraction,   // bands of a material's fraction
    attribute,  // bands of an attribute
    crossed,    // bands of several values at once: a region for each combination
  };
  Kind kind = Kind::whole;
  std::string of;                        // name of the material or attribute
  std::vector<double> borders;           // borders between bands, increasing; one less than there are bands
  std::vector<RegionRule> crossed = {};  // rules for Kind::crossed: fractions and attributes
  std::optional<Interval> range = {};    // least and greatest value, if they are known
};

// A region with its names for people. Regions count from 1, this list from 0.
struct Region {
  std::string name;                       // "red", "handle", "red 25-50 %", "density 0.2-0.4"
  std::optional<MaterialId> material;     // only for Kind::materials
  std::optional<double> least, greatest;  // only for bands: values are at least `least` and less than `greatest`
  // Attributes of a body made by bands, each with the value in the middle of its band.
  std::vector<std::pair<std::string, double>> attributes = {};
  // Bands of fractions have the material, and the fraction in the middle.
  std::vector<std::pair<MaterialId, double>> fractions = {};
};
// Limit of combinations, since each has a body of its own.
inline constexpr size_t most_crossed_regions = 256;

struct RegionProgram {
  surface::Partition partition;
  std::vector<Region> regions;
};

// Builds the programs. Points outside of `box`, and outside of `shape` if that part of the design is given, are void.
// Returns nothing, and adds diagnostics, if the rule names something that the design lacks or the programs would not
// fit into memory.
std::optional<RegionProgram> build_region_program(const design::Design& design, const Box& box, const RegionRule& rule,
                                                  Diagnostics& diagnostics, const design::NodePtr& shape = nullptr);

}  // namespace ombre::compile

// A design cut into regions, as programs: one body, a body for each material, or bands of a value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "base/math/run.h"
#include "design/design.h"
#include "surface/cells/partition.h"

namespace ombre::compile {

struct RegionRule {
  enum class Kind : uint8_t {
    whole,      // all that is inside
    materials,  // by the material of the greatest fraction
    parts,      // by the name of the part
    fraction,   // by bands of a material's fraction
    attribute,  // by bands of an attribute
    crossed,    // by bands of several values at once: a region for each combination
  };
  Kind kind = Kind::whole;
  std::string of;                        // the material or attribute
  std::vector<double> borders;           // between bands; increasing, one less than there are bands
  std::vector<RegionRule> crossed = {};  // of that kind: fractions and attributes
  std::optional<Interval> range = {};    // from the least to the greatest value, if it is known
};

// A region as people know it; regions count from 1, this list from 0.
struct Region {
  std::string name;                       // "red", "handle", "red 25-50 %", "density 0.2-0.4"
  std::optional<MaterialId> material;     // of Kind::materials
  std::optional<double> least, greatest;  // of bands: values from `least`, up to and without `greatest`
  // A body made by bands of attributes has each attribute here, with the value in the middle of its band.
  std::vector<std::pair<std::string, double>> attributes = {};
};
// More are refused: each has a body of its own.
inline constexpr size_t most_crossed_regions = 256;

struct RegionProgram {
  surface::Partition partition;
  std::vector<Region> regions;
};

// What lies outside of `box` is void, and outside of `shape`, a part of the design, where one is given. Nothing, and
// diagnostics, when the rule names what is not there or the programs would not fit into memory.
std::optional<RegionProgram> build_region_program(const design::Design& design, const Box& box, const RegionRule& rule,
                                                  Diagnostics& diagnostics, const design::NodePtr& shape = nullptr);

}  // namespace ombre::compile

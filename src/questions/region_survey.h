// What a design's regions are like, from samples on a coarse lattice.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/box.h"
#include "design/design.h"
#include "program/program.h"
#include "surface/cells/partition.h"

namespace ombre::compile {

// The values of each of a program's outputs at points of a coarse lattice over the box, x fastest, then y, then z.
std::vector<std::vector<float>> sample_coarsely(const program::Program& program, const Box& box);

// The material whose fraction differs most within the design; of about equals the first. Nothing when it is empty.
std::optional<MaterialId> most_varying_material(const design::Design& design, const Box& box, Diagnostics& diagnostics);

struct MaterialsInside {
  std::vector<std::string> names;  // in the order of the design's materials
  bool are_mixed = false;          // some sample has more than one
};

// The materials that a design can have inside, by intervals, which miss none, however small. Nothing, and a diagnostic,
// when the programs would not fit into memory.
std::optional<MaterialsInside> find_materials(const design::Design& design, const Box& box, int threads,
                                              Diagnostics& diagnostics);

// From the least to the greatest value inside of a material's fraction or of an attribute. Nothing when nothing is
// inside, or, and a diagnostic, when the design has none of that name.
std::optional<Interval> value_range(const design::Design& design, const Box& box, const std::string& name,
                                    Diagnostics& diagnostics);

// From the least to the greatest value of the first score inside. Nothing when nothing is inside.
std::optional<Interval> score_range(const surface::Partition& partition, const Box& box);

// The mean of materials' colours by their fractions, for region 1 and so on; grey where no sample fell.
std::vector<design::Rgba> mean_colours(const design::Design& design, const surface::Partition& partition,
                                       const Box& box, Diagnostics& diagnostics);

}  // namespace ombre::compile

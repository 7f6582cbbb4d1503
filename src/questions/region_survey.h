// Surveys a design's regions by samples on a coarse lattice.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/box.h"
#include "design/design.h"
#include "program/program.h"
#include "surface/cells/partition.h"

namespace ombre::compile {

// Returns the values of each output of a program at points of a coarse lattice over the box, x fastest, then y, then z.
std::vector<std::vector<float>> sample_coarsely(const program::Program& program, const Box& box);

// Returns the material whose fraction varies most within the design; of about equal ones the first. Returns nothing if
// the design is empty.
std::optional<MaterialId> most_varying_material(const design::Design& design, const Box& box, Diagnostics& diagnostics);

struct MaterialsInside {
  std::vector<std::string> names;  // names in the order of the design's materials, without void
  bool are_mixed = false;          // true if some sample has more than one material
};

// Finds the materials that a design can have inside. Intervals miss none, however small its place. Returns nothing, and
// adds a diagnostic, if the programs would not fit into memory.
std::optional<MaterialsInside> find_materials(const design::Design& design, const Box& box, int threads,
                                              Diagnostics& diagnostics);

// Returns the least and the greatest value inside of a material's fraction or of an attribute. Returns nothing if
// nothing is inside, or, with a diagnostic, if the design has no such name.
std::optional<Interval> value_range(const design::Design& design, const Box& box, const std::string& name,
                                    Diagnostics& diagnostics);

// Returns the least and the greatest value of the first score inside; nothing if nothing is inside.
std::optional<Interval> score_range(const surface::Partition& partition, const Box& box);

// Returns the mean of the materials' colours by their fractions, from region 1 on; grey if no sample lies in a region.
std::vector<design::Rgba> mean_colours(const design::Design& design, const surface::Partition& partition,
                                       const Box& box, Diagnostics& diagnostics);

}  // namespace ombre::compile

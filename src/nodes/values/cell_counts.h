// The numbers of cells of a map, as parameters.
#pragma once

#include <cmath>
#include <optional>

#include "design/spec.h"

namespace ombre::nodes {

inline constexpr double most_cells = 1e6;  // along an axis
inline constexpr std::string_view cell_size_doc =
    "Length of cells along u, v and w, of which as many are laid as fit best";
inline constexpr std::string_view cell_count_doc = "Numbers of cells along u, v and w, in place of their size";

inline design::Domain whole_from_one() { return design::from_to(1, most_cells); }

// Finds the numbers of cells along the lengths of a region, from their size or number. Returns false and adds an error
// if both or none are given.
inline bool find_counts(const design::Reader& reader, Vec3 lengths, const std::optional<Vec3>& size,
                        const std::optional<design::Counts3>& count, Vec3& counts) {
  if (size.has_value() == count.has_value())
    return reader.refuse(
        std::string(reader.node) + (size ? " has both the size and the numbers of its cells"
                                         : " has neither the size nor the numbers of its cells"),
        "write " + spelled::parameter("size", "(5, 5, 5)") + ", or " + spelled::parameter("count", "(12, 8, 1)"));
  for (int n = 0; n < 3; ++n)
    counts[n] = count ? (*count)[static_cast<size_t>(n)]
                      : std::min(std::max(1.0, std::round(lengths[n] / (*size)[n])), most_cells);
  return true;
}

}  // namespace ombre::nodes

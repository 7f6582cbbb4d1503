// Polyhedra as tetrahedra.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "formats/results/results.h"

namespace ombre::formats {

// Cuts polyhedra into tetrahedra from the mean of their corners to their faces. Faces of more than three corners are
// cut from the mean of theirs, which neighbours share. Convex polyhedra with plane faces are filled exactly.
class PolyhedronCutter {
 public:
  using Face = std::vector<uint32_t>;  // numbers of points, in order around the face

  explicit PolyhedronCutter(Results& results) : results_(results) {}

  // Adds a polyhedron as elements and returns their number.
  size_t add(std::span<const Face> faces);
  // Sets the values of the points that were added, to the means of the values of those in whose middle they lie. The
  // field must have values for all points.
  void fill(ResultField& field) const;
  // Returns how many polyhedra have tetrahedra that may overlap: sides that face their middle, or in no common order.
  uint64_t folded() const { return folded_; }

 private:
  struct Mean {
    uint32_t point = 0;
    std::vector<uint32_t> corners;
  };

  uint32_t add_mean(std::vector<uint32_t> corners);
  uint32_t centre_of(const Face& face);
  double add_tetrahedron(uint32_t a, uint32_t b, uint32_t c, uint32_t top);

  Results& results_;
  std::vector<Mean> means_;
  std::map<std::vector<uint32_t>, uint32_t> centres_;  // of faces, by their sorted corners
  uint64_t folded_ = 0;
};

}  // namespace ombre::formats

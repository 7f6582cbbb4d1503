// Meshes of results: finds the element that contains a point, and the point of the mesh nearest to a point.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "base/math/box_tree.h"
#include "formats/results/results.h"
#include "import/fields/element_shapes.h"

namespace ombre::importing {

// A place in an element.
struct ElementPlace {
  uint32_t element = 0;
  Vec3 at;                 // reference coordinates
  double distance_mm = 0;  // distance from the queried point; 0 in the mesh
};

// A triangle of the mesh's border, with the places of its corners in its element.
struct BorderTriangle {
  uint32_t element = 0;
  std::array<uint32_t, 3> points{};  // numbers of the results' points
  std::array<Vec3, 3> at{};          // reference coordinates
};

// A mesh with search trees. Thread-safe. A point in several elements, such as one on a common side, belongs to the
// first of them.
class ResultMesh {
 public:
  // Constructs the mesh of results, which must have elements.
  explicit ResultMesh(formats::Results results);

  const formats::Results& results() const { return results_; }
  size_t element_count() const { return results_.kinds.size(); }
  const Box& bounds() const { return bounds_; }
  const Box& element_bounds(size_t element) const { return boxes_[element]; }
  std::span<const uint32_t> nodes(size_t element) const {
    return {results_.nodes.data() + results_.first[element], node_count(results_.kinds[element])};
  }

  // Returns the element and place that contain the point, or null. `guess` may be the place of a nearby point; the
  // result does not depend on it.
  std::optional<ElementPlace> place(Vec3 p, const ElementPlace* guess = nullptr) const;
  // Returns the nearest place on the border, with its sides as flat triangles; the distance is infinite if there is no
  // border. `triangle` may be null, or hold the number of the triangle found for a nearby point; it is set to the one
  // found now. The result does not depend on it.
  ElementPlace nearest(Vec3 p, uint32_t* triangle = nullptr) const;

  // Returns the sides that belong to only one element, in the order of the elements. Built on first use.
  const std::vector<BorderTriangle>& border() const;

  // Returns one component of a field at a place.
  double value(const formats::ResultField& field, size_t component, const ElementPlace& place) const;
  // find_weights() computes the weights of the element's nodes at a place, which all fields share; value() uses them.
  using Weights = std::array<double, most_element_nodes>;
  void find_weights(const ElementPlace& place, Weights& weights) const;
  double value(const formats::ResultField& field, size_t component, size_t element, const Weights& weights) const;
  // Encloses the component in the whole element.
  Interval value_bounds(const formats::ResultField& field, size_t component, size_t element) const;

  size_t bytes() const;

 private:
  bool find_in(uint32_t element, Vec3 p, Vec3& at) const;
  // Copies the points of the element's nodes into `room`.
  std::span<const Vec3> points_of(size_t element, std::span<Vec3> room) const;
  void make_border() const;

  formats::Results results_;
  std::vector<Box> boxes_;
  std::vector<uint8_t> affine_;  // by element: is_affine()
  BoxTree tree_;
  Box bounds_;
  mutable std::once_flag border_made_;
  mutable std::vector<BorderTriangle> border_;
  mutable BoxTree border_tree_;
};

}  // namespace ombre::importing

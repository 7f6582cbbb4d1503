// Meshes of results: in which element a point lies, and where it is nearest to the mesh.
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
  double distance_mm = 0;  // from the point that was asked for; 0 in the mesh
};

// A triangle of the mesh's border, with the places of its corners in its element.
struct BorderTriangle {
  uint32_t element = 0;
  std::array<uint32_t, 3> points{};  // numbers of the results' points
  std::array<Vec3, 3> at{};          // reference coordinates
};

// Thread-safe. What lies in several elements, as their common sides do, belongs to the first of them.
class ResultMesh {
 public:
  // `results` must have elements.
  explicit ResultMesh(formats::Results results);

  const formats::Results& results() const { return results_; }
  size_t element_count() const { return results_.kinds.size(); }
  const Box& bounds() const { return bounds_; }
  const Box& element_bounds(size_t element) const { return boxes_[element]; }
  std::span<const uint32_t> nodes(size_t element) const {
    return {results_.nodes.data() + results_.first[element], node_count(results_.kinds[element])};
  }

  // The element that holds the point. `guess` may be where a point beside it was found; the answer does not depend on
  // it.
  std::optional<ElementPlace> place(Vec3 p, const ElementPlace* guess = nullptr) const;
  // The nearest place of the border; sides are taken as flat triangles. Infinitely far where there is no border.
  // `triangle`, which may be null, is where a point beside it was found, and gets where this one is; the answer does
  // not depend on it.
  ElementPlace nearest(Vec3 p, uint32_t* triangle = nullptr) const;

  // The sides that belong to one element alone, in the order of elements. Made on first use.
  const std::vector<BorderTriangle>& border() const;

  // One component of a field.
  double value(const formats::ResultField& field, size_t component, const ElementPlace& place) const;
  // The same with the weights of the element's nodes there, which all fields share.
  using Weights = std::array<double, most_element_nodes>;
  void find_weights(const ElementPlace& place, Weights& weights) const;
  double value(const formats::ResultField& field, size_t component, size_t element, const Weights& weights) const;
  // Encloses it in the whole element.
  Interval value_bounds(const formats::ResultField& field, size_t component, size_t element) const;

  size_t bytes() const;

 private:
  bool find_in(uint32_t element, Vec3 p, Vec3& at) const;
  // Copies the nodes' places into `room`.
  std::span<const Vec3> points_of(size_t element, std::span<Vec3> room) const;
  void make_border() const;

  formats::Results results_;
  std::vector<Box> boxes_;
  std::vector<uint8_t> affine_;  // of each element: is_affine()
  BoxTree tree_;
  Box bounds_;
  mutable std::once_flag border_made_;
  mutable std::vector<BorderTriangle> border_;
  mutable BoxTree border_tree_;
};

}  // namespace ombre::importing

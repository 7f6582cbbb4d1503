// The surface between changes: the clusters at the corners of each quad, and the quad's triangles.
#pragma once

#include <span>
#include <vector>

#include "surface/mesh/clusters.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// A triangle by the numbers of its clusters.
using Triangle = std::array<uint32_t, 3>;

// The up to two triangles of a quad after clusters were joined.
struct QuadTriangles {
  std::array<Triangle, 2> all{};
  uint8_t count = 0;

  std::span<const Triangle> list() const { return {all.data(), count}; }
};

class QuadSurface {
 public:
  QuadSurface(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh,
              const ContourOptions& options);

  const DualMesh& mesh() const { return mesh_; }
  const Clusters& clusters() const { return clusters_; }
  size_t quads() const { return triangles_.size(); }
  std::span<const Triangle> triangles(uint32_t quad) const { return triangles_[quad].list(); }
  const Crossing& crossing(uint32_t quad) const { return crossings_[quad]; }
  std::array<Vec3, 3> corners(const Triangle& triangle) const;
  std::span<const uint32_t> quads_around(uint32_t vertex) const {
    return std::span(quads_of_vertices_).subspan(quad_begins_[vertex], quad_begins_[vertex + 1] - quad_begins_[vertex]);
  }
  // Hashes of the quads' shapes: equal shapes have equal hashes even if their clusters were renumbered.
  const std::vector<uint64_t>& shape_hashes() const { return shape_hashes_; }
  // True if the quad is small, the border around it is nearly flat, and the quad is parallel to the border.
  bool is_calm(uint32_t quad) const;

  Vec3 normal(const Triangle& triangle) const;  // length is twice the area
  bool is_folded(const Triangle& triangle, uint32_t quad) const;
  bool is_folded(uint32_t quad) const;
  std::vector<uint32_t> folded_quads() const;

  void split(uint32_t cluster) { clusters_.split(cluster, changed_); }
  void move(uint32_t vertex, Vec3 at);
  // Moves a cluster, joined or not; afterwards all quads count as changed.
  void place(uint32_t cluster, Vec3 at) {
    clusters_.move(cluster, at);
    is_new_ = true;
  }
  // Updates the surface and returns, in order, the quads changed since the last call, or all.
  std::vector<uint32_t> refresh();

  RegionSurface build() const;

 private:
  void list_quads_of_vertices();
  void cut(uint32_t quad);

  const std::vector<Crossing>& crossings_;
  const DualMesh& mesh_;
  const Workers& workers_;
  double least_calm_cosine_;
  Clusters clusters_;
  std::vector<uint32_t> quad_begins_, quads_of_vertices_;
  std::vector<QuadTriangles> triangles_;
  std::vector<uint64_t> shape_hashes_;
  std::vector<uint32_t> changed_;  // changed vertices
  bool is_new_ = true;
};

}  // namespace ombre::surface

// The surface as it is between changes: what stands for the corners of each quad, and its triangles.
#pragma once

#include <span>
#include <vector>

#include "surface/mesh/clusters.h"
#include "surface/mesh/contour_types.h"

namespace ombre::surface {

// Between clusters.
using Triangle = std::array<uint32_t, 3>;

// What is left of a quad after its vertices were drawn together: up to two triangles.
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
  // Hashes of the quads' shapes: equal where the shapes are, also after their clusters got other numbers.
  const std::vector<uint64_t>& shape_hashes() const { return shape_hashes_; }
  // Whether the quad is small, the border around it nearly flat, and the quad along it.
  bool is_calm(uint32_t quad) const;

  Vec3 normal(const Triangle& triangle) const;  // as long as twice its area
  bool is_folded(const Triangle& triangle, uint32_t quad) const;
  bool is_folded(uint32_t quad) const;
  std::vector<uint32_t> folded_quads() const;

  void split(uint32_t cluster) { clusters_.split(cluster, changed_); }
  void move(uint32_t vertex, Vec3 at);
  // What stands for several too; all quads count as changed.
  void place(uint32_t cluster, Vec3 at) {
    clusters_.move(cluster, at);
    is_new_ = true;
  }
  // Quads that changed since the last time, or all, in order.
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
  std::vector<uint32_t> changed_;  // vertices
  bool is_new_ = true;
};

}  // namespace ombre::surface

// Vertices of the dual mesh drawn together, level by level of an octree, where the surface is flat enough.
#pragma once

#include <vector>

#include "surface/dual_mesh.h"

namespace ombre::surface {

// A vertex, or what stands for several in a cell of 2^level units.
struct Cluster {
  static constexpr uint32_t none = ~uint32_t{0};
  CellPlace place{};  // in units of its level
  uint8_t level = 0;
  bool is_split = false;  // its members stand for themselves
  uint32_t parent = none;
  Vec3 at;  // mm
};

// After Schaefer, Ju and Warren, Manifold Dual Contouring (2007): vertices of a cell that hang together become one if
// they make up a disc, no edge of the cell crosses it twice and no face cuts it twice, so that closed surfaces
// without pinched places stay such. Only where exactly two regions meet: lines where more meet keep their vertices.
class Clusters {
 public:
  // Clusters keep within about tolerance_mm of the planes at their crossings; 0: none are made.
  Clusters(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh, double tolerance_mm);

  // What stands for a vertex now.
  uint32_t of(uint32_t vertex) const;
  const Cluster& operator[](uint32_t cluster) const { return clusters_[cluster]; }
  size_t size() const { return clusters_.size(); }
  // Whether it stands for several vertices, or may.
  bool is_joined(uint32_t cluster) const { return cluster >= vertices_; }
  // Takes a cluster that is joined apart.
  void split(uint32_t cluster) { clusters_[cluster].is_split = true; }
  void move(uint32_t cluster, Vec3 at) { clusters_[cluster].at = at; }

 private:
  std::vector<Cluster> clusters_;  // the vertices first
  size_t vertices_ = 0;
};

}  // namespace ombre::surface

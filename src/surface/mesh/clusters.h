// Joins vertices of the dual mesh, level by level of an octree, where the surface is flat enough.
#pragma once

#include <vector>

#include "surface/mesh/dual_mesh.h"

namespace ombre::surface {

// A vertex, or a cluster that replaces several vertices in a cell of 2^level units.
struct Cluster {
  static constexpr uint32_t none = ~uint32_t{0};
  CellPlace place{};  // in units of its level
  uint8_t level = 0;
  bool is_split = false;  // true if its members are used instead of it
  uint32_t parent = none;
  uint32_t first_member = 0, member_count = 0;
};

struct ClusterList {
  std::vector<Cluster> all;  // vertices first, then joined clusters
  std::vector<Vec3> places;
  std::vector<uint32_t> members;
};

// A hierarchy of clusters (Schaefer, Ju and Warren, Manifold Dual Contouring, 2007). Connected vertices of a cell
// become one if they form a disc, no edge of the cell crosses it twice and no face cuts it twice. Closed surfaces thus
// remain manifold. Vertices where more than two regions meet are never joined.
class Clusters {
 public:
  // Builds clusters that stay within about tolerance_mm of the planes at their crossings; with 0, none are built.
  Clusters(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh, double tolerance_mm,
           const Workers& workers);

  // Returns the cluster that currently represents a vertex.
  uint32_t of(uint32_t vertex) const { return stands_for_[vertex]; }
  const Cluster& operator[](uint32_t cluster) const { return list_.all[cluster]; }
  const std::vector<Vec3>& places() const { return list_.places; }  // mm
  size_t size() const { return list_.all.size(); }
  // True if it was joined from several vertices, even if it is split now.
  bool is_joined(uint32_t cluster) const { return cluster >= vertices_; }
  // Splits a joined cluster into its members, and appends the vertices that it represented.
  void split(uint32_t cluster, std::vector<uint32_t>& vertices);
  void move(uint32_t cluster, Vec3 at) { list_.places[cluster] = at; }

 private:
  void let_stand(uint32_t cluster, uint32_t below, std::vector<uint32_t>& vertices);

  ClusterList list_;
  std::vector<uint32_t> stands_for_;  // by vertex: the cluster that represents it
  size_t vertices_ = 0;
};

}  // namespace ombre::surface

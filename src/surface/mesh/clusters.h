// Vertices of the dual mesh drawn together, level by level of an octree, where the surface is flat enough.
#pragma once

#include <vector>

#include "surface/mesh/dual_mesh.h"

namespace ombre::surface {

// A vertex, or what stands for several in a cell of 2^level units.
struct Cluster {
  static constexpr uint32_t none = ~uint32_t{0};
  CellPlace place{};  // in units of its level
  uint8_t level = 0;
  bool is_split = false;  // its members stand for themselves
  uint32_t parent = none;
  uint32_t first_member = 0, member_count = 0;
};

struct ClusterList {
  std::vector<Cluster> all;  // the vertices first
  std::vector<Vec3> places;
  std::vector<uint32_t> members;
};

// After Schaefer, Ju and Warren, Manifold Dual Contouring (2007): vertices of a cell that hang together become one if
// they make up a disc, no edge of the cell crosses it twice and no face cuts it twice, so that closed surfaces
// without pinched places stay such. Only where exactly two regions meet: lines where more meet keep their vertices.
class Clusters {
 public:
  // Clusters keep within about tolerance_mm of the planes at their crossings; 0: none are made.
  Clusters(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh, double tolerance_mm,
           const Workers& workers);

  // What stands for a vertex now.
  uint32_t of(uint32_t vertex) const { return stands_for_[vertex]; }
  const Cluster& operator[](uint32_t cluster) const { return list_.all[cluster]; }
  const std::vector<Vec3>& places() const { return list_.places; }  // mm
  size_t size() const { return list_.all.size(); }
  // Whether it stands for several vertices, or may.
  bool is_joined(uint32_t cluster) const { return cluster >= vertices_; }
  // Takes a cluster that is joined apart, and adds the vertices it stood for.
  void split(uint32_t cluster, std::vector<uint32_t>& vertices);
  void move(uint32_t cluster, Vec3 at) { list_.places[cluster] = at; }

 private:
  void let_stand(uint32_t cluster, uint32_t below, std::vector<uint32_t>& vertices);

  ClusterList list_;
  std::vector<uint32_t> stands_for_;  // what stands for a vertex
  size_t vertices_ = 0;
};

}  // namespace ombre::surface

// Partitions of space whose borders tests know exactly, and surfaces of them.
#pragma once

#include <cmath>
#include <functional>

#include "base/system/not_copied.h"
#include "program/field.h"
#include "surface/cells/cell_tree.h"
#include "surface/cells/crossings.h"
#include "surface/mesh/quad_surface.h"

namespace ombre::surface {

// Returns a lattice of corners 1 mm apart, the first at the origin.
inline voxel::Lattice corners_from_origin(const std::array<int64_t, 3>& count) {
  voxel::Lattice corners;
  corners.origin = {-0.5, -0.5, -0.5};
  corners.pitch = {Pitch{1, 1}, Pitch{1, 1}, Pitch{1, 1}};
  corners.count = count;
  return corners;
}

using FieldOfSpace = std::function<program::Field(program::Builder&)>;

// Returns the partition into region 1, where g is negative, and void.
inline Partition solid_where_negative(const FieldOfSpace& g) {
  program::Builder builder;
  const program::Field distance = g(builder);
  const program::Field label = select(distance < 0, builder.constant(1), builder.constant(0));
  Partition partition;
  partition.label = builder.finish({{"region", label}});
  partition.details =
      LocalPrograms(builder.finish({{"region", label}, {"distance", distance}}), Box::centered({100, 100, 100}));
  return partition;
}

inline Partition ball_of(Vec3 middle, double radius) {
  return solid_where_negative([&](program::Builder& b) {
    return length(b.input(0) - middle.x, b.input(1) - middle.y, b.input(2) - middle.z) - radius;
  });
}

// Returns the half of space behind the plane normal . p = offset; the normal is a unit vector.
inline Partition half_space(Vec3 normal, double offset) {
  return solid_where_negative([&](program::Builder& b) {
    return b.input(0) * normal.x + b.input(1) * normal.y + b.input(2) * normal.z - offset;
  });
}

// The surface of a partition in cells that are not subdivided, with the steps that lead to it.
struct PlainSurface : NotCopied {
  PlainSurface(Partition of, const voxel::Lattice& corners, double tolerance_mm)
      : partition(std::move(of)),
        options{corners, tolerance_mm, tolerance_mm > 0, {1}, 0},
        tree(find_mixed_cells(partition.label, corners, 1)),
        crossings(find_crossings(partition, tree, 1)),
        mesh(make_dual_mesh(tree, crossings, options.workers)),
        surface(tree, crossings, mesh, options) {
    surface.refresh();
  }

  Partition partition;
  ContourOptions options;
  CellTree tree;
  std::vector<Crossing> crossings;
  DualMesh mesh;
  QuadSurface surface;
};

}  // namespace ombre::surface

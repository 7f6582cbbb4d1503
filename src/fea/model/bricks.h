// Meshes of equal bricks: the cells of a grid that are inside a solid, with the nodes at their corners.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/math/box.h"
#include "base/system/progress.h"
#include "fea/model/fill.h"

namespace ombre::fea {

// A cell's place in its grid.
using Cell = std::array<int32_t, 3>;

// True if a comes before b in the order of cells and nodes: by z, then y, then x.
inline bool is_before(const Cell& a, const Cell& b) {
  return std::array{a[2], a[1], a[0]} < std::array{b[2], b[1], b[0]};
}

// A mesh of bricks. The nodes of brick n have the order of Abaqus' C3D8 and of VTK's hexahedron: around the lower face,
// counter-clockwise as seen from above, then around the upper one.
struct Bricks {
  Vec3 origin;   // the corner of cell (0, 0, 0) with the least x, y and z; mm
  Vec3 size_mm;  // size of a brick
  std::vector<Cell> cells;
  std::vector<Cell> corners;  // places of nodes, in bricks from the origin
  std::vector<std::array<uint32_t, 8>> nodes;
  // Period of the mesh along each axis in bricks, by which its last bricks share nodes with its first; 0: not periodic.
  Cell period{};
  std::vector<Fill> fills = {};  // fill of each brick; empty: all are full

  size_t count() const { return cells.size(); }
  size_t node_count() const { return corners.size(); }
  Vec3 node(size_t n) const { return at(corners[n], 0); }      // place of a node, mm
  Vec3 centroid(size_t n) const { return at(cells[n], 0.5); }  // middle of a brick, mm
  // Returns the centroid of the brick's part inside.
  Vec3 centre_of_fill(size_t n) const {
    if (fill(n) == full_fill) return centroid(n);
    const Vec3 corner = at(cells[n], 0), within = fill_centre(fill(n));
    return {corner.x + within.x * size_mm.x, corner.y + within.y * size_mm.y, corner.z + within.z * size_mm.z};
  }
  // Returns the number of the brick in this cell; count() if there is none.
  size_t find(const Cell& cell) const;
  double volume_mm3() const { return size_mm.x * size_mm.y * size_mm.z; }  // volume of a full brick
  Fill fill(size_t n) const { return fills.empty() ? full_fill : fills[n]; }
  double share(size_t n) const { return fills.empty() ? 1 : fill_share(fills[n]); }
  // Returns the sum of all shares: the number of full bricks with the same volume.
  double filled_count() const {
    double sum = 0;
    for (size_t n = 0; n < count(); ++n) sum += share(n);
    return sum;
  }

 private:
  Vec3 at(const Cell& cell, double offset) const {
    return {origin.x + (cell[0] + offset) * size_mm.x, origin.y + (cell[1] + offset) * size_mm.y,
            origin.z + (cell[2] + offset) * size_mm.z};
  }
};

// Places of a brick's corners in it: 0 or 1 along each axis.
inline constexpr std::array<Cell, 8> brick_corners{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

// Makes a mesh of the cells. They must come in ascending order of z, then y, then x; with a period they run from 0 to
// less than it. Nodes are numbered in the same order, without duplicates. Throws Cancelled.
Bricks make_bricks(Vec3 origin, Vec3 size_mm, std::vector<Cell> cells, const Cell& period = {},
                   const StopFlag* stop = nullptr);

// A face of a brick that no other brick touches.
struct OuterFace {
  uint32_t brick = 0;
  uint8_t axis = 0;       // axis that the face is perpendicular to
  bool is_upper = false;  // true at the greater coordinate
};
// Returns the outer faces in the order of bricks, then axes, the lower one first.
std::vector<OuterFace> outer_faces(const Bricks& bricks);

}  // namespace ombre::fea

#include "surface/cells/cell_parts.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace ombre::surface {
namespace {

struct Face {
  std::array<size_t, 4> corners{};  // in the order 00, 10, 01, 11 along the two other axes
  // Edges between corners 00-10, 01-11, 00-01 and 10-11.
  std::array<int, 4> edges{};
};

constexpr Face face_of(int axis, int side) {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  Face face;
  for (int n = 0; n < 4; ++n) {
    std::array<int, 3> offsets{};
    offsets[static_cast<size_t>(axis)] = side;
    offsets[static_cast<size_t>(b)] = n & 1;
    offsets[static_cast<size_t>(c)] = n >> 1;
    face.corners[static_cast<size_t>(n)] = corner_number(offsets);
  }
  // Axes are cyclic: axis b is followed by c, then `axis`; c is followed by `axis`, then b.
  face.edges = {edge_number(b, 0, side), edge_number(b, 1, side), edge_number(c, side, 0), edge_number(c, side, 1)};
  return face;
}

class Joiner {
 public:
  Joiner() { std::iota(parents_.begin(), parents_.end(), 0); }
  int find(int e) const {
    while (parents_[static_cast<size_t>(e)] != e) e = parents_[static_cast<size_t>(e)];
    return e;
  }
  void join(int a, int b) { parents_[static_cast<size_t>(std::max(find(a), find(b)))] = std::min(find(a), find(b)); }

 private:
  std::array<int, 12> parents_{};
};

// Joins the edges of a face all four of whose edges are crossed: neighbouring corners differ, diagonal ones may be
// equal.
void join_ambiguous(const Face& face, const std::array<Label, 4>& q, Joiner& joiner) {
  const auto& e = face.edges;
  const bool first = q[0] == q[3], second = q[1] == q[2];
  if (!first && !second) {
    for (size_t n = 1; n < 4; ++n) joiner.join(e[0], e[n]);
  } else if (first && (!second || q[0] > q[1])) {
    joiner.join(e[0], e[3]);  // cuts off corner 10
    joiner.join(e[1], e[2]);  // cuts off corner 01
  } else {
    joiner.join(e[0], e[2]);  // cuts off corner 00
    joiner.join(e[1], e[3]);  // cuts off corner 11
  }
}

void join_across(const Face& face, const std::array<Label, 8>& corners, Joiner& joiner) {
  const std::array<Label, 4> q{corners[face.corners[0]], corners[face.corners[1]], corners[face.corners[2]],
                               corners[face.corners[3]]};
  const std::array<bool, 4> crossed{q[0] != q[1], q[2] != q[3], q[0] != q[2], q[1] != q[3]};
  if (crossed[0] && crossed[1] && crossed[2] && crossed[3]) return join_ambiguous(face, q, joiner);
  int first = -1;
  for (size_t n = 0; n < 4; ++n) {
    if (!crossed[n]) continue;
    if (first >= 0) joiner.join(first, face.edges[n]);
    first = face.edges[n];
  }
}

CellParts find_parts(const std::array<Label, 8>& corners) {
  Joiner joiner;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) join_across(face_of(axis, side), corners, joiner);
  CellParts parts;
  for (int e = 0; e < 12; ++e) {
    auto& part = parts.part_of_edge[static_cast<size_t>(e)];
    part = CellParts::none;
    if (corners[first_corner(e)] == corners[second_corner(e)]) continue;
    const int root = joiner.find(e);
    part = root == e ? parts.count++ : parts.part_of_edge[static_cast<size_t>(root)];
  }
  return parts;
}

// Returns the corners in the greater region as bits; null unless exactly two regions meet in the cell.
std::optional<size_t> bits_of_two(const std::array<Label, 8>& corners) {
  const auto [least, greatest] = std::ranges::minmax(corners);
  size_t bits = 0;
  for (size_t n = 0; n < 8; ++n) {
    if (corners[n] == greatest)
      bits |= size_t{1} << n;
    else if (corners[n] != least)
      return std::nullopt;
  }
  return bits;
}

std::array<CellParts, 256> parts_of_two() {
  std::array<CellParts, 256> parts;
  for (size_t bits = 0; bits < parts.size(); ++bits) {
    std::array<Label, 8> corners{};
    for (size_t n = 0; n < 8; ++n) corners[n] = static_cast<Label>(bits >> n & 1);
    parts[bits] = find_parts(corners);
  }
  return parts;
}

}  // namespace

CellParts find_cell_parts(const std::array<Label, 8>& corners) {
  static const std::array<CellParts, 256> known = parts_of_two();
  const std::optional<size_t> bits = bits_of_two(corners);
  return bits ? known[*bits] : find_parts(corners);
}

}  // namespace ombre::surface

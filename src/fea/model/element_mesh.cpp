#include "fea/model/element_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/math/disjoint_sets.h"
#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::fea {
namespace {

using Side = std::array<uint8_t, 6>;

constexpr std::array<Side, 4> tetrahedron_sides{
    {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}}};
constexpr std::array<Side, 6> hexahedron_sides{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

// For each axis, the numbers of a brick's lower and upper side that are perpendicular to it.
constexpr std::array<std::array<uint8_t, 2>, 3> brick_sides{{{5, 3}, {2, 4}, {0, 1}}};

constexpr std::array<std::array<uint8_t, 2>, 6> tetrahedron_edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

double tetrahedron_volume(Vec3 a, Vec3 b, Vec3 c, Vec3 d) { return dot(cross(b - a, c - a), d - a) / 6; }

// Returns the angle in degrees between the two sides of a tetrahedron that meet in the edge ab.
double dihedral(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 u = cross(b - a, c - a), v = cross(b - a, d - a);
  return std::atan2(length(cross(u, v)), dot(u, v)) * 180 / std::numbers::pi;
}

// Distributes an amount at a place of a brick to its nodes by their trilinear functions; coordinates go from 0 to 1.
void add_at(const Bricks& bricks, size_t brick, Vec3 at, double amount, std::vector<NodeShare>& shares) {
  for (size_t c = 0; c < 8; ++c) {
    double weight = amount;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double along = at[static_cast<int>(axis)];
      weight *= brick_corners[c][axis] == 1 ? along : 1 - along;
    }
    if (weight == 0) continue;
    const uint32_t node = bricks.nodes[brick][c];
    const auto known = std::ranges::find(shares, node, &NodeShare::node);
    if (known != shares.end())
      known->share += weight;
    else
      shares.push_back({node, weight});
  }
}

// Looks through columns of parts from a side inwards.
class Surface {
 public:
  Surface(const Bricks& bricks, const OuterSide& side) : bricks_(bricks), first_(side.element) {
    while (brick_sides[axis_][0] != side.side && brick_sides[axis_][1] != side.side) ++axis_;
    is_upper_ = brick_sides[axis_][1] == side.side;
  }

  std::vector<NodeShare> shares() const {
    const double area = bricks_.volume_mm3() / bricks_.size_mm[static_cast<int>(axis_)];
    std::vector<NodeShare> shares;
    for (size_t a = 0; a < parts_along; ++a)
      for (size_t b = 0; b < parts_along; ++b) add_column(a, b, area / (parts_along * parts_along), shares);
    return shares;
  }

 private:
  // Adds an area at the first part inside, of this brick or of one behind it.
  void add_column(size_t a, size_t b, double area, std::vector<NodeShare>& shares) const {
    std::array<size_t, 3> part{};
    part[(axis_ + 1) % 3] = a;
    part[(axis_ + 2) % 3] = b;
    for (size_t brick = first_; brick < bricks_.count(); brick = behind(brick))
      for (size_t n = 0; n < parts_along; ++n) {
        part[axis_] = is_upper_ ? parts_along - 1 - n : n;
        if (!has_part(bricks_.fill(brick), part[0], part[1], part[2])) continue;
        Vec3 at;
        for (size_t axis = 0; axis < 3; ++axis) {
          const double within = axis != axis_ ? 0.5 : is_upper_ ? 1 : 0;
          at[static_cast<int>(axis)] = (static_cast<double>(part[axis]) + within) / parts_along;
        }
        return add_at(bricks_, brick, at, area, shares);
      }
  }

  size_t behind(size_t brick) const {
    Cell cell = bricks_.cells[brick];
    cell[axis_] += is_upper_ ? -1 : 1;
    return bricks_.find(cell);
  }

  const Bricks& bricks_;
  size_t first_, axis_ = 0;
  bool is_upper_ = false;
};

std::vector<NodeShare> surface_shares(const Bricks& bricks, const OuterSide& side) {
  return Surface(bricks, side).shares();
}

std::vector<NodeShare> fill_shares(const Bricks& bricks, size_t brick) {
  std::vector<NodeShare> shares;
  const double volume = bricks.volume_mm3() / parts_of_brick;
  const auto middle = [](size_t part) { return (static_cast<double>(part) + 0.5) / parts_along; };
  for (size_t z = 0; z < parts_along; ++z)
    for (size_t y = 0; y < parts_along; ++y)
      for (size_t x = 0; x < parts_along; ++x)
        if (has_part(bricks.fills[brick], x, y, z))
          add_at(bricks, brick, {middle(x), middle(y), middle(z)}, volume, shares);
  return shares;
}

}  // namespace

const ElementShape& shape_of(ElementKind kind) {
  static const std::array<ElementShape, 3> shapes{{{4, 4, "C3D4", 10, tetrahedron_sides, 3, 3},
                                                   {10, 4, "C3D10", 24, tetrahedron_sides, 6, 3},
                                                   {8, 8, "C3D8", 12, hexahedron_sides, 4, 4}}};
  return shapes[static_cast<size_t>(kind)];
}

Vec3 MeshView::centroid(size_t element) const {
  if (bricks_) return bricks_->centre_of_fill(element);
  const auto nodes_here = nodes(element);
  const size_t corners = shape().corners;
  Vec3 sum;
  for (size_t n = 0; n < corners; ++n) sum = sum + node(nodes_here[n]);
  return (1 / static_cast<double>(corners)) * sum;
}

double MeshView::volume_mm3(size_t element) const {
  if (bricks_) return bricks_->share(element) * bricks_->volume_mm3();
  const auto n = nodes(element);
  if (shape().corners == 4) return tetrahedron_volume(node(n[0]), node(n[1]), node(n[2]), node(n[3]));
  // A hexahedron is divided into six tetrahedra around the diagonal 1-7.
  constexpr std::array<std::array<size_t, 2>, 6> pairs{{{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}};
  double volume = 0;
  for (const auto& [a, b] : pairs) volume += tetrahedron_volume(node(n[0]), node(n[a]), node(n[b]), node(n[6]));
  return volume;
}

double MeshView::total_volume_mm3() const {
  double volume = 0;
  for (size_t n = 0; n < count(); ++n) volume += volume_mm3(n);
  return volume;
}

Box MeshView::bounds() const {
  Box box;
  for (size_t n = 0; n < node_count(); ++n) box = hull(box, Box{node(n), node(n)});
  return box;
}

double MeshView::typical_size_mm() const {
  if (bricks_) return std::min({bricks_->size_mm.x, bricks_->size_mm.y, bricks_->size_mm.z});
  return count() == 0 ? 0 : std::cbrt(std::abs(total_volume_mm3()) / static_cast<double>(count()));
}

std::vector<OuterSide> outer_sides(const MeshView& mesh) {
  std::vector<OuterSide> outer;
  if (mesh.bricks()) {
    for (const OuterFace& face : outer_faces(*mesh.bricks()))
      outer.push_back({face.brick, brick_sides[face.axis][face.is_upper ? 1 : 0]});
    return outer;
  }
  // After sorting, sides with the same corners are neighbours.
  constexpr auto none = ~uint32_t{0};
  struct Entry {
    std::array<uint32_t, 4> corners;
    OuterSide side;
  };
  const ElementShape& shape = mesh.shape();
  std::vector<Entry> entries;
  entries.reserve(mesh.count() * shape.sides.size());
  for (uint32_t element = 0; element < mesh.count(); ++element) {
    const auto nodes = mesh.nodes(element);
    for (size_t side = 0; side < shape.sides.size(); ++side) {
      Entry entry{{none, none, none, none}, {element, static_cast<uint8_t>(side)}};
      for (size_t n = 0; n < shape.side_corners; ++n) entry.corners[n] = nodes[shape.sides[side][n]];
      std::ranges::sort(entry.corners);
      entries.push_back(entry);
    }
  }
  std::ranges::stable_sort(entries, {}, &Entry::corners);
  for (size_t n = 0; n < entries.size();) {
    size_t end = n + 1;
    while (end < entries.size() && entries[end].corners == entries[n].corners) ++end;
    if (end == n + 1) outer.push_back(entries[n].side);
    n = end;
  }
  std::ranges::sort(outer, {}, [](const OuterSide& side) { return std::pair(side.element, side.side); });
  return outer;
}

std::vector<uint32_t> side_nodes(const MeshView& mesh, const OuterSide& side) {
  const ElementShape& shape = mesh.shape();
  const auto nodes = mesh.nodes(side.element);
  std::vector<uint32_t> found;
  for (size_t n = 0; n < shape.side_nodes; ++n) found.push_back(nodes[shape.sides[side.side][n]]);
  return found;
}

Vec3 side_area(const MeshView& mesh, const OuterSide& side) {
  const std::vector<uint32_t> n = side_nodes(mesh, side);
  const Vec3 a = mesh.node(n[0]), b = mesh.node(n[1]), c = mesh.node(n[2]);
  if (mesh.shape().side_corners == 3) return 0.5 * cross(b - a, c - a);
  return 0.5 * cross(c - a, mesh.node(n[3]) - b);
}

std::vector<NodeShare> side_shares(const MeshView& mesh, const OuterSide& side) {
  if (mesh.bricks() && !mesh.bricks()->fills.empty()) return surface_shares(*mesh.bricks(), side);
  const double area = length(side_area(mesh, side));
  std::vector<NodeShare> shares;
  for (const uint32_t node : side_nodes(mesh, side)) shares.push_back({node, 0});
  // Shares are integrals of shape functions; those of the corners of a quadratic triangle are 0.
  const size_t first = shares.size() == 6 ? 3 : 0;
  for (size_t n = first; n < shares.size(); ++n) shares[n].share = area / static_cast<double>(shares.size() - first);
  return shares;
}

std::vector<NodeShare> volume_shares(const MeshView& mesh, size_t element) {
  if (mesh.bricks() && mesh.bricks()->fill(element) != full_fill) return fill_shares(*mesh.bricks(), element);
  const auto nodes = mesh.nodes(element);
  const double volume = mesh.volume_mm3(element), even = volume / static_cast<double>(nodes.size());
  std::vector<NodeShare> shares;
  for (size_t n = 0; n < nodes.size(); ++n)
    shares.push_back({nodes[n], nodes.size() != 10 ? even : (n < 4 ? -0.05 : 0.2) * volume});
  return shares;
}

std::vector<uint32_t> pieces_of(const MeshView& mesh) {
  DisjointSets sets(mesh.node_count());
  for (size_t element = 0; element < mesh.count(); ++element) {
    const auto nodes = mesh.nodes(element);
    for (const uint32_t node : nodes) sets.join(nodes[0], node);
  }
  constexpr auto unknown = ~uint32_t{0};
  std::vector<uint32_t> numbers(mesh.node_count(), unknown), pieces;
  uint32_t next = 0;
  for (size_t element = 0; element < mesh.count(); ++element) {
    uint32_t& number = numbers[sets.root(mesh.nodes(element)[0])];
    if (number == unknown) number = next++;
    pieces.push_back(number);
  }
  return pieces;
}

Mesh with_middle_nodes(const Mesh& tetrahedra) {
  Mesh mesh{ElementKind::c3d10, tetrahedra.points, {}};
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  for (size_t first = 0; first + 3 < tetrahedra.nodes.size(); first += 4) {
    for (size_t n = 0; n < 4; ++n) mesh.nodes.push_back(tetrahedra.nodes[first + n]);
    for (const auto& [from, to] : tetrahedron_edges) {
      const uint32_t a = tetrahedra.nodes[first + from], b = tetrahedra.nodes[first + to];
      const auto [place, is_new] = middles.emplace(std::minmax(a, b), static_cast<uint32_t>(mesh.points.size()));
      if (is_new) mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
      mesh.nodes.push_back(place->second);
    }
  }
  return mesh;
}

MeshQuality quality_of(const MeshView& mesh) {
  MeshQuality quality;
  const bool is_tetrahedra = mesh.shape().corners == 4;
  if (is_tetrahedra) quality.least_dihedral = 180;
  double edges = 0;
  size_t edge_count = 0;
  for (size_t element = 0; element < mesh.count(); ++element) {
    const double volume = mesh.volume_mm3(element);
    if (!(volume > 0)) ++quality.inverted;
    if (!is_tetrahedra) continue;
    const auto n = mesh.nodes(element);
    double longest = 0, largest_side = 0;
    for (size_t edge = 0; edge < 6; ++edge) {
      const auto& [from, to] = tetrahedron_edges[edge];
      std::array<size_t, 2> others{};
      size_t found = 0;
      for (size_t k = 0; k < 4; ++k)
        if (k != from && k != to) others[found++] = k;
      const Vec3 a = mesh.node(n[from]), b = mesh.node(n[to]);
      const double angle = dihedral(a, b, mesh.node(n[others[0]]), mesh.node(n[others[1]]));
      quality.least_dihedral = std::min(quality.least_dihedral, angle);
      quality.most_dihedral = std::max(quality.most_dihedral, angle);
      const double edge_length = length(b - a);
      longest = std::max(longest, edge_length);
      edges += edge_length;
      ++edge_count;
    }
    for (uint8_t side = 0; side < 4; ++side)
      largest_side = std::max(largest_side, length(side_area(mesh, {static_cast<uint32_t>(element), side})));
    // The height of a regular tetrahedron is sqrt(2/3) of its edge.
    const double height = 3 * std::abs(volume) / largest_side;
    quality.worst_aspect = std::max(quality.worst_aspect, longest * std::sqrt(2.0 / 3) / height);
  }
  if (edge_count > 0) quality.mean_edge_mm = edges / static_cast<double>(edge_count);
  return quality;
}

void refuse_inverted(const MeshView& mesh) {
  if (mesh.bricks()) return;
  size_t wrong = 0, first = 0;
  for (size_t element = mesh.count(); element-- > 0;)
    if (!(mesh.volume_mm3(element) > 0)) ++wrong, first = element;
  if (wrong == 0) return;
  const Vec3 at = mesh.centroid(first);
  throw Error(Code::not_meshed, format_count(wrong) + " of the mesh's elements are inside out or flat, the first at (" +
                                    format_rounded(at.x) + ", " + format_rounded(at.y) + ", " + format_rounded(at.z) +
                                    ") mm");
}

}  // namespace ombre::fea

#include "formats/results/deck_shells.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "base/math/math.h"
#include "base/text/text.h"

namespace ombre::formats {
namespace {

const double least_cosine = math::cos(std::numbers::pi / 9);  // of 20 degrees, between normals that count as one

struct Thickness {
  double mm = 0, offset = 0;
  bool operator==(const Thickness&) const = default;
};

// A corner or a node between corners of a shell, with the normal of the shell there.
struct ShellNode {
  size_t shell = 0, place = 0;  // which shell, and which of its nodes
  Vec3 normal;
};

// The points of a node of shells with one normal: at the bottom, in the middle and at the top.
constexpr std::array heights{-0.5, 0.0, 0.5};
using Column = std::array<uint32_t, heights.size()>;

Vec3 unit(Vec3 v) { return 1 / length(v) * v; }

// Returns the normals at the corners, then those at the nodes between them.
std::vector<Vec3> normals_of(const DeckPart::Element& shell, const std::vector<Vec3>& nodes) {
  const size_t corners = shell.kind == ElementKind::wedge6 ? 3 : 4;
  std::vector<Vec3> normals;
  for (size_t n = 0; n < corners; ++n) {
    const Vec3 at = nodes[n], after = nodes[(n + 1) % corners], before = nodes[(n + corners - 1) % corners];
    const Vec3 normal = cross(after - at, before - at);
    if (!(length(normal) > 0)) shell.line.fail("shell " + std::to_string(shell.number) + " has no area at a corner");
    normals.push_back(unit(normal));
  }
  for (size_t n = corners; n < nodes.size(); ++n)
    normals.push_back(unit(normals[n - corners] + normals[(n - corners + 1) % corners]));
  return normals;
}

// Returns the columns of a solid's points in the order of its nodes: those at the bottom, those at the top, and between
// them for elements with nodes in the middles of edges.
std::array<uint32_t, 20> points_of(ElementKind kind, const std::vector<Column>& columns) {
  constexpr size_t bottom = 0, middle = 1, top = 2;
  std::array<uint32_t, 20> points{};
  size_t n = 0;
  const auto add = [&](size_t from, size_t count, size_t height) {
    for (size_t k = 0; k < count; ++k) points[n++] = columns[from + k][height];
  };
  const size_t corners = kind == ElementKind::wedge6 ? 3 : 4;
  add(0, corners, bottom);
  add(0, corners, top);
  if (kind != ElementKind::brick20) return points;
  add(corners, corners, bottom);
  add(corners, corners, top);
  add(0, corners, middle);
  return points;
}

}  // namespace

std::optional<ElementKind> thick_shell_kind(std::string_view type) {
  if (type.starts_with("ds")) type.remove_prefix(1);  // shells that conduct heat
  if (type.starts_with("stri3")) return ElementKind::wedge6;
  if (!type.starts_with('s')) return std::nullopt;
  type.remove_prefix(1);
  const std::string_view digits = type.substr(0, type.find_first_not_of("0123456789"));
  if (digits == "3") return ElementKind::wedge6;
  if (digits == "4") return ElementKind::brick8;
  if (digits == "8") return ElementKind::brick20;
  return std::nullopt;
}

ThickShells::ThickShells(const DeckPart& part) {
  std::map<uint64_t, Thickness> thicknesses;  // by number of the shell; later sections replace earlier ones
  for (const ShellSection& section : part.shell_sections())
    for (const uint64_t number : part.element_set(section.set))
      thicknesses.insert_or_assign(number, Thickness{section.thickness_mm, section.offset});

  std::vector<Thickness> of_shell;
  std::vector<std::vector<Column>> columns;
  std::map<uint64_t, std::vector<ShellNode>> around;  // by number of the node
  for (const DeckPart::Element& element : part.elements()) {
    if (!element.is_shell) continue;
    const auto thickness = thicknesses.find(element.number);
    if (thickness == thicknesses.end()) {
      ++thin_;
      continue;
    }
    std::vector<Vec3> nodes;
    for (const uint64_t node : part.nodes_of(element)) nodes.push_back(part.nodes()[part.place_of(element, node)].at);
    const std::vector<Vec3> normals = normals_of(element, nodes);
    for (size_t n = 0; n < nodes.size(); ++n)
      around[part.nodes_of(element)[n]].push_back({solids_.size(), n, normals[n]});
    solids_.push_back({&element, {}});
    of_shell.push_back(thickness->second);
    columns.emplace_back(nodes.size());
  }

  for (auto& [number, left] : around) {
    std::ranges::sort(left, {}, [&](const ShellNode& node) { return solids_[node.shell].shell->number; });
    const DeckPart::Element& any = *solids_[left.front().shell].shell;
    const Vec3 at = part.nodes()[part.place_of(any, number)].at;
    while (!left.empty()) {
      const ShellNode first = left.front();
      const Thickness& thickness = of_shell[first.shell];
      const auto is_apart = [&](const ShellNode& node) {
        return dot(node.normal, first.normal) < least_cosine || !(of_shell[node.shell] == thickness);
      };
      const auto others = std::stable_partition(left.begin(), left.end(), is_apart);
      Vec3 sum;
      for (auto node = others; node != left.end(); ++node) sum = sum + node->normal;
      const Vec3 along = thickness.mm * unit(sum);
      const auto place = static_cast<uint32_t>(points_.size());
      for (const double height : heights) points_.push_back(at + (height - thickness.offset) * along);
      nodes_.insert(nodes_.end(), heights.size(), number);
      for (auto node = others; node != left.end(); ++node)
        columns[node->shell][node->place] = {place, place + 1, place + 2};
      left.erase(others, left.end());
    }
  }
  for (size_t n = 0; n < solids_.size(); ++n) solids_[n].points = points_of(solids_[n].shell->kind, columns[n]);
}

}  // namespace ombre::formats

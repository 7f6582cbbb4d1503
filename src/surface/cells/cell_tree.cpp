#include "surface/cells/cell_tree.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/system/assert.h"

namespace ombre::surface {
namespace {

CellPlace moved(const CellPlace& at, size_t number, int32_t by) {
  CellPlace place = at;
  for (size_t axis = 0; axis < 3; ++axis) place[axis] += (number >> axis & 1) ? by : 0;
  return place;
}

CellPlace first_unit_of(const CellPlace& grid_cell) {
  return {grid_cell[0] << grid_level, grid_cell[1] << grid_level, grid_cell[2] << grid_level};
}

// Returns the number, 0 to 7, of the child that contains a unit.
size_t child_of(const CellPlace& unit, int children_level) {
  size_t child = 0;
  for (size_t axis = 0; axis < 3; ++axis) child |= static_cast<size_t>(unit[axis] >> children_level & 1) << axis;
  return child;
}

template <class Visit>
void each_around(const CellPlace& cell, const Visit& visit) {
  for (int32_t k = -1; k <= 1; ++k)
    for (int32_t j = -1; j <= 1; ++j)
      for (int32_t i = -1; i <= 1; ++i) visit(CellPlace{cell[0] + i, cell[1] + j, cell[2] + k});
}

bool comes_before(const MixedCell& a, const MixedCell& b) {
  return std::tie(a.at[2], a.at[1], a.at[0]) < std::tie(b.at[2], b.at[1], b.at[0]);
}

}  // namespace

CellPlace grid_cell_of(const CellPlace& unit) {
  return {unit[0] >> grid_level, unit[1] >> grid_level, unit[2] >> grid_level};
}

size_t PlaceHash::operator()(const CellPlace& at) const {
  uint64_t mixed = 0;
  for (const int32_t index : at) {
    mixed = (mixed ^ static_cast<uint32_t>(index)) * 0x9E3779B97F4A7C15U;
    mixed ^= mixed >> 29;
  }
  return mixed;
}

bool Leaf::is_mixed() const {
  return std::ranges::any_of(corners, [&](Label label) { return label != corners[0]; });
}

CellTree::CellTree(MixedCells grid) : grid_(std::move(grid)), roots_(grid_.cells().size()) { list_leaves(); }

Vec3 CellTree::point(const CellPlace& units) const {
  Vec3 point;
  for (size_t axis = 0; axis < 3; ++axis)
    point[static_cast<int>(axis)] =
        lattice().origin[static_cast<int>(axis)] +
        lattice().pitch[axis].times(static_cast<double>(units[axis]) / units_per_cell + 0.5);
  return point;
}

CellPlace CellTree::unit_at(Vec3 point) const {
  CellPlace unit{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const double from_origin = point[static_cast<int>(axis)] - lattice().origin[static_cast<int>(axis)];
    unit[axis] = static_cast<int32_t>(std::floor((from_origin / lattice().pitch[axis].mm() - 0.5) * units_per_cell));
  }
  return unit;
}

Vec3 CellTree::size_mm(int level) const {
  return (static_cast<double>(1 << level) / units_per_cell) * lattice().voxel_mm();
}

bool CellTree::is_within(const CellPlace& unit) const {
  for (size_t axis = 0; axis < 3; ++axis)
    if (unit[axis] < 0 || unit[axis] >= (lattice().count[axis] - 1) * units_per_cell) return false;
  return true;
}

bool CellTree::is_outermost(const CellPlace& units) const {
  for (size_t axis = 0; axis < 3; ++axis)
    if (units[axis] <= 0 || units[axis] >= (lattice().count[axis] - 1) * units_per_cell) return true;
  return false;
}

uint32_t CellTree::find(const CellPlace& unit) const {
  const uint32_t cell = grid_.find(grid_cell_of(unit));
  if (cell == MixedCells::none) return none;
  const Root& root = roots_[cell];
  if (root.children == none) return root.leaf;
  uint32_t children = root.children;
  for (int level = grid_level - 1;; --level) {
    const Child& child = children_[children + child_of(unit, level)];
    if (child.children == none) return child.leaf;
    children = child.children;
  }
}

void CellTree::grow(const Growth& growth, const LabelQuery& ask) {
  grow_at_end(growth, ask);
  list_leaves();
}

void CellTree::grow_on(Growth growth, const LabelQuery& ask, const MoreGrowth& more) {
  while (!growth.is_empty()) {
    const size_t grown_before = grown_.size();
    grow_at_end(growth, ask);
    growth = more(leaves_around({grown_.begin() + static_cast<ptrdiff_t>(grown_before), grown_.end()}));
  }
  list_leaves();
}

void CellTree::grow_at_end(const Growth& growth, const LabelQuery& ask) {
  std::vector<CellPlace> corners;
  for (const uint32_t number : growth.cut) {
    const Leaf& leaf = leaves_[number];
    ASSERT(leaf.level > 0);
    learn_corners(leaf);
    for (size_t child = 0; child < 8; ++child)
      for (size_t corner = 0; corner < 8; ++corner)
        corners.push_back(moved(moved(leaf.at, child, 1 << (leaf.level - 1)), corner, 1 << (leaf.level - 1)));
  }
  for (const CellPlace& place : growth.taken_in)
    for (size_t corner = 0; corner < 8; ++corner)
      corners.push_back(moved(first_unit_of(place), corner, units_per_cell));
  query_unknown(std::move(corners), ask);
  grown_.insert(grown_.end(), growth.taken_in.begin(), growth.taken_in.end());
  for (const uint32_t number : growth.cut) grown_.push_back(grid_cell_of(leaves_[number].at));
  for (const uint32_t number : growth.cut) cut(Leaf(leaves_[number]));
  take_in(growth.taken_in);
}

// Returns the leaves in and around cells of the grid, in ascending order, and sets their is_near_cut.
std::vector<uint32_t> CellTree::leaves_around(const std::vector<CellPlace>& grid_cells) {
  std::vector<uint32_t> cells;
  for (const CellPlace& cell : grid_cells)
    each_around(cell, [&](const CellPlace& place) {
      const uint32_t number = grid_.find(place);
      if (number != MixedCells::none) cells.push_back(number);
    });
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<uint32_t> leaves;
  for (const uint32_t cell : cells) each_leaf_below(roots_[cell], [&](uint32_t leaf) { leaves.push_back(leaf); });
  std::ranges::sort(leaves);
  for (const uint32_t leaf : leaves) leaves_[leaf].is_near_cut = true;
  return leaves;
}

template <class Visit>
void CellTree::each_leaf_below(const Root& root, const Visit& visit) const {
  if (root.children == none) return visit(root.leaf);
  std::vector<uint32_t> waiting{root.children};
  while (!waiting.empty()) {
    const uint32_t children = waiting.back();
    waiting.pop_back();
    for (uint32_t n = children; n < children + 8; ++n) {
      if (children_[n].children == none)
        visit(children_[n].leaf);
      else
        waiting.push_back(children_[n].children);
    }
  }
}

void CellTree::learn_corners(const Leaf& leaf) {
  for (size_t corner = 0; corner < 8; ++corner)
    labels_.try_emplace(moved(leaf.at, corner, 1 << leaf.level), leaf.corners[corner]);
}

// Returns a corner's label if it was queried before or belongs to a mixed cell of the grid.
std::optional<Label> CellTree::known_label(const CellPlace& corner) const {
  if (const auto found = labels_.find(corner); found != labels_.end()) return found->second;
  const CellPlace above = grid_cell_of(corner);
  if (first_unit_of(above) != corner) return std::nullopt;
  for (size_t n = 0; n < 8; ++n) {
    const uint32_t cell = grid_.find(moved(above, n, -1));
    if (cell != MixedCells::none) return grid_.cells()[cell].corners[n];
  }
  return std::nullopt;
}

void CellTree::query_unknown(std::vector<CellPlace> corners, const LabelQuery& ask) {
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<CellPlace> unknown;
  for (const CellPlace& corner : corners) {
    if (const auto label = known_label(corner))
      labels_.try_emplace(corner, *label);
    else
      unknown.push_back(corner);
  }
  const std::vector<Label> labels = ask(unknown);
  for (size_t n = 0; n < unknown.size(); ++n) labels_.emplace(unknown[n], labels[n]);
}

void CellTree::cut(const Leaf& leaf) {
  const auto first = static_cast<uint32_t>(children_.size());
  const int level = leaf.level - 1;
  for (size_t n = 0; n < 8; ++n) {
    Child child;
    for (size_t corner = 0; corner < 8; ++corner)
      child.corners[corner] = labels_.at(moved(moved(leaf.at, n, 1 << level), corner, 1 << level));
    child.leaf = static_cast<uint32_t>(leaves_.size());
    leaves_.push_back({{moved(leaf.at, n, 1 << level), child.corners}, static_cast<uint8_t>(level), true, true});
    children_.push_back(child);
  }
  uint32_t* above = &roots_[grid_.find(grid_cell_of(leaf.at))].children;
  for (int l = grid_level - 1; l > level; --l) above = &children_[*above + child_of(leaf.at, l)].children;
  *above = first;
}

void CellTree::take_in(const std::vector<CellPlace>& places) {
  if (places.empty()) return;
  std::vector<MixedCell> more;
  for (const CellPlace& place : places) {
    MixedCell& cell = more.emplace_back(MixedCell{place, {}});
    for (size_t corner = 0; corner < 8; ++corner)
      cell.corners[corner] = labels_.at(moved(first_unit_of(place), corner, units_per_cell));
  }
  std::ranges::sort(more, comes_before);
  std::vector<MixedCell> cells;
  std::vector<Root> roots;
  cells.reserve(roots_.size() + more.size());
  roots.reserve(roots_.size() + more.size());
  auto next = more.begin();
  const auto take_before = [&](const auto& is_before) {
    for (; next != more.end() && is_before(*next); ++next) {
      cells.push_back(*next);
      roots.emplace_back().leaf = static_cast<uint32_t>(leaves_.size());
      leaves_.push_back({{first_unit_of(next->at), next->corners}, grid_level, false, true});
    }
  };
  for (size_t n = 0; n < roots_.size(); ++n) {
    const MixedCell& cell = grid_.cells()[n];
    take_before([&](const MixedCell& other) { return comes_before(other, cell); });
    cells.push_back(cell);
    roots.push_back(roots_[n]);
  }
  take_before([](const MixedCell&) { return true; });
  roots_ = std::move(roots);
  grid_ = MixedCells(lattice(), std::move(cells));
}

void CellTree::flag_around(const CellPlace& grid_cell, std::vector<bool>& flags) const {
  each_around(grid_cell, [&](const CellPlace& place) {
    const uint32_t cell = grid_.find(place);
    if (cell != MixedCells::none) flags[cell] = true;
  });
}

std::vector<bool> CellTree::cells_around_cuts() const {
  std::vector<bool> flags(roots_.size());
  for (size_t n = 0; n < roots_.size(); ++n)
    if (roots_[n].children != none) flag_around(grid_.cells()[n].at, flags);
  return flags;
}

std::vector<bool> CellTree::cells_around_growth() const {
  std::vector<bool> flags(roots_.size());
  std::vector<CellPlace> cells = grown_;
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  for (const CellPlace& cell : cells) flag_around(cell, flags);
  return flags;
}

void CellTree::list_leaves() {
  const std::vector<bool> is_near_cut = cells_around_cuts(), is_near_growth = cells_around_growth();
  leaves_.clear();
  for (size_t n = 0; n < roots_.size(); ++n) {
    const MixedCell& cell = grid_.cells()[n];
    const CellPlace at = first_unit_of(cell.at);
    if (roots_[n].children != none) {
      list_below(at, grid_level - 1, roots_[n].children, is_near_growth[n]);
      continue;
    }
    roots_[n].leaf = static_cast<uint32_t>(leaves_.size());
    leaves_.push_back({{at, cell.corners}, grid_level, is_near_cut[n], is_near_growth[n]});
  }
}

void CellTree::list_below(const CellPlace& at, int level, uint32_t children, bool is_near_growth) {
  for (size_t n = 0; n < 8; ++n) {
    Child& child = children_[children + n];
    const CellPlace place = moved(at, n, 1 << level);
    if (child.children != none) {
      list_below(place, level - 1, child.children, is_near_growth);
      continue;
    }
    child.leaf = static_cast<uint32_t>(leaves_.size());
    leaves_.push_back({{place, child.corners}, static_cast<uint8_t>(level), true, is_near_growth});
  }
}

std::vector<uint32_t> numbers_after_growth(const std::vector<Leaf>& before, const std::vector<Leaf>& after) {
  std::vector<uint32_t> numbers;
  numbers.reserve(before.size());
  uint32_t next = 0;
  for (const Leaf& leaf : before) {
    while (after[next].at != leaf.at) ++next;
    numbers.push_back(after[next].level == leaf.level ? next : CellTree::none);
  }
  return numbers;
}

}  // namespace ombre::surface

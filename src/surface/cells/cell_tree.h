// The mixed cells of a grid, some of them cut into finer ones: an octree below each cell of the grid.
#pragma once

#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "surface/cells/cell_grid.h"

namespace ombre::surface {

// Places in a tree count in units, sides of its finest cells. A cell of level n has sides of 2^n units.
constexpr int grid_level = 5;
constexpr int32_t units_per_cell = 1 << grid_level;

CellPlace grid_cell_of(const CellPlace& unit);

struct PlaceHash {
  size_t operator()(const CellPlace& at) const;
};

// A cell that is not cut.
struct Leaf : MixedCell {
  uint8_t level = grid_level;
  bool is_near_cut = false;     // a cell of the grid around it is cut, or its own
  bool is_near_growth = false;  // the same since growth was forgotten, or one was taken in

  bool is_mixed() const;
};

// Leaves above level 0 that are cut into eight, and cells of the grid that are not mixed and are taken in, by their
// places in the grid.
struct Growth {
  std::vector<uint32_t> cut;
  std::vector<CellPlace> taken_in;

  bool is_empty() const { return cut.empty() && taken_in.empty(); }
};

class CellTree {
 public:
  static constexpr uint32_t none = ~uint32_t{0};
  // The labels at corners, given by their places in units.
  using LabelQuery = std::function<std::vector<Label>(const std::vector<CellPlace>&)>;

  explicit CellTree(MixedCells grid);

  const voxel::Lattice& lattice() const { return grid_.lattice(); }
  Vec3 point(const CellPlace& units) const;
  CellPlace unit_at(Vec3 point) const;  // the unit that holds it
  Vec3 size_mm(int level) const;
  // Whether the grid, of which the tree has but some cells, holds a unit.
  bool is_within(const CellPlace& unit) const;
  // Whether a corner lies on the border of the grid, where all is void.
  bool is_outermost(const CellPlace& units) const;

  // In order of the grid's cells: z, then y, then x.
  const std::vector<Leaf>& leaves() const { return leaves_; }
  // The number of the leaf that holds a unit; none in cells of the grid that the tree does not have.
  uint32_t find(const CellPlace& unit) const;

  void forget_growth() { grown_.clear(); }
  // Leaves get new numbers.
  void grow(const Growth& growth, const LabelQuery& ask);
  // Grows by what `more` requests until it requests nothing. `more` gets the leaves in and around the cells of the grid
  // that grew last; what was cut is still among all leaves() until the end, but is not found.
  using MoreGrowth = std::function<Growth(const std::vector<uint32_t>& leaves)>;
  void grow_on(Growth growth, const LabelQuery& ask, const MoreGrowth& more);

 private:
  struct Child {
    std::array<Label, 8> corners{};
    uint32_t children = none;
    uint32_t leaf = none;
  };
  // Of a cell of the grid: the first of its eight children, or its number as a leaf.
  struct Root {
    uint32_t children = none;
    uint32_t leaf = none;
  };

  void learn_corners(const Leaf& leaf);
  std::optional<Label> known_label(const CellPlace& corner) const;
  void query_unknown(std::vector<CellPlace> corners, const LabelQuery& ask);
  void take_in(const std::vector<CellPlace>& places);
  // Leaves that come are numbered after the others.
  void grow_at_end(const Growth& growth, const LabelQuery& ask);
  void cut(const Leaf& leaf);
  std::vector<uint32_t> leaves_around(const std::vector<CellPlace>& grid_cells);
  template <class Visit>
  void each_leaf_below(const Root& root, const Visit& visit) const;
  std::vector<bool> cells_around_cuts() const;
  std::vector<bool> cells_around_growth() const;
  void flag_around(const CellPlace& grid_cell, std::vector<bool>& flags) const;
  void list_leaves();
  void list_below(const CellPlace& at, int level, uint32_t children, bool is_near_growth);

  MixedCells grid_;
  std::vector<Root> roots_;  // of the grid's mixed cells
  std::vector<Child> children_;
  std::vector<Leaf> leaves_;
  std::vector<CellPlace> grown_;                            // cells of the grid, since growth was forgotten
  std::unordered_map<CellPlace, Label, PlaceHash> labels_;  // at corners of cells that were cut
};

// The numbers that leaves have after a tree grew; none where they were cut.
std::vector<uint32_t> numbers_after_growth(const std::vector<Leaf>& before, const std::vector<Leaf>& after);

}  // namespace ombre::surface

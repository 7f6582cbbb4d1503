// The mixed cells of a grid, each of which may be the root of an octree of finer cells.
#pragma once

#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "surface/cells/cell_grid.h"

namespace ombre::surface {

// Places in a tree are counted in units; a unit is the side of the finest cells. A cell of level n has sides of 2^n
// units.
constexpr int grid_level = 5;
constexpr int32_t units_per_cell = 1 << grid_level;

CellPlace grid_cell_of(const CellPlace& unit);

struct PlaceHash {
  size_t operator()(const CellPlace& at) const;
};

// A cell of the tree that is not subdivided.
struct Leaf : MixedCell {
  uint8_t level = grid_level;
  bool is_near_cut = false;     // true if its own cell of the grid, or a neighbour of that, is subdivided
  bool is_near_growth = false;  // true if such a cell was subdivided or added since forget_growth()

  bool is_mixed() const;
};

// A request to grow a tree: numbers of leaves above level 0 to subdivide into eight, and places of unmixed cells of the
// grid to add to the tree.
struct Growth {
  std::vector<uint32_t> cut;
  std::vector<CellPlace> taken_in;

  bool is_empty() const { return cut.empty() && taken_in.empty(); }
};

class CellTree {
 public:
  static constexpr uint32_t none = ~uint32_t{0};
  // Returns the labels at corners, which are given by their places in units.
  using LabelQuery = std::function<std::vector<Label>(const std::vector<CellPlace>&)>;

  explicit CellTree(MixedCells grid);

  const voxel::Lattice& lattice() const { return grid_.lattice(); }
  Vec3 point(const CellPlace& units) const;
  CellPlace unit_at(Vec3 point) const;  // the unit that contains the point
  Vec3 size_mm(int level) const;
  // True if the unit lies inside the grid, even if the tree does not have that cell.
  bool is_within(const CellPlace& unit) const;
  // True if a corner lies on the outer boundary of the grid, where every label is void.
  bool is_outermost(const CellPlace& units) const;

  // Leaves in the order of the grid's cells: by z, then y, then x.
  const std::vector<Leaf>& leaves() const { return leaves_; }
  // Returns the number of the leaf that contains a unit, or none if the tree does not have that cell of the grid.
  uint32_t find(const CellPlace& unit) const;

  void forget_growth() { grown_.clear(); }
  // Grows the tree and renumbers its leaves.
  void grow(const Growth& growth, const LabelQuery& ask);
  // Grows the tree by `growth`, then by what `more` requests, until it requests nothing. `more` is passed the leaves in
  // and around the cells of the grid that grew last. Subdivided leaves remain in leaves() until the end, but find() no
  // longer returns them.
  using MoreGrowth = std::function<Growth(const std::vector<uint32_t>& leaves)>;
  void grow_on(Growth growth, const LabelQuery& ask, const MoreGrowth& more);

 private:
  struct Child {
    std::array<Label, 8> corners{};
    uint32_t children = none;
    uint32_t leaf = none;
  };
  // A cell of the grid: the index of the first of its eight children, or its number as a leaf.
  struct Root {
    uint32_t children = none;
    uint32_t leaf = none;
  };

  void learn_corners(const Leaf& leaf);
  std::optional<Label> known_label(const CellPlace& corner) const;
  void query_unknown(std::vector<CellPlace> corners, const LabelQuery& ask);
  void take_in(const std::vector<CellPlace>& places);
  // Grows the tree; new leaves are numbered after the existing ones.
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
  std::vector<Root> roots_;  // one per mixed cell of the grid
  std::vector<Child> children_;
  std::vector<Leaf> leaves_;
  std::vector<CellPlace> grown_;                            // cells of the grid that grew since forget_growth()
  std::unordered_map<CellPlace, Label, PlaceHash> labels_;  // labels at the corners of subdivided cells
};

// Returns the new number of each leaf after a tree grew, or none if the leaf was subdivided.
std::vector<uint32_t> numbers_after_growth(const std::vector<Leaf>& before, const std::vector<Leaf>& after);

}  // namespace ombre::surface

// Field sources whose values are known at the centres of a lattice's cells.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "design/stage.h"
#include "program/field_source.h"
#include "voxel/lattice.h"

namespace ombre::compile {

using CellIndex = std::array<int64_t, 3>;

// The description of a source on a lattice, without its values.
struct LatticeFrame {
  design::StagePtr stage;
  voxel::Lattice lattice;  // the number of voxels is ignored
  Box box;                 // points beyond it are not flagged
  IndexBox cells;          // all values beyond them are 0
  std::vector<design::StageChannel> channels;
  design::MaterialTable materials;     // of the solids that the stage reads
  std::optional<Hash> made_from = {};  // hash of everything that the values depend on, if a memory keeps them
};

// Reads cells, most often near those that it read before.
class CellReader {
 public:
  virtual ~CellReader() = default;
  // Reads the values of the cells first, first + (1, 0, 0) ..., which all lie in the source's frame().cells.
  virtual void read(size_t channel, const CellIndex& first, std::span<float> values) = 0;
  // Returns the value of the cells first to first + (1, 1, 1), if it is known to be the same for all.
  virtual std::optional<float> same_around(size_t /*channel*/, const CellIndex& /*first*/) { return std::nullopt; }
};

// A source on a lattice. Flags have the value of the nearest centre; other channels are linear along each axis. A
// source with a flag "inside" has a further channel "distance" to the border of the flagged cells whose centres lie in
// the box. It is exact up to one cell away.
class LatticeSource : public program::FieldSource {
 public:
  explicit LatticeSource(LatticeFrame frame);

  std::string name() const override { return frame_.stage->name(); }
  Hash content() const override { return frame_.stage->content(); }
  Box bounds() const override { return frame_.box; }
  int channel(std::string_view channel_name) const override;
  double sample(int channel, Vec3 p) const override;
  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override;
  Interval range(int channel, const Box& box) const override;
  std::unique_ptr<program::RowSampler> rows(int channel, const Affine& source_from_index) const override;

  const LatticeFrame& frame() const { return frame_; }
  // Reads the values of the cells first, first + (1, 0, 0) ..., which all lie in frame().cells.
  virtual void read_cells(size_t channel, const CellIndex& first, std::span<float> values) const = 0;
  virtual std::unique_ptr<CellReader> reader() const;
  // Encloses the values of cells in frame().cells; may be wider than the values to save time.
  virtual Interval range_of_cells(size_t channel, const IndexBox& cells) const = 0;
  // Returns the range that the stage declares for the channel, extended to 0.
  Interval declared_range(size_t channel) const;

 protected:
  // True if range() may look at values, which must be computed by then.
  virtual bool has_values() const { return true; }

 private:
  bool is_distance(int channel) const { return channel == static_cast<int>(frame_.channels.size()); }
  CellIndex cell_of(Vec3 p) const;
  float at(size_t channel, const CellIndex& cell) const;
  bool holds(const CellIndex& cell) const { return at(static_cast<size_t>(inside_), cell) != 0; }
  Box box_of(const CellIndex& cell) const;
  double between_centres(size_t channel, Vec3 p, CellReader& reader) const;
  double in_centres(int axis, double mm) const;
  std::array<float, 2> pair_at(size_t channel, const CellIndex& cell, CellReader& reader) const;
  Interval range_between_centres(size_t channel, const Box& box) const;
  double distance(Vec3 p) const;
  double distance_to_cells(Vec3 p) const;
  Interval range_of_flag(size_t channel, const Box& box) const;

  LatticeFrame frame_;
  Vec3 cell_mm_;
  IndexBox cells_in_box_;  // cells whose centres lie in the box
  int inside_ = -1;        // the channel of that name, if it is a flag; else -1
};

}  // namespace ombre::compile

// Connected parts of a solid and its hollows, found from runs of voxels.
#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "nodes/common/whole_stages.h"

namespace ombre::nodes {
namespace {

using design::StageValues;

// The voxels [begin, end) of a row.
struct AlikeRun {
  int64_t begin = 0, end = 0;
  size_t parent = 0;  // parent in a tree whose root, the part's first run, represents the part
};

// The runs of voxels with the same flag, joined where they share sides.
class AlikeRuns {
 public:
  AlikeRuns(const std::vector<float>& flags, const IndexBox& box, bool wanted, const StopFlag* stop) : box_(box) {
    const auto width = static_cast<size_t>(box.size(0));
    const auto rows = static_cast<size_t>(box.size(1) * box.size(2));
    for (size_t row = 0; row < rows; ++row) {
      design::check_stop(stop);
      first_.push_back(runs_.size());
      add_row(flags.data() + row * width, wanted);
      if (row % static_cast<size_t>(box.size(1)) > 0) join(row, row - 1);
      if (row >= static_cast<size_t>(box.size(1))) join(row, row - static_cast<size_t>(box.size(1)));
    }
    first_.push_back(runs_.size());
  }

  size_t count() const { return runs_.size(); }
  const AlikeRun& run(size_t n) const { return runs_[n]; }
  size_t root(size_t n) const {
    while (runs_[n].parent != n) n = runs_[n].parent;
    return n;
  }
  size_t rows() const { return first_.size() - 1; }
  size_t first(size_t row) const { return first_[row]; }

  // Returns the number of voxels of each part, stored at its root.
  std::vector<int64_t> sizes() const {
    std::vector<int64_t> sizes(runs_.size(), 0);
    for (size_t n = 0; n < runs_.size(); ++n) sizes[root(n)] += runs_[n].end - runs_[n].begin;
    return sizes;
  }

  // Returns the root of the part that contains the voxel, or nothing.
  std::optional<size_t> part_at(const std::array<int64_t, 3>& cell) const {
    for (size_t a = 0; a < 3; ++a)
      if (cell[a] < box_.lo[a] || cell[a] >= box_.hi[a]) return std::nullopt;
    const auto row = static_cast<size_t>((cell[2] - box_.lo[2]) * box_.size(1) + cell[1] - box_.lo[1]);
    const int64_t x = cell[0] - box_.lo[0];
    for (size_t n = first_[row]; n < first_[row + 1]; ++n)
      if (x >= runs_[n].begin && x < runs_[n].end) return root(n);
    return std::nullopt;
  }

 private:
  void add_row(const float* row, bool wanted) {
    const int64_t width = box_.size(0);
    for (int64_t x = 0; x < width;) {
      while (x < width && (row[x] != 0) != wanted) ++x;
      const int64_t begin = x;
      while (x < width && (row[x] != 0) == wanted) ++x;
      if (x > begin) runs_.push_back({begin, x, runs_.size()});
    }
  }

  void join(size_t row, size_t other) {
    size_t a = first_[row], b = first_[other];
    const size_t a_end = runs_.size(), b_end = other + 1 < first_.size() ? first_[other + 1] : runs_.size();
    while (a < a_end && b < b_end) {
      if (runs_[a].begin < runs_[b].end && runs_[b].begin < runs_[a].end) unite(a, b);
      if (runs_[a].end < runs_[b].end)
        ++a;
      else
        ++b;
    }
  }

  // Joins two parts. The root is the part's first run; paths are halved on the way.
  void unite(size_t a, size_t b) {
    const auto shortened = [&](size_t n) {
      while (runs_[n].parent != n) n = runs_[n].parent = runs_[runs_[n].parent].parent;
      return n;
    };
    const size_t x = shortened(a), y = shortened(b);
    runs_[std::max(x, y)].parent = std::min(x, y);
  }

  IndexBox box_;
  std::vector<AlikeRun> runs_;
  std::vector<size_t> first_;  // first run of each row, and the total number of runs
};

double cell_volume(const design::StageLattice& lattice) {
  return lattice.pitch[0].mm() * lattice.pitch[1].mm() * lattice.pitch[2].mm();
}

void flag(const AlikeRuns& runs, const std::vector<char>& chosen, const IndexBox& box, std::vector<float>& flags,
          const StopFlag* stop) {
  for (size_t row = 0; row < runs.rows(); ++row) {
    design::check_stop(stop);
    for (size_t n = runs.first(row); n < runs.first(row + 1); ++n) {
      if (!chosen[runs.root(n)]) continue;
      const auto begin = flags.begin() + static_cast<ptrdiff_t>(static_cast<int64_t>(row) * box.size(0));
      std::fill(begin + runs.run(n).begin, begin + runs.run(n).end, 1.0f);
    }
  }
}

class FlagStage : public design::WholeStage {
 public:
  FlagStage(const design::NodePtr& solid, const std::optional<Vec3>& cell_mm) : solid_(solid), cell_mm_(cell_mm) {}

  Box bounds() const override { return solid_->bounds(design::design_space()); }
  design::LatticeChoice lattice() const override { return {cell_mm_, false}; }
  double bytes_of_cell() const override { return sizeof(AlikeRun); }  // there are at most half as many runs as cells
  std::vector<design::StageRead> reads() const override { return {{.solid = solid_, .inside = true}}; }
  std::vector<design::StageChannel> channels(const std::vector<design::StageChannel>&) const override {
    return {{"inside", {}, 0, true, {0, 1}}};
  }

 private:
  design::NodePtr solid_;
  std::optional<Vec3> cell_mm_;
};

class PartsStage final : public FlagStage {
 public:
  PartsStage(const design::NodePtr& solid, const PartChoice& choice, const std::optional<Vec3>& cell_mm)
      : FlagStage(solid, cell_mm), choice_(choice) {}

  std::string name() const override { return "keep_parts"; }
  Hash content() const override {
    std::string text = "parts " + std::to_string(static_cast<int>(choice_.keep));
    text += ' ' + format_number(choice_.least_mm3);
    for (const Vec3& p : choice_.at)
      for (int axis = 0; axis < 3; ++axis) text += ' ' + format_number(p[axis]);
    return hash_bytes(text);
  }

  void compute(const StageValues& read, StageValues& made, const design::StageLattice& lattice,
               const design::StageWork& work) const override {
    const AlikeRuns runs(read.channel(0), read.box(), true, work.stop);
    flag(runs, chosen(runs, lattice), made.box(), made.channel(0), work.stop);
  }

 private:
  std::vector<char> chosen(const AlikeRuns& runs, const design::StageLattice& lattice) const {
    std::vector<char> flags(runs.count(), 0);
    if (flags.empty()) return flags;
    if (choice_.keep == KeepParts::at) {
      for (const Vec3& p : choice_.at)
        if (const auto part = runs.part_at(cell_of(p, lattice))) flags[*part] = 1;
      return flags;
    }
    const std::vector<int64_t> sizes = runs.sizes();
    if (choice_.keep == KeepParts::largest) {
      flags[static_cast<size_t>(std::ranges::max_element(sizes) - sizes.begin())] = 1;
      return flags;
    }
    for (size_t n = 0; n < sizes.size(); ++n)
      flags[n] = sizes[n] > 0 && static_cast<double>(sizes[n]) * cell_volume(lattice) >= choice_.least_mm3 ? 1 : 0;
    return flags;
  }

  static std::array<int64_t, 3> cell_of(Vec3 p, const design::StageLattice& lattice) {
    std::array<int64_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<size_t>(axis);
      cell[a] = static_cast<int64_t>(std::floor((p[axis] - lattice.origin[axis]) / lattice.pitch[a].mm()));
    }
    return cell;
  }

  PartChoice choice_;
};

class FillStage final : public FlagStage {
 public:
  FillStage(const design::NodePtr& solid, double most_mm3, const std::optional<Vec3>& cell_mm)
      : FlagStage(solid, cell_mm), most_mm3_(most_mm3) {}

  std::string name() const override { return "fill_holes"; }
  Hash content() const override { return hash_bytes("fill " + format_number(most_mm3_)); }

  void compute(const StageValues& read, StageValues& made, const design::StageLattice& lattice,
               const design::StageWork& work) const override {
    const IndexBox& box = read.box();
    const AlikeRuns runs(read.channel(0), box, false, work.stop);
    const std::vector<int64_t> sizes = runs.sizes();
    std::vector<char> filled(runs.count(), 0);
    for (size_t n = 0; n < sizes.size(); ++n)
      filled[n] = static_cast<double>(sizes[n]) * cell_volume(lattice) <= most_mm3_ ? 1 : 0;
    leave_open(runs, box, filled);
    made.channel(0) = read.channel(0);
    flag(runs, filled, box, made.channel(0), work.stop);
  }

 private:
  // Unmarks hollows that reach a side of the box, since they are open.
  static void leave_open(const AlikeRuns& runs, const IndexBox& box, std::vector<char>& filled) {
    const int64_t ny = box.size(1), nz = box.size(2);
    for (size_t row = 0; row < runs.rows(); ++row) {
      const int64_t j = static_cast<int64_t>(row) % ny, k = static_cast<int64_t>(row) / ny;
      const bool is_side = j == 0 || j == ny - 1 || k == 0 || k == nz - 1;
      for (size_t n = runs.first(row); n < runs.first(row + 1); ++n)
        if (is_side || runs.run(n).begin == 0 || runs.run(n).end == box.size(0)) filled[runs.root(n)] = 0;
    }
  }

  double most_mm3_;
};

}  // namespace

design::StagePtr make_parts_stage(const design::NodePtr& solid, const PartChoice& choice,
                                  const std::optional<Vec3>& cell_mm) {
  return std::make_shared<PartsStage>(solid, choice, cell_mm);
}

design::StagePtr make_fill_stage(const design::NodePtr& solid, double most_mm3, const std::optional<Vec3>& cell_mm) {
  return std::make_shared<FillStage>(solid, most_mm3, cell_mm);
}

}  // namespace ombre::nodes

#include "surface/cells/local_programs.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "surface/cells/shortened.h"

namespace ombre::surface {
namespace {

// operations; looking up a shortened program would take as long as shortening this one
constexpr size_t short_enough = 1000;
constexpr size_t many_parts = 32;  // from this number of parts on, they are not unrolled
constexpr int most_halvings = 8;
constexpr double worth_keeping = 0.6;          // greatest share of operations left for a shortened program to be kept
constexpr size_t most_operations = 4'000'000;  // limit for all cells together; about 130 MB
constexpr double slack = 0.25;  // fraction of its side by which a cell's program is valid beyond the cell

}  // namespace

double longest_side(const Box& box) { return std::max({box.size().x, box.size().y, box.size().z}); }

// A hierarchy of cells: halves, quarters and so on of a cube, each with the program for a box slightly larger than
// itself.
class LocalPrograms::Cells {
 public:
  Cells(program::Program whole, const Box& space)
      : whole_(std::move(whole)), origin_(space.lo), side_mm_(longest_side(space)) {}

  const program::Program& whole() const { return whole_; }

  const program::Program& around(const Box& box) {
    const Vec3 middle = box.center() - origin_;
    const double longest = longest_side(box);
    const program::Program* program = &whole_;
    double side = 0.5 * side_mm_;
    for (int halvings = 1; halvings <= most_halvings && program->code.size() > short_enough; ++halvings, side *= 0.5) {
      if (!(0.5 * longest <= slack * side)) break;
      Place place{halvings};
      for (size_t axis = 0; axis < 3; ++axis)
        place[axis + 1] = static_cast<int>(std::floor(middle[static_cast<int>(axis)] / side));
      program = &shortened(place, side, *program);
    }
    return *program;
  }

 private:
  using Place = std::array<int, 4>;  // number of halvings, then the cell's index along each axis
  struct Cell {
    std::once_flag once;
    program::Program program;
    const program::Program* use = nullptr;  // the program of this cell, or that of a larger cell
  };

  const program::Program& shortened(const Place& place, double side, const program::Program& above) {
    Cell& cell = at(place);
    std::call_once(cell.once, [&] {
      const Vec3 low = origin_ + Vec3{place[1] * side, place[2] * side, place[3] * side};
      const Box box{low, low + Vec3{side, side, side}};
      cell.use = &above;
      if (operations_ > most_operations) return;
      program::Program shorter = shortened_for(above, box.expanded(slack * side), many_parts);
      if (static_cast<double>(shorter.code.size()) > worth_keeping * static_cast<double>(above.code.size())) return;
      operations_ += shorter.code.size();
      cell.program = std::move(shorter);
      cell.use = &cell.program;
    });
    return *cell.use;
  }

  Cell& at(const Place& place) {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<Cell>& cell = cells_[place];
    if (!cell) cell = std::make_unique<Cell>();
    return *cell;
  }

  program::Program whole_;
  Vec3 origin_;
  double side_mm_;
  std::atomic<size_t> operations_ = 0;
  std::mutex mutex_;
  std::map<Place, std::unique_ptr<Cell>> cells_;
};

LocalPrograms::LocalPrograms() : LocalPrograms(program::Program(), Box()) {}
LocalPrograms::LocalPrograms(program::Program whole, const Box& space)
    : cells_(std::make_shared<Cells>(std::move(whole), space)) {}

const program::Program& LocalPrograms::whole() const { return cells_->whole(); }
const program::Program& LocalPrograms::around(const Box& box) const { return cells_->around(box); }

}  // namespace ombre::surface

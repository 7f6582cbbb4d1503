#include "render/end_colours.h"

#include <algorithm>

namespace ombre::render {
namespace {

constexpr TileSize together{64, 32, 32};       // steps, columns, rows
constexpr int64_t behind = fine_per_step / 2;  // distance behind a surface at which its colour is taken

// Returns the sort key of an end's group: row, column, then depth. Numbers of films and rays are far smaller than these
// bit fields.
uint64_t group_of(const Ray& end) {
  const auto depth = static_cast<uint64_t>(end.first / (together[0] * fine_per_step));
  const auto column = static_cast<uint64_t>(end.column / together[1]),
             row = static_cast<uint64_t>(end.row / together[2]);
  return row << 42 | column << 21 | depth;
}

// Returns the box around the ends in fine steps.
TileBox around(std::span<const Ray> ends) {
  TileBox fine{{ends[0].first, ends[0].column, ends[0].row}, {}};
  for (const Ray& end : ends) {
    const int64_t first[] = {end.first, end.column, end.row};
    const int64_t last[] = {end.first + behind, end.column, end.row};
    for (size_t axis = 0; axis < 3; ++axis) {
      fine.lo[axis] = std::min(fine.lo[axis], first[axis]);
      fine.hi[axis] = std::max(fine.hi[axis], last[axis] + 1);
    }
  }
  return fine;
}

}  // namespace

void EndColours::take(const voxel::StripSources& sources, const std::function<bool()>& is_stopped) {
  const std::vector<size_t> sizes = sort_by_group();
  std::vector<Group> groups;
  for (auto begin = ends_.cbegin(); const size_t size : sizes) {
    groups.emplace_back(begin, size);
    begin += static_cast<std::ptrdiff_t>(size);
  }
  if (!groups.empty()) take(groups, sources, is_stopped);
  ends_.clear();
}

// Sorts the ends by group and returns the size of each group. Sorting keys is faster than sorting ends.
std::vector<size_t> EndColours::sort_by_group() {
  keys_.clear();
  for (const Ray& end : ends_) keys_.emplace_back(group_of(end), static_cast<uint32_t>(keys_.size()));
  std::ranges::sort(keys_);
  queried_.clear();
  std::vector<size_t> sizes;
  for (size_t n = 0; n < keys_.size(); ++n) {
    if (n == 0 || keys_[n].first != keys_[n - 1].first) sizes.push_back(0);
    ++sizes.back();
    queried_.push_back(ends_[keys_[n].second]);
  }
  ends_.swap(queried_);
  return sizes;
}

void EndColours::take(const std::vector<Group>& groups, const voxel::StripSources& sources,
                      const std::function<bool()>& is_stopped) {
  std::vector<TileBox> boxes;
  for (const Group& group : groups) boxes.push_back(around(group));
  all_.ask(whole_, {around(ends_)}, sources);
  all_.shorten(size_t{0});
  each_.ask(all_.left, boxes, sources);
  for (size_t n = 0; n < groups.size() && !is_stopped(); ++n) {
    each_.shorten(n);
    if (each_.left.has_parts()) each_.write_out_parts();
    take(groups[n], sources);
  }
}

// Takes colours slightly behind the surface if the solid is thick enough: where surfaces of two materials coincide,
// rounding decides which a ray meets first.
void EndColours::take(Group group, const voxel::StripSources& sources) {
  thin_.clear();
  queried_.assign(group.begin(), group.end());
  for (Ray& ray : queried_) ray.first += behind;
  batch_.compile(each_.left, each_.kept, group.size(), sources);
  batch_.evaluate(queried_, 1, 1, true);
  for (size_t n = 0; n < group.size(); ++n) {
    if (batch_.value(Scene::opaque, n, 0) != 0)
      hits_.at(group[n].column, group[n].row).at_end = batch_.colour(n, 0);
    else
      thin_.push_back(group[n]);
  }
  if (thin_.empty()) return;
  batch_.evaluate(thin_, 1, 1, true);
  for (size_t n = 0; n < thin_.size(); ++n) hits_.at(thin_[n].column, thin_[n].row).at_end = batch_.colour(n, 0);
}

}  // namespace ombre::render

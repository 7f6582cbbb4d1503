// Finds the voxels of a row inside of a surface with gaps.
#include "import/surfaces/generalized_rows.h"

#include <algorithm>
#include <cmath>

namespace ombre::importing {
namespace {

using Crossing = RowWinding::Crossing;
using Place = GeneralizedWinding::Place;
using Rule = GeneralizedWinding::Rule;
using program::Span;

void append(std::vector<Span>& spans, int64_t begin, int64_t end) {
  if (begin >= end) return;
  if (!spans.empty() && spans.back().end == begin)
    spans.back().end = end;
  else
    spans.push_back({begin, end});
}

}  // namespace

// Follows a row from piece to piece, with the winding number of the closed surface.
class GeneralizedRows::Row {
 public:
  Row(const GeneralizedWinding& winding, Vec3 origin, Vec3 step, std::span<const Crossing> crossings,
      std::vector<Span>& spans)
      : winding_(winding), origin_(origin), step_(step), crossings_(crossings), spans_(spans) {}

  void fill(int64_t width) {
    winding_.pieces(origin_, step_, 0, width,
                    [&](int64_t begin, int64_t end, const Place& place) { piece(begin, end, place); });
  }

 private:
  void piece(int64_t begin, int64_t end, const Place& place) {
    if (place.rule == Rule::inside) append(spans_, begin, end);
    if (place.rule == Rule::inside || place.rule == Rule::outside) return;
    while (begin < end) {
      while (next_ < crossings_.size() && crossings_[next_].voxel <= begin) whole_ += crossings_[next_++].winding;
      const int64_t stop = next_ < crossings_.size() ? std::min(end, crossings_[next_].voxel) : end;
      if (place.rule == Rule::difference)
        compute(place, begin, stop);
      else if (whole_ != 0)
        append(spans_, begin, stop);
      begin = stop;
    }
  }

  // Computes the voxels [begin, end), which all have the same winding number of the closed surface.
  void compute(const Place& place, int64_t begin, int64_t end) {
    points_.clear();
    for (int64_t i = begin; i < end; ++i) points_.push_back(origin_ + static_cast<double>(i) * step_);
    inside_.resize(points_.size());
    winding_.decide(place, points_, whole_, inside_);
    for (int64_t i = begin; i < end; ++i)
      if (inside_[static_cast<size_t>(i - begin)] != 0) append(spans_, i, i + 1);
  }

  const GeneralizedWinding& winding_;
  Vec3 origin_, step_;
  std::span<const Crossing> crossings_;
  std::vector<Span>& spans_;
  size_t next_ = 0;
  int64_t whole_ = 0;
  std::vector<Vec3> points_;
  std::vector<char> inside_;
};

GeneralizedRows::GeneralizedRows(std::shared_ptr<const GeneralizedWinding> winding, const Affine& source_from_index)
    : winding_(std::move(winding)),
      source_from_index_(source_from_index),
      is_mirrored_(determinant(source_from_index) < 0),
      closed_rows_(winding_->closed(), source_from_index, InsideRule::nonzero) {}

void GeneralizedRows::layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
                            std::vector<std::vector<Span>>& rows) const {
  rows.resize(static_cast<size_t>(std::max<int64_t>(0, j_end - j_begin)));
  for (auto& row : rows) row.clear();
  std::vector<Crossing> crossings;
  closed_rows_.find_crossings(k, j_begin, j_end, width, crossings);
  if (is_mirrored_)
    for (Crossing& crossing : crossings) crossing.winding = -crossing.winding;
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.row != b.row ? a.row < b.row : a.voxel < b.voxel; });
  const Vec3 step = source_from_index_.linear({1, 0, 0});
  auto crossing = crossings.begin();
  for (int64_t j = j_begin; j < j_end; ++j) {
    const auto first = crossing;
    while (crossing != crossings.end() && crossing->row == j) ++crossing;
    const Vec3 origin = source_from_index_({0, static_cast<double>(j), static_cast<double>(k)});
    Row(*winding_, origin, step, {first, crossing}, rows[static_cast<size_t>(j - j_begin)]).fill(width);
  }
}

}  // namespace ombre::importing

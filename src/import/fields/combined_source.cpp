#include "import/fields/combined_source.h"

#include <algorithm>
#include <limits>

#include "base/system/assert.h"
#include "import/fields/channels.h"
#include "import/fields/spans.h"

namespace ombre::importing {
namespace {

using program::FieldSource;
using program::RowSampler;
using program::SourceField;
using Rows = std::vector<Spans>;
using Samplers = std::vector<std::unique_ptr<RowSampler>>;

enum class Operation : uint8_t { unite, intersect, subtract };

// Combines the rows of one channel of several sources.
class CombinedRows final : public RowSampler {
 public:
  CombinedRows(Samplers samplers, Operation operation) : samplers_(std::move(samplers)), operation_(operation) {}

  void layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width, Rows& rows) const override {
    samplers_[0]->layer(k, j_begin, j_end, width, rows);
    Rows others;
    for (size_t n = 1; n < samplers_.size(); ++n) {
      samplers_[n]->layer(k, j_begin, j_end, width, others);
      for (size_t j = 0; j < rows.size(); ++j) combine(rows[j], others[j]);
    }
  }

 private:
  void combine(Spans& row, const Spans& other) const {
    if (operation_ == Operation::intersect) row = intersection(row, other);
    if (operation_ == Operation::subtract) row = difference(row, other);
    if (operation_ != Operation::unite || other.empty()) return;
    row.insert(row.end(), other.begin(), other.end());
    unite(row);
  }

  Samplers samplers_;
  Operation operation_;
};

Hash content_of(const std::vector<SourceField>& sources, Operation operation) {
  std::string all = std::to_string(static_cast<int>(operation));
  for (const SourceField& source : sources) all += source->content().hex();
  return hash_bytes(all);
}

class CombinedSource final : public FieldSource {
 public:
  CombinedSource(std::vector<SourceField> sources, Operation operation)
      : sources_(std::move(sources)), operation_(operation), content_(content_of(sources_, operation)) {
    bounds_ = sources_[0]->bounds();
    for (size_t n = 1; n < sources_.size(); ++n) {
      const Box other = sources_[n]->bounds();
      if (operation == Operation::unite) bounds_ = hull(bounds_, other);
      if (operation == Operation::intersect) bounds_ = intersect(bounds_, other);
    }
  }

  std::string name() const override { return sources_[0]->name(); }
  Hash content() const override { return content_; }
  Box bounds() const override { return bounds_; }

  int channel(std::string_view channel_name) const override {
    const bool all = std::ranges::all_of(sources_, [&](const auto& s) { return s->channel(channel_name) >= 0; });
    return all ? channel_of(channel_name) : -1;
  }

  double sample(int channel, Vec3 p) const override {
    if (channel == inside_channel) return inside(p) ? 1 : 0;
    double value = distance(0, p);
    for (size_t n = 1; n < sources_.size(); ++n) {
      const double other = distance(n, p);
      value = operation_ == Operation::unite       ? std::min(value, other)
              : operation_ == Operation::intersect ? std::max(value, other)
                                                   : std::max(value, -other);
    }
    return value;
  }

  Interval range(int channel, const Box& box) const override {
    const bool is_distance = channel == distance_channel;
    Interval value = range_of(0, channel, box);
    for (size_t n = 1; n < sources_.size(); ++n) {
      const Interval other = range_of(n, channel, box);
      if (operation_ == Operation::unite)
        value = is_distance ? least(value, other) : greatest(value, other);
      else if (operation_ == Operation::intersect)
        value = is_distance ? greatest(value, other) : least(value, other);
      else
        value = is_distance ? greatest(value, {-other.hi, -other.lo}) : least(value, {1 - other.hi, 1 - other.lo});
    }
    return value;
  }

  std::unique_ptr<RowSampler> rows(int channel, const Affine& source_from_index) const override {
    return combined(channel, [&](const FieldSource& source, int own) { return source.rows(own, source_from_index); });
  }

  std::unique_ptr<RowSampler> rays(int channel, const program::RayLattice& rays,
                                   const Affine& source_from_view) const override {
    return combined(channel,
                    [&](const FieldSource& source, int own) { return source.rays(own, rays, source_from_view); });
  }

 private:
  static Interval least(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)}; }
  static Interval greatest(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }

  int own_channel(size_t n, int channel) const {
    return sources_[n]->channel(channel == inside_channel ? "inside" : "distance");
  }
  double distance(size_t n, Vec3 p) const { return sources_[n]->sample(own_channel(n, distance_channel), p); }
  bool holds(size_t n, Vec3 p) const { return sources_[n]->sample(own_channel(n, inside_channel), p) != 0; }
  Interval range_of(size_t n, int channel, const Box& box) const {
    return sources_[n]->range(own_channel(n, channel), box);
  }

  bool inside(Vec3 p) const {
    if (!bounds_.contains(p)) return false;
    for (size_t n = 0; n < sources_.size(); ++n) {
      const bool held = holds(n, p);
      if (operation_ == Operation::unite && held) return true;
      if (operation_ == Operation::intersect && !held) return false;
      if (operation_ == Operation::subtract && held != (n == 0)) return false;
    }
    return operation_ != Operation::unite;
  }

  // Returns combined rows, or null if one of the sources has none.
  template <class Sampler>
  std::unique_ptr<RowSampler> combined(int channel, const Sampler& sampler_of) const {
    if (channel != inside_channel) return nullptr;
    Samplers samplers;
    for (size_t n = 0; n < sources_.size(); ++n) {
      samplers.push_back(sampler_of(*sources_[n], own_channel(n, channel)));
      if (!samplers.back()) return nullptr;
    }
    return std::make_unique<CombinedRows>(std::move(samplers), operation_);
  }

  std::vector<SourceField> sources_;
  Operation operation_;
  Hash content_;
  Box bounds_;
};

}  // namespace

SourceField make_union_source(std::vector<SourceField> sources) {
  ASSERT(!sources.empty());
  if (sources.size() == 1) return sources[0];
  return std::make_shared<CombinedSource>(std::move(sources), Operation::unite);
}

SourceField make_clipped_source(SourceField source, SourceField by, bool keeps_inside) {
  const Operation operation = keeps_inside ? Operation::intersect : Operation::subtract;
  return std::make_shared<CombinedSource>(std::vector{std::move(source), std::move(by)}, operation);
}

}  // namespace ombre::importing

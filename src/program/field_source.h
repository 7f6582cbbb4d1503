// Field sources: how anything not written in ops (meshes, volumes, results) enters a program.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/math/box.h"
#include "base/math/index_box.h"
#include "base/system/hash.h"
#include "base/text/data.h"

namespace ombre::program {

// Voxels [begin, end) of a row.
struct Span {
  int64_t begin = 0, end = 0;
  bool operator==(const Span&) const = default;
};

// What a channel of a source is along the voxels' rows, for one placement of the source on one voxel lattice.
// Thread-safe.
class RowSampler {
 public:
  virtual ~RowSampler() = default;
  // For channels that are 1 or 0, rows[j - j_begin] gets the spans of row j of layer k that lie in [0, width) and are
  // 1: sorted, disjoint, not empty.
  virtual void layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
                     std::vector<std::vector<Span>>& rows) const = 0;
  // Other channels have values in place of spans; the two methods below are theirs alone.
  virtual bool has_values() const { return false; }
  // Gives the values of the voxels from (i, j, k) on, along x.
  virtual void values(int64_t /*i*/, int64_t /*j*/, int64_t /*k*/, std::span<float> /*values*/) const {}
  // Encloses the values in a box.
  virtual Interval range(const IndexBox&) const { return Interval::everything(); }
};

// A sampler of a channel with values.
class ValueSampler : public RowSampler {
 public:
  void layer(int64_t, int64_t, int64_t, int64_t, std::vector<std::vector<Span>>&) const final {}
  bool has_values() const final { return true; }
  void values(int64_t i, int64_t j, int64_t k, std::span<float> values) const override = 0;
  Interval range(const IndexBox& box) const override = 0;
};

// Rows that meet in an eye, as the rays of a picture do. Voxel (i, j, k) has its centre at i * step + first: a depth
// behind the picture plane, and the place (right, down) where its ray meets that plane. All in mm of a space whose
// origin lies in the picture plane, with the eye at the depth -eye_mm.
struct RayLattice {
  double eye_mm = 0;
  Vec3 first, step;
};

// A source has channels, each a scalar field over its own space (mm). Thread-safe once built;
// what is expensive and not always needed (a search tree) is built on first use.
class FieldSource : public HostObject {
 public:
  virtual std::string name() const = 0;  // for messages
  virtual Hash content() const = 0;      // of the bytes it was read from, and of the options that matter
  virtual Box bounds() const = 0;        // outside of it, nothing is inside
  virtual int channel(std::string_view channel_name) const = 0;  // -1: there is none of that name
  virtual double sample(int channel, Vec3 p) const = 0;
  // The same at many points, to the last bit. Points next to each other in the list may be so in space, which some
  // sources answer more quickly.
  virtual void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const {
    for (size_t n = 0; n < points.size(); ++n) values[n] = sample(channel, points[n]);
  }
  // Several channels at once, for which a source may find its place only once; values[c] has room for all points. The
  // bits are those of sample_all.
  virtual void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                               std::span<double* const> values) const {
    for (size_t c = 0; c < channels.size(); ++c) sample_all(channels[c], points, {values[c], points.size()});
  }
  virtual Interval range(int, const Box&) const { return Interval::everything(); }
  // About what a sample costs beside an op, so that tiles are cut where ranges spare samples.
  virtual double ops_of_sample(int) const { return 1; }
  // Gives exact row spans of a channel that is 1 inside and 0 outside, and values of others where they need no
  // rounding, under an affine map from index coordinates (voxel (i, j, k) has its centre at index (i, j, k)) to the
  // source's space. Null if the source cannot.
  virtual std::unique_ptr<RowSampler> rows(int, const Affine& /*source_from_index*/) const { return nullptr; }
  // The same for rays; nothing is said of what lies within a two-hundredth of the way from the eye to the picture
  // plane.
  virtual std::unique_ptr<RowSampler> rays(int, const RayLattice&, const Affine& /*source_from_view*/) const {
    return nullptr;
  }
};

using SourceField = std::shared_ptr<const FieldSource>;

}  // namespace ombre::program

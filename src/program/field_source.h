// Field sources: values that are not computed by ops (meshes, volumes, results) enter a program through them.
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

// The voxels [begin, end) of a row.
struct Span {
  int64_t begin = 0, end = 0;
  bool operator==(const Span&) const = default;
};

// Samples a channel of a source along rows of voxels, for one placement of the source on one voxel lattice.
// Thread-safe.
class RowSampler {
 public:
  virtual ~RowSampler() = default;
  // Handles channels whose values are 1 or 0. Sets rows[j - j_begin] to the spans of row j of layer k where the value
  // is 1. The spans lie in [0, width), are sorted and disjoint, and none is empty.
  virtual void layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
                     std::vector<std::vector<Span>>& rows) const = 0;
  // True for channels that have values instead of spans; the two methods below apply only to them.
  virtual bool has_values() const { return false; }
  // Writes the values of the voxels from (i, j, k) on, along x.
  virtual void values(int64_t /*i*/, int64_t /*j*/, int64_t /*k*/, std::span<float> /*values*/) const {}
  // Returns an interval that encloses the values in a box of voxels.
  virtual Interval range(const IndexBox&) const { return Interval::everything(); }
};

// A sampler of a channel that has values instead of spans.
class ValueSampler : public RowSampler {
 public:
  void layer(int64_t, int64_t, int64_t, int64_t, std::vector<std::vector<Span>>&) const final {}
  bool has_values() const final { return true; }
  void values(int64_t i, int64_t j, int64_t k, std::span<float> values) const override = 0;
  Interval range(const IndexBox& box) const override = 0;
};

// A lattice whose rows are rays that meet in an eye point, as in perspective pictures. Voxel (i, j, k) has its centre
// at i * step + first, which gives a depth behind the picture plane and the position (right, down) where its ray meets
// that plane. All lengths are in mm, in a space whose origin lies in the picture plane, with the eye at depth -eye_mm.
struct RayLattice {
  double eye_mm = 0;
  Vec3 first, step;
};

// A source has channels, each of which is a scalar field over the source's own space (mm). Sources are thread-safe once
// built. Expensive data that is not always needed, such as a search tree, is built on first use.
class FieldSource : public HostObject {
 public:
  virtual std::string name() const = 0;  // name for messages
  virtual Hash content() const = 0;      // hash of the bytes it was read from and of the options that matter
  virtual Box bounds() const = 0;        // nothing is inside beyond this box
  virtual int channel(std::string_view channel_name) const = 0;  // -1 if there is no such channel
  virtual double sample(int channel, Vec3 p) const = 0;
  // Samples at many points, with results that are bit-identical to sample(). Some sources are faster if consecutive
  // points are near each other.
  virtual void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const {
    for (size_t n = 0; n < points.size(); ++n) values[n] = sample(channel, points[n]);
  }
  // Samples several channels at once, for which a source may have to locate each point only once. values[c] has room
  // for all points. Results are bit-identical to those of sample_all.
  virtual void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                               std::span<double* const> values) const {
    for (size_t c = 0; c < channels.size(); ++c) sample_all(channels[c], points, {values[c], points.size()});
  }
  virtual Interval range(int, const Box&) const { return Interval::everything(); }
  // Returns the approximate cost of a sample, in ops. Tiles are subdivided where ranges can save such samples.
  virtual double ops_of_sample(int) const { return 1; }
  // Returns a sampler for a lattice that is mapped to the source's space by an affine map from index coordinates, where
  // voxel (i, j, k) has its centre at (i, j, k). It gives exact spans of a channel that is 1 inside and 0 outside, and
  // values of other channels if these need no rounding. Returns null if the source cannot do that.
  virtual std::unique_ptr<RowSampler> rows(int, const Affine& /*source_from_index*/) const { return nullptr; }
  // Returns a sampler for rays, or null. Results closer to the eye than a two-hundredth of the distance from the eye to
  // the picture plane are undefined.
  virtual std::unique_ptr<RowSampler> rays(int, const RayLattice&, const Affine& /*source_from_view*/) const {
    return nullptr;
  }
};

// A source that is named and hashed when it is made.
class NamedSource : public FieldSource {
 public:
  std::string name() const final { return name_; }
  Hash content() const final { return content_; }

 protected:
  NamedSource(std::string name, const Hash& content) : name_(std::move(name)), content_(content) {}

 private:
  std::string name_;
  Hash content_;
};

using SourceField = std::shared_ptr<const FieldSource>;

}  // namespace ombre::program

// Reads the images of a layer back into voxels.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "jobs/slice/slice_request.h"
#include "jobs/stacks/findings.h"
#include "stores/journal.h"

namespace ombre::compile {

// The voxels of a channel in a box as images show them, x fastest, then y. A material is the id of the first one with
// the same pixels, and void is 0. A number is its shade, and a colour is red, green, blue and alpha, 8 bits each.
using Shown = std::vector<uint32_t>;

// Stands for a pixel that shows nothing of the job.
inline constexpr uint32_t shows_nothing = UINT32_MAX;

// Tells which materials the images of a job can tell apart.
class Appearance {
 public:
  explicit Appearance(const SliceRequest& request);

  uint32_t of(MaterialId id) const { return of_[id]; }
  // Returns names of materials that have the pixels of an earlier one, or of void.
  const std::vector<std::string>& hidden() const { return hidden_; }

 private:
  std::array<uint32_t, 256> of_{};
  std::vector<std::string> hidden_;
};

// Returns what images of this job would show of the pixels of a channel.
Shown shown_of(const voxel::ChannelPixels& pixels, voxel::ChannelType type, const Appearance& appearance);

// Thread-safe.
class LayerReader {
 public:
  explicit LayerReader(const SliceRequest& request) : request_(request), appearance_(request) {}

  const Appearance& appearance() const { return appearance_; }
  // Reads the files of a layer, whose names and bytes are given, channel by channel. Adds what is wrong with them.
  // Returns nothing if one of them cannot be read, or has another size.
  std::optional<std::vector<Shown>> read(int64_t layer, const std::vector<std::string>& names,
                                         const std::vector<std::string>& bytes, Findings& findings) const;
  // Returns what a layer without files shows.
  std::vector<Shown> blank() const;
  // Adds a finding for each count of the layer's line in the journal that its images do not have.
  void compare_counts(const std::vector<Shown>& channels, const stores::Entry& entry, Findings& findings) const;
  // Returns the voxels of each of the job's materials and other channels that images tell apart.
  std::vector<uint64_t> counts(const std::vector<Shown>& channels) const;
  // Returns the names of what is counted.
  std::vector<std::string> counted() const;
  // Adds stated counts of materials to those of materials with the same pixels.
  std::vector<uint64_t> seen_together(const std::vector<uint64_t>& stated) const;

 private:
  size_t voxels() const;

  const SliceRequest& request_;
  Appearance appearance_;
};

}  // namespace ombre::compile

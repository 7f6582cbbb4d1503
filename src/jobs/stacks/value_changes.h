// Compares two stacks that show values, voxel by voxel and channel by channel.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/math/index_box.h"
#include "jobs/stacks/compared_solid.h"
#include "jobs/stacks/material_changes.h"

namespace ombre::compile {

// The differences in a channel. Those of numbers have their unit, those of colours are shades of the component that
// differs most.
struct ValueChange {
  voxel::Channel channel;  // of the first stack
  uint64_t voxels = 0;     // that differ
  double greatest = 0, sum = 0;
  std::array<int64_t, 3> where{};  // the first voxel with the greatest difference
  IndexBox box;                    // of the voxels that differ

  double mean() const { return voxels > 0 ? sum / static_cast<double>(voxels) : 0; }
};

struct ValueChanges {
  std::vector<ValueChange> channels;
  std::vector<LayerChanges> layers;  // that differ in some channel, the worst one first
};

// Throws Error unless the stacks show the same values.
void check_same_channels(const ComparedSource& a, const ComparedSource& b);

// Compares all layers of the lattice. Numbers in channels of other ranges or bits are the same if both may stand for
// one. Throws Error and Cancelled.
ValueChanges value_changes(const ComparedValues& a, const ComparedValues& b, const voxel::Lattice& lattice,
                           const CheckWork& work);

// Returns a picture of a layer of the first channel in grays: what the second stack has less of is red, what it has
// more of blue, and other colours are orange.
std::string picture_of_values(const ComparedValues& a, const ComparedValues& b, const voxel::Lattice& lattice,
                              int64_t layer);

}  // namespace ombre::compile

// A design or a stack, whose materials are read on a lattice that it shares with another one.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/stacks/design_voxels.h"
#include "jobs/stacks/stack_checks.h"

namespace ombre::compile {

// A design or a stack before it has a lattice.
struct ComparedSource {
  std::string path;
  LoadedPtr design;                    // null for a stack
  std::shared_ptr<const Stack> stack;  // null for a design
  Box box;
};

// True if the path is the folder or the archive of a slice job.
bool is_stack(const std::string& path);
ComparedSource compared_stack(const std::string& path);
// Returns nothing, and adds diagnostics, if the design is empty or has no bounds.
std::optional<ComparedSource> compared_design(const LoadedPtr& loaded, Diagnostics& diagnostics);

// The lattice and the rules of a comparison. A stack that is the only one, or like the other one, gives its own.
struct CommonLattice {
  Sampling sampling;        // of designs; its materials are unused
  bool keeps_draws = true;  // false if mixtures of a stack's design are drawn anew, since the box is larger
};
CommonLattice common_lattice(const ComparedSource& a, const ComparedSource& b,
                             const std::array<std::optional<Pitch>, 3>& pitch);

// A solid on the lattice. Thread-safe.
struct ComparedSolid {
  std::vector<SliceMaterial> materials;
  std::function<Shown(int64_t layer)> layer;  // ids of materials; throws Error for layers that cannot be read
};
// Returns nothing, and adds diagnostics, if the design is wrong. A stack has to show materials. Throws Cancelled.
std::optional<ComparedSolid> compared_solid(const ComparedSource& source, const CommonLattice& common,
                                            const CheckWork& work, Diagnostics& diagnostics);

// The channels of a stack, on a lattice that it shares with another one. Thread-safe.
struct ComparedValues {
  std::vector<voxel::Channel> channels;
  std::function<std::vector<Shown>(int64_t layer)> layer;  // throws Error for layers that cannot be read
};
ComparedValues compared_values(const std::shared_ptr<const Stack>& stack, const voxel::Lattice& common);

}  // namespace ombre::compile

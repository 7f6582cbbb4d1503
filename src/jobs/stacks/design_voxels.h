// Evaluates a design on the lattice of a stack.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/text/diagnostic.h"
#include "jobs/slice/slice_request.h"
#include "load/loaded.h"
#include "questions/build.h"
#include "stages/job_stages.h"

namespace ombre::compile {

// Returns the lattice of the whole job, of which a stack may be a part.
voxel::Lattice whole_lattice(const Sampling& sampling);

// Thread-safe once it is made.
class DesignVoxels {
 public:
  // Makes the programs of a design for the lattice, channels and rules of a job, and computes its stages. `whole` is
  // the lattice of the whole job. Returns null, and adds diagnostics, if the design is wrong. Throws Cancelled.
  static std::shared_ptr<const DesignVoxels> make(const LoadedPtr& loaded, const Sampling& sampling,
                                                  const voxel::Lattice& whole, const StageLoan& loan,
                                                  Diagnostics& diagnostics);

  // Returns the materials that the design can have somewhere in the lattice.
  std::vector<SliceMaterial> materials() const;
  // Makes boxes of the stack's voxels. Values are taken this far from the centres of voxels, mm.
  RegionProducer voxels(voxel::Evaluator evaluator, Vec3 beside = {}) const;
  // Makes boxes of the fractions of these materials, by the reference: a channel for each, whose last shade is 1.
  RegionProducer fractions(const std::vector<SliceMaterial>& materials) const;

 private:
  DesignVoxels() = default;
  RegionProducer values(const voxel::Lattice& lattice, const std::vector<voxel::Channel>& channels,
                        voxel::Evaluator evaluator) const;

  LoadedPtr loaded_;
  Sampling sampling_;
  voxel::Lattice whole_;
  design::Design design_;
  std::optional<Built> built_;  // of jobs of materials
};

}  // namespace ombre::compile

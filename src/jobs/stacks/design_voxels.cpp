#include "jobs/stacks/design_voxels.h"

#include "jobs/slice/value_layers.h"
#include "questions/design_stages.h"

namespace ombre::compile {
namespace {

// Returns a producer of voxels that are counted from the least voxel of a part of a job.
RegionProducer in_part(const Sampling& sampling, RegionProducer whole) {
  if (!sampling.part) return whole;
  return [first = sampling.part->first, whole = std::move(whole)](voxel::TileBox box, const StopFlag* stop) {
    for (size_t axis = 0; axis < 3; ++axis) {
      box.lo[axis] += first[axis];
      box.hi[axis] += first[axis];
    }
    return whole(box, stop);
  };
}

}  // namespace

voxel::Lattice whole_lattice(const Sampling& sampling) {
  voxel::Lattice whole = sampling.lattice;
  if (!sampling.part) return whole;
  whole.count = sampling.part->count;
  for (size_t axis = 0; axis < 3; ++axis)
    whole.origin[static_cast<int>(axis)] -= whole.pitch[axis].times(static_cast<double>(sampling.part->first[axis]));
  return whole;
}

std::shared_ptr<const DesignVoxels> DesignVoxels::make(const LoadedPtr& loaded, const Sampling& sampling,
                                                       const voxel::Lattice& whole, const StageLoan& loan,
                                                       Diagnostics& diagnostics) {
  const std::shared_ptr<DesignVoxels> made(new DesignVoxels());
  made->loaded_ = loaded;
  made->sampling_ = sampling;
  made->whole_ = whole;
  made->design_ = with_stages(design::for_lattice(loaded->design, {whole.origin, whole.pitch}), loan);
  if (sampling.has_materials()) {
    made->built_ = build_flat_program(made->design_, diagnostics, loan.threads);
    if (!made->built_) return nullptr;
    leave_out_impossible(*made->built_, whole.box(), loan.threads);
  } else if (!value_layers(made->design_, whole, sampling.channels, voxel::Evaluator::reference, diagnostics)) {
    return nullptr;
  }
  stages_of(made->design_)->prepare(loan);
  return made;
}

std::vector<SliceMaterial> DesignVoxels::materials() const {
  std::vector<SliceMaterial> materials;
  if (!built_) return materials;
  for (const MaterialId id : built_->materials.materials) {
    const design::Material& material = design_.materials.all()[id];
    if (id != 0) materials.push_back({material.name, id, material.colour});
  }
  return materials;
}

RegionProducer DesignVoxels::voxels(voxel::Evaluator evaluator, Vec3 beside) const {
  voxel::Lattice lattice = whole_;
  lattice.origin = lattice.origin + beside;
  if (!built_) return in_part(sampling_, values(lattice, sampling_.channels, evaluator));
  voxel::EvaluatorOptions how;
  how.evaluator = evaluator;
  const auto layers =
      std::make_shared<const voxel::LayerEvaluator>(built_->materials, lattice, sampling_.dither, sampling_.seed, how);
  return in_part(sampling_,
                 [layers](const voxel::TileBox& box, const StopFlag* stop) { return layers->region(box, stop); });
}

RegionProducer DesignVoxels::fractions(const std::vector<SliceMaterial>& materials) const {
  std::vector<voxel::Channel> channels;
  for (const SliceMaterial& material : materials)
    channels.push_back({material.name, voxel::ChannelType::dose16, "", {0, 1}});
  return in_part(sampling_, values(whole_, channels, voxel::Evaluator::reference));
}

RegionProducer DesignVoxels::values(const voxel::Lattice& lattice, const std::vector<voxel::Channel>& channels,
                                    voxel::Evaluator evaluator) const {
  Diagnostics diagnostics;
  auto regions = value_layers(design_, lattice, channels, evaluator, diagnostics);
  if (!regions) throw error_of(diagnostics);
  return std::move(*regions);
}

}  // namespace ombre::compile

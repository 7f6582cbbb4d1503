// Base of stages that filter a solid's voxels.
#pragma once

#include "nodes/common/filter_stages.h"
#include "nodes/stages/box_sum.h"

namespace ombre::nodes {

// Reads fractions, attributes and "inside", in this order, as far as they are filtered. Its channels are the materials,
// "share" and the attributes.
class FilterStage : public design::HaloStage {
 public:
  FilterStage(const design::NodePtr& solid, FilterUse use) : solid_(solid), use_(std::move(use)) {}

  Box bounds() const override { return solid_->bounds(design::design_space()); }
  design::LatticeChoice lattice() const override { return {use_.cell_mm, false}; }
  std::vector<design::StageRead> reads() const override;
  std::vector<design::StageChannel> channels(const std::vector<design::StageChannel>& read) const override;

 protected:
  virtual Interval material_range() const { return {0, 1}; }
  virtual Interval share_range() const { return {0, 1}; }

  const FilterUse& use() const { return use_; }
  Hash hash_with(const std::string& key) const;

  // These functions return numbers of channels.
  size_t fractions(const design::StageValues& read) const { return read.channels() - 1 - use_.attributes.size(); }
  size_t attribute(const design::StageValues& read, size_t n) const { return fractions(read) + n; }
  static size_t inside(const design::StageValues& read) { return read.channels() - 1; }
  size_t made_share(const design::StageValues& made) const { return made.channels() - 1 - use_.attributes.size(); }
  size_t made_attribute(const design::StageValues& made, size_t n) const { return made_share(made) + 1 + n; }
  // Void is the solid's first material if the solid contains void; otherwise it comes after the materials.
  size_t made_void(const design::StageValues& read, const design::StageValues& made) const {
    return made_share(made) == fractions(read) ? 0 : fractions(read);
  }

  design::NodePtr solid_;

 private:
  FilterUse use_;
};

}  // namespace ombre::nodes

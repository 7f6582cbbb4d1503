// Helpers for nodes with stages.
#pragma once

#include "design/node.h"
#include "design/stage.h"

namespace ombre::nodes {

inline constexpr const char* about_pitch = "Size of the voxels; none: that of the job's voxels";

// Returns the value of a channel of the stage's source at the point.
inline program::Field read_channel(const design::Inputs& in, const design::StagePtr& stage, const std::string& channel,
                                   const program::Point& p) {
  const program::SourceField source = in.staged(stage);
  return p.builder().source(source, source->channel(channel), p.x, p.y, p.z);
}

// Returns false and adds a diagnostic if the stage reads all voxels but its solid is unbounded.
inline bool is_bounded(const design::Reader& reader, const design::StagePtr& stage) {
  const Box box = stage->bounds();
  if (box.is_empty() || length(box.size()) < 2 * design::design_limit_mm) return true;
  reader.diagnostics.error(Code::unbounded, reader.where, std::string(reader.node) + " needs a solid that ends",
                           "intersect it with a box first");
  return false;
}

// The solid that a stage flags as "inside". Its materials are those of the child at the point, or at the nearest point
// of the child.
struct StagedSolid {
  design::StagePtr stage;

  design::Metric metric() const { return design::Metric::bounded(); }
  Box reach(const design::Inputs&, const Box& where, double margin) const {
    const Box box = stage->bounds();
    return box.is_empty() ? box : intersect(box.expanded(margin), where);
  }
  program::Field distance(const design::Inputs& in, const program::Point& p) const {
    return read_channel(in, stage, "distance", p);
  }
  program::Field membership(const design::Inputs& in, const program::Point& p, design::Border) const {
    return truth(read_channel(in, stage, "inside", p));
  }
  design::Composition composition(const design::Inputs& in, const program::Point& p, design::Demand) const {
    return in.composition(0, p, design::Demand::everywhere);
  }
};

}  // namespace ombre::nodes

// Solids computed from all voxels of another: its parts, filled hollows, distances.
#include "base/text/text.h"
#include "design/spec.h"
#include "nodes/common/shapes.h"
#include "nodes/common/stage_fields.h"
#include "nodes/common/whole_stages.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct KeepPartsOf : StagedSolid {
  Choice keep = "largest";
  double volume = 0;
  Vec3 at;
  Points seeds;
  std::optional<Vec3> pitch;

  static Spec<KeepPartsOf> spec() {
    return {
        "keep_parts",
        "Keeps the largest part of its child, all parts that are large enough, or the parts at given points.",
        {{"keep", &KeepPartsOf::keep,
          "Parts to keep: the largest, those above a volume, or those at points. Voxels that share a side belong "
          "together",
          one_of({"largest", "above", "at"})},
         {"volume", &KeepPartsOf::volume, "Least volume of the parts that are kept by \"above\"", not_negative("mm3")},
         {"at", &KeepPartsOf::at, "A point of the part that is kept by \"at\"", unit::point},
         {"seeds", &KeepPartsOf::seeds, "In place of `at`: points of the parts that are kept by \"at\"", unit::points},
         {"pitch", &KeepPartsOf::pitch, about_pitch, unit::positive_mm}},
        one_solid,
        "keep_parts() union() { sphere(4, \"red\"); translate(8, 0, 0) sphere(2, \"red\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    const KeepParts what = keep == "largest" ? KeepParts::largest : keep == "above" ? KeepParts::above : KeepParts::at;
    stage = make_parts_stage(inputs[0], {what, volume, seeds.at.empty() ? std::vector{at} : seeds.at}, pitch);
    return is_bounded(reader, stage);
  }
};

struct FillHoles : StagedSolid {
  double volume = 1e18;
  std::optional<Vec3> pitch;

  static Spec<FillHoles> spec() {
    return {"fill_holes",
            "Fills the hollows of its child that are closed on all sides.",
            {{"volume", &FillHoles::volume, "Greatest volume of a hollow that is filled", not_negative("mm3")},
             {"pitch", &FillHoles::pitch, about_pitch, unit::positive_mm}},
            one_solid,
            "fill_holes() difference() { sphere(5, \"red\"); sphere(3); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    stage = make_fill_stage(inputs[0], volume, pitch);
    return is_bounded(reader, stage);
  }
};

struct Redistance {
  double margin = 2;
  std::optional<Vec3> pitch;
  StagePtr stage;

  static Spec<Redistance> spec() {
    return {
        "redistance",
        "Gives a child without distances in mm (a scan, a formula) such distances, which offset, shell and blends "
        "need.",
        {{"margin", &Redistance::margin, "Distance from the child up to which distances are known", positive("mm")},
         {"pitch", &Redistance::pitch, about_pitch, unit::positive_mm}},
        one_solid,
        "offset(1) redistance(3, pitch=(0.25, 0.25, 0.25)) function(\"x*x + y*y + z*z - 16\", \"red\", min=(-4, -4, "
        "-4), max=(4, 4, 4));"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    stage = make_distance_stage(inputs[0], pitch, 2 * margin);
    return is_bounded(reader, stage);
  }

  Metric metric() const { return Metric::bounded(); }
  Box reach(const Inputs& in, const Box& where, double distance_mm) const {
    const Box box = in.bounds(0, design_space());
    return box.is_empty() ? box : intersect(box.expanded(distance_mm), where);
  }
  // Farther away, the distance to the box around the child is a lower bound.
  Field distance(const Inputs& in, const Point& p) const {
    const Box box = in.input(0).bounds(design_space());
    if (box.is_empty()) return p.constant(Box::inf);
    const Vec3 c = box.center(), h = 0.5 * box.size();
    const Field from_box = corner(abs(p.x - c.x) - h.x, abs(p.y - c.y) - h.y, abs(p.z - c.z) - h.z);
    const Field is_near = less_equal(from_box, p.constant(margin)), known = truth(read_channel(in, stage, "known", p));
    return select(logical_and(is_near, known), read_channel(in, stage, "sdf", p), max(from_box, margin));
  }
};

}  // namespace

void add_whole_solids(Registry& registry) { registry.add<KeepPartsOf, FillHoles, Redistance>("voxel shapes"); }

}  // namespace ombre::nodes

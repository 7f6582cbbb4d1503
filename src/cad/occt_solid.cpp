// One solid of Open CASCADE: what is asked of it.
#ifdef OMBRE_CAD

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <cmath>
#include <mutex>

#include "cad/occt_guard.h"
#include "cad/occt_shapes.h"
#include "cad/occt_triangles.h"

namespace ombre::cad {
namespace {

// Facets turn by no more than so many radians along a curve, so that small roundings keep their shape.
constexpr double facet_angle = 0.5;
// Points so close to the surface lie on it; mm.
constexpr double surface_tolerance = 1e-9;

TopoDS_Shape copy_of(const TopoDS_Shape& shape, bool with_geometry) {
  return BRepBuilderAPI_Copy(shape, with_geometry, false).Shape();
}

// The faces alone: a solid is at no distance from what is inside.
TopoDS_Shape skin_of(const TopoDS_Shape& solid) {
  TopoDS_Compound skin;
  const BRep_Builder builder;
  builder.MakeCompound(skin);
  for (TopExp_Explorer e(solid, TopAbs_FACE); e.More(); e.Next()) builder.Add(skin, e.Current());
  return skin;
}

class OcctQuery final : public Query {
 public:
  explicit OcctQuery(const TopoDS_Shape& shape, std::string what)
      : what_(std::move(what)), classifier_(shape), skin_(skin_of(shape)) {
    distance_.LoadS2(skin_);
  }

  bool is_inside(Vec3 p) override {
    return guarded(what_, [&] {
      classifier_.Perform(gp_Pnt(p.x, p.y, p.z), surface_tolerance);
      return classifier_.State() == TopAbs_IN || classifier_.State() == TopAbs_ON;
    });
  }

  double surface_distance(Vec3 p) override {
    return guarded(what_, [&] {
      distance_.LoadS1(BRepBuilderAPI_MakeVertex(gp_Pnt(p.x, p.y, p.z)));
      if (!distance_.Perform()) throw Error(what_ + ": the distance to its surface cannot be found");
      return distance_.Value();
    });
  }

 private:
  std::string what_;
  BRepClass3d_SolidClassifier classifier_;
  TopoDS_Shape skin_;
  BRepExtrema_DistShapeShape distance_;
};

class OcctSolid final : public Solid {
 public:
  explicit OcctSolid(const NamedShape& named) : shape_(named.shape) {
    name = named.name;
    colour = named.colour;
    volume_mm3 = volume();
    // Of mirrored instances, too, the faces turn inwards.
    if (volume_mm3 < 0) {
      shape_.Reverse();
      volume_mm3 = -volume_mm3;
    }
    find_bounds();
  }

  // On a copy: a mesh that is there would be kept where it is fine enough.
  Triangles triangulate(double deflection_mm) const override {
    const std::lock_guard lock(mutex_);
    return guarded(what(), [&] {
      const TopoDS_Shape copy = copy_of(shape_, false);
      const BRepMesh_IncrementalMesh mesh(copy, deflection_mm, false, facet_angle, false);
      return triangles_of(copy, what());
    });
  }

  // With geometry of its own: the library's surfaces remember what they were asked last.
  std::unique_ptr<Query> query() const override {
    const std::lock_guard lock(mutex_);
    return guarded(what(), [&] { return std::make_unique<OcctQuery>(copy_of(shape_, true), what()); });
  }

 private:
  std::string what() const { return name.empty() ? "the CAD solid" : "the CAD solid \"" + name + '"'; }

  double volume() const {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape_, properties);
    return properties.Mass();
  }

  void find_bounds() {
    Bnd_Box box;
    box.SetGap(0);
    BRepBndLib::AddOptimal(shape_, box, false, false);
    box.Get(bounds.lo.x, bounds.lo.y, bounds.lo.z, bounds.hi.x, bounds.hi.y, bounds.hi.z);
    for (int axis = 0; axis < 3; ++axis) {
      bounds.lo[axis] = without_noise(bounds.lo[axis]);
      bounds.hi[axis] = without_noise(bounds.hi[axis]);
    }
  }

  // Splines get a margin of a ten-millionth of a mm, for which a job would need a layer more.
  static double without_noise(double mm) {
    const double even = std::round(mm * 1e6) / 1e6;
    return std::abs(mm - even) < 2e-7 ? even : mm;
  }

  TopoDS_Shape shape_;
  mutable std::mutex mutex_;
};

}  // namespace

SolidPtr make_solid(const NamedShape& named) { return std::make_shared<OcctSolid>(named); }

}  // namespace ombre::cad

#endif

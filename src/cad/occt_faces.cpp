// The surfaces of a shape's faces: distances to them, and their sides.
#ifdef OMBRE_CAD

#include "cad/occt_faces.h"

#include <ElSLib.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ombre::cad {
namespace {

// The point of a surface nearest to a point, and the radius of curvature there.
struct Foot {
  double u = 0, v = 0;
  double radius_mm = std::numeric_limits<double>::infinity();
};

Foot foot_on(const gp_Cone& cone, const gp_Pnt& p) {
  Foot foot;
  ElSLib::Parameters(cone, p, foot.u, foot.v);
  foot.radius_mm = std::abs(cone.RefRadius() + foot.v * std::sin(cone.SemiAngle()));
  return foot;
}

Foot foot_on(const gp_Torus& torus, const gp_Pnt& p) {
  Foot foot;
  ElSLib::Parameters(torus, p, foot.u, foot.v);
  foot.radius_mm = std::min(torus.MinorRadius(), torus.MajorRadius() - torus.MinorRadius());
  return foot;
}

template <class RoundSurface>
Foot foot_on(const RoundSurface& surface, const gp_Pnt& p) {
  Foot foot;
  ElSLib::Parameters(surface, p, foot.u, foot.v);
  foot.radius_mm = surface.Radius();
  return foot;
}

std::optional<Foot> foot_on(const BRepAdaptor_Surface& surface, const gp_Pnt& p) {
  Foot foot;
  switch (surface.GetType()) {
    case GeomAbs_Plane:
      ElSLib::Parameters(surface.Plane(), p, foot.u, foot.v);
      return foot;
    case GeomAbs_Cylinder:
      return foot_on(surface.Cylinder(), p);
    case GeomAbs_Cone:
      return foot_on(surface.Cone(), p);
    case GeomAbs_Sphere:
      return foot_on(surface.Sphere(), p);
    case GeomAbs_Torus:
      return foot_on(surface.Torus(), p);
    default:
      return std::nullopt;
  }
}

}  // namespace

FaceSurfaces::FaceSurfaces(const TopoDS_Shape& shape) {
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    const TopoDS_Face& face = TopoDS::Face(e.Current());
    faces_.push_back({BRepAdaptor_Surface(face, false), face.Orientation() == TopAbs_REVERSED});
  }
}

std::optional<FaceSide> FaceSurfaces::side(uint32_t face, Vec3 p, double least_radius_mm) const {
  const auto& [surface, is_turned] = faces_[face];
  const gp_Pnt point(p.x, p.y, p.z);
  const auto foot = foot_on(surface, point);
  if (!foot || foot->radius_mm < least_radius_mm) return std::nullopt;
  gp_Pnt at;
  gp_Vec along_u, along_v;
  surface.D1(foot->u, foot->v, at, along_u, along_v);
  gp_Vec normal = along_u.Crossed(along_v);
  if (normal.Magnitude() < gp::Resolution()) return std::nullopt;
  normal.Normalize();
  if (is_turned) normal.Reverse();
  return FaceSide{gp_Vec(at, point).Dot(normal), {normal.X(), normal.Y(), normal.Z()}};
}

}  // namespace ombre::cad

#endif

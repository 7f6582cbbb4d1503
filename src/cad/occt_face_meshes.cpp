// Triangles of faces with the coordinates of their surfaces.
#ifdef OMBRE_CAD

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>

#include "base/text/error.h"
#include "cad/occt_triangles.h"

namespace ombre::cad {
namespace {

std::string kind_of(const BRepAdaptor_Surface& surface) {
  // The library counts its kinds in this order, with another one for what is none of them.
  static_assert(GeomAbs_Plane == 0 && GeomAbs_OtherSurface == face_kinds.size() - 1);
  return std::string(face_kinds[static_cast<size_t>(surface.GetType())]);
}

Vec3 vector_of(const gp_Vec& v) { return {v.X(), v.Y(), v.Z()}; }

// Adds the points with their normals and coordinates; returns the lengths of the derivatives by u and v at each.
std::vector<Vec2> add_points(const TopoDS_Face& face, const Poly_Triangulation& mesh, const gp_Trsf& move,
                             FaceMesh& made) {
  const BRepAdaptor_Surface surface(face, false);
  made.kind = kind_of(surface);
  const double sign = face.Orientation() == TopAbs_REVERSED ? -1 : 1;
  std::vector<Vec2> speeds;
  for (Standard_Integer n = 1; n <= mesh.NbNodes(); ++n) {
    const gp_Pnt2d place = mesh.UVNode(n);
    const gp_Pnt p = mesh.Node(n).Transformed(move);
    gp_Pnt at;
    gp_Vec by_u, by_v;
    surface.D1(place.X(), place.Y(), at, by_u, by_v);
    const gp_Vec normal = by_u.Crossed(by_v);
    const double size = normal.Magnitude();
    made.points.push_back({p.X(), p.Y(), p.Z()});
    made.normals.push_back(size > gp::Resolution() ? (sign / size) * vector_of(normal) : Vec3{});
    // Triangles of a turned face are turned, too, so v is mirrored with them.
    made.places.push_back({place.X(), sign * place.Y()});
    speeds.push_back({by_u.Magnitude(), by_v.Magnitude()});
  }
  return speeds;
}

void add_triangles(const Poly_Triangulation& mesh, bool is_turned, const std::vector<Vec2>& speeds, FaceMesh& made) {
  Vec2 lengths{0, 0};
  Vec3 areas, moments;
  for (Standard_Integer t = 1; t <= mesh.NbTriangles(); ++t) {
    Standard_Integer a = 0, b = 0, c = 0;
    mesh.Triangle(t).Get(a, b, c);
    if (is_turned) std::swap(b, c);
    const std::array<uint32_t, 3> corners{static_cast<uint32_t>(a - 1), static_cast<uint32_t>(b - 1),
                                          static_cast<uint32_t>(c - 1)};
    const Vec3 first = made.points[corners[0]], second = made.points[corners[1]], third = made.points[corners[2]];
    const Vec3 area = 0.5 * cross(second - first, third - first);
    const double size = length(area);
    if (!(size > 0)) continue;
    made.triangles.push_back(corners);
    made.area_mm2 += size;
    areas = areas + area;
    moments = moments + (size / 3) * (first + second + third);
    for (const uint32_t corner : corners) lengths = lengths + (size / 3) * speeds[corner];
  }
  if (!(made.area_mm2 > 0)) return;
  made.center = (1 / made.area_mm2) * moments;
  const double size = length(areas);
  made.normal = size > 1e-9 * made.area_mm2 ? (1 / size) * areas : Vec3{};
  for (Vec2& place : made.places) place = {place.x * lengths.x / made.area_mm2, place.y * lengths.y / made.area_mm2};
}

}  // namespace

TopoDS_Shape whole_faces_of(const TopoDS_Shape& shape) {
  constexpr double same_place = 1e-7;  // mm, the library's usual tolerance
  const BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    const TopoDS_Face& face = TopoDS::Face(e.Current());
    Standard_Real u_least = 0, u_most = 0, v_least = 0, v_most = 0;
    BRepTools::UVBounds(face, u_least, u_most, v_least, v_most);
    const BRepBuilderAPI_MakeFace whole(BRep_Tool::Surface(face), u_least, u_most, v_least, v_most, same_place);
    builder.Add(all, whole.Face().Oriented(face.Orientation()));
  }
  return all;
}

std::vector<FaceMesh> face_meshes_of(const TopoDS_Shape& shape, const std::string& what) {
  std::vector<FaceMesh> all;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    const TopoDS_Face& face = TopoDS::Face(e.Current());
    TopLoc_Location place;
    const opencascade::handle<Poly_Triangulation> mesh = BRep_Tool::Triangulation(face, place);
    if (mesh.IsNull() || mesh->NbTriangles() == 0 || !mesh->HasUVNodes())
      throw Error(Code::file_content,
                  what + " has a face that Open CASCADE cannot cut into triangles; repair it where it was drawn");
    FaceMesh& made = all.emplace_back();
    const std::vector<Vec2> speeds = add_points(face, *mesh, place.Transformation(), made);
    add_triangles(*mesh, face.Orientation() == TopAbs_REVERSED, speeds, made);
  }
  return all;
}

}  // namespace ombre::cad

#endif

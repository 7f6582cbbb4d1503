// Queries of one solid of Open CASCADE.
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
#include <functional>
#include <mutex>

#include "base/system/byte_pack.h"
#include "base/system/helper_process.h"
#include "cad/occt_faces.h"
#include "cad/occt_guard.h"
#include "cad/occt_shapes.h"
#include "cad/occt_triangles.h"

namespace ombre::cad {
namespace {

// Greatest angle in radians between neighbouring facets along a curve, which preserves small fillets.
constexpr double facet_angle = 0.5, fine_facet_angle = 0.1;
// Distance in mm below which a point lies on the surface.
constexpr double surface_tolerance = 1e-9;
// Time limits for the triangulation of a solid.
constexpr double seconds_to_cut = 20, seconds_to_cut_a_face = 0.2;

TopoDS_Shape copy_of(const TopoDS_Shape& shape, bool with_geometry) {
  return BRepBuilderAPI_Copy(shape, with_geometry, false).Shape();
}

// Returns only the faces: the library's distance to a solid is 0 for points inside of it.
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
      : what_(std::move(what)), classifier_(shape), skin_(skin_of(shape)), faces_(shape) {
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
      if (!distance_.Perform())
        throw Error(Code::file_content, what_ + ": the distance to its surface cannot be found");
      return distance_.Value();
    });
  }

  std::optional<FaceSide> side_of_face(uint32_t face, Vec3 p, double least_radius_mm) override {
    return guarded(what_, [&] { return faces_.side(face, p, least_radius_mm); });
  }

 private:
  std::string what_;
  BRepClass3d_SolidClassifier classifier_;
  TopoDS_Shape skin_;
  BRepExtrema_DistShapeShape distance_;
  FaceSurfaces faces_;
};

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

// Rounds away the margin of 1e-7 mm around splines, because of which a job would need an additional layer.
double without_noise(double mm) {
  const double even = std::round(mm * 1e6) / 1e6;
  return std::abs(mm - even) < 2e-7 ? even : mm;
}

Box bounds_of(const TopoDS_Shape& shape) {
  Bnd_Box box;
  box.SetGap(0);
  BRepBndLib::AddOptimal(shape, box, false, false);
  Box bounds;
  box.Get(bounds.lo.x, bounds.lo.y, bounds.lo.z, bounds.hi.x, bounds.hi.y, bounds.hi.z);
  for (int axis = 0; axis < 3; ++axis) {
    bounds.lo[axis] = without_noise(bounds.lo[axis]);
    bounds.hi[axis] = without_noise(bounds.hi[axis]);
  }
  return bounds;
}

size_t face_count(const TopoDS_Shape& shape) {
  size_t count = 0;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) ++count;
  return count;
}

class OcctSolid final : public Solid {
 public:
  explicit OcctSolid(const MeasuredShape& shape) : shape_(shape.named.shape) {
    name = shape.named.name;
    unit = shape.named.unit;
    colour = shape.named.colour;
    volume_mm3 = shape.volume_mm3;
    faces = face_count(shape.named.shape);
    bounds = shape.bounds;
  }

  Triangles triangulate(double deflection_mm) const override {
    const auto copy = [&] { return copy_of(shape_, false); };
    const std::string bytes = meshed(deflection_mm, facet_angle, copy, [&](const TopoDS_Shape& shape) {
      const Triangles made = triangles_of(shape, what());
      BytePacker packer;
      packer.add_list(made.vertices);
      packer.add_list(made.triangles);
      packer.add_list(made.faces);
      return packer.take();
    });
    ByteUnpacker unpacker(bytes);
    Triangles triangles;
    triangles.vertices = unpacker.get_list<Vec3>();
    triangles.triangles = unpacker.get_list<std::array<uint32_t, 3>>();
    triangles.faces = unpacker.get_list<uint32_t>();
    return triangles;
  }

  std::vector<FaceMesh> face_meshes(double deflection_mm, FaceExtent extent) const override {
    const auto faces_of_copy = [&] {
      const TopoDS_Shape copy = copy_of(shape_, false);
      return extent == FaceExtent::whole_rectangle ? whole_faces_of(copy) : copy;
    };
    const std::string bytes = meshed(deflection_mm, fine_facet_angle, faces_of_copy, [&](const TopoDS_Shape& shape) {
      const std::vector<FaceMesh> made = face_meshes_of(shape, what());
      BytePacker packer;
      packer.add(uint64_t{made.size()});
      for (const FaceMesh& face : made) {
        packer.add_text(face.kind);
        packer.add(face.area_mm2);
        packer.add(face.center);
        packer.add(face.normal);
        packer.add_list(face.points);
        packer.add_list(face.normals);
        packer.add_list(face.places);
        packer.add_list(face.triangles);
      }
      return packer.take();
    });
    ByteUnpacker unpacker(bytes);
    std::vector<FaceMesh> all(unpacker.get<uint64_t>());
    for (FaceMesh& face : all) {
      face.kind = unpacker.get_text();
      face.area_mm2 = unpacker.get<double>();
      face.center = unpacker.get<Vec3>();
      face.normal = unpacker.get<Vec3>();
      face.points = unpacker.get_list<Vec3>();
      face.normals = unpacker.get_list<Vec3>();
      face.places = unpacker.get_list<Vec2>();
      face.triangles = unpacker.get_list<std::array<uint32_t, 3>>();
    }
    return all;
  }

  // Copies the geometry, because the library's surfaces cache their last query.
  std::unique_ptr<Query> query() const override {
    const std::lock_guard lock(mutex_);
    return guarded(what(), [&] { return std::make_unique<OcctQuery>(copy_of(shape_, true), what()); });
  }

 private:
  // Returns the bytes that `pack` makes of the meshed shape that `make_copy` makes of the solid, in a helper process.
  // The shape is a copy, because an existing mesh would be kept if it is fine enough.
  std::string meshed(double deflection_mm, double angle, const std::function<TopoDS_Shape()>& make_copy,
                     const std::function<std::string(const TopoDS_Shape&)>& pack) const {
    const std::lock_guard lock(mutex_);
    const auto cut = [&] {
      return guarded(what(), [&] {
        const TopoDS_Shape copy = make_copy();
        const BRepMesh_IncrementalMesh mesh(copy, deflection_mm, false, angle, false);
        return pack(copy);
      });
    };
    const HelperLimits limits{seconds_to_cut + seconds_to_cut_a_face * static_cast<double>(face_count(shape_))};
    const auto explain = [&](HelperFailure failure) {
      return Error(Code::file_content,
                   what() + (failure == HelperFailure::crashed
                                 ? " makes Open CASCADE crash; repair it where it was drawn"
                                 : " takes longer than " + std::to_string(static_cast<int>(limits.seconds)) +
                                       " s of processor time to cut into triangles; give cad a larger tolerance, or "
                                       "repair it where it was drawn"));
    };
    return run_in_helper(cut, limits, explain, nullptr);
  }

  std::string what() const { return name.empty() ? "the CAD solid" : "the CAD solid \"" + name + '"'; }

  TopoDS_Shape shape_;
  mutable std::mutex mutex_;
};

}  // namespace

MeasuredShape measured(NamedShape named) {
  MeasuredShape shape;
  shape.named = std::move(named);
  shape.volume_mm3 = volume_of(shape.named.shape);
  // Faces of mirrored instances may also be oriented inward.
  if (shape.volume_mm3 < 0) {
    shape.named.shape.Reverse();
    shape.volume_mm3 = -shape.volume_mm3;
  }
  shape.bounds = bounds_of(shape.named.shape);
  return shape;
}

SolidPtr make_solid(const MeasuredShape& shape) { return std::make_shared<OcctSolid>(shape); }

}  // namespace ombre::cad

#endif

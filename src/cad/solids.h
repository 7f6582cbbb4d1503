// Solids from CAD files: STEP and IGES, by Open CASCADE.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/box.h"
#include "base/system/file_format.h"
#include "base/system/progress.h"

namespace ombre::cad {

struct Triangles {
  std::vector<Vec3> vertices;                      // without duplicates
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise from outside
  std::vector<uint32_t> faces;                     // by triangle: the face of the solid that it approximates
};

// Kinds of surfaces as Open CASCADE tells them apart.
inline constexpr std::array<std::string_view, 11> face_kinds{
    "plane", "cylinder", "cone", "sphere", "torus", "bezier", "bspline", "revolution", "extrusion", "offset", "other"};

// A face with the coordinates of its surface.
struct FaceMesh {
  std::string kind;  // one of face_kinds
  double area_mm2 = 0;
  Vec3 center, normal;                // mean of its triangles; the normal points out of the solid
  std::vector<Vec3> points, normals;  // normals have the length 1, or 0 where the surface has none
  std::vector<Vec2> places;           // u and v of the surface, in mm where they are stretched as on average
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise from outside, and in u and v
};

// The part of a face's surface: what its border encloses, or all between its least and greatest u and v.
enum class FaceExtent : uint8_t { within_border, whole_rectangle };

// The position of a point relative to a surface.
struct FaceSide {
  double distance = 0;  // mm; negative on the inner side
  Vec3 normal;          // unit normal at the nearest point, out of the solid
};

// Queries of a solid, for one thread at a time.
class Query {
 public:
  virtual ~Query() = default;
  virtual bool is_inside(Vec3 p) = 0;           // true also on the surface
  virtual double surface_distance(Vec3 p) = 0;  // unsigned distance in mm
  // Returns the side of a face's surface, which extends beyond the face's borders. Fast, but only for planes,
  // cylinders, cones, spheres and tori; null for others, and where the surface's radius of curvature is less than
  // `least_radius_mm`.
  virtual std::optional<FaceSide> side_of_face(uint32_t face, Vec3 p, double least_radius_mm) = 0;
};

// A solid, with lengths in mm whatever the file's unit is. Thread-safe; functions that call the library throw Error.
class Solid {
 public:
  std::string name;  // may be empty
  std::string unit;  // of lengths in the file, as it names them: "INCH", "millimetre"; may be empty
  std::optional<std::array<uint8_t, 4>> colour;
  double volume_mm3 = 0;
  size_t faces = 0;
  Box bounds;

  virtual ~Solid() = default;
  // Returns triangles that deviate by at most about `deflection_mm` from the surface. Faces share the vertices of their
  // edges.
  virtual Triangles triangulate(double deflection_mm) const = 0;
  // Returns the faces in the order of Triangles::faces, with triangles that deviate by at most about `deflection_mm`.
  virtual std::vector<FaceMesh> face_meshes(double deflection_mm,
                                            FaceExtent extent = FaceExtent::within_border) const = 0;
  virtual std::unique_ptr<Query> query() const = 0;
};
using SolidPtr = std::shared_ptr<const Solid>;

std::vector<FileFormat> file_formats();
// Returns true if the name of a file ends like that of a CAD file.
bool is_cad_file(const std::string& path);

// Returns at least one solid, in the order of the file; closed shells that belong to no solid become solids. Throws
// Error if the file has none, is broken, or takes much longer than valid files of its size, and in builds without the
// library; Cancelled once `stop`, which may be null, is set.
std::vector<SolidPtr> read_solids(const std::string& path, const StopFlag* stop = nullptr);

}  // namespace ombre::cad

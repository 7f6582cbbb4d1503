// Solids of CAD files: STEP and IGES, by Open CASCADE.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/math/box.h"
#include "base/system/file_format.h"
#include "base/system/progress.h"

namespace ombre::cad {

struct Triangles {
  std::vector<Vec3> vertices;                      // each once
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise from outside
  std::vector<uint32_t> faces;                     // of each triangle: the face of the solid that it is cut from
};

// A point beside a surface.
struct FaceSide {
  double distance = 0;  // mm; negative on the side of the solid
  Vec3 normal;          // of length 1, out of the solid, where the surface is nearest
};

// Answers one thread at a time.
class Query {
 public:
  virtual ~Query() = default;
  virtual bool is_inside(Vec3 p) = 0;           // or on the surface
  virtual double surface_distance(Vec3 p) = 0;  // mm, not negative
  // The side of the surface that a face is cut from, beyond the face's borders too. Quick, but only for planes,
  // cylinders, cones, spheres and tori, and nothing where these are curved more tightly than `least_radius_mm`.
  virtual std::optional<FaceSide> side_of_face(uint32_t face, Vec3 p, double least_radius_mm) = 0;
};

// Lengths in mm, whatever the file has. Thread-safe; what asks the library throws Error.
class Solid {
 public:
  std::string name;  // may be empty
  std::optional<std::array<uint8_t, 4>> colour;
  double volume_mm3 = 0;
  Box bounds;

  virtual ~Solid() = default;
  // Chords are at most about `deflection_mm` away from what they stand for. Faces share the vertices of their edges.
  virtual Triangles triangulate(double deflection_mm) const = 0;
  virtual std::unique_ptr<Query> query() const = 0;
};
using SolidPtr = std::shared_ptr<const Solid>;

// Whether the name of a file says that it is one of CAD.
std::vector<FileFormat> file_formats();
bool is_cad_file(const std::string& path);

// At least one, in the order of the file; closed shells without a solid become some. Throws Error when the file holds
// none, or is broken, or takes far longer than good files of its size, and when this was built without the library;
// Cancelled once `stop`, which may be null, is set.
std::vector<SolidPtr> read_solids(const std::string& path, const StopFlag* stop = nullptr);

}  // namespace ombre::cad

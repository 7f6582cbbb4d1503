// The choice of a part of a surface, as parameters of nodes.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "design/ports/file_names.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/parameter_checks.h"

namespace ombre::nodes {

// Base of nodes that take a part of the surface of a mesh or CAD file, laid out in a plane.
struct OnSurfacePart {
  design::FilePath path;
  design::Choice method = "lscm";
  std::string kind;
  double least_area = 0, most_area = 0;
  std::optional<Vec3> at, min, max, normal;
  double angle = 180, within = 60, tolerance = 0.05;
  Vec3 toward{1, 0, 0};

  // These return parameters of T, which derives from this class.
  template <class T>
  static std::vector<design::Parameter<T>> path_parameter() {
    return {{"path", &OnSurfacePart::path, "A file with a mesh, or a CAD file", design::required()}};
  }
  template <class T>
  static std::vector<design::Parameter<T>> part_parameters(std::string_view about_tolerance) {
    using namespace design;
    return {
        {"at", &OnSurfacePart::at,
         "Takes what is linked to the triangle nearest to this point, or the nearest face of a CAD file",
         unit::on_surface},
        {"angle", &OnSurfacePart::angle, "Greatest bend between triangles that are linked", from_to(0, 180, "deg")},
        {"min", &OnSurfacePart::min, "Least corner of a box that the centres of triangles or faces lie in",
         unit::point},
        {"max", &OnSurfacePart::max, "Greatest corner of that box", unit::point},
        {"normal", &OnSurfacePart::normal, "Takes triangles or faces that face this direction", unit::direction},
        {"within", &OnSurfacePart::within, "Greatest angle from that direction", from_to(0, 180, "deg")},
        {"kind", &OnSurfacePart::kind,
         "Kind of the faces of a CAD file that are taken: plane, cylinder, cone, sphere, torus, bspline, ..."},
        {"least_area", &OnSurfacePart::least_area, "Least area of the faces of a CAD file that are taken",
         not_negative("mm^2")},
        {"most_area", &OnSurfacePart::most_area, "Greatest area of the faces of a CAD file that are taken; 0: any",
         not_negative("mm^2")},
        {"toward", &OnSurfacePart::toward,
         "Direction in which u runs, as far as possible; a single face of a CAD file keeps its own u", unit::direction},
        {"method", &OnSurfacePart::method,
         "lscm keeps angles as far as possible, arap lengths; authalic fills a circle",
         one_of({"lscm", "arap", "authalic"})},
        {"tolerance", &OnSurfacePart::tolerance, about_tolerance, unit::positive_mm}};
  }

 protected:
  // Returns false, with an error, if the conditions are wrong.
  bool are_sound(const design::Reader& reader) const {
    if (!reader.loader) return reader.refuse("meshes cannot be read here");
    return is_box_or_none(reader, min, max) && has_length(reader, "normal", normal);
  }
  static bool has_length(const design::Reader& reader, const char* name, const std::optional<Vec3>& direction) {
    return !direction || length(*direction) > 0 ||
           reader.refuse(std::string(name) + " of " + std::string(reader.node) + " has no length",
                         "write for example " + spelled::parameter(name, "(0, 0, 1)"));
  }

  design::SurfaceChoice part() const { return choice(path, at, min, max, normal, kind, {least_area, most_area}); }
  // `areas` are the least and the greatest; 0 for any.
  design::SurfaceChoice choice(const design::FilePath& file, const std::optional<Vec3>& near,
                               const std::optional<Vec3>& low, const std::optional<Vec3>& high,
                               const std::optional<Vec3>& facing, const std::string& of_kind, Interval areas) const {
    design::SurfaceChoice made;
    made.file = file;
    made.at = near;
    made.angle_deg = angle;
    if (low) made.box = Box{*low, *high};
    made.normal = facing;
    made.within_deg = within;
    made.kind = of_kind;
    made.area_mm2 = {areas.lo, areas.hi > 0 ? areas.hi : std::numeric_limits<double>::infinity()};
    return made;
  }
  design::SurfaceLayout layout() const { return {method, toward, tolerance}; }
};

// Returns lists of parameters as one.
template <class T>
std::vector<design::Parameter<T>> joined(std::vector<design::Parameter<T>> parameters,
                                         std::vector<design::Parameter<T>> more) {
  for (design::Parameter<T>& one : more) parameters.push_back(std::move(one));
  return parameters;
}

}  // namespace ombre::nodes

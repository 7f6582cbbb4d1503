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
template <class T>
struct OnSurfacePart {
  design::FilePath path;
  design::Choice method = "lscm";
  std::string kind;
  double least_area = 0, most_area = 0;
  std::optional<Vec3> at, min, max, normal;
  double angle = 180, within = 60, tolerance = 0.05;
  Vec3 toward{1, 0, 0};

  static std::vector<design::Parameter<T>> path_parameter() {
    return {{"path", of_base(&OnSurfacePart::path), "A file with a mesh, or a CAD file", design::required()}};
  }
  static std::vector<design::Parameter<T>> part_parameters(std::string_view about_tolerance) {
    using namespace design;
    return {
        {"at", of_base(&OnSurfacePart::at),
         "Takes what is linked to the triangle nearest to this point, or the nearest face of a CAD file", unit::points},
        {"angle", of_base(&OnSurfacePart::angle), "Greatest bend between triangles that are linked",
         from_to(0, 180, "deg")},
        {"min", of_base(&OnSurfacePart::min), "Least corner of a box that the centres of triangles or faces lie in",
         unit::point},
        {"max", of_base(&OnSurfacePart::max), "Greatest corner of that box", unit::point},
        {"normal", of_base(&OnSurfacePart::normal), "Takes triangles or faces that face this direction",
         unit::direction},
        {"within", of_base(&OnSurfacePart::within), "Greatest angle from that direction", from_to(0, 180, "deg")},
        {"kind", of_base(&OnSurfacePart::kind),
         "Kind of the faces of a CAD file that are taken: plane, cylinder, cone, sphere, torus, bspline, ..."},
        {"least_area", of_base(&OnSurfacePart::least_area), "Least area of the faces of a CAD file that are taken",
         not_negative("mm^2")},
        {"most_area", of_base(&OnSurfacePart::most_area),
         "Greatest area of the faces of a CAD file that are taken; 0: any", not_negative("mm^2")},
        {"toward", of_base(&OnSurfacePart::toward),
         "Direction in which u runs, as far as possible; a single face of a CAD file keeps its own u", unit::direction},
        {"method", of_base(&OnSurfacePart::method),
         "lscm keeps angles as far as possible, arap lengths; authalic fills a circle",
         one_of({"lscm", "arap", "authalic"})},
        {"tolerance", of_base(&OnSurfacePart::tolerance), about_tolerance, unit::positive_mm}};
  }

 protected:
  // Sets the part of a request. Returns false, with an error, if it is not well chosen.
  bool choose(const design::Reader& reader, design::SurfacePart& part) const {
    if (!reader.loader) return reader.refuse("meshes cannot be read here");
    if (!is_box_or_none(reader, min, max)) return false;
    if (normal && !(length(*normal) > 0))
      return reader.refuse("normal of " + std::string(reader.node) + " has no length",
                           "write for example " + spelled::parameter("normal", "(0, 0, 1)"));
    part.file = path;
    part.at = at;
    part.angle_deg = angle;
    if (min) part.box = Box{*min, *max};
    part.normal = normal;
    part.within_deg = within;
    part.kind = kind;
    part.area_mm2 = {least_area, most_area > 0 ? most_area : std::numeric_limits<double>::infinity()};
    part.method = method;
    part.toward = toward;
    part.tolerance_mm = tolerance;
    return true;
  }

 private:
  // Returns a pointer to a member of this base as one to a member of T.
  template <class M>
  static M T::*of_base(M OnSurfacePart::*member) {
    return member;
  }
};

// Returns lists of parameters as one.
template <class T>
std::vector<design::Parameter<T>> joined(std::vector<design::Parameter<T>> parameters,
                                         std::vector<design::Parameter<T>> more) {
  for (design::Parameter<T>& one : more) parameters.push_back(std::move(one));
  return parameters;
}

}  // namespace ombre::nodes

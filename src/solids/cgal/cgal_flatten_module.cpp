// Lays out surfaces in a plane by CGAL's Surface_mesh_parameterization.
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Discrete_authalic_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <exception>

#include "base/text/error.h"
#include "import/charts/flat_surface.h"
#include "solids/cgal/cgal_sheet.h"

namespace ombre::importing {
namespace {

namespace Parameterization = CGAL::Surface_mesh_parameterization;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = Sheet<Kernel>;

template <class Method>
Parameterization::Error_code run(Mesh& mesh, Mesh::Property_map<Mesh::Vertex_index, Kernel::Point_2>& places) {
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  return Parameterization::parameterize(mesh, Method(), border, places);
}

}  // namespace
}  // namespace ombre::importing

void ombre_flatten(const std::vector<ombre::Vec3>& points, const std::vector<std::array<uint32_t, 3>>& triangles,
                   ombre::importing::Flattening method, std::vector<ombre::Vec2>& places) {
  using namespace ombre;
  using namespace ombre::importing;
  Mesh mesh = sheet_of<Kernel>(points, triangles, "the surface cannot be laid out in a plane");
  auto found = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:place").first;
  Parameterization::Error_code code = Parameterization::OK;
  try {
    if (method == Flattening::lscm) code = run<Parameterization::LSCM_parameterizer_3<Mesh>>(mesh, found);
    if (method == Flattening::arap) code = run<Parameterization::ARAP_parameterizer_3<Mesh>>(mesh, found);
    if (method == Flattening::authalic)
      code = run<Parameterization::Discrete_authalic_parameterizer_3<Mesh>>(mesh, found);
  } catch (const std::exception& failed) {
    throw Error(Code::file_content, "the surface cannot be laid out in a plane: " + std::string(failed.what()));
  }
  if (code != Parameterization::OK)
    throw Error(Code::file_content,
                "the surface cannot be laid out in a plane: " + std::string(Parameterization::get_error_message(code)));
  for (const Mesh::Vertex_index vertex : mesh.vertices()) places.push_back({found[vertex].x(), found[vertex].y()});
}

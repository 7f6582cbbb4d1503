#include "sources/mesh_closing.h"

#include <map>

#include "base/math/point_text.h"
#include "base/text/text.h"
#include "import/surfaces/corner_welder.h"
#include "import/surfaces/mesh_source.h"
#include "import/surfaces/shells.h"

namespace ombre::sources {
namespace {

bool has_inside(const importing::MeshReport& report, std::string_view rule) {
  return report.is_closed() || rule == "generalized" || (rule == "parity" && report.open_edges == 0);
}

// Describes the faults of a mesh, such as "is open along 4 edges, for example from ... to ..."
std::string faults(const importing::MeshReport& report) {
  std::string message;
  if (report.open_edges > 0)
    message = "is open along " + format_count(report.open_edges) + (report.open_edges == 1 ? " edge" : " edges");
  if (report.inconsistent_edges > 0)
    message += std::string(report.open_edges > 0 ? " and " : "") + "has triangles facing different ways along " +
               format_count(report.inconsistent_edges) + (report.inconsistent_edges == 1 ? " edge" : " edges");
  if (!report.examples.empty())
    message +=
        ", for example from " + format_point(report.examples[0][0]) + " to " + format_point(report.examples[0][1]);
  return message;
}

// Closes a surface that is open because corners differ by rounding.
void join_corners(const std::string& subject, formats::Mesh& mesh, std::string_view rule, const design::Reader& reader,
                  importing::MeshReport& report) {
  const size_t open_edges = report.open_edges;
  const auto welded = importing::weld_corners(mesh, rule == "parity");
  if (!welded) return;
  reader.diagnostics.note(reader.where, format_count(welded->corners) + " corners of " + subject + " that lie up to " +
                                            format_rounded(welded->farthest_mm, 2) +
                                            " mm apart were joined: the surface was open along " +
                                            format_count(open_edges) + (open_edges == 1 ? " edge" : " edges"));
  report = importing::inspect(mesh);
}

// Turns shells that face inward and would cancel out overlapping outward ones.
void turn_shells(const std::string& subject, formats::Mesh& mesh, const design::Reader& reader) {
  const auto [turned, shells] = importing::turn_inverted_shells(mesh);
  if (turned == 0) return;
  const bool is_one = turned == 1;
  reader.diagnostics.warning(reader.where, format_count(turned) + " of the " + format_count(shells) + " shells of " +
                                               subject + " " + (is_one ? "faces" : "face") +
                                               " inward, where others face outward, and " + (is_one ? "lies" : "lie") +
                                               " in none of them; " + (is_one ? "it is" : "they are") +
                                               " turned round");
}

}  // namespace

std::string mesh_called(const std::string& path) { return kind_of(path) + " \"" + path + '"'; }

bool make_closed(const std::string& subject, formats::Mesh& mesh, std::string_view rule, const design::Reader& reader) {
  if (mesh.triangles.empty()) return true;
  importing::MeshReport report = importing::inspect(mesh);
  if (!has_inside(report, rule)) join_corners(subject, mesh, rule, reader, report);
  if (!has_inside(report, rule)) {
    const Phrase hint = report.open_edges > 0
                            ? "repair it, or write " + spelled::parameter("inside", "\"generalized\"") +
                                  " to close it by winding number"
                            : "repair it, or write " + spelled::parameter("inside", "\"parity\"") +
                                  " to ignore which way triangles face";
    reader.diagnostics.error(Code::surface_open, reader.where, subject + " " + faults(report), hint);
    return false;
  }
  if (rule != "parity" && report.inward_shells > 0 && report.inward_shells < report.shells)
    turn_shells(subject, mesh, reader);
  return true;
}

bool check_part_closed(const std::string& path, const MaterialMesh& part, std::string_view rule,
                       const design::Reader& reader) {
  if (part.mesh.triangles.empty()) return true;
  const importing::MeshReport report = importing::inspect(part.mesh);
  if (has_inside(report, rule)) return true;
  reader.diagnostics.error(
      Code::surface_open, reader.where,
      "what the mesh \"" + path + "\" has of \"" + part.material.material->name + "\" " + faults(report),
      "save a closed body for each material, or leave materials out to have one");
  return false;
}

bool close_clips(const std::string& path, formats::Mesh& mesh, std::string_view rule, const design::Reader& reader) {
  std::map<std::shared_ptr<const formats::Mesh>, std::shared_ptr<const formats::Mesh>> closed;
  for (formats::PlacedLattice& placed : mesh.lattices) {
    if (!placed.lattice->clip) continue;
    std::shared_ptr<const formats::Mesh>& clip = closed[placed.lattice->clip];
    if (!clip) {
      formats::Mesh mended = *placed.lattice->clip;
      if (!make_closed("a clipping mesh of \"" + path + '"', mended, rule, reader)) return false;
      clip = std::make_shared<const formats::Mesh>(std::move(mended));
    }
    formats::BeamLattice lattice = *placed.lattice;
    lattice.clip = clip;
    placed.lattice = std::make_shared<const formats::BeamLattice>(std::move(lattice));
  }
  return true;
}

}  // namespace ombre::sources

#include "jobs/info/file_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/math/point_text.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "cad/solids.h"
#include "design/materials.h"
#include "design/reader.h"
#include "formats/containers/file.h"
#include "formats/containers/xml_text.h"
#include "formats/drawings/dxf_measures.h"
#include "formats/images/read_picture.h"
#include "formats/mesh/mesh_objects.h"
#include "formats/packages/read_mesh.h"
#include "import/surfaces/mesh_report.h"
#include "jobs/info/summary_text.h"
#include "load/design_sources.h"
#include "solids/files.h"
#include "sources/file_formats.h"
#include "sources/layer_images.h"

namespace ombre::jobs {
namespace {

std::string mesh_state(const formats::Mesh& mesh, const importing::MeshReport& report) {
  if (mesh.triangles.empty()) return "no triangles";
  std::vector<std::string> faults;
  if (report.open_edges > 0) faults.push_back(format_count(report.open_edges) + " open edges");
  if (report.inconsistent_edges > 0)
    faults.push_back(format_count(report.inconsistent_edges) + " edges of triangles that face opposite sides");
  if (report.is_closed() && report.volume < 0) faults.push_back("its triangles face inward");
  std::string text = faults.empty() ? "yes" : "no: " + join(faults, ", ");
  if (report.degenerate > 0) text += "; " + format_count(report.degenerate) + " triangles have no area";
  return text;
}

FileSummary summary_of_mesh(const formats::Mesh& mesh) {
  const importing::MeshReport report = importing::inspect(mesh);
  std::set<std::string> colours, materials;
  size_t beams = 0;
  for (const formats::MeshGroup& group : mesh.groups) {
    if (group.colour) colours.insert(formats::hex_colour({group.colour->data(), 3}));
    if (!group.material.empty()) materials.insert(group.material);
  }
  for (const formats::PlacedLattice& placed : mesh.lattices) beams += placed.lattice->beams.size();
  const auto list = [](const auto& words) { return std::vector<std::string>(words.begin(), words.end()); };
  FileSummary summary{"mesh", "a surface mesh"};
  summary.add_count("triangles", report.triangles);
  if (beams > 0) summary.add_count("beams", beams);
  summary.add("closed", mesh_state(mesh, report), Data(report.is_closed() && report.volume > 0));
  summary.add("open_edges", "", Data(static_cast<double>(report.open_edges)));
  summary.add("inconsistent_edges", "", Data(static_cast<double>(report.inconsistent_edges)));
  if (report.is_closed()) {
    summary.add_count("shells", report.shells);
    summary.add("volume_mm3", format_rounded(report.volume, 7) + " mm3", report.volume);
  }
  summary.add("area_mm2", format_rounded(report.area, 7) + " mm2", report.area);
  summary.add_box(report.bounds);
  summary.add_names("parts", formats::object_names(mesh));
  summary.add_names("materials", list(materials));
  summary.add_names("colours", list(colours));
  return summary;
}

std::optional<FileSummary> mesh_summary(const std::string& path, Session&, Diagnostics& diagnostics) {
  const auto mesh = formats::read_mesh(path, diagnostics);
  if (!mesh) return std::nullopt;
  return summary_of_mesh(*mesh);
}

// The faces of a solid, in their order: kind, area and place.
DataList faces_of(const cad::Solid& solid) {
  constexpr double fine = 1e-3;  // share of the solid's size by which triangles may deviate
  const auto point = [](Vec3 p) { return Data(DataList{p.x, p.y, p.z}); };
  DataList faces;
  for (const cad::FaceMesh& face : solid.face_meshes(fine * length(solid.bounds.size()))) {
    Box box;
    for (const Vec3 p : face.points) box = hull(box, Box{p, p});
    faces.emplace_back(DataMembers{{"kind", face.kind},
                                   {"area_mm2", face.area_mm2},
                                   {"center", point(face.center)},
                                   {"normal", point(face.normal)},
                                   {"box", DataList{point(box.lo), point(box.hi)}}});
  }
  return faces;
}

std::optional<FileSummary> cad_summary(const std::string& path, Session& session, Diagnostics&) {
  const std::vector<cad::SolidPtr> solids = cad::read_solids(path, &session.stop);
  FileSummary summary{"cad", "a CAD file"};
  Box box;
  double volume = 0;
  DataList list;
  std::string lines;
  for (const cad::SolidPtr& solid : solids) {
    box = hull(box, solid->bounds);
    volume += solid->volume_mm3;
    const std::string colour = solid->colour ? formats::hex_colour({solid->colour->data(), 3}) : "";
    lines += "  solid       " + (solid->name.empty() ? std::string("(no name)") : solid->name) + ", " +
             format_count(solid->faces) + " faces, " + format_rounded(solid->volume_mm3, 7) + " mm3" +
             (colour.empty() ? "" : ", " + colour) + "\n";
    list.emplace_back(DataMembers{{"name", solid->name},
                                  {"faces", static_cast<double>(solid->faces)},
                                  {"volume_mm3", solid->volume_mm3},
                                  {"surfaces", session.events.wants_data() ? faces_of(*solid) : DataList()},
                                  {"colour", colour.empty() ? Data() : Data(colour)}});
  }
  summary.add_count("solid_count", solids.size());
  if (!solids[0]->unit.empty())
    summary.add("unit", to_lower(solids[0]->unit) + ", read as mm", Data(to_lower(solids[0]->unit)));
  summary.add("volume_mm3", format_rounded(volume, 7) + " mm3", volume);
  summary.add_box(box);
  summary.text += lines;
  summary.members.emplace_back("solids", std::move(list));
  return summary;
}

std::optional<FileSummary> drawing_summary(const std::string& path, Session&, Diagnostics& diagnostics) {
  solids::Import import;
  import.path = path;
  import.fragments = {360};  // so that areas with circles have an error of less than 0.01 %
  const solids::Pieces pieces = solids::import_pieces(import, {}, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  FileSummary summary{"drawing", "a drawing"};
  size_t outer = 0, holes = 0;
  double area = 0;
  Box box;
  for (const solids::Piece& piece : pieces) {
    const solids::Region* region = piece.region();
    if (!region) continue;
    for (const Ring& ring : region->rings) {
      const double doubled = doubled_area(ring);
      area += doubled / 2;
      ++(doubled > 0 ? outer : holes);
      for (const Vec2& p : ring) box = hull(box, Box{{p.x, p.y, 0}, {p.x, p.y, 0}});
    }
  }
  summary.add_count("regions", outer);
  summary.add_count("holes", holes);
  summary.add("area_mm2", format_rounded(area, 7) + " mm2", area);
  summary.add_box(box);
  if (ending_of(path) == ".dxf") summary.add_names("layers", formats::dxf_layers(path, formats::read_file(path)));
  return summary;
}

std::optional<FileSummary> table_summary(const std::string& path, Session& session, Diagnostics& diagnostics) {
  compile::DesignSources loader(session.cache, &session.stop);
  const design::MaterialTable materials;
  const design::Reader reader{materials, diagnostics, &loader, {}, {}, {}};
  design::TableRequest request{{path, {}}};
  const auto rows = loader.source(request, reader);
  if (!rows) return std::nullopt;
  FileSummary summary{"table", "a table of numbers"};
  const size_t columns = rows->front().size();
  summary.add_count("rows", rows->size());
  summary.add_count("columns", columns);
  DataList ranges;
  constexpr size_t most_shown = 32;
  for (size_t n = 0; n < columns; ++n) {
    Interval range((*rows)[0][n]);
    for (const auto& row : *rows) range = hull(range, Interval(row[n]));
    ranges.emplace_back(DataList{range.lo, range.hi});
    if (n < most_shown)
      summary.text += "  column " + std::to_string(n + 1) + "    " + format_rounded(range.lo, 6) + " to " +
                      format_rounded(range.hi, 6) + "\n";
  }
  summary.members.emplace_back("ranges", std::move(ranges));
  return summary;
}

// Returns the pages of an image; a photograph has one.
std::vector<sources::LayerColours> pages_of(const std::string& path, const Session& session) {
  const std::string bytes = formats::read_file(path);
  if (sources::is_image(bytes)) return sources::read_layer_colours(path, bytes, &session.stop);
  formats::Picture picture = formats::read_picture(path, bytes, formats::Turning::as_seen);
  return {{picture.width, picture.height, std::move(picture.rgba)}};
}

std::optional<FileSummary> image_summary(const std::string& path, Session& session, Diagnostics&) {
  const std::vector<sources::LayerColours> pages = pages_of(path, session);
  std::map<uint32_t, size_t> counts;
  constexpr size_t most_counted = 256, most_shown = 16;
  for (const sources::LayerColours& page : pages)
    for (size_t n = 0; n + 3 < page.rgba.size() && counts.size() <= most_counted; n += 4) {
      const uint8_t* p = &page.rgba[n];
      ++counts[uint32_t{p[0]} << 24 | uint32_t{p[1]} << 16 | uint32_t{p[2]} << 8 | p[3]];
    }
  FileSummary summary{"image", "an image"};
  if (pages.empty()) return summary;
  summary.add_count("width", pages[0].width);
  summary.add_count("height", pages[0].height);
  summary.add_count("pages", pages.size());
  if (counts.size() > most_counted) {
    summary.add("colour_count", "more than 256", Data());
    return summary;
  }
  summary.add_count("colour_count", counts.size());
  DataList list;
  for (const auto& [colour, count] : counts) {
    const std::array<uint8_t, 4> rgba{static_cast<uint8_t>(colour >> 24), static_cast<uint8_t>(colour >> 16),
                                      static_cast<uint8_t>(colour >> 8), static_cast<uint8_t>(colour)};
    const std::string name = formats::hex_colour({rgba.data(), rgba[3] == 255 ? size_t{3} : size_t{4}});
    list.emplace_back(DataList{name, static_cast<double>(count)});
    if (list.size() <= most_shown) summary.text += "  " + name + "     " + format_count(count) + " pixels\n";
  }
  summary.members.emplace_back("colours", std::move(list));
  return summary;
}

// A function that describes a kind of content; the first row that fits a file's name counts.
struct Row {
  Content content;
  std::optional<FileSummary> (*summarise)(const std::string& path, Session& session, Diagnostics& diagnostics);
};
constexpr std::array<Row, 5> rows{{{Content::mesh, mesh_summary},
                                   {Content::cad, cad_summary},
                                   {Content::drawing, drawing_summary},
                                   {Content::table, table_summary},
                                   {Content::image, image_summary}}};

}  // namespace

std::optional<Content> summarised_content(const std::string& path) {
  if (ending_of(path) == ".csv") return Content::table;
  for (const Row& row : rows)
    if (sources::is_read_as(path, row.content) && !sources::is_read_as(path, Content::volume)) return row.content;
  return std::nullopt;
}

int show_summary(const std::string& path, Content content, Session& session) {
  Diagnostics diagnostics;
  const auto row = std::ranges::find(rows, content, &Row::content);
  auto summary = row->summarise(path, session, diagnostics);
  session.events.diagnose(diagnostics);
  if (!summary) return wrong_input;
  if (session.events.wants_data()) {
    DataMembers members{{"file", path}};
    std::ranges::move(summary->members, std::back_inserter(members));
    session.events.event(summary->event, std::move(members));
  } else {
    session.events.print(path + ": " + summary->kind + "\n" + summary->text);
  }
  return done;
}

}  // namespace ombre::jobs

#include "jobs/characterise/random_cells.h"

#include "base/math/voronoi_cells.h"
#include "base/text/text.h"
#include "design/registry.h"

namespace ombre::compile {
namespace {

std::vector<Vec3> points_of(const Data& data) {
  std::vector<Vec3> points;
  if (!data.list()) return points;
  for (const Data& one : *data.list()) {
    const DataList& numbers = *one.list();
    points.push_back({*numbers[0].number(), *numbers[1].number(), *numbers[2].number()});
  }
  return points;
}

void measure(const OfPoints<VoronoiCell>& all, RandomCells& found) {
  std::vector<double> volumes, faces;
  double edges = 0, length = 0, sides = 0;
  for (const VoronoiCell& cell : all.list) {
    if (!cell.is_inner) continue;
    volumes.push_back(cell.volume_mm3);
    faces.push_back(static_cast<double>(cell.faces));
    edges += static_cast<double>(cell.edges);
    length += cell.edges_mm;
    sides += static_cast<double>(cell.faces);
  }
  found.cells = volumes.size();
  found.volume_mm3 = Spread::of(volumes);
  found.faces = Spread::of(faces);
  if (found.cells == 0) return;
  found.edges_of_face = 2 * edges / sides;
  found.edge_mm = length / edges;
}

}  // namespace

DataMembers RandomCells::data() const {
  return {{"node", node},
          {"line", static_cast<double>(line)},
          {"points", static_cast<double>(points)},
          {"cells", static_cast<double>(cells)},
          {"volume_mm3", volume_mm3.data()},
          {"faces", faces.data()},
          {"edges_of_face", edges_of_face},
          {"edge_mm", edge_mm}};
}

std::string RandomCells::text() const {
  const auto number = [](double value) { return format_rounded(value, 4); };
  std::string text = node + (line > 0 ? ", line " + std::to_string(line) : "") + ": " + format_count(points) +
                     " points, " + format_count(cells) + (cells == 1 ? " cell" : " cells") + " away from the rim";
  if (cells == 0) return text;
  return text + "; " + number(volume_mm3.least) + " to " + number(volume_mm3.greatest) + " mm3, " +
         number(volume_mm3.mean) + " mm3 in the mean with a variation of " + number(volume_mm3.variation) + "; " +
         number(faces.least) + " to " + number(faces.greatest) + " faces, " + number(faces.mean) + " in the mean, of " +
         number(edges_of_face) + " edges; edges are " + number(edge_mm) + " mm long in the mean";
}

std::vector<RandomCells> random_cells_of(const design::Design& design) {
  std::vector<RandomCells> all;
  for (const design::Node* node : design::topological(design.roots())) {
    const std::string& name = node->type().name;
    const auto number = node->type().output("points");
    if (!name.starts_with("voronoi_") || !number) continue;
    const std::vector<Vec3> points = points_of(node->constant(*number));
    const OfPoints<VoronoiCell> cells = voronoi_cells(points);
    if (!cells.problem.empty()) continue;  // fewer than five points
    const SourceRange& where = node->where();
    RandomCells& found = all.emplace_back();
    found.node = name;
    found.line = where.source ? where.source->place(where.begin).line : 0;
    found.points = points.size();
    measure(cells, found);
  }
  return all;
}

}  // namespace ombre::compile

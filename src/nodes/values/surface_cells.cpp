// Maps of cells on surfaces.
#include "base/system/assert.h"
#include "base/text/text.h"
#include "nodes/values/cell_counts.h"
#include "nodes/values/cell_outputs.h"
#include "nodes/values/surface_part.h"
#include "nodes/values/whole_cells.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct SurfaceCells : CellOutputs<SurfaceCells>, OnSurfacePart {
  std::optional<FilePath> to;
  std::optional<Vec3> size;
  std::optional<Counts3> count;
  double height = 5, standoff = 0;
  Choice side = "outside", trim = "border", pairing = "normal";
  std::optional<Vec3> to_at, to_min, to_max, to_normal;
  std::string to_kind;
  double to_least_area = 0, to_most_area = 0;
  std::shared_ptr<const SurfaceSpace> space;  // made with the node
  program::SourceField whole;                 // made with the node; null unless only whole cells are kept

  static Spec<SurfaceCells> spec() {
    std::vector<OutputSpec<SurfaceCells>> all = outputs();
    all.emplace_back("border", static_cast<Field (SurfaceCells::*)(const Ask&) const>(&SurfaceCells::border),
                     "Distance to the border of the part at the same height, mm");
    all.emplace_back("report", &SurfaceCells::report, "Extents, stretches and volumes of cells, as text");
    return {
        "surface_cells",
        "A map of cells on a part of a mesh, which is laid out in a plane, or on a face of a CAD file: u and v run "
        "along "
        "the surface, w away from it, or to another surface.",
        joined(joined(joined(path_parameter<SurfaceCells>(), layer_parameters()),
                      part_parameters<SurfaceCells>("Greatest distance of the highest cells from the other surface, "
                                                    "and of triangles from a CAD file's faces")),
               pair_parameters()),
        no_inputs,
        "tpms(\"gyroid\", map=surface_cells(\"models/insole.off\", (8, 8, 4), height=4, normal=(0, 0, 1)), "
        "thickness=0.6, material=\"red\");",
        std::move(all)};
  }

  static std::vector<Parameter<SurfaceCells>> layer_parameters() {
    return {
        {"size", &SurfaceCells::size, cell_size_doc, unit::positive_mm},
        {"count", &SurfaceCells::count, cell_count_doc, whole_from_one()},
        {"height", &SurfaceCells::height, "Height of all cells above one another", unit::positive_mm},
        {"standoff", &SurfaceCells::standoff, "Distance of the lowest cells from the surface", unit::not_negative_mm},
        {"side", &SurfaceCells::side, "Side of the surface", one_of({"outside", "inside"})},
        {"to", &SurfaceCells::to,
         "Another mesh or CAD file: cells reach from the surface up to it, along the normal; height and standoff do "
         "not count"},
        {"trim", &SurfaceCells::trim,
         "border: the border of the part cuts cells; cells: only whole cells are kept; none: cells go on beyond the "
         "border "
         "of a face of a CAD file, over all between its least and greatest u and v",
         one_of({"border", "cells", "none"})}};
  }

  static std::vector<Parameter<SurfaceCells>> pair_parameters() {
    return {
        {"pairing", &SurfaceCells::pairing,
         "How places are joined with those of the other surface: along the normals; or at equal shares of u and v, "
         "which run "
         "along its u and v (uv) or its v and u (vu), some of them flipped, or such that ways are short (nearest)",
         one_of({pairings.begin(), pairings.end()})},
        {"to_at", &SurfaceCells::to_at, "Takes a part of the other surface as `at` does", unit::on_surface},
        {"to_min", &SurfaceCells::to_min, "Least corner of a box for parts of the other surface", unit::point},
        {"to_max", &SurfaceCells::to_max, "Greatest corner of that box", unit::point},
        {"to_normal", &SurfaceCells::to_normal, "Takes a part of the other surface as `normal` does", unit::direction},
        {"to_kind", &SurfaceCells::to_kind, "Kind of the faces of the other file that are taken"},
        {"to_least_area", &SurfaceCells::to_least_area, "Least area of the faces of the other file that are taken",
         not_negative("mm^2")},
        {"to_most_area", &SurfaceCells::to_most_area,
         "Greatest area of the faces of the other file that are taken; 0: any", not_negative("mm^2")}};
  }

  bool complete(const Reader& reader) {
    if (!are_sound(reader) || !is_box_or_none(reader, to_min, to_max) || !has_length(reader, "to_normal", to_normal))
      return false;
    if (!to && (!(pairing == "normal") || to_at || to_min || to_normal || !to_kind.empty()))
      return reader.refuse("surface_cells has no other surface to pair with",
                           "write its file, for example " + spelled::parameter("to", "\"part.step\""));
    SurfaceRequest request{layout(), part()};
    if (to) request.to = choice(*to, to_at, to_min, to_max, to_normal, to_kind, {to_least_area, to_most_area});
    request.pairing = pairing;
    request.part.is_rectangle = request.to.is_rectangle = trim == "none";
    request.standoff_mm = standoff;
    request.height_mm = height;
    request.is_inward = side == "inside";
    space = reader.loader->source(request, reader);
    path = request.part.file;
    if (to) to = request.to.file;
    if (!space) return false;
    return find_counts(reader, {space->lengths.x, space->lengths.y, space->thickness_mm}, size, count, counts) &&
           (!(trim == "cells") || find_whole_cells(reader));
  }

  Slope cells_at(const Point& p) const {
    return {read(p, "u") * scale(0), read(p, "v") * scale(1), (read(p, "height") - space->heights.lo) * scale(2)};
  }
  Slope slope(const Point& p, size_t n) const {
    constexpr std::array names{"u_x", "u_y", "u_z", "v_x", "v_y", "v_z", "height_x", "height_y", "height_z"};
    return {read(p, names[3 * n]) * scale(n), read(p, names[3 * n + 1]) * scale(n),
            read(p, names[3 * n + 2]) * scale(n)};
  }

  Field outside(const Ask& ask) const {
    const Field cut = read(ask.p, "outside");
    return whole ? select(is_kept(ask.p), cut, program::max(cut, ask.p.constant(1))) : cut;
  }
  Field inside(const Ask& ask) const {
    const Field in_shell = read(ask.p, "inside");
    return whole ? logical_and(in_shell, is_kept(ask.p)) : in_shell;
  }
  Box region_within(const Box&) const { return space->source->bounds(); }
  Field border(const Ask& ask) const { return read(ask.p, "border"); }

  std::string report() const {
    const Vec2 lengths = space->lengths;
    const double cell = space->lengths.x * space->lengths.y * (space->heights.hi - space->heights.lo) /
                        (counts.x * counts.y * counts.z);
    return format_rounded(lengths.x) + " x " + format_rounded(lengths.y) + " x " + format_rounded(space->thickness_mm) +
           " mm, " + format_rounded(counts.x) + " x " + format_rounded(counts.y) + " x " + format_rounded(counts.z) +
           " cells; lengths along the surface are stretched by " + range_text(space->stretches, 1) + unevenness() +
           "; volumes of cells are " + range_text(space->volumes, cell) + " mm^3";
  }

 private:
  // Returns nothing where lengths are stretched alike in all directions.
  std::string unevenness() const {
    const std::string times = format_rounded(space->aspect);
    return times == "1" ? "" : ", in one place by up to " + times + " times as much in one direction as in the other";
  }
  Field is_kept(const Point& p) const {
    const Slope place = cells_at(p);
    return p.builder().source(whole, 0, place[0], place[1], p.constant(0));
  }

  bool find_whole_cells(const Reader& reader) {
    if (counts.x * counts.y > most_whole_cells)
      return reader.refuse("surface_cells has too many cells to look for whole ones", "make cells larger");
    std::vector<CellLine> border;
    for (const auto& [a, b] : space->border)
      border.push_back({Vec2{a.x * scale(0), a.y * scale(1)}, Vec2{b.x * scale(0), b.y * scale(1)}});
    whole = whole_cells(static_cast<size_t>(counts.x), static_cast<size_t>(counts.y), border);
    return whole != nullptr ||
           reader.refuse("no whole cell of surface_cells lies on the surface",
                         "make cells smaller, or write " + spelled::parameter("trim", "\"border\""));
  }
  static std::string range_text(Interval range, double scale) {
    return format_rounded(range.lo * scale) + " to " + format_rounded(range.hi * scale);
  }
  double scale(size_t n) const {
    const double lengths[] = {space->lengths.x, space->lengths.y, space->heights.hi - space->heights.lo};
    return counts[static_cast<int>(n)] / lengths[n];
  }
  Field read(const Point& p, const char* name) const {
    const int channel = space->source->channel(name);
    ASSERT(channel >= 0);
    return p.builder().source(space->source, channel, p.x, p.y, p.z);
  }
};

}  // namespace

void add_surface_cells(Registry& registry) { registry.add<SurfaceCells>("cells"); }

}  // namespace ombre::nodes

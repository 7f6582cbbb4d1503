// Solids from grids of numbers.
#include "base/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/all_nodes.h"
#include "nodes/shapes.h"

namespace ombre::nodes {
namespace {

using namespace design;

// From the frame of a file to one that is wanted, or nothing where the file does not say enough.
std::optional<Affine> turn_of(PatientSpace from, std::string_view wanted) {
  const auto known = [&](double x, double y) { return std::optional(Affine::scaling({x, y, 1})); };
  const bool is_ras = wanted == "RAS";
  if (from == PatientSpace::ras) return is_ras ? known(1, 1) : known(-1, -1);
  if (from == PatientSpace::lps) return is_ras ? known(-1, -1) : known(1, 1);
  if (from == PatientSpace::las) return is_ras ? known(-1, 1) : known(1, -1);
  return std::nullopt;
}

struct VolumeSolid {
  FilePath path;
  MaterialName material;
  double level = 0.5;
  int label = -1;
  bool above = true;
  std::optional<Vec3> spacing, origin;
  Choice space = "file";
  std::shared_ptr<const VolumeGrid> grid;  // read when the node is made
  Affine here_from_index, index_from_here;

  static Spec<VolumeSolid> spec() {
    return {
        "volume_solid",
        "imported",
        "Everything in a grid of numbers (NRRD, NPY, raw) where they reach a level, or where they are a label.",
        {{"path", &VolumeSolid::path, "The file; relative to the script, then to the working directory", required()},
         {"material", &VolumeSolid::material, "Its material"},
         {"level", &VolumeSolid::level, "Inside are values of at least this, interpolated between voxels' centres"},
         {"label", &VolumeSolid::label,
          "Inside are the voxels with this number, whole and not interpolated; -1: by level",
          from_to(-1, greatest_label)},
         {"above", &VolumeSolid::above, "Inside are values above the level; false: those below it"},
         {"spacing", &VolumeSolid::spacing, "Lengths of a voxel; none: those of the file", unit::positive_mm},
         {"origin", &VolumeSolid::origin, "Centre of the first voxel; none: that of the file", unit::mm},
         {"space", &VolumeSolid::space,
          "Frame of the places: the file's own, or RAS or LPS, for which the file must say what it has",
          one_of({"file", "RAS", "LPS"})}},
        no_inputs,
        "volume_solid(\"models/two_lobes.nrrd\", \"red\", level=100);"};
  }

  bool complete(const Reader& reader) {
    const auto fail = [&](const std::string& message, const std::string& hint) {
      reader.diagnostics.error(reader.where, message, hint);
      return false;
    };
    if (!reader.loader) return fail("volumes cannot be read here", "");
    VolumeRequest request{path};
    grid = reader.loader->source(request, reader);
    if (!grid) return false;
    path = request.file;
    if (!grid->space_from_index && !spacing)
      return fail("the volume \"" + path.path + "\" does not say how large its voxels are",
                  "write spacing=(0.5, 0.5, 1), in mm along its axes");
    here_from_index = placed();
    if (!turn(fail)) return false;
    index_from_here = inverse(here_from_index);
    return true;
  }

  Metric metric() const { return Metric::implicit(); }

  Box reach(const Inputs&, const Box& where, double margin) const {
    const Box places = grid->places(channel(), wanted(margin));
    if (places.is_empty()) return places;
    const Box box = image(here_from_index, places.expanded(margin));
    return intersect(box.expanded(1e-9 * (length(box.size()) + length(here_from_index.offset))), where);
  }

  Field distance(const Point& p) const {
    const Point at = p.mapped(index_from_here);
    const Box cells = grid->source->bounds();
    const Vec3 c = cells.center(), h = 0.5 * cells.size();
    const Field from_grid = corner(abs(at.x - c.x) - h.x, abs(at.y - c.y) - h.y, abs(at.z - c.z) - h.z);
    const Field read = p.builder().source(grid->source, channel(), at.x, at.y, at.z);
    const Field value = label >= 0 ? abs(read - label) - 0.5 : above ? level - read : read - level;
    return select(from_grid <= 0, value, program::max(value, from_grid));
  }

 private:
  static constexpr int greatest_label = (1 << 24) - 1;  // that floats tell from its neighbours

  int channel() const {
    const int number = grid->source->channel(label >= 0 ? "nearest" : "value");
    ASSERT(number >= 0);
    return number;
  }

  // Values where g is `margin` or less.
  Interval wanted(double margin) const {
    if (label >= 0) return {label - 0.5 - margin, label + 0.5 + margin};
    return above ? Interval(level - margin, Box::inf) : Interval(-Box::inf, level + margin);
  }

  // The file's directions, with the lengths and the origin that are given.
  Affine placed() const {
    Affine map = grid->space_from_index.value_or(Affine{});
    if (spacing)
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step{map.rows[0][axis], map.rows[1][axis], map.rows[2][axis]};
        for (Vec3& row : map.rows) row[axis] *= (*spacing)[axis] / length(step);
      }
    if (origin) map.offset = *origin;
    return map;
  }

  template <class Fail>
  bool turn(const Fail& fail) {
    const std::string file = "the volume \"" + path.path + '"';
    if (space == "file") {
      if (grid->space == PatientSpace::las || grid->space == PatientSpace::left_handed)
        return fail(file + " has left-handed axes, in which it would be mirrored here",
                    grid->space == PatientSpace::las ? "write space=\"RAS\" or space=\"LPS\""
                                                     : "save it in a right-handed space");
      return true;
    }
    const auto map = turn_of(grid->space, space.text());
    if (!map) return fail(file + " does not say where the right side of a patient is", "leave space out");
    here_from_index = *map * here_from_index;
    return true;
  }
};

}  // namespace

void add_volumes(Registry& registry) { registry.add<VolumeSolid>(); }

}  // namespace ombre::nodes

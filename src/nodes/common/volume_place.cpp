#include "nodes/common/volume_place.h"

#include "base/system/assert.h"

namespace ombre::nodes {
namespace {

using design::PatientSpace;

// Returns the map from a file's coordinate system to the wanted one, or nothing if the file does not specify its own.
std::optional<Affine> turn_of(PatientSpace from, std::string_view wanted) {
  const auto known = [&](double x, double y) { return std::optional(Affine::scaling({x, y, 1})); };
  const bool is_ras = wanted == "RAS";
  if (from == PatientSpace::ras) return is_ras ? known(1, 1) : known(-1, -1);
  if (from == PatientSpace::lps) return is_ras ? known(-1, -1) : known(1, 1);
  if (from == PatientSpace::las) return is_ras ? known(-1, 1) : known(1, -1);
  return std::nullopt;
}

}  // namespace

bool VolumePlace::read_volume(const design::Reader& reader, design::VolumeRequest request) {
  if (!reader.loader) return reader.refuse("volumes cannot be read here");
  request.file = path;
  request.series = series;
  request.channel = voxel_channel;
  request.phase = phase;
  request.nan = nan;
  request.is_regular = is_regular;
  request.has_space = space != "file";
  grid = reader.loader->source(request, reader);
  if (!grid) return false;
  segment_label = request.label;
  path = request.file;
  if (!grid->space_from_index && !spacing && space != "index")
    return reader.refuse("the volume \"" + path.path + "\" does not say how large its voxels are",
                         "write " + spelled::parameter("spacing", "(0.5, 0.5, 1)") + ", in mm along its axes");
  here_from_index = placed();
  if (!turn(reader)) return false;
  index_from_here = inverse(here_from_index);
  return true;
}

int VolumePlace::channel(const char* name) const {
  const int number = grid->source->channel(name);
  ASSERT(number >= 0);
  return number;
}

// Returns the file's map with the spacing and origin of the node, if given.
Affine VolumePlace::placed() const {
  Affine map = grid->space_from_index.value_or(Affine{});
  if (spacing)
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step{map.rows[0][axis], map.rows[1][axis], map.rows[2][axis]};
      for (Vec3& row : map.rows) row[axis] *= (*spacing)[axis] / length(step);
    }
  if (origin) map.offset = *origin;
  return map;
}

bool VolumePlace::turn(const design::Reader& reader) {
  if (space == "index") {
    if (spacing || origin)
      return reader.refuse("space=\"index\" counts voxels, which have no spacing and no origin", "leave these out");
    here_from_index = Affine{};
    return true;
  }
  const std::string file = "the volume \"" + path.path + '"';
  if (space == "file") {
    if (grid->space == PatientSpace::las || grid->space == PatientSpace::left_handed)
      return reader.refuse(file + " has left-handed axes, in which it would be mirrored here",
                           grid->space == PatientSpace::las ? "write " + spelled::parameter("space", "\"RAS\"") +
                                                                  " or " + spelled::parameter("space", "\"LPS\"")
                                                            : Phrase("save it in a right-handed space"));
    return true;
  }
  const auto map = turn_of(grid->space, space.text());
  if (!map) return reader.refuse(file + " does not say where the right side of a patient is", "leave space out");
  here_from_index = *map * here_from_index;
  return true;
}

}  // namespace ombre::nodes

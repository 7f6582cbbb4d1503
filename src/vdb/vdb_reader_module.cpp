// Reads .vdb files as dense grids: part of the module.
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/system/helper_process.h"
#include "base/text/error.h"
#include "vdb/grid_reader.h"

namespace ombre::vdb {
namespace {

constexpr double most_bytes = 16.0 * (1U << 30);

[[noreturn]] void fail(const std::string& path, const std::string& message) {
  throw Error(Code::file_content, "the grid file \"" + path + "\" " + message, {{"file", path}});
}

std::string names_in(openvdb::io::File& file) {
  std::string names;
  for (auto name = file.beginName(); name != file.endName(); ++name)
    names += (names.empty() ? "" : ", ") + name.gridName();
  return names;
}

openvdb::GridBase::Ptr find_grid(openvdb::io::File& file, const std::string& path, const std::string& wanted) {
  const std::string names = names_in(file);
  if (names.empty()) fail(path, "holds no grids");
  if (wanted.empty() && names.find(", ") != std::string::npos)
    fail(path, "holds several grids: " + names + "; choose one by series=\"" + file.beginName().gridName() + '"');
  const std::string name = wanted.empty() ? file.beginName().gridName() : wanted;
  if (!file.hasGrid(name)) fail(path, "holds no grid \"" + name + "\"; it holds " + names);
  return file.readGrid(name);
}

openvdb::CoordBBox voxels_of(const openvdb::GridBase& grid, const std::string& path) {
  openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) fail(path, "has a grid without active voxels");
  box.expand(1);
  const auto dim = box.dim();
  if (static_cast<double>(dim.x()) * dim.y() * dim.z() * sizeof(float) > most_bytes)
    fail(path, "has " + std::to_string(dim.x()) + " x " + std::to_string(dim.y()) + " x " + std::to_string(dim.z()) +
                   " voxels, which are more than 16 GiB; cut it or make it coarser");
  return box;
}

template <class Value>
constexpr int channels_of() {
  if constexpr (requires { Value::size; })
    return static_cast<int>(Value::size);
  else
    return 1;
}

template <class Value>
float number_of(const Value& value, int channel) {
  if constexpr (channels_of<Value>() == 1)
    return static_cast<float>(value);
  else
    return static_cast<float>(channel >= 0 ? static_cast<double>(value[channel])
                                           : static_cast<double>(openvdb::Vec3d(value).length()));
}

template <class Grid>
bool take(const openvdb::GridBase& base, const std::string& path, int channel, DenseGrid& dense) {
  const auto* grid = dynamic_cast<const Grid*>(&base);
  if (!grid) return false;
  dense.channels = channels_of<typename Grid::ValueType>();
  if (channel >= dense.channels)
    fail(path, "has no channel " + std::to_string(channel) + " in its grid \"" + base.getName() + "\", which has " +
                   std::to_string(dense.channels));
  const openvdb::CoordBBox box = voxels_of(base, path);
  const auto dim = box.dim();
  dense.count = {dim.x(), dim.y(), dim.z()};
  dense.values.reserve(static_cast<size_t>(dim.x()) * static_cast<size_t>(dim.y()) * static_cast<size_t>(dim.z()));
  const auto accessor = grid->getConstAccessor();
  for (int k = box.min().z(); k <= box.max().z(); ++k)
    for (int j = box.min().y(); j <= box.max().y(); ++j)
      for (int i = box.min().x(); i <= box.max().x(); ++i)
        dense.values.push_back(number_of(accessor.getValue({i, j, k}), channel));
  const auto place = [&](int i, int j, int k) {
    const openvdb::Vec3d p =
        base.transform().indexToWorld(openvdb::Vec3d(box.min().x() + i, box.min().y() + j, box.min().z() + k));
    return Vec3{p.x(), p.y(), p.z()};
  };
  const Vec3 origin = place(0, 0, 0);
  const Vec3 steps[] = {place(1, 0, 0) - origin, place(0, 1, 0) - origin, place(0, 0, 1) - origin};
  for (int axis = 0; axis < 3; ++axis)
    for (int n = 0; n < 3; ++n) dense.space_from_index.rows[static_cast<size_t>(axis)][n] = steps[n][axis];
  dense.space_from_index.offset = origin;
  return true;
}

DenseGrid read(const std::string& path, const std::string& name, int channel) {
  openvdb::initialize();
  openvdb::io::File file(path);
  file.open(false);
  const openvdb::GridBase::Ptr grid = find_grid(file, path, name);
  if (!grid->transform().isLinear()) fail(path, "has a grid in perspective; resample it");
  DenseGrid dense;
  dense.name = grid->getName();
  const auto is_taken = [&]<class... Grid>() { return (take<Grid>(*grid, path, channel, dense) || ...); };
  using namespace openvdb;
  if (!is_taken.
       operator()<FloatGrid, DoubleGrid, Int32Grid, Int64Grid, BoolGrid, MaskGrid, Vec3SGrid, Vec3DGrid, Vec3IGrid>())
    fail(path, "has a grid of the type " + grid->valueType() + "; numbers, flags and vectors are read");
  return dense;
}

std::string pack(const DenseGrid& grid) {
  std::string bytes(
      sizeof grid.channels + sizeof grid.count + sizeof grid.space_from_index + grid.values.size() * sizeof(float),
      '\0');
  char* to = bytes.data();
  std::memcpy(to, &grid.channels, sizeof grid.channels);
  std::memcpy(to += sizeof grid.channels, &grid.count, sizeof grid.count);
  std::memcpy(to += sizeof grid.count, &grid.space_from_index, sizeof grid.space_from_index);
  std::memcpy(to + sizeof grid.space_from_index, grid.values.data(), grid.values.size() * sizeof(float));
  return bytes + grid.name;
}

DenseGrid unpack(const std::string& bytes) {
  DenseGrid grid;
  const char* from = bytes.data();
  std::memcpy(&grid.channels, from, sizeof grid.channels);
  std::memcpy(&grid.count, from += sizeof grid.channels, sizeof grid.count);
  std::memcpy(&grid.space_from_index, from += sizeof grid.count, sizeof grid.space_from_index);
  from += sizeof grid.space_from_index;
  grid.values.resize(static_cast<size_t>(grid.count[0] * grid.count[1] * grid.count[2]));
  std::memcpy(grid.values.data(), from, grid.values.size() * sizeof(float));
  grid.name = from + grid.values.size() * sizeof(float);
  return grid;
}

}  // namespace
}  // namespace ombre::vdb

// Reads files in a helper process, because broken files may crash the library.
void ombre_read_vdb_grid(const std::string* path, const std::string* name, int channel, const ombre::StopFlag* stop,
                         ombre::vdb::DenseGrid* grid) {
  using namespace ombre;
  using namespace ombre::vdb;
  std::error_code failed;
  const uintmax_t size = std::filesystem::file_size(*path, failed);
  constexpr double least_seconds = 30, seconds_for_a_byte = 1e-6;
  const HelperLimits limits{least_seconds + seconds_for_a_byte * static_cast<double>(failed ? 0 : size),
                            size_t{40} << 30};
  const auto explain = [&](HelperFailure failure) {
    return Error(Code::file_content,
                 "the grid file \"" + *path + "\" is broken: reading it " +
                     (failure == HelperFailure::crashed ? "crashes the library" : "takes too long"),
                 {{"file", *path}});
  };
  const auto work = [&] {
    try {
      return pack(read(*path, *name, channel));
    } catch (const openvdb::Exception& error) {
      throw Error(Code::cannot_read, "the grid file \"" + *path + "\" cannot be read: " + error.what(),
                  {{"file", *path}});
    } catch (const std::bad_alloc&) {
      throw Error(Code::memory, "the grid file \"" + *path + "\" needs more memory than there is");
    }
  };
  *grid = unpack(run_in_helper(work, limits, explain, stop));
}

// Voxels on the faces of cuts, as the printer gets them.
#include <cmath>
#include <map>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "jobs/slice/job_description.h"
#include "studio/views.h"

namespace ombre::studio {
namespace {

class FaceVoxels {
  using Index = std::array<int64_t, 3>;
  using Tile = std::vector<MaterialId>;     // voxels, x fastest, z slowest
  static constexpr int64_t tile_side = 64;  // voxels along each of a face's axes
  static constexpr double behind = 1e-6;    // pitches from a face to the place whose voxel is shown

 public:
  FaceVoxels(CutDesignPtr cut, design::SubDesignMemory& memory, const StopFlag& stop)
      : cut_(std::move(cut)),
        memory_(memory),
        stop_(stop),
        job_(hash_bytes("voxels on faces " + print_json(compile::describe_job(cut_->plan.request)))) {
    for (const compile::SliceMaterial& material : cut_->plan.request.materials) colours_[material.id] = material.rgba;
  }

  std::vector<std::optional<formats::Rgba>> of(const std::vector<compile::FacePlace>& places) {
    std::vector<std::optional<formats::Rgba>> found(places.size());
    std::vector<std::optional<Index>> voxels;
    std::map<std::pair<int, Index>, Tile> tiles;  // by the axis of the face and the first voxel
    for (const compile::FacePlace& place : places) {
      voxels.push_back(voxel_at(place));
      if (voxels.back()) tiles.try_emplace({place.face.axis, first_of_tile(*voxels.back(), place.face.axis)});
    }
    make(tiles);
    for (size_t n = 0; n < places.size(); ++n)
      if (voxels[n]) found[n] = colour_in(tiles, places[n].face.axis, *voxels[n]);
    return found;
  }

 private:
  std::optional<Index> voxel_at(const compile::FacePlace& place) const {
    const voxel::Lattice& lattice = cut_->plan.request.lattice;
    Index voxel{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<size_t>(axis);
      const bool is_across = axis == place.face.axis;
      const double mm = is_across ? place.face.mm : place.at[axis];
      const double in_voxels =
          (mm - lattice.origin[axis]) / lattice.pitch[n].mm() + (is_across ? place.face.inward * behind : 0);
      if (!(in_voxels >= 0 && in_voxels < static_cast<double>(lattice.count[n]))) return std::nullopt;
      voxel[n] = static_cast<int64_t>(in_voxels);
    }
    return voxel;
  }

  static Index first_of_tile(Index voxel, int across) {
    for (size_t axis = 0; axis < 3; ++axis)
      if (axis != static_cast<size_t>(across)) voxel[axis] -= voxel[axis] % tile_side;
    return voxel;
  }
  voxel::TileBox box_of(int across, const Index& first) const {
    Index end{};
    for (size_t axis = 0; axis < 3; ++axis)
      end[axis] = axis == static_cast<size_t>(across)
                      ? first[axis] + 1
                      : std::min(first[axis] + tile_side, cut_->plan.request.lattice.count[axis]);
    return {first, end};
  }

  template <class Tiles>
  void make(Tiles& tiles) {
    std::vector<typename Tiles::value_type*> all;
    for (auto& tile : tiles) all.push_back(&tile);
    run_parallel(all.size(), 0, [&](size_t n) {
      auto& [key, tile] = *all[n];
      const auto& [across, first] = key;
      const Hash own = key_of(across, first);
      if (const auto known = memory_.find(own)) {
        tile = *std::static_pointer_cast<const Tile>(known);
        return;
      }
      tile = made(box_of(across, first));
      memory_.keep(own, std::make_shared<const Tile>(tile), tile.size() * sizeof(MaterialId));
    });
  }
  Hash key_of(int across, const Index& first) const {
    std::string text = job_.hex();
    for (const int64_t number : {int64_t{across}, first[0], first[1], first[2]}) text += ' ' + std::to_string(number);
    return hash_bytes(text);
  }
  Tile made(const voxel::TileBox& box) const {
    if (stop_.requested()) throw Cancelled();
    const auto width = static_cast<size_t>(box.hi[0] - box.lo[0]);
    Tile tile;
    for (const voxel::LayerResult& layer : cut_->plan.regions(box, &stop_))
      for (uint32_t row = 0; row < layer.materials().height(); ++row) {
        tile.resize(tile.size() + width);
        layer.materials().row(row).unpack(tile.data() + tile.size() - width);
      }
    return tile;
  }

  template <class Tiles>
  std::optional<formats::Rgba> colour_in(const Tiles& tiles, int across, const Index& voxel) const {
    const Index first = first_of_tile(voxel, across);
    const voxel::TileBox box = box_of(across, first);
    const int64_t width = box.hi[0] - box.lo[0], height = box.hi[1] - box.lo[1];
    const int64_t place = ((voxel[2] - first[2]) * height + (voxel[1] - first[1])) * width + (voxel[0] - first[0]);
    const auto found = colours_.find(tiles.at({across, first})[static_cast<size_t>(place)]);
    return found == colours_.end() ? std::nullopt : std::optional(found->second);
  }

  CutDesignPtr cut_;
  design::SubDesignMemory& memory_;
  const StopFlag& stop_;
  Hash job_;
  std::map<MaterialId, formats::Rgba> colours_;
};

}  // namespace

compile::FaceColours voxels_on_faces(CutDesignPtr cut, design::SubDesignMemory& memory, const StopFlag& stop) {
  const auto voxels = std::make_shared<FaceVoxels>(std::move(cut), memory, stop);
  return [voxels](const std::vector<compile::FacePlace>& places) { return voxels->of(places); };
}

}  // namespace ombre::studio

// The colours at the ends of rays in opaque material.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "render/queried_tiles.h"
#include "render/ray_batch.h"

namespace ombre::render {

class EndColours {
 public:
  // `whole` says colours; all outlive this.
  EndColours(const program::Program& whole, const RaySteps& steps, RayBand& hits)
      : whole_(whole), hits_(hits), batch_(steps), all_(steps), each_(steps) {}

  // It begins where it ends.
  void note(const Ray& end) { ends_.push_back(end); }
  // Those that were noted get their colours, those that lie together at a time.
  void take(const voxel::StripSources& sources, const std::function<bool()>& is_stopped);

 private:
  using Group = std::span<const Ray>;

  std::vector<size_t> sort_by_group();
  void take(const std::vector<Group>& groups, const voxel::StripSources& sources,
            const std::function<bool()>& is_stopped);
  // By what is left of the program in each_.
  void take(Group group, const voxel::StripSources& sources);

  const program::Program& whole_;
  RayBand& hits_;
  RayBatch batch_;
  QueriedTiles all_, each_;
  std::vector<Ray> ends_, queried_, thin_;
  std::vector<std::pair<uint64_t, uint32_t>> keys_;  // of groups, and numbers of ends
};

}  // namespace ombre::render

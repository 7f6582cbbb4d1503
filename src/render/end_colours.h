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
  // Constructs an empty list of ends; `whole` is the program that evaluates colours. All arguments must outlive this
  // object.
  EndColours(const program::Program& whole, const RaySteps& steps, RayBand& hits)
      : whole_(whole), hits_(hits), batch_(steps), all_(steps), each_(steps) {}

  // Adds a ray's end; the ray begins at its end.
  void note(const Ray& end) { ends_.push_back(end); }
  // Evaluates the colours of all added ends; neighbouring ends are evaluated together.
  void take(const voxel::StripSources& sources, const std::function<bool()>& is_stopped);

 private:
  using Group = std::span<const Ray>;

  std::vector<size_t> sort_by_group();
  void take(const std::vector<Group>& groups, const voxel::StripSources& sources,
            const std::function<bool()>& is_stopped);
  // Evaluates a group with the shortened program in each_.
  void take(Group group, const voxel::StripSources& sources);

  const program::Program& whole_;
  RayBand& hits_;
  RayBatch batch_;
  QueriedTiles all_, each_;
  std::vector<Ray> ends_, queried_, thin_;
  std::vector<std::pair<uint64_t, uint32_t>> keys_;  // keys of groups, with numbers of ends
};

}  // namespace ombre::render

#include "surface/mesh/unfold.h"

#include <algorithm>

namespace ombre::surface {
namespace {

class Unfolder {
 public:
  explicit Unfolder(QuadSurface& surface) : surface_(surface) {}

  void unfold() {
    surface_.refresh();
    for (const uint32_t quad : surface_.folded_quads())
      for (const uint32_t vertex : surface_.mesh().quads[quad].corners)
        if (surface_.is_folded(quad) && surface_.clusters().of(vertex) == vertex) try_places(vertex);
  }

 private:
  std::ptrdiff_t folds(uint32_t quad) const {
    return std::ranges::count_if(surface_.triangles(quad),
                                 [&](const Triangle& triangle) { return surface_.is_folded(triangle, quad); });
  }

  // Returns the number of folded triangles around the vertex if it lay at `at`.
  std::ptrdiff_t folds_at(uint32_t vertex, Vec3 at) {
    surface_.move(vertex, at);
    std::ptrdiff_t count = 0;
    for (const uint32_t quad : surface_.refresh()) count += folds(quad);
    return count;
  }

  void try_places(uint32_t vertex) {
    Vec3 best = surface_.clusters().places()[vertex];
    std::ptrdiff_t fewest = folds_at(vertex, best);
    for (const Vec3& place : places_for(vertex)) {
      const std::ptrdiff_t count = folds_at(vertex, place);
      if (count >= fewest) continue;
      fewest = count;
      best = place;
    }
    folds_at(vertex, best);
  }

  std::vector<Vec3> places_for(uint32_t vertex) const {
    const Vec3 now = surface_.clusters().places()[vertex], least = surface_.mesh().vertices[vertex].at;
    const Vec3 among_others = middle_of_neighbours(vertex);
    return {0.5 * (now + among_others), among_others, 0.5 * (now + least), least};
  }

  Vec3 middle_of_neighbours(uint32_t vertex) const {
    Vec3 sum;
    double count = 0;
    for (const uint32_t quad : surface_.quads_around(vertex))
      for (const Triangle& triangle : surface_.triangles(quad)) {
        if (std::ranges::find(triangle, vertex) == triangle.end()) continue;
        for (const uint32_t corner : triangle) {
          if (corner == vertex) continue;
          sum = sum + surface_.clusters().places()[corner];
          ++count;
        }
      }
    return count > 0 ? (1 / count) * sum : surface_.clusters().places()[vertex];
  }

  QuadSurface& surface_;
};

}  // namespace

void unfold(QuadSurface& surface) { Unfolder(surface).unfold(); }

}  // namespace ombre::surface

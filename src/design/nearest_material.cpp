#include "design/nearest_material.h"

namespace ombre::design {
namespace {

int colour_distance(const Rgba& a, const Rgba& b) {
  int sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

}  // namespace

const Material& nearest_material(const Rgba& colour, const MaterialTable& table) {
  const Material* best = &table.first();
  for (const Material& material : table.all())
    if (material.id != 0 && colour_distance(material.colour, colour) < colour_distance(best->colour, colour))
      best = &material;
  return *best;
}

}  // namespace ombre::design

#include "design/many_parts.h"

namespace ombre::design {

PartFields ManyParts::at(const Point& p) const {
  const auto slot = [&](size_t number) { return p.builder().parts(set, number, p.x, p.y, p.z); };
  PartFields fields;
  fields.inside = slot(set->held_slot);
  if (count_slot > 0) fields.count = slot(count_slot);
  if (along_slot > 0) fields.along = slot(along_slot);
  if (weight_slot > 0) fields.weight = slot(weight_slot);
  const auto composition = [&](const CompositionSlots& slots) {
    Composition result;
    for (const auto& [id, number] : slots.materials) result.fractions.emplace_back(id, slot(number));
    for (const auto& [check, number] : slots.checks) result.checks.emplace_back(check, slot(number));
    return result;
  };
  fields.composition = composition(held);
  fields.weighed = composition(weighed);
  fields.others = others;
  fields.only = only;
  return fields;
}

}  // namespace ombre::design

#include "design/many_parts.h"

#include <cmath>

#include "base/tasks.h"
#include "design/lowering.h"
#include "design/part_rows.h"

namespace ombre::design {
namespace {

// A few parts are worth a table where they are short and leave most of the space between them empty. Else less is to be
// computed when they are written out and shortened tile by tile; of many the index in space spares more.
constexpr size_t least_parts = 3, many_parts = 32;
constexpr double most_filling_of_few = 0.25;
constexpr size_t longest_of_few = 100;  // instructions
constexpr size_t parts_per_task = 256;

// Half the distance from part to part, about.
double finest_piece(const Node& node, const PartList& list, const Affine& node_from_program) {
  const Vec3 size = image(inverse(node_from_program), node.bounds(design_space())).size();
  return 0.5 * std::cbrt(size.x * size.y * size.z / static_cast<double>(list.count()));
}

ManyParts make_parts(const PartsQuestion& question, int threads) {
  const size_t count = question.list.count(), tasks = (count + parts_per_task - 1) / parts_per_task;
  PartRows all(question);
  all.expect_all();
  const auto produce = [&](size_t task) {
    auto rows = std::make_unique<PartRows>(question);
    const size_t begin = task * parts_per_task;
    for (size_t part = begin; part < std::min(begin + parts_per_task, count); ++part) rows->add(part);
    return rows;
  };
  const auto consume = [&](size_t, std::unique_ptr<PartRows>& rows) { all.append(*rows); };
  const size_t window = 4 * static_cast<size_t>(threads > 0 ? threads : core_count());
  run_ordered<std::unique_ptr<PartRows>>(tasks, threads, window, produce, consume);
  return std::move(all).finish();
}

bool pays(const ManyParts& made, size_t count) {
  const size_t in_table = count - made.others.size();
  if (in_table < least_parts || in_table >= many_parts) return in_table >= many_parts;
  const program::PartTable& table = made.set->batch;
  for (uint32_t body = 0; body < table.body_count(); ++body)
    if (table.body(body).code.code.size() > longest_of_few) return false;
  return made.set->index.filling() <= most_filling_of_few;
}

}  // namespace

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

const ManyParts* LoweringContext::many_parts(const Node& node, const PartList& list, PartQuery query,
                                             const Affine& node_from_program, const Falloff* falloff) {
  if (list.count() < least_parts) return nullptr;
  const auto& [rows, offset] = node_from_program;
  const PartsKey key{&node,
                     query,
                     falloff != nullptr,
                     {rows[0].x, rows[0].y, rows[0].z, rows[1].x, rows[1].y, rows[1].z,  //
                      rows[2].x, rows[2].y, rows[2].z, offset.x, offset.y, offset.z}};
  const auto [it, is_new] = many_parts_.try_emplace(key);
  if (is_new) {
    auto made = std::make_unique<ManyParts>(make_parts(
        {*this, node, list, query, falloff, node_from_program, finest_piece(node, list, node_from_program)}, threads_));
    if (pays(*made, list.count())) it->second = std::move(made);
  }
  return it->second.get();
}

}  // namespace ombre::design

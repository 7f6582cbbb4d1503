// Tables of many parts: decides when they pay, and keeps them in memory.
#include <cmath>

#include "base/system/tasks.h"
#include "design/design.h"
#include "design/lowering.h"
#include "design/part_rows.h"

namespace ombre::design {
namespace {

// Thresholds of tables. With `many_parts` or more, the index in space saves time. Fewer are worth a table only if they
// are short and leave most of the space between them empty; otherwise it is faster to write them out and to shorten the
// code for each tile.
constexpr size_t least_parts = 3, many_parts = 32;
constexpr double most_filling_of_few = 0.25;
constexpr size_t longest_of_few = 100;  // number of instructions
constexpr size_t parts_per_task = 256;

// Returns about half the distance between neighbouring parts.
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

constexpr size_t bytes_of_row = 1024;  // approximate size of a row in both tables and the index

// Returns null if a table does not pay.
std::shared_ptr<const ManyParts> make_if_it_pays(const PartsQuestion& question, int threads) {
  auto made = std::make_shared<const ManyParts>(make_parts(question, threads));
  return pays(*made, question.list.count()) ? made : nullptr;
}

// An entry of the memory. `parts` is null if a table does not pay.
struct KeptParts {
  std::shared_ptr<const ManyParts> parts;
};

// True if the parts have checks, whose numbers are valid only within one context.
bool has_checks(const ManyParts& parts) { return !parts.held.checks.empty() || !parts.weighed.checks.empty(); }

}  // namespace

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
  if (!is_new) return it->second.get();
  const PartsQuestion question{
      *this, node, list, query, falloff, node_from_program, finest_piece(node, list, node_from_program)};
  it->second = memory_ ? remembered(question) : make_if_it_pays(question, threads_);
  return it->second.get();
}

size_t LoweringContext::reports() {
  const std::scoped_lock lock(queries_mutex_);
  return diagnostics_.list().size();
}

std::shared_ptr<const ManyParts> LoweringContext::remembered(const PartsQuestion& question) {
  const Hash key = hash_of_parts(question);
  if (const auto known = memory_->find(key)) return std::static_pointer_cast<const KeptParts>(known)->parts;
  const size_t reports_before = reports();
  auto made = make_if_it_pays(question, threads_);
  // Tables of nodes that report messages are not kept, since each job must report them.
  if (reports() == reports_before && !(made && has_checks(*made)))
    memory_->keep(key, std::make_shared<const KeptParts>(KeptParts{made}),
                  made ? bytes_of_row * question.list.count() : 0);
  return made;
}

// Hashes the node with everything below it, and the declarations of attributes in the whole design. A node has only one
// list of parts.
Hash LoweringContext::hash_of_parts(const PartsQuestion& question) const {
  Design design;
  design.materials = materials_;
  design.parts = {{"", NodePtr(std::shared_ptr<const Node>(), &question.node)}};
  std::string text = "table of parts " + hash(design).hex() + ' ' + std::to_string(static_cast<int>(question.query)) +
                     (question.falloff ? " weighed" : "");
  for (const AttributeDeclaration& declared : attributes_) {
    text += '\n' + declared.name + ' ' + std::string(name(declared.type));
    for (const auto& names : {declared.materials, declared.labels})
      for (const std::string& each : names) text += '\t' + each;
  }
  return hash_bytes(text);
}

}  // namespace ombre::design

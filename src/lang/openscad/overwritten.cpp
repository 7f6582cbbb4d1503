#include "lang/openscad/overwritten.h"

#include <algorithm>

#include "lang/openscad/script_evaluator.h"

namespace ombre::lang::openscad {
namespace {

class Finder {
 public:
  Finder(const Program& program, uint32_t definitions_from)
      : main_(program.units.front().path), definitions_from_(definitions_from) {}

  std::vector<Message> run(const Program& program) {
    for (const ast::File& file : program.files) order_.push_back(file.source.get());
    for (const ast::File& file : program.files) statements(file.statements);
    for (const Unit& unit : program.units) {
      scope(unit.plan);
      flush();
    }
    return std::move(messages_);
  }

 private:
  using Pair = std::pair<const ast::Assign*, const ast::Assign*>;

  void scope(const ast::Plan& plan) { found_.insert(found_.end(), plan.replaced.begin(), plan.replaced.end()); }

  void block(const ast::Block& block) {
    scope(block.plan);
    statements(block.statements);
  }

  void statements(const std::vector<ast::StatementPtr>& list) {
    for (const ast::StatementPtr& statement : list) {
      if (statement->kind == ast::Statement::Kind::module) block(static_cast<const ast::ModuleDef&>(*statement).body);
      if (const auto* call = dynamic_cast<const ast::CallStatement*>(statement.get())) block(call->children);
      if (statement->kind == ast::Statement::Kind::group)
        statements(static_cast<const ast::Group&>(*statement).statements);
      if (statement->kind != ast::Statement::Kind::condition) continue;
      const auto& condition = static_cast<const ast::Condition&>(*statement);
      for (const auto& branch : condition.branches) block(branch.second);
      block(condition.otherwise);
    }
  }

  size_t place_of(const ast::Assign& assign) const {
    return static_cast<size_t>(std::ranges::find(order_, assign.span.source) - order_.begin());
  }

  void flush() {
    std::ranges::stable_sort(found_, [&](const Pair& a, const Pair& b) {
      const size_t first = place_of(*a.second), second = place_of(*b.second);
      return first != second ? first < second : a.second->span.begin < b.second->span.begin;
    });
    for (const Pair& pair : found_) report(*pair.first, *pair.second);
    found_.clear();
  }

  // Reports an overwritten variable. The main file may replace variables that it included.
  void report(const ast::Assign& earlier, const ast::Assign& later) {
    const SourceText &before = **earlier.span.source, &after = **later.span.source;
    const bool was_main = before.name() == main_, is_main = after.name() == main_;
    if (is_main && (!was_main || later.span.begin >= definitions_from_)) return;
    if (!was_main && before.name() != after.name()) return;
    if (before.name() == after.name() && earlier.span.begin == later.span.begin) return;  // the file was included twice
    const std::string of = is_main ? "" : " of \"" + shown_path(before.name(), folder_of(main_)) + '"';
    messages_.push_back({Message::Kind::warning,
                         later.name.text() + " was assigned on line " +
                             std::to_string(before.place(earlier.span.begin).line) + of + " but was overwritten",
                         shown_path(after.name(), folder_of(main_)), after.place(later.span.begin).line});
  }

  const std::string& main_;
  uint32_t definitions_from_;
  std::vector<const SourcePtr*> order_;
  std::vector<Pair> found_;
  std::vector<Message> messages_;
};

}  // namespace

std::vector<Message> overwritten(const Program& program, uint32_t definitions_from) {
  return Finder(program, definitions_from).run(program);
}

}  // namespace ombre::lang::openscad

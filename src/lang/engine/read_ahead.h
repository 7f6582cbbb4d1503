// Deferred calls read on a thread of its own, some of them before they are evaluated.
#pragma once

#include <memory>
#include <vector>

#include "base/system/ahead.h"
#include "lang/engine/ast.h"

namespace ombre::lang {

class ReadAhead {
 public:
  // Null where so few of the actions are deferred that a thread would not pay. Both must outlive it; their names are
  // in the table since the file was parsed, so that nothing is added to it.
  static std::unique_ptr<ReadAhead> start(const std::vector<const ast::Statement*>& actions, Names& names);

  // Actions are gone to one after the other, from the first.
  void go_to(size_t action);
  // What the action gone to says; null if the statement is another one.
  const ast::Statement* call(const ast::Deferred& statement) const {
    return &statement == actions_[action_] ? batch_[action_ % per_batch].get() : nullptr;
  }

 private:
  using Batch = std::vector<ast::StatementPtr>;  // null for those that are not deferred

  static constexpr size_t per_batch = 256;

  ReadAhead(const std::vector<const ast::Statement*>& actions, Names& names);

  const std::vector<const ast::Statement*>& actions_;
  size_t action_ = 0;
  Batch batch_;  // with the action
  Ahead<Batch> batches_;
};

}  // namespace ombre::lang

// Reads deferred calls on a separate thread, ahead of their evaluation.
#pragma once

#include <memory>
#include <vector>

#include "base/system/ahead.h"
#include "lang/syntax/ast.h"

namespace ombre::lang {

class ReadAhead {
 public:
  // Returns null if too few of the actions are deferred for a thread to pay. Both arguments must outlive the reader.
  // All names are in the table since the file was parsed, so the thread does not change it.
  static std::unique_ptr<ReadAhead> start(const std::vector<const ast::Statement*>& actions, Names& names);

  // Moves to an action. Actions are visited one after the other.
  void go_to(size_t action);
  // Returns the call of the current action, or null if it is another statement.
  const ast::Statement* call(const ast::Deferred& statement) const {
    return &statement == actions_[action_] ? batch_[action_ % per_batch].get() : nullptr;
  }

 private:
  using Batch = std::vector<ast::StatementPtr>;  // null for statements that are not deferred

  static constexpr size_t per_batch = 256;

  ReadAhead(const std::vector<const ast::Statement*>& actions, Names& names);

  const std::vector<const ast::Statement*>& actions_;
  size_t action_ = 0;
  Batch batch_;  // contains the current action
  Ahead<Batch> batches_;
};

}  // namespace ombre::lang

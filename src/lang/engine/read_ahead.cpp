#include "lang/engine/read_ahead.h"

#include <algorithm>

#include "lang/syntax/parser.h"

namespace ombre::lang {
namespace {

using Actions = std::vector<const ast::Statement*>;

constexpr size_t most_batches = 3;
constexpr size_t least_deferred = 1000;

bool is_deferred(const ast::Statement* action) { return action->kind == ast::Statement::Kind::deferred; }

}  // namespace

std::unique_ptr<ReadAhead> ReadAhead::start(const Actions& actions, Names& names) {
  if (actions.size() < least_deferred) return nullptr;  // the usual case
  const auto deferred = static_cast<size_t>(std::count_if(actions.begin(), actions.end(), is_deferred));
  if (deferred < least_deferred) return nullptr;
  return std::unique_ptr<ReadAhead>(new ReadAhead(actions, names));
}

ReadAhead::ReadAhead(const Actions& actions, Names& names)
    : actions_(actions),
      batches_((actions.size() + per_batch - 1) / per_batch, most_batches, [&actions, &names](size_t number) {
        Batch batch;
        const size_t begin = number * per_batch, end = std::min(begin + per_batch, actions.size());
        for (size_t n = begin; n < end; ++n)
          batch.push_back(is_deferred(actions[n]) ? read(static_cast<const ast::Deferred&>(*actions[n]), names)
                                                  : nullptr);
        return batch;
      }) {}

void ReadAhead::go_to(size_t action) {
  action_ = action;
  if (action % per_batch == 0) batch_ = batches_.take(std::move(batch_));
}

}  // namespace ombre::lang

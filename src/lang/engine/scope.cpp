#include "lang/engine/scope.h"

#include <algorithm>

namespace ombre::lang {

void Scope::set(Symbol name, Value value) {
  if (const Value* old = own(name)) {
    *const_cast<Value*>(old) = std::move(value);  // NOLINT: it is this scope's own
    return;
  }
  variables_.emplace_back(name, std::move(value));
  if (variables_.size() < index_from) return;
  if (index_.empty())
    for (size_t i = 0; i < variables_.size(); ++i) index_[variables_[i].first] = i;
  else
    index_[name] = variables_.size() - 1;
}

void CapturedScopes::add(const ScopePtr& scope) {
  // Captures all parents as well, since they live as long.
  for (const ScopePtr* at = &scope; *at && !(*at)->is_captured(); at = &(*at)->parent()) {
    (*at)->keep_alive();
    scopes_.push_back(*at);
  }
  if (scopes_.size() < next_sweep_) return;
  drop_unused();
  next_sweep_ = std::max<size_t>(1024, scopes_.size() * 2);
  if (scopes_.size() > limits_.closures)
    throw LimitReached{"function literals keep more than " + format_count(limits_.closures) + " scopes alive",
                       "write a named function instead"};
}

// Parents of a dropped scope are owned here as well, so long chains are not destroyed recursively.
void CapturedScopes::drop_unused() {
  const auto is_unused = [](const ScopePtr& scope) { return scope->use_count() == 1; };
  scopes_.erase(std::remove_if(scopes_.begin(), scopes_.end(), is_unused), scopes_.end());
}

CapturedScopes::~CapturedScopes() {
  for (const ScopePtr& scope : scopes_) scope->clear();
  // Parents were added after their children, so they are destroyed after them.
  for (ScopePtr& scope : scopes_) scope = ScopePtr();
}

}  // namespace ombre::lang

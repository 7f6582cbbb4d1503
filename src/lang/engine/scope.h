// The variables, functions and modules that are visible at a position.
#pragma once

#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/system/not_copied.h"
#include "lang/engine/value.h"

namespace ombre::lang {

class Scope;

// A reference-counted pointer without atomics, since a script runs on one thread.
class ScopePtr {
 public:
  ScopePtr() = default;
  explicit ScopePtr(Scope* scope);
  ScopePtr(const ScopePtr& other);
  ScopePtr(ScopePtr&& other) noexcept : scope_(std::exchange(other.scope_, nullptr)) {}
  ScopePtr& operator=(ScopePtr other) noexcept {
    std::swap(scope_, other.scope_);
    return *this;
  }
  ~ScopePtr();

  Scope* get() const { return scope_; }
  Scope* operator->() const { return scope_; }
  Scope& operator*() const { return *scope_; }
  explicit operator bool() const { return scope_ != nullptr; }

 private:
  Scope* scope_ = nullptr;
};

struct Unit;

// The children of a module call.
struct Children {
  const ast::Block* block = nullptr;
  ScopePtr scope;  // the scope of the call
};

class Scope {
 public:
  Scope(ScopePtr parent, const ast::Plan* plan)
      : parent_(std::move(parent)), plan_(plan), children_(parent_ ? parent_->children_ : nullptr) {}

  const ScopePtr& parent() const { return parent_; }
  const ast::Plan* plan() const { return plan_; }

  // Returns the variable of this scope, or null.
  const Value* own(Symbol name) const {
    if (!index_.empty()) {
      const auto found = index_.find(name);
      return found == index_.end() ? nullptr : &variables_[found->second].second;
    }
    for (const auto& [symbol, value] : variables_)
      if (symbol == name) return &value;
    return nullptr;
  }

  // Returns the variable of the innermost scope that has it, or null.
  const Value* find(Symbol name) const {
    for (const Scope* scope = this; scope; scope = scope->parent_.get())
      if (const Value* value = scope->own(name)) return value;
    return nullptr;
  }

  // Finds a variable by the text of its name, without the table of names, to which a thread that reads ahead may add.
  const Value* find_text(std::string_view name) const {
    for (const Scope* scope = this; scope; scope = scope->parent_.get())
      for (const auto& [symbol, value] : scope->variables_)
        if (*symbol == name) return &value;
    return nullptr;
  }

  void reserve(size_t count) { variables_.reserve(count); }
  void set(Symbol name, Value value);
  // Removes the variables, for another pass of a loop.
  void clear() {
    variables_.clear();
    index_.clear();
  }
  const std::vector<std::pair<Symbol, Value>>& variables() const { return variables_; }

  int use_count() const { return use_count_; }
  void keep_alive() { is_captured_ = true; }
  bool is_captured() const { return is_captured_; }

  const Children* children() const { return children_; }
  void set_children(const Children* children) { children_ = children; }
  const Unit* unit() const { return unit_; }
  void set_unit(const Unit* unit) { unit_ = unit; }

 private:
  friend class ScopePtr;
  static constexpr size_t index_from = 12;  // number of variables; fewer are found faster by linear search

  ScopePtr parent_;
  const ast::Plan* plan_;
  const Children* children_;    // children of the enclosing module call; valid while its statements run
  const Unit* unit_ = nullptr;  // set for a file's outermost scope
  std::vector<std::pair<Symbol, Value>> variables_;
  std::unordered_map<Symbol, size_t> index_;
  int use_count_ = 0;
  bool is_captured_ = false;
};

inline ScopePtr::ScopePtr(Scope* scope) : scope_(scope) { ++scope_->use_count_; }
inline ScopePtr::ScopePtr(const ScopePtr& other) : scope_(other.scope_) {
  if (scope_) ++scope_->use_count_;
}
inline ScopePtr::~ScopePtr() {
  // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Branch): every constructor sets it
  if (scope_ && --scope_->use_count_ == 0) delete scope_;
}

inline ScopePtr make_scope(ScopePtr parent, const ast::Plan* plan = nullptr) {
  return ScopePtr(new Scope(std::move(parent), plan));
}

// A function as a value: the literal, and the scope in which it was written.
struct Closure {
  const ast::Function* function;
  ScopePtr scope;
};

// The scopes that closures capture. Closures and scopes may refer to each other in rings and long chains, so all of
// them are also owned here and cleared one by one.
class CapturedScopes : NotCopied {
 public:
  explicit CapturedScopes(const Limits& limits) : limits_(limits) {}
  ~CapturedScopes();

  void add(const ScopePtr& scope);

 private:
  void drop_unused();

  const Limits& limits_;
  std::vector<ScopePtr> scopes_;
  size_t next_sweep_ = 1024;
};

}  // namespace ombre::lang

// Statements: scopes, conditions, loops, calls of modules.
#include "lang/engine/evaluation_loops.h"
#include "lang/engine/parser.h"
#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {

using ast::CallStatement;
using ast::Statement;
using solids::TreePtr;

const ScopePtr& Evaluator::unit_scope(const Unit& unit) {
  const auto found = unit_scopes_.find(&unit);
  if (found != unit_scopes_.end()) return found->second;
  const ScopePtr& scope = unit_scopes_[&unit] = make_scope(ScopePtr(), &unit.plan);
  scope->set_unit(&unit);
  const size_t before = specials_.size();
  assign(unit.plan, scope);
  if (&unit == &program_.units.front()) return scope;
  // Keeps the special variables of a used file for its functions and modules.
  const auto first = specials_.begin() + static_cast<std::ptrdiff_t>(before);
  unit_specials_[&unit].assign(first, specials_.end());
  specials_.resize(before);
  return unit_scopes_[&unit];
}

void Evaluator::assign(const ast::Plan& plan, const ScopePtr& scope) {
  const size_t specials_from = specials_.size();
  for (const ast::Assign* assignment : plan.assignments)
    set_variable(assignment->name, eval(*assignment->value, scope), *scope, specials_from);
}

void Evaluator::run_block(const ast::Block& block, const ScopePtr& outer, Trees& out) {
  if (block.plan.defines_nothing()) return run_actions(block.plan, outer, out);
  const ScopePtr scope = make_scope(outer, &block.plan);
  const SpecialsMark mark(*this);
  assign(block.plan, scope);
  run_actions(block.plan, scope, out);
}

void Evaluator::run_actions(const ast::Plan& plan, const ScopePtr& scope, Trees& out) {
  for (const Statement* action : plan.actions)
    if (TreePtr tree = run_statement(*action, scope)) out.push_back(std::move(tree));
}

TreePtr Evaluator::run_statement(const Statement& statement, const ScopePtr& scope) {
  struct Nested {
    int& depth;
    ~Nested() { --depth; }
  };
  ++nested_statements_;
  const Nested nested{nested_statements_};
  const Level level(*this, statement.span);
  TreePtr tree = dispatch(statement, scope);
  const bool needs_modifiers = tree && !statement.modifiers.empty() && tree->where == statement.span.range();
  if (!needs_modifiers) return tree;
  auto with_modifiers = std::make_shared<solids::Tree>(*tree);
  with_modifiers->background |= statement.has('%');
  with_modifiers->highlight |= statement.has('#');
  if (statement.has('!')) roots_.push_back(with_modifiers.get());
  return with_modifiers;
}

TreePtr Evaluator::dispatch(const Statement& statement, const ScopePtr& scope) {
  if (statement.kind == Statement::Kind::deferred) {
    const ast::StatementPtr call =
        read(static_cast<const ast::Deferred&>(statement), *program_.names, Dialect::openscad);
    return dispatch(*call, scope);
  }
  const bool is_condition = statement.kind == Statement::Kind::condition;
  try {
    if (is_condition) return run_condition(static_cast<const ast::Condition&>(statement), 0, scope);
    const auto& named = static_cast<const CallStatement&>(statement);
    switch (statement.kind) {
      case Statement::Kind::loop:
        return run_loops(named, solids::Group{}, scope);
      case Statement::Kind::let:
        return run_let(named, scope);
      case Statement::Kind::assertion:
        assert_true(named.arguments, named.whole, scope);
        return group(named, scope, true);
      case Statement::Kind::echo:
        echo(named.arguments, scope);
        return group(named, scope, true);
      default:
        return run_call(named, scope);
    }
  } catch (const Stopped&) {
    trace(is_condition ? "if" : static_cast<const CallStatement&>(statement).name.text(), statement.span);
    throw;
  }
}

// Runs a condition. An "else if" is a separate condition within "else".
TreePtr Evaluator::run_condition(const ast::Condition& statement, size_t branch, const ScopePtr& scope) {
  const auto result = tree(solids::Group{}, statement.span);
  const auto& [condition, block] = statement.branches[branch];
  if (truth(eval(*condition, scope))) {
    run_block(block, scope, result->children);
  } else if (branch + 1 < statement.branches.size()) {
    if (TreePtr inner = run_condition(statement, branch + 1, scope)) result->children.push_back(std::move(inner));
  } else if (statement.has_otherwise) {
    run_block(statement.otherwise, scope, result->children);
  } else {
    return nullptr;
  }
  return result;
}

TreePtr Evaluator::run_loops(const CallStatement& statement, solids::Operation operation, const ScopePtr& scope) {
  auto result = tree(std::move(operation), statement.span);
  if (!statement.arguments.empty()) run_loop(statement, 0, scope, result->children);
  return result;
}

// Runs a loop over its variables, starting with number `variable`.
void Evaluator::run_loop(const CallStatement& statement, size_t variable, const ScopePtr& scope, Trees& out) {
  if (variable == statement.arguments.size()) return run_block(statement.children, scope, out);
  const Level level(*this, statement.span);
  for_each_scope(statement.arguments[variable], statement.span, scope,
                 [&](const ScopePtr& inner) { run_loop(statement, variable + 1, inner, out); });
}

TreePtr Evaluator::run_let(const CallStatement& statement, const ScopePtr& scope) {
  const ScopePtr inner = make_scope(scope);
  const SpecialsMark mark(*this);
  bind_let(statement.arguments, inner, mark.size());
  return group(statement, inner, false);
}

TreePtr Evaluator::group(const CallStatement& statement, const ScopePtr& scope, bool is_null_without) {
  if (is_null_without && statement.children.statements.empty()) return nullptr;
  auto result = tree(solids::Group{}, statement.span);
  run_block(statement.children, scope, result->children);
  if (is_null_without && result->children.empty()) return nullptr;
  return result;
}

TreePtr Evaluator::run_call(const CallStatement& statement, const ScopePtr& scope) {
  const Symbol name = statement.name.symbol;
  for (const ScopePtr* at = &scope; *at; at = &(*at)->parent()) {
    if ((*at)->plan())
      if (const ast::ModuleDef* module = (*at)->plan()->module(name))
        return run_module(*module, *at, nullptr, statement, scope);
    if (!(*at)->unit()) continue;
    // Clang 14 cannot read std::views::reverse. NOLINTNEXTLINE(modernize-loop-convert)
    for (auto used = (*at)->unit()->uses.rbegin(); used != (*at)->unit()->uses.rend(); ++used)
      if (const ast::ModuleDef* module = (*used)->plan.module(name))
        return run_module(*module, unit_scope(**used), *used, statement, scope);
  }
  if (name == children_name_ || name == child_name_) return run_children(statement, scope);
  if (name == intersection_for_name_) return run_loops(statement, solids::Intersection{}, scope);
  if (name == assign_name_) {
    say(Message::Kind::deprecated,
        "The assign() module will be removed in future releases. Use a regular assignment instead.", statement.span);
    return run_let(statement, scope);
  }
  const auto builtin = modules_.find(name);
  if (builtin != modules_.end()) return run_builtin(*builtin->second, statement, scope);
  if (makes_solid(statement.name, *scope)) return run_word(statement, scope);
  warn("Ignoring unknown module '" + statement.name.text() + '\'', statement.span);
  return nullptr;
}

TreePtr Evaluator::run_module(const ast::ModuleDef& module, const ScopePtr& home, const Unit* used,
                              const CallStatement& statement, const ScopePtr& scope) {
  constexpr int levels_of_statement = 8;  // trees are as deep as statements, and other code walks them recursively
  if (depth_ > options_.limits.depth - spare_levels || nested_statements_ > options_.limits.depth / levels_of_statement)
    stop("Recursion detected calling module '" + statement.name.text() + '\'', statement.span);
  meter_.count_call();
  const Children children{&statement.children, scope};
  const ScopePtr inner = make_scope(home, &module.body.plan);
  const SpecialsMark mark(*this);
  inner->set_children(&children);
  if (used) enter(*used, mark.size());
  bind(module.parameters, statement.arguments, scope, home, inner, statement.span, mark.size());
  set_special(children_count_, static_cast<double>(statement.children.plan.actions.size()), mark.size());
  set_special(parent_modules_, static_cast<double>(module_names_.size() + 1), mark.size());

  struct Entered {
    std::vector<std::string>& names;
    ~Entered() { names.pop_back(); }
  };
  module_names_.push_back(statement.name.text());
  const Entered entered{module_names_};
  auto result = tree(solids::Group{}, statement.span);
  assign(module.body.plan, inner);
  run_actions(module.body.plan, inner, result->children);
  return result;
}

// Returns nothing and adds a warning unless the value is the number of a child.
std::optional<size_t> Evaluator::chosen_child(const Value& index, size_t count) {
  const double* number = index.number();
  if (!number) return std::nullopt;
  const double place = std::trunc(*number);
  const std::string shown = number_text(place);
  if (place < 0)
    messages_.add({Message::Kind::warning, "Negative children index (" + shown + ") not allowed", "", 0});
  else if (place >= static_cast<double>(count))
    messages_.add({Message::Kind::warning,
                   "Children index (" + shown + ") out of bounds (" + std::to_string(count) + " children)", "", 0});
  else if (!std::isnan(place))
    return static_cast<size_t>(place);
  return std::nullopt;
}

// Runs children(), which makes a group of all children, children(i), which returns that child, or children([...]),
// which makes a group of several.
TreePtr Evaluator::run_children(const CallStatement& statement, const ScopePtr& scope) {
  const bool is_old = statement.name.symbol == child_name_;
  if (is_old)
    messages_.add(
        {Message::Kind::deprecated, "child() will be removed in future releases. Use children() instead.", "", 0});
  const Children* children = scope->children();
  if (!children) return nullptr;
  meter_.count_call();
  const ast::Plan& plan = children->block->plan;
  auto result = tree(solids::Group{}, statement.span);
  if (statement.arguments.empty() && !is_old) {
    run_block(*children->block, children->scope, result->children);
    return result;
  }
  const Value index = statement.arguments.empty() ? Value(0.0) : eval(*statement.arguments[0].value, scope);
  if (!index.number() && !index.list() && !index.range()) {
    warn("Bad parameter type (" + value_text(index, true, meter_) +
             ") for children, only accept: empty, number, vector, range",
         statement.span);
    return nullptr;
  }
  const SpecialsMark mark(*this);
  ScopePtr inner;  // scope of the children, whose variables are computed once
  const auto run_child = [&](const Value& each) {
    const auto chosen = chosen_child(each, plan.actions.size());
    if (!chosen) return;
    if (!inner) {
      inner = make_scope(children->scope, &plan);
      assign(plan, inner);
    }
    if (TreePtr child = run_statement(*plan.actions[*chosen], inner)) result->children.push_back(std::move(child));
  };
  if (index.number())
    run_child(index);
  else
    for_each(index, statement.span, "", run_child);
  if (!index.number()) return result;
  return result->children.empty() ? nullptr : result->children.front();
}

}  // namespace ombre::lang::openscad

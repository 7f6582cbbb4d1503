// Statements of OpenSCAD scripts, which make trees.
#include <cmath>
#include <limits>

#include "lang/engine/evaluation_loops.h"
#include "lang/openscad/ranges.h"
#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/value_text.h"
#include "lang/syntax/parser.h"

namespace ombre::lang::openscad {

using ast::CallStatement;
using ast::Statement;
using solids::TreePtr;

namespace {

// True for what is written as a value: numbers with signs, strings, truth values, undef, and lists and ranges of them.
bool is_literal(const ast::Expr& expr) {
  using Kind = ast::Expr::Kind;
  switch (expr.kind) {
    case Kind::undef:
    case Kind::boolean:
    case Kind::number:
    case Kind::string:
      return true;
    case Kind::unary:
      return is_literal(*static_cast<const ast::Unary&>(expr).operand);
    case Kind::list:
      return std::ranges::all_of(static_cast<const ast::List&>(expr).elements,
                                 [](const auto& element) { return is_literal(*element); });
    case Kind::range: {
      const auto& range = static_cast<const ast::Range&>(expr);
      return is_literal(*range.begin) && (!range.step || is_literal(*range.step)) && is_literal(*range.end);
    }
    default:
      return false;
  }
}

// True within operators of .vcad files, in which Ombre's words go before OpenSCAD's.
bool is_of_vcad(const Scope& scope) {
  const Scope* at = &scope;
  while (!at->unit() && at->parent()) at = at->parent().get();
  return at->unit() && at->unit()->path.ends_with(".vcad");
}

}  // namespace

// Keeps the special variables of a used file for its functions and modules.
void Evaluator::end(const Unit& unit, size_t specials_before) {
  if (&unit == &program_.units.front()) return;
  const auto first = specials_.begin() + static_cast<std::ptrdiff_t>(specials_before);
  unit_specials_[&unit].assign(first, specials_.end());
  specials_.resize(specials_before);
}

void Evaluator::run_actions(const ast::Plan& plan, const ScopePtr& scope, Trees& out) {
  for (const Statement* action : plan.actions) run_statement(*action, scope, out);
}

// Makes one tree at most.
void Evaluator::run_statement(const Statement& statement, const ScopePtr& scope, Trees& out) {
  const Temporary nested(nested_statements_, nested_statements_ + 1);
  const auto level = deeper(statement.span);
  const size_t before = out.size();
  dispatch(statement, scope, out);
  if (out.size() == before || statement.modifiers.empty() || out.back()->where != statement.span.range()) return;
  auto with_modifiers = std::make_shared<solids::Tree>(*out.back());
  with_modifiers->background |= statement.has('%');
  with_modifiers->highlight |= statement.has('#');
  if (statement.has('!')) roots_.push_back(with_modifiers.get());
  out.back() = std::move(with_modifiers);
}

void Evaluator::run_deferred(const ast::Deferred& statement, const ScopePtr& scope, Trees& out) {
  const ast::StatementPtr call = read(statement, *program_.names, Dialect::openscad);
  dispatch(*call, scope, out);
}

void Evaluator::trace(const Statement& statement) {
  const bool is_condition = statement.kind == Statement::Kind::condition;
  trace(is_condition ? "if" : static_cast<const CallStatement&>(statement).name.text(), statement.span);
}

// Runs a condition, starting with number `branch`. An "else if" is a separate condition within "else".
void Evaluator::run_condition(const ast::Condition& statement, const ScopePtr& scope, Trees& out, size_t branch) {
  const auto result = tree(solids::Group{}, statement.span);
  const auto& [condition, block] = statement.branches[branch];
  if (holds(*condition, scope))
    run_block(block, scope, result->children);
  else if (branch + 1 < statement.branches.size())
    run_condition(statement, scope, result->children, branch + 1);
  else if (statement.has_otherwise)
    run_block(statement.otherwise, scope, result->children);
  else
    return;
  out.push_back(result);
}

// A loop without variables makes an empty group.
void Evaluator::run_loops(const CallStatement& statement, const ScopePtr& scope, Trees& out,
                          solids::Operation operation) {
  const auto passes = [&](Trees& inside) {
    if (!statement.arguments.empty()) run_loop(statement, 0, scope, inside);
  };
  group(statement.span, out, passes, std::move(operation));
}

// Runs the statements after assert or echo, which make a group unless it is empty.
void Evaluator::run_inside(const CallStatement& statement, const ScopePtr& scope, Trees& out) {
  if (statement.children.statements.empty()) return;
  group(statement.span, out, [&](Trees& inside) { run_block(statement.children, scope, inside); });
  if (out.back()->children.empty()) out.pop_back();
}

void Evaluator::call_other(const CallStatement& statement, const ScopePtr& scope, Trees& out) {
  const Symbol name = statement.name.symbol;
  const auto add = [&](TreePtr tree) {
    if (tree) out.push_back(std::move(tree));
  };
  if (name == children_name_ || name == child_name_) return add(run_children(statement, scope));
  if (name == intersection_for_name_) return run_loops(statement, scope, out, solids::Intersection{});
  if (name == assign_name_) {
    say(Message::Kind::deprecated,
        "The assign() module will be removed in future releases. Use a regular assignment instead.", statement.span);
    return run_let(statement, scope, out);
  }
  const bool is_word = makes_solid(statement.name, *scope);
  if (is_word && is_of_vcad(*scope)) return add(run_word(statement, scope));
  const auto builtin = modules_.find(name);
  if (builtin != modules_.end()) return add(run_builtin(*builtin->second, statement, scope));
  if (is_word) return add(run_word(statement, scope));
  warn("Ignoring unknown module '" + statement.name.text() + '\'', statement.span);
}

void Evaluator::check_depth(const ast::ModuleDef& module) {
  constexpr int levels_of_statement = 8;  // trees are as deep as statements, and other code walks them recursively
  if (depth_ > options_.limits.depth - spare_levels || nested_statements_ > options_.limits.depth / levels_of_statement)
    stop_recursion(module);
}

// OpenSCAD names the place of the module, not of the call.
void Evaluator::stop_recursion(const ast::ModuleDef& module) {
  stop("Recursion detected calling module '" + module.name.text() + '\'', module.name.span);
}

// Values grow beyond a limit in an endless recursion that passes on lists of its own arguments.
void Evaluator::stop_if_recursive(const ast::ModuleDef& module) {
  constexpr size_t deep = 200;
  if (module_calls_.size() >= deep) stop_recursion(module);
}

void Evaluator::check_assignments(const ast::ModuleDef& module) {
  for (const ast::Assign* assignment : module.body.plan.assignments) {
    if (!is_literal(*assignment->value)) continue;
    const auto is_it = [&](const ast::Parameter& parameter) {
      return parameter.name.symbol == assignment->name.symbol;
    };
    if (std::ranges::any_of(module.parameters, is_it))
      warn("Module " + module.name.text() + ": Parameter " + assignment->name.text() + " is overwritten with a literal",
           assignment->span);
  }
}

// $children belongs to the module in which it stands, so braces of a call have that of the module around them.
void Evaluator::set_counts(const CallStatement& statement, Scope& inner, size_t specials_from) {
  inner.set(children_count_, static_cast<double>(statement.children.plan.actions.size()));
  set_special(parent_modules_, static_cast<double>(module_calls_.size() + 1), specials_from);
}

// Returns nothing and adds a warning unless the value is the number of a child.
std::optional<size_t> Evaluator::chosen_child(const CallStatement& statement, const Value& index, size_t count) {
  const double* number = index.number();
  if (!number) return std::nullopt;
  // OpenSCAD's integers have 32 bits; what does not fit becomes the least one.
  constexpr int least = std::numeric_limits<int>::min();
  const int place = std::abs(*number) < -static_cast<double>(least) ? static_cast<int>(*number) : least;
  const std::string shown = std::to_string(place);
  // OpenSCAD gives places for child() alone.
  const bool is_old = statement.name.symbol == child_name_;
  const std::string which = is_old ? "hild" : "hildren";
  const ast::Span where = is_old ? statement.span : ast::Span{};
  if (place < 0)
    warn("Negative c" + which + " index (" + shown + ") not allowed", where);
  else if (static_cast<size_t>(place) >= count)
    warn('C' + which + " index (" + shown + ") out of bounds (" + std::to_string(count) + " children)", where);
  else
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
  if (!children) {
    // OpenSCAD reports a wrong number outside modules, too, if it is negative.
    const Value index = is_old && !statement.arguments.empty() ? eval(*statement.arguments[0].value, scope) : Value();
    if (index.number() && *index.number() <= -1) (void)chosen_child(statement, index, 0);
    return nullptr;
  }
  meter_.count_call();
  const ast::Plan& plan = children->block->plan;
  auto result = tree(solids::Group{}, statement.span);
  if (statement.arguments.empty() && !is_old) {
    run_block(*children->block, children->scope, result->children);
    return result;
  }
  Value index = statement.arguments.empty() ? Value(0.0) : eval(*statement.arguments[0].value, scope);
  if (is_old && !index.number()) index = 0.0;  // as in OpenSCAD
  if (!index.number() && !index.list() && !index.range()) {
    warn("Bad parameter type (" + value_text(index, true, meter_) +
             ") for children, only accept: empty, number, vector, range",
         statement.span);
    return nullptr;
  }
  constexpr double most_children = 10'000;
  if (const Range* range = index.range(); range && element_count(*range) >= most_children) {
    warn("Bad range parameter for children: too many elements (" +
             std::to_string(static_cast<uint64_t>(element_count(*range))) + ")",
         statement.span);
    return nullptr;
  }
  const SpecialsMark mark(*this);
  ScopePtr inner;  // scope of the children, whose variables are computed once
  const auto run_child = [&](const Value& each) {
    const auto chosen = chosen_child(statement, each, plan.actions.size());
    if (!chosen) return;
    if (!inner) {
      inner = make_scope(children->scope, &plan);
      assign(plan, inner);
    }
    run_statement(*plan.actions[*chosen], inner, result->children);
  };
  if (index.number())
    run_child(index);
  else
    for_each(index, statement.span, "", run_child);
  if (!index.number()) return result;
  return result->children.empty() ? nullptr : result->children.front();
}

}  // namespace ombre::lang::openscad

#include "lang/syntax/ast.h"

namespace ombre::lang::ast {

namespace {

// They stand in the order of Operator.
constexpr std::array spellings{"+",  "-",  "*",  "/", "%", "^",  "<",  "<=", ">", ">=", "==",
                               "!=", "&&", "||", "|", "&", "<<", ">>", "-",  "+", "!",  "~"};
static_assert(spellings.size() == static_cast<size_t>(Operator::bit_not) + 1);

template <class Definition>
using ByName = std::unordered_map<Symbol, const Definition*>;

template <class Definition>
void add_to(std::vector<const Definition*>& list, ByName<Definition>& by_name, const Statement& statement) {
  const auto& definition = static_cast<const Definition&>(statement);
  list.push_back(&definition);
  by_name[definition.name.symbol] = &definition;
}

template <class Definition>
const Definition* found_in(const ByName<Definition>& by_name, Symbol name) {
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : found->second;
}

}  // namespace

const char* spelling(Operator op) { return spellings[static_cast<size_t>(op)]; }

const char* spelling(PrefixKind kind) {
  return kind == PrefixKind::let ? "let" : kind == PrefixKind::assertion ? "assert" : "echo";
}

void Plan::add(const Statement& statement) {
  switch (statement.kind) {
    case Statement::Kind::assign:
      return assign(static_cast<const Assign&>(statement));
    case Statement::Kind::function:
      return add_to(functions, functions_by_name_, statement);
    case Statement::Kind::module:
      return add_to(modules, modules_by_name_, statement);
    case Statement::Kind::include:
      return;  // the loader replaces it by the file's statements
    case Statement::Kind::group:
      for (const StatementPtr& inner : static_cast<const Group&>(statement).statements) add(*inner);
      return;
    default:
      if (!statement.has('*')) actions.push_back(&statement);
  }
}

void Plan::assign(const Assign& assignment) {
  const auto [place, is_new] = places_.emplace(assignment.name.symbol, assignments.size());
  if (is_new) {
    assignments.push_back(&assignment);
  } else {
    replaced.emplace_back(assignments[place->second], &assignment);
    assignments[place->second] = &assignment;
  }
}

const FunctionDef* Plan::function(Symbol name) const { return found_in(functions_by_name_, name); }
const ModuleDef* Plan::module(Symbol name) const { return found_in(modules_by_name_, name); }
bool Plan::assigns(Symbol name) const { return places_.count(name) > 0; }

}  // namespace ombre::lang::ast

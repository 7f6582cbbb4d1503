#include "lang/engine/ast.h"

namespace ombre::lang::ast {

const char* spelling(Operator op) {
  switch (op) {
    case Operator::add:
    case Operator::plus:
      return "+";
    case Operator::subtract:
    case Operator::negate:
      return "-";
    case Operator::multiply:
      return "*";
    case Operator::divide:
      return "/";
    case Operator::modulo:
      return "%";
    case Operator::power:
      return "^";
    case Operator::less:
      return "<";
    case Operator::less_equal:
      return "<=";
    case Operator::greater:
      return ">";
    case Operator::greater_equal:
      return ">=";
    case Operator::equal:
      return "==";
    case Operator::not_equal:
      return "!=";
    case Operator::logical_and:
      return "&&";
    case Operator::logical_or:
      return "||";
    case Operator::bit_or:
      return "|";
    case Operator::bit_and:
      return "&";
    case Operator::shift_left:
      return "<<";
    case Operator::shift_right:
      return ">>";
    case Operator::bit_not:
      return "~";
    case Operator::logical_not:
      break;
  }
  return "!";
}

const char* spelling(PrefixKind kind) {
  switch (kind) {
    case PrefixKind::let:
      return "let";
    case PrefixKind::assertion:
      return "assert";
    case PrefixKind::echo:
      break;
  }
  return "echo";
}

void Plan::add(const Statement& statement) {
  switch (statement.kind) {
    case Statement::Kind::assign:
      return assign(static_cast<const Assign&>(statement));
    case Statement::Kind::function: {
      const auto& definition = static_cast<const FunctionDef&>(statement);
      functions.push_back(&definition);
      functions_by_name_[definition.name.symbol] = &definition;
      return;
    }
    case Statement::Kind::module: {
      const auto& definition = static_cast<const ModuleDef&>(statement);
      modules.push_back(&definition);
      modules_by_name_[definition.name.symbol] = &definition;
      return;
    }
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

const FunctionDef* Plan::function(Symbol name) const {
  const auto found = functions_by_name_.find(name);
  return found == functions_by_name_.end() ? nullptr : found->second;
}

const ModuleDef* Plan::module(Symbol name) const {
  const auto found = modules_by_name_.find(name);
  return found == modules_by_name_.end() ? nullptr : found->second;
}

bool Plan::assigns(Symbol name) const { return places_.count(name) > 0; }

}  // namespace ombre::lang::ast

// Evaluates a script's tree: statements make nodes, expressions make values.
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "lang/engine/builtins.h"
#include "lang/engine/evaluation.h"
#include "lang/engine/operators.h"
#include "lang/engine/read_ahead.h"
#include "lang/engine/run_options.h"

namespace ombre::lang {

class Interpreter : Evaluation<Interpreter, Product> {
 public:
  using Nodes = Products;

  Interpreter(const Program& program, Vocabulary& vocabulary, const Options& options, Diagnostics& diagnostics);
  Nodes run();

 private:
  friend Evaluation;

  static constexpr int heavy = 2;  // levels that a call or a statement counts for
  static constexpr Rules rules{.call_levels = heavy,
                               .names_whole_constructs = false,
                               .prefers_variables = false,
                               .prefers_last_use = false,
                               .defaults_see_parameters = true,
                               .arguments_set_specials_last = false,
                               .calls_specials = true};

  // Functions that were entered are not reported.
  struct EnteredCalls {
    void add(const ast::Call&, const ast::Expr&) {}
  };
  void trace(const EnteredCalls&) {}
  void stop_if_recursive(const EnteredCalls&) {}
  void stop_if_recursive(const ast::ModuleDef&) {}
  void trace(const ast::Statement&) {}

  // Defined in interpreter_diagnostics.cpp.
  void report(Diagnostic diagnostic);
  static constexpr size_t most_callers = 8;  // number of callers that an invocation lists
  // These functions assemble messages outside recursive functions, whose stack frames would otherwise hold all parts of
  // them.
  [[noreturn]] void fail(const ast::Span& where, std::string_view message, const Phrase& hint = {});
  [[noreturn]] void fail(Code code, const ast::Span& where, std::string_view message, const Phrase& hint = {},
                         CodeValues values = {});
  [[noreturn]] void fail_found(const ast::Span& where, std::string_view expected, const Value& found,
                               const Phrase& hint = {});
  [[noreturn]] void fail_operator(ast::Operator op, const ast::Span& where, const Value& left, const Value& right,
                                  const Mismatch& mismatch);
  [[noreturn]] void stop_at_depth(const ast::Span& where);
  [[noreturn]] Value mistaken(const ast::Span& where, std::string_view expected, const Value& found) {
    fail_found(where, expected, found);
  }
  [[noreturn]] void stop_without_part(const ast::Member& member, const Object& object, const std::string& known);
  [[noreturn]] void stop_at_function(const ast::Span& argument);
  [[noreturn]] void stop_at_choice(const ast::Span& where, const Value& yes, const Value& no);
  [[noreturn]] void stop_at_argument(const ast::Span& where, std::string_view message) {
    fail(Code::parameter_type, where, message);
  }
  [[noreturn]] void report_parameter(const ast::Name& name, const ast::Span& callee,
                                     const std::vector<ast::Parameter>& parameters);
  [[noreturn]] void report_too_many(const ast::Argument& argument, const ast::Span& callee,
                                    const std::vector<ast::Parameter>& parameters);
  [[noreturn]] void report_twice(const ast::Argument& argument, Symbol parameter, const ast::Span& callee);
  [[noreturn]] void fail_builtin(const ast::Span& where, const Builtin& builtin, std::string_view problem,
                                 std::string_view rest);
  [[noreturn]] void fail_assertion(const ast::Span& condition);
  [[noreturn]] void fail_unknown(Code code, const ast::Name& name, const char* what,
                                 std::vector<std::string> candidates, const std::string& otherwise);
  [[noreturn]] Value value_of_unknown(const ast::Name& name, const Scope& scope);
  [[noreturn]] void fail_unknown_function(const ast::Name& name, const Scope& scope);
  [[noreturn]] void fail_unknown_module(const ast::Name& name, const Scope& scope);
  std::string hint_of_libraries(const ast::Name& name) const;
  // Returns what is wrong with the name of a material, or "".
  std::string mismatch_of_material(const std::string& name) const;

  // Defined in interpreter_statements.cpp.
  void begin(const Unit& unit, Scope& scope);
  void end(const Unit&, size_t) {}
  bool is_overridden(const ast::Assign& assignment, const Scope& scope) const;
  Value assigned(const ast::Assign& assignment, const ScopePtr& scope);
  // Tells the caller of the script what an expression gives. Returns that value.
  Value computed(const ast::Expr& expr, Value value) const {
    if (options_.computed) tell(expr, value);
    return value;
  }
  void tell(const ast::Expr& expr, const Value& value) const;
  void report_missing(Severity severity, const std::string& name, const std::string& what, const Unit& main);
  // If `ends` is given, it gets the size of `out` after each statement that makes solids.
  void run_actions(const ast::Plan& plan, const ScopePtr& scope, Nodes& out, std::vector<size_t>* ends = nullptr);
  void run_action(const ast::Statement& statement, const ScopePtr& scope, Nodes& out);
  void execute(const ast::Statement& statement, const ScopePtr& scope, Nodes& out);
  void execute_modified(const ast::Statement& statement, const ScopePtr& scope, Nodes& out);
  void run_deferred(const ast::Deferred& statement, const ScopePtr& scope, Nodes& out);
  void run_condition(const ast::Condition& statement, const ScopePtr& scope, Nodes& out);
  void run_loops(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out) {
    run_loop(statement, 0, scope, out);
  }
  void run_inside(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out) {
    run_block(statement.children, scope, out);
  }
  // Nodes of a module, a loop or let stand among those around them.
  template <class Body>
  void group(const ast::Span&, Nodes& out, const Body& body) {
    body(out);
  }

  // Defined in calls.cpp.
  void call_other(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out);
  void check_depth(const ast::ModuleDef&) {}
  void check_assignments(const ast::ModuleDef&) {}
  void set_counts(const ast::CallStatement& statement, Scope& inner, size_t specials_from);
  void call_children(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out);
  void make_children(const std::vector<ast::Argument>& arguments, const ast::Span& where, const ScopePtr& scope,
                     Nodes& out);
  std::vector<size_t> chosen_children(const std::vector<ast::Argument>& arguments, const ScopePtr& scope, size_t count);
  void call_node(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out);
  std::vector<SourceRange> callers() const;
  static void ignore(const ast::Argument&, const Value&) {}
  void make_node(Invocation invocation, const ast::Span& where, Nodes& out);
  bool knows(const ast::Name& name);
  void assert_true(const std::vector<ast::Argument>& arguments, const ast::Span& where, const ScopePtr& scope);
  void append(std::string& text, const Value& value) { append_text(text, value, true, meter_); }
  void print(const std::string& text) {
    if (options_.echo) options_.echo(text);
  }

  // Defined in interpreter_expressions.cpp.
  double passes(const Range& range, const ast::Span& where);
  bool is_one_pass(const Value& values, const ast::Span& where, const char* expected);
  void check_pass(uint64_t count, const ast::GenerateLoop& loop);
  void check_count(double count, const ast::Span& where, const char* what);
  const Value* find_constant(Symbol name);
  double number(const ast::Expr& expr, const ScopePtr& scope, const char* what);
  Value eval_range(const ast::Range& range, const ScopePtr& scope);
  Value binary(ast::Operator op, const ast::Span& where, const Value& left, const Value& right);
  Value unary(ast::Operator op, const ast::Span& where, const Value& operand);
  Value eval_other_member(const ast::Member& member, const Value& base);
  bool is_chosen(const Value& condition, const ast::Span& where);

  // Defined in interpreter_function_calls.cpp.
  void check_depth(const ast::Call&, const EnteredCalls&) {}
  void enter(const Unit&, size_t) {}
  bool ignores(const std::vector<ast::Argument>&, size_t, const Value&) { return false; }
  [[noreturn]] void replace_callee(const ast::Call& call, const Value& value, const ScopePtr& scope, Callee& callee);
  Value call_other(const ast::Call& call, const ScopePtr& scope);
  Value call_builtin(const Builtin& builtin, const ast::Call& call, const ScopePtr& scope);
  Value children_value(const ast::Call& call, const ScopePtr& scope);
  Value call_value_node(const ast::Call& call, const ScopePtr& scope);
  std::vector<Value> builtin_arguments(const Builtin& builtin, const ast::Call& call, const ScopePtr& scope,
                                       std::vector<const ast::Expr*>& places);
  size_t builtin_place(const Builtin& builtin, const ast::Argument& argument, size_t position);

  Vocabulary& vocabulary_;
  const Options& options_;
  Diagnostics& diagnostics_;
  Symbol children_name_, children_count_name_;
  std::unordered_map<Symbol, const Builtin*> builtins_;
  std::unordered_set<Symbol> no_constants_;
  std::unordered_map<Symbol, bool> known_nodes_;
  std::unordered_map<Symbol, Value> overrides_;  // values of variables from the command line

  int node_depth_ = 0;  // number of calls of nodes whose children are being evaluated
  Nodes roots_;         // nodes of statements marked "!"
  bool has_roots_ = false;
  ReadAhead* reader_ = nullptr;               // reader of the latest action, or null
  std::unordered_set<std::string> reported_;  // diagnostics that were reported
  size_t failures_ = 0;                       // number of failed statements, reported or not
};

extern template class Evaluation<Interpreter, Product>;

}  // namespace ombre::lang

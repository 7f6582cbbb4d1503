// Evaluates a script's tree: statements make nodes, expressions make values.
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "lang/engine/builtins.h"
#include "lang/engine/loader.h"
#include "lang/engine/operators.h"
#include "lang/engine/read_ahead.h"
#include "lang/engine/run_options.h"
#include "lang/engine/scope.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

class Interpreter {
 public:
  using Nodes = std::vector<Product>;

  Interpreter(const Program& program, Vocabulary& vocabulary, const Options& options, Diagnostics& diagnostics);
  Nodes run();

 private:
  // Thrown if evaluation of the current item cannot continue. A diagnostic was recorded before.
  struct Failure {};

  static constexpr int heavy = 2;  // levels that a call or a statement counts for

  // Counts a level of evaluation for as long as it lives.
  class Level {
   public:
    Level(Interpreter& interpreter, const ast::Span& at, int weight = 1);
    ~Level() { interpreter_.depth_ -= weight_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Interpreter& interpreter_;
    int weight_;  // proportional to its stack: 5000 levels stay below 6 MB under AddressSanitizer
  };

  // Removes the special variables that were set during its life.
  class SpecialsMark {
   public:
    explicit SpecialsMark(Interpreter& interpreter) : interpreter_(interpreter), size_(interpreter.specials_.size()) {}
    ~SpecialsMark() { interpreter_.specials_.resize(size_); }
    SpecialsMark(const SpecialsMark&) = delete;
    SpecialsMark& operator=(const SpecialsMark&) = delete;
    size_t size() const { return size_; }

   private:
    Interpreter& interpreter_;
    size_t size_;
  };

  // A function to call, named or a literal.
  struct Callee {
    const std::vector<ast::Parameter>* parameters = nullptr;
    const ast::Expr* body = nullptr;
    ScopePtr scope;  // the scope where it was defined
  };

  // Makes `now` the current reader of deferred calls while the actions of a list run.
  class Reading {
   public:
    Reading(ReadAhead*& place, ReadAhead* now) : place_(place), before_(std::exchange(place, now)) {}
    ~Reading() { place_ = before_; }
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    ReadAhead*& place_;
    ReadAhead* before_;
  };

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
  [[noreturn]] void fail_parameter(const ast::Name& name, const ast::Span& callee,
                                   const std::vector<ast::Parameter>& parameters);
  [[noreturn]] void fail_too_many(const ast::Span& where, const ast::Span& callee,
                                  const std::vector<ast::Parameter>& parameters);
  [[noreturn]] void fail_twice(const ast::Argument& argument, Symbol parameter);
  [[noreturn]] void fail_builtin(const ast::Span& where, const Builtin& builtin, std::string_view problem,
                                 std::string_view rest);
  [[noreturn]] void fail_assertion(const ast::Span& condition);
  [[noreturn]] void fail_unknown(Code code, const ast::Name& name, const char* what,
                                 std::vector<std::string> candidates, const std::string& otherwise);
  [[noreturn]] void fail_unknown_variable(const ast::Name& name, const Scope& scope);
  [[noreturn]] void fail_unknown_function(const ast::Name& name, const Scope& scope);
  [[noreturn]] void fail_unknown_module(const ast::Name& name, const Scope& scope);

  // Defined in interpreter_statements.cpp.
  const ScopePtr& unit_scope(const Unit& unit);
  void assign(const ast::Plan& plan, const ScopePtr& scope, bool is_main);
  void report_missing(Severity severity, const std::string& name, const std::string& what, const Unit& main);
  // If `ends` is given, it gets the size of `out` after each statement that makes solids.
  void run_block(const ast::Block& block, const ScopePtr& outer, Nodes& out, std::vector<size_t>* ends = nullptr);
  void run_actions(const ast::Plan& plan, const ScopePtr& scope, Nodes& out, std::vector<size_t>* ends = nullptr);
  void run_action(const ast::Statement& statement, const ScopePtr& scope, Nodes& out);
  void execute(const ast::Statement& statement, const ScopePtr& scope, Nodes& out);
  void execute_modified(const ast::Statement& statement, const ScopePtr& scope, Nodes& out);
  void dispatch(const ast::Statement& statement, const ScopePtr& scope, Nodes& out);
  void run_deferred(const ast::Deferred& statement, const ScopePtr& scope, Nodes& out);
  void run_condition(const ast::Condition& statement, const ScopePtr& scope, Nodes& out);
  void run_loop(const ast::CallStatement& statement, size_t variable, const ScopePtr& scope, Nodes& out);
  void run_let(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out);

  // Defined in calls.cpp.
  void call(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out);
  void call_module(const ast::ModuleDef& module, const ScopePtr& home, const ast::CallStatement& statement,
                   const ScopePtr& scope, Nodes& out);
  void call_children(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out);
  std::vector<size_t> chosen_children(const ast::CallStatement& statement, const ScopePtr& scope, size_t count);
  void call_node(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out);
  void node_arguments(const std::vector<ast::Argument>& arguments, const ScopePtr& scope, Invocation& invocation);
  void make_node(Invocation invocation, const ast::Span& where, Nodes& out);
  bool knows(const ast::Name& name);
  std::pair<const ast::ModuleDef*, ScopePtr> find_module(Symbol name, const ScopePtr& scope);
  void bind(const std::vector<ast::Parameter>& parameters, const std::vector<ast::Argument>& arguments,
            const ScopePtr& caller, const ScopePtr& into, const ast::Span& callee, size_t specials_from);
  void bind_argument(const std::vector<ast::Parameter>& parameters, const ast::Argument& argument, size_t position,
                     const ScopePtr& caller, Scope& into, const ast::Span& callee, size_t specials_from);
  void assert_true(const std::vector<ast::Argument>& arguments, const ast::Span& where, const ScopePtr& scope);
  void echo(const std::vector<ast::Argument>& arguments, const ScopePtr& scope);

  // Defined in interpreter_expressions.cpp.
  Value eval(const ast::Expr& expr, const ScopePtr& scope);
  Value eval_branching(const ast::Expr& expr, const ScopePtr& scope);
  Value eval_variable(const ast::Name& name, const Scope& scope);
  const Value* quiet_variable(Symbol name, const Scope& scope);
  Value eval_range(const ast::Range& range, const ScopePtr& scope);
  Value eval_list(const ast::List& list, const ScopePtr& scope);
  Value eval_unary(const ast::Unary& unary, const ScopePtr& scope);
  Value eval_chain(const ast::Chain& chain, const ScopePtr& scope);
  Value eval_logic(const ast::Chain& chain, const ScopePtr& scope);
  Value eval_power(const ast::Power& power, const ScopePtr& scope);
  Value eval_index(const ast::Index& index, const ScopePtr& scope);
  Value eval_member(const ast::Member& member, const ScopePtr& scope);
  Value eval_function(const ast::Function& function, const ScopePtr& scope);
  Value binary(ast::Operator op, const ast::Span& where, const Value& left, const Value& right);
  Value unary(ast::Operator op, const ast::Span& where, const Value& operand);
  bool holds(const ast::Expr& condition, const ScopePtr& scope);
  // Evaluates calls, conditions and let. If one ends with another, continues in a loop instead of recursively.
  Value eval_tail(const ast::Expr& expr, const ScopePtr& scope);
  const ast::Expr* choose(const ast::Conditional& conditional, const ScopePtr& scope, Value& chosen);
  Value otherwise(const ast::Conditional& conditional, size_t first, const ScopePtr& scope);
  Value choice(const Value& condition, const Value& yes, const Value& no, const ast::Span& where);
  const ast::Expr* enter_prefix(const ast::Prefix& prefix, ScopePtr& scope, size_t specials_from);
  const Builtin* resolve(const ast::Call& call, const ScopePtr& scope, Callee& callee);
  bool find_function(Symbol name, const ScopePtr& scope, Callee& callee);
  Value call_builtin(const Builtin& builtin, const ast::Call& call, const ScopePtr& scope);
  std::optional<Value> result_of_objects(std::string_view function, const std::vector<Value>& arguments);
  Value call_value_node(const ast::Call& call, const ScopePtr& scope);
  std::vector<Value> builtin_arguments(const Builtin& builtin, const ast::Call& call, const ScopePtr& scope,
                                       std::vector<const ast::Expr*>& places);
  size_t builtin_place(const Builtin& builtin, const ast::Argument& argument, size_t position);
  void bind_let(const std::vector<ast::Argument>& arguments, const ScopePtr& scope, size_t specials_from);
  double number(const ast::Expr& expr, const ScopePtr& scope, const char* what);

  // Defined in generators.cpp.
  void generate(const ast::Expr& expr, const ScopePtr& scope, ListBuilder& out);
  void generate_for(const ast::GenerateFor& loop, size_t variable, const ScopePtr& scope, ListBuilder& out);
  void generate_loop(const ast::GenerateLoop& loop, const ScopePtr& scope, ListBuilder& out);
  void generate_each(const ast::GenerateEach& each, const ScopePtr& scope, ListBuilder& out);
  // Calls `body` with each element of a range, list or string.
  template <class Body>
  void for_each(const Value& values, const ast::Span& where, const char* expected, const Body& body);
  // Calls `body` with a scope for each value of a loop's variable.
  template <class Body>
  void for_each_scope(const ast::Argument& loop, const ScopePtr& scope, const Body& body);
  void check_count(double count, const ast::Span& where, const char* what);

  // Defined in call_arguments.cpp.
  Data to_data(const Value& value, const SourceRange& where, const ast::Span& argument);
  Data list_to_data(const List& list, const SourceRange& where, const ast::Span& argument);
  Data range_to_data(const Range& range, const SourceRange& where, const ast::Span& argument);

  void set_special(Symbol name, Value value, size_t from);
  const Value* find_special(Symbol name) const;
  void set_variable(const ast::Name& name, Value value, Scope& scope, size_t specials_from);

  const Program& program_;
  Vocabulary& vocabulary_;
  const Options& options_;
  Diagnostics& diagnostics_;
  Meter meter_;
  CapturedScopes captured_;

  Symbol children_name_, children_count_name_, facets_name_;
  std::unordered_map<Symbol, const Builtin*> builtins_;
  std::unordered_map<Symbol, Value> constants_;
  std::unordered_set<Symbol> no_constants_;
  std::unordered_map<Symbol, bool> known_nodes_;
  std::unordered_map<Symbol, Value> overrides_;  // values of variables from the command line
  std::unordered_map<const Unit*, ScopePtr> unit_scopes_;

  // Special variables of the calls that are being evaluated, innermost last.
  std::vector<std::pair<Symbol, Value>> specials_;
  std::vector<const ast::CallStatement*> module_calls_;  // calls that are being evaluated, innermost last
  int depth_ = 0;
  int node_depth_ = 0;           // number of calls of nodes whose children are being evaluated
  ast::Span at_;                 // position of the current evaluation
  uint64_t argument_bytes_ = 0;  // bytes in the arguments of the current call
  Nodes roots_;                  // nodes of statements marked "!"
  bool has_roots_ = false;
  ReadAhead* reader_ = nullptr;               // reader of the latest action, or null
  std::unordered_set<std::string> reported_;  // diagnostics that were reported
  size_t failures_ = 0;                       // number of failed statements, reported or not
};

}  // namespace ombre::lang

// Evaluates a parsed OpenSCAD script: expressions give values, statements give trees of solids. Undefined operations
// give undef and a warning. Only a failed assertion, endless recursion and the limits stop the evaluation.
#pragma once

#include <random>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lang/engine/evaluation.h"
#include "lang/openscad/script_functions.h"
#include "lang/openscad/script_messages.h"
#include "lang/openscad/script_options.h"

namespace ombre::lang::openscad {

class Evaluator;

// Returns the path of a file relative to a folder, usually that of the main file, as messages show it. An empty folder
// is the working directory.
std::string shown_path(const std::string& path, const std::string& folder);
std::string folder_of(const std::string& path);

using Trees = std::vector<solids::TreePtr>;

// One call of a builtin module with evaluated arguments.
class ModuleCall {
 public:
  ModuleCall(Evaluator& evaluator, const ast::CallStatement& statement, const ScopePtr& scope)
      : evaluator_(evaluator), statement_(statement), scope_(scope) {}

  std::string name() const { return statement_.name.text(); }
  bool has(std::string_view parameter) const;  // true if the argument is given and not undef
  const Value& operator[](std::string_view parameter) const;
  std::optional<double> number(std::string_view parameter) const;
  double number(std::string_view parameter, double otherwise) const { return number(parameter).value_or(otherwise); }
  bool flag(std::string_view parameter, bool otherwise) const;
  std::string text(std::string_view parameter, const std::string& otherwise = "") const;
  std::string shown(std::string_view parameter) const;  // value as messages show it
  std::string shown_value(const Value& value) const;
  void warn(const std::string& text) const;
  void deprecate(const std::string& text) const;
  void deprecate_here(const std::string& text) const;
  void note(const std::string& text) const;

  solids::Fragments fragments() const;          // fragments from $fn, $fa and $fs at the call
  solids::Fragments checked_fragments() const;  // enforces the least values of $fa and $fs
  std::string complete_path(const std::string& path) const;
  const std::vector<std::string>& font_files() const;  // that the script uses
  const Trees& children();
  std::shared_ptr<solids::Tree> node(solids::Operation operation) const;
  solids::TreePtr with_children(solids::Operation operation);

 private:
  friend class Evaluator;

  Evaluator& evaluator_;
  const ast::CallStatement& statement_;
  const ScopePtr& scope_;
  std::vector<std::pair<std::string_view, Value>> values_;
  std::optional<Trees> children_;
  std::optional<solids::Semantics> semantics_;  // value of the argument `semantics`
};

// A builtin module: the parameters that may be positional, those that must be named, and the function that makes its
// tree.
struct Module {
  const char* name;
  std::vector<std::string_view> positional, named;
  solids::TreePtr (*make)(ModuleCall& call);
  bool takes_anything = false;  // arguments are not checked
  bool is_operation = false;    // an operation on children, which accepts `semantics`
  bool warns_of_children = false;
};

// Warns of an `origin` that is no pair of finite numbers; it counts for files alone.
void check_origin(const ModuleCall& call, const std::string& module);

std::vector<Module> shape_modules();
std::vector<Module> plane_modules();
std::vector<Module> transform_modules();
std::vector<Module> operation_modules();
std::vector<Module> file_modules();

class Evaluator : Evaluation<Evaluator, solids::TreePtr> {
 public:
  Evaluator(const Program& program, const Options& options, Messages& messages);
  // Returns the group of all nodes, or the node marked "!"; null after an error.
  solids::TreePtr run();
  // Warns of variables of the view that the script has set, after a run.
  void check_view();
  const std::vector<std::string>& read_files() const { return read_files_; }  // those that functions have read

 private:
  friend Evaluation;
  friend class ModuleCall;

  static constexpr Rules rules{.call_levels = 1,
                               .names_whole_constructs = true,
                               .prefers_variables = true,
                               .prefers_last_use = true,
                               .defaults_see_parameters = false,
                               .arguments_set_specials_last = true,
                               .calls_specials = false};

  // Levels that are reserved for what the last allowed call still evaluates.
  static constexpr int spare_levels = 200;

  // The calls that were entered without a further level. A function that calls itself at its end counts once.
  class EnteredCalls {
   public:
    void add(const ast::Call& call, const ast::Expr& body) {
      if (!first_)
        first_ = &call;
      else if (&body != body_)
        others_.push_back(&call);
      else
        ++repeats_;
      body_ = &body;
    }
    const ast::Call* first() const { return first_; }
    const std::vector<const ast::Call*>& others() const { return others_; }
    const ast::Call* last() const { return others_.empty() ? first_ : others_.back(); }
    size_t count() const { return others_.size() + static_cast<size_t>(repeats_) + (first_ ? 1 : 0); }
    int repeats() const { return repeats_; }  // of calls of a function with which it ends itself

   private:
    const ast::Call* first_ = nullptr;
    std::vector<const ast::Call*> others_;
    const ast::Expr* body_ = nullptr;  // of the last call
    int repeats_ = 0;
  };

  // The file from whose folder a message shows a path. As in OpenSCAD, operators, ranges and the arguments of a call
  // have that of the unit, and all others that of the main file.
  enum class ShownFrom : uint8_t { main_file, unit };

  // Functions that report messages.
  void say(Message::Kind kind, std::string text, const ast::Span& where, Code code = Code::script,
           ShownFrom from = ShownFrom::main_file);
  void warn(std::string text, const ast::Span& where, ShownFrom from = ShownFrom::main_file);
  void warn_all(Problems& problems, const ast::Span& where, ShownFrom from = ShownFrom::main_file);
  [[noreturn]] void stop(std::string text, const ast::Span& where, Code code = Code::script);
  void trace(const std::string& name, const ast::Span& where);
  void trace(const EnteredCalls& entered);
  // Throws Stopped if a recursion that does not end has led to a limit of what values may hold.
  void stop_if_recursive(const EnteredCalls& entered);
  void stop_if_recursive(const ast::ModuleDef& module);
  void say_recursion(const ast::Call& call);
  void trace(const ast::Statement& statement);
  std::pair<std::string, int> file_and_line(const ast::Span& where, ShownFrom from = ShownFrom::main_file);
  const std::string& path_of(ShownFrom from, const SourcePtr* source) const;

  // Defined in script_statements.cpp.
  void begin(const Unit&, Scope&) {}
  void end(const Unit& unit, size_t specials_before);
  bool is_overridden(const ast::Assign&, const Scope&) const { return false; }
  Value assigned(const ast::Assign& assignment, const ScopePtr& scope) { return eval(*assignment.value, scope); }
  static Value computed(const ast::Expr&, Value value) { return value; }
  void run_actions(const ast::Plan& plan, const ScopePtr& scope, Trees& out);
  void run_statement(const ast::Statement& statement, const ScopePtr& scope, Trees& out);
  void run_deferred(const ast::Deferred& statement, const ScopePtr& scope, Trees& out);
  void run_condition(const ast::Condition& statement, const ScopePtr& scope, Trees& out, size_t branch = 0);
  void run_loops(const ast::CallStatement& statement, const ScopePtr& scope, Trees& out,
                 solids::Operation operation = solids::Group{});
  void run_inside(const ast::CallStatement& statement, const ScopePtr& scope, Trees& out);
  // A module, a loop or let makes one tree.
  template <class Body>
  void group(const ast::Span& where, Trees& out, const Body& body, solids::Operation operation = solids::Group{}) {
    auto result = tree(std::move(operation), where);
    body(result->children);
    out.push_back(std::move(result));
  }
  void check_depth(const ast::ModuleDef& module);
  [[noreturn]] void stop_recursion(const ast::ModuleDef& module);
  // Warns of parameters to which the module gives other values.
  void check_assignments(const ast::ModuleDef& module);
  void set_counts(const ast::CallStatement& statement, Scope& inner, size_t specials_from);
  void call_other(const ast::CallStatement& statement, const ScopePtr& scope, Trees& out);
  solids::TreePtr run_builtin(const Module& module, const ast::CallStatement& statement, const ScopePtr& scope);
  solids::TreePtr run_children(const ast::CallStatement& statement, const ScopePtr& scope);
  std::optional<size_t> chosen_child(const ast::CallStatement& statement, const Value& index, size_t count);
  void bind_builtin(const Module& module, const std::vector<ast::Argument>& arguments, const ScopePtr& scope,
                    ModuleCall& call, size_t specials_from);
  std::shared_ptr<solids::Tree> tree(solids::Operation operation, const ast::Span& where);
  solids::Semantics semantics_of(const Value& value, const ast::Span& where);
  void find_roots(const solids::TreePtr& tree, std::vector<solids::TreePtr>& found) const;
  void warn_of_roots(const solids::Tree& second);

  // Defined in word_calls.cpp.
  void check_words();
  bool has_words(const Scope& scope) const;
  bool makes_solid(const ast::Name& name, const Scope& scope) const;
  bool gives_value(const ast::Name& name, const Scope& scope) const;
  solids::TreePtr run_word(const ast::CallStatement& statement, const ScopePtr& scope);
  Value value_of_word(const ast::Call& call, const ScopePtr& scope);
  Invocation word_call(const ast::Name& name, const ast::Span& whole, const std::vector<ast::Argument>& arguments,
                       const ScopePtr& scope, std::string& written);
  void report_words(const Diagnostics& found, const ast::Span& where);
  [[noreturn]] void stop_at_function(const ast::Span& argument);

  // Defined in script_expressions.cpp.
  [[noreturn]] void stop_at_depth(const ast::Span& where);
  double passes(const Range& range, const ast::Span& where);
  bool is_one_pass(const Value& values, const ast::Span&, const char*) { return !values.is_undef(); }
  void check_pass(uint64_t count, const ast::GenerateLoop& loop);
  const Value* find_constant(Symbol) { return nullptr; }
  Value value_of_unknown(const ast::Name& name, const Scope& scope);
  Value mistaken(const ast::Span&, std::string_view, const Value&) { return {}; }
  Value eval_range(const ast::Range& range, const ScopePtr& scope);
  Value eval_other_member(const ast::Member& member, const Value& base);
  [[noreturn]] void stop_without_part(const ast::Member& member, const Object& object, const std::string& known);
  [[noreturn]] void stop_at_choice(const ast::Span& where, const Value& yes, const Value& no);
  bool is_chosen(const Value& condition, const ast::Span&) { return is_true(condition); }
  Value unary(ast::Operator op, const ast::Span& where, const Value& operand);
  Value binary(ast::Operator op, const ast::Span& where, const Value& left, const Value& right) {
    if (left.number() && right.number()) {  // a shortcut for the most frequent operators
      const double a = *left.number(), b = *right.number();
      if (op == ast::Operator::add) return a + b;
      if (op == ast::Operator::subtract) return a - b;
      if (op == ast::Operator::multiply) return a * b;
    }
    return operate(op, where, left, right);
  }
  Value operate(ast::Operator op, const ast::Span& where, const Value& left, const Value& right);

  // Defined in script_function_calls.cpp.
  void check_depth(const ast::Call& call, const EnteredCalls& entered);
  void enter(const Unit& used, size_t specials_from);
  void replace_callee(const ast::Call& call, const Value& value, const ScopePtr& scope, Callee& callee);
  Value call_other(const ast::Call& call, const ScopePtr& scope);
  [[noreturn]] void stop_at_argument(const ast::Span& where, std::string message) {
    stop(std::move(message), where, Code::parameter_type);
  }
  static std::string mismatch_of_material(const std::string&) { return ""; }  // scripts have no table of materials
  void report_too_many(const ast::Argument& argument, const ast::Span& where,
                       const std::vector<ast::Parameter>& parameters);
  void report_parameter(const ast::Name& name, const ast::Span& where, const std::vector<ast::Parameter>& parameters);
  void report_twice(const ast::Argument& argument, Symbol parameter, const ast::Span& where);
  bool ignores(const std::vector<ast::Argument>& arguments, size_t n, const Value& value);
  void assert_true(const std::vector<ast::Argument>& arguments, const ast::Span& where, const ScopePtr& scope);
  void append(std::string& text, const Value& value);
  void print(std::string text);

  double special_number(Symbol name) const;

  const Options& options_;
  Messages& messages_;
  std::mt19937 random_{0};
  std::vector<std::string> read_files_;
  FunctionFiles files_{{}, program_.fonts};

  Symbol children_name_, child_name_, intersection_for_name_, assign_name_, children_count_, parent_modules_, fa_, fs_,
      semantics_;
  std::unordered_map<Symbol, NamedFunction> functions_;
  std::vector<Module> module_table_;
  std::unordered_map<Symbol, const Module*> modules_;
  std::unordered_map<const Unit*, std::vector<std::pair<Symbol, Value>>> unit_specials_;
  std::array<std::unordered_map<const SourcePtr*, std::string>, 2> shown_files_;  // by ShownFrom

  std::vector<const solids::Tree*> roots_;  // marked with "!"
  int nested_statements_ = 0;
  int traced_ = 0;  // number of calls around an error that were reported
};

}  // namespace ombre::lang::openscad

namespace ombre::lang {
extern template class Evaluation<openscad::Evaluator, solids::TreePtr>;
}

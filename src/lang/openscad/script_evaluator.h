// Evaluates a parsed OpenSCAD script: expressions give values, statements give trees of solids. Undefined operations
// give undef and a warning. Only a failed assertion, endless recursion and the limits stop the evaluation.
#pragma once

#include <random>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lang/engine/loader.h"
#include "lang/engine/scope.h"
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
  void warn(const std::string& text) const;
  void deprecate(const std::string& text) const;
  void deprecate_here(const std::string& text) const;
  void note(const std::string& text) const;

  solids::Fragments fragments() const;          // fragments from $fn, $fa and $fs at the call
  solids::Fragments checked_fragments() const;  // enforces the least values of $fa and $fs
  std::string complete_path(const std::string& path) const;
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

std::vector<Module> shape_modules();
std::vector<Module> plane_modules();
std::vector<Module> transform_modules();
std::vector<Module> operation_modules();
std::vector<Module> file_modules();

class Evaluator {
 public:
  Evaluator(const Program& program, const Options& options, Messages& messages);
  // Returns the group of all nodes, or the node marked "!"; null after an error.
  solids::TreePtr run();

 private:
  friend class ModuleCall;

  // Levels that are reserved for what the last allowed call still evaluates.
  static constexpr int spare_levels = 200;

  // Thrown to stop the evaluation after a message was added.
  struct Stopped {};

  class Level {
   public:
    explicit Level(Evaluator& evaluator) : evaluator_(evaluator) { ++evaluator_.depth_; }
    ~Level() { --evaluator_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Evaluator& evaluator_;
  };

  // Removes the special variables that were set during its life.
  class SpecialsMark {
   public:
    explicit SpecialsMark(Evaluator& evaluator) : evaluator_(evaluator), size_(evaluator.specials_.size()) {}
    ~SpecialsMark() { evaluator_.specials_.resize(size_); }
    SpecialsMark(const SpecialsMark&) = delete;
    SpecialsMark& operator=(const SpecialsMark&) = delete;
    size_t size() const { return size_; }

   private:
    Evaluator& evaluator_;
    size_t size_;
  };

  // A function to call, and the scope in which it was defined.
  struct Callee {
    const std::vector<ast::Parameter>* parameters = nullptr;
    const ast::Expr* body = nullptr;
    ScopePtr scope;
    const Unit* used = nullptr;  // the file that defines the function, if it is one of `use`
  };

  // Functions that report messages.
  void say(Message::Kind kind, std::string text, const ast::Span& where, Code code = Code::script);
  void warn(std::string text, const ast::Span& where);
  void warn_all(Problems& problems, const ast::Span& where);
  [[noreturn]] void stop(std::string text, const ast::Span& where, Code code = Code::script);
  void trace(const std::string& name, const ast::Span& where);
  std::pair<std::string, int> place(const ast::Span& where);

  // Defined in script_statements.cpp.
  const ScopePtr& unit_scope(const Unit& unit);
  void assign(const ast::Plan& plan, const ScopePtr& scope);
  void run_actions(const ast::Plan& plan, const ScopePtr& scope, Trees& out);
  void run_block(const ast::Block& block, const ScopePtr& outer, Trees& out);
  solids::TreePtr run_statement(const ast::Statement& statement, const ScopePtr& scope);
  solids::TreePtr dispatch(const ast::Statement& statement, const ScopePtr& scope);
  solids::TreePtr run_condition(const ast::Condition& statement, size_t branch, const ScopePtr& scope);
  solids::TreePtr run_call(const ast::CallStatement& statement, const ScopePtr& scope);
  solids::TreePtr run_loops(const ast::CallStatement& statement, solids::Operation operation, const ScopePtr& scope);
  void run_loop(const ast::CallStatement& statement, size_t variable, const ScopePtr& scope, Trees& out);
  solids::TreePtr run_module(const ast::ModuleDef& module, const ScopePtr& home, const Unit* used,
                             const ast::CallStatement& statement, const ScopePtr& scope);
  solids::TreePtr run_builtin(const Module& module, const ast::CallStatement& statement, const ScopePtr& scope);
  solids::TreePtr run_children(const ast::CallStatement& statement, const ScopePtr& scope);
  std::optional<size_t> chosen_child(const Value& index, size_t count);
  solids::TreePtr run_let(const ast::CallStatement& statement, const ScopePtr& scope);
  solids::TreePtr group(const ast::CallStatement& statement, const ScopePtr& scope, bool is_null_without);
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
  Data data_of(const Value& value, const SourceRange& where, const ast::Span& argument);
  std::optional<Value> of_objects(std::string_view function, const std::vector<Value>& arguments);
  Value choice(const ast::Conditional& conditional, size_t branch, const Value& condition, const ScopePtr& scope);

  // Defined in script_expressions.cpp.
  Value eval(const ast::Expr& expr, const ScopePtr& scope);
  Value eval_compound(const ast::Expr& expr, const ScopePtr& scope);
  Value eval_variable(const ast::Name& name, const Scope& scope);
  const Value* find_variable(Symbol name, const Scope& scope) const;
  Value eval_range(const ast::Range& range, const ScopePtr& scope);
  Value eval_list(const ast::List& list, const ScopePtr& scope);
  Value eval_chain(const ast::Chain& chain, const ScopePtr& scope);
  Value eval_index(const ast::Index& index, const ScopePtr& scope);
  Value eval_member(const ast::Member& member, const ScopePtr& scope);
  Value operate(ast::Operator op, const Value& left, const Value& right, const ast::Span& where);
  Value at_index(const Value& base, double index);

  // Defined in script_function_calls.cpp.
  Value eval_tail(const ast::Expr& expr, const ScopePtr& scope);
  const ast::Expr* enter_prefix(const ast::Prefix& prefix, ScopePtr& scope, size_t specials_from);
  bool find_function(const ast::Call& call, const ScopePtr& scope, Callee& callee);
  bool find_named_function(Symbol name, const ScopePtr& scope, Callee& callee);
  Value call_builtin(const ast::Call& call, const ScopePtr& scope);
  void bind(const std::vector<ast::Parameter>& parameters, const std::vector<ast::Argument>& arguments,
            const ScopePtr& caller, const ScopePtr& home, const ScopePtr& into, const ast::Span& where,
            size_t specials_from);
  void bind_let(const std::vector<ast::Argument>& arguments, const ScopePtr& scope, size_t specials_from);
  void assert_true(const std::vector<ast::Argument>& arguments, const ast::Span& where, const ScopePtr& scope);
  void echo(const std::vector<ast::Argument>& arguments, const ScopePtr& scope);

  // Defined in script_generators.cpp.
  void generate(const ast::Expr& expr, const ScopePtr& scope, ListBuilder& out);
  void generate_for(const ast::GenerateFor& loop, size_t variable, const ScopePtr& scope, ListBuilder& out);
  void generate_loop(const ast::GenerateLoop& loop, const ScopePtr& scope, ListBuilder& out);
  void generate_each(const ast::GenerateEach& each, const ScopePtr& scope, ListBuilder& out);
  template <class Body>
  void for_each(const Value& values, const ast::Span& where, const Body& body);
  template <class Body>
  void for_each_scope(const ast::Argument& loop, const ScopePtr& scope, const ast::Span& where, const Body& body);

  void set_special(Symbol name, Value value, size_t from);
  const Value* find_special(Symbol name) const;
  void set_variable(const ast::Name& name, Value value, Scope& scope, size_t specials_from);
  double special_number(Symbol name) const;

  const Program& program_;
  const Options& options_;
  Messages& messages_;
  Meter meter_;
  CapturedScopes captured_;
  std::mt19937 random_{0};

  Symbol children_name_, child_name_, intersection_for_name_, assign_name_, children_count_, parent_modules_, fn_, fa_,
      fs_, semantics_;
  std::unordered_map<Symbol, NamedFunction> functions_;
  std::vector<Module> module_table_;
  std::unordered_map<Symbol, const Module*> modules_;
  std::unordered_map<Symbol, Value> constants_;
  std::unordered_map<const Unit*, ScopePtr> unit_scopes_;
  std::unordered_map<const Unit*, std::vector<std::pair<Symbol, Value>>> unit_specials_;
  std::unordered_map<const SourcePtr*, std::string> shown_files_;

  // Special variables of the calls that are being evaluated, innermost last.
  std::vector<std::pair<Symbol, Value>> specials_;
  std::vector<std::string> module_names_;   // names of the modules that are being evaluated, outermost first
  std::vector<const solids::Tree*> roots_;  // marked with "!"
  ast::Span at_;                            // position of the current evaluation
  int depth_ = 0, nested_statements_ = 0;
  int traced_ = 0;  // number of calls around an error that were reported
};

template <class Body>
void Evaluator::for_each_scope(const ast::Argument& loop, const ScopePtr& scope, const ast::Span& where,
                               const Body& body) {
  const Value values = eval(*loop.value, scope);
  const SpecialsMark mark(*this);
  ScopePtr inner = make_scope(scope);
  for_each(values, where, [&](const Value& value) {
    // Reuses the scope for the next pass, unless a closure holds it.
    if (inner->use_count() > 1) inner = make_scope(scope);
    inner->clear();
    if (loop.name.symbol) set_variable(loop.name, value, *inner, mark.size());
    body(inner);
  });
}

}  // namespace ombre::lang::openscad

// Evaluates what is alike in the script languages. A language derives from Evaluation, and says what a mistake does,
// which functions and modules there are, and what statements make (interpreter.h, ../openscad/script_evaluator.h).
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/system/not_copied.h"
#include "base/system/temporary.h"
#include "lang/engine/loader.h"
#include "lang/engine/scope.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// The rules in which the languages differ. Each language has the constant `rules`.
struct Rules {
  int call_levels;                   // levels that a call, a conditional and let count for
  bool names_whole_constructs;       // messages point to a whole loop or operation, not to a part of it
  bool prefers_variables;            // a closure in a variable hides the function of that name in the same scope
  bool prefers_last_use;             // the last file of `use` that defines a name gives it
  bool defaults_see_parameters;      // default values may use the parameters before them
  bool arguments_set_specials_last;  // arguments and defaults do not see the special variables that the call sets
  bool calls_specials;               // functions in special variables may be called
};

// `Product` is what statements make.
template <class Language, class Product>
class Evaluation {
 protected:
  using Products = std::vector<Product>;

  // Thrown if the current item cannot be evaluated. A message was added before.
  struct Stopped {};

  // Removes the special variables that were set during its life.
  class SpecialsMark : NotCopied {
   public:
    explicit SpecialsMark(Evaluation& evaluation) : specials_(evaluation.specials_), size_(specials_.size()) {}
    ~SpecialsMark() { specials_.resize(size_); }
    size_t size() const { return size_; }

   private:
    std::vector<std::pair<Symbol, Value>>& specials_;
    size_t size_;
  };

  // A function to call, named or a literal.
  struct Callee {
    const std::vector<ast::Parameter>* parameters = nullptr;
    const ast::Expr* body = nullptr;
    ScopePtr scope;              // the scope where it was defined
    const Unit* used = nullptr;  // the file that defines the function, if it is one of `use`
    const Declaration* declaration = nullptr;
  };

  Evaluation(const Program& program, const Limits& limits, const StopFlag* stop)
      : program_(program), meter_(limits, stop), captured_(limits), facets_name_(symbol("$fn")) {
    constants_[symbol("PI")] = 3.14159265358979323846;
  }

  Language& self() { return static_cast<Language&>(*this); }
  Symbol symbol(std::string_view name) const { return program_.names->intern(name); }
  // Counts levels of evaluation for as long as the result lives.
  Temporary<int> deeper(const ast::Span& at, int levels = 1) {
    at_ = at;
    meter_.spend();
    if (depth_ + levels > meter_.limits().depth) self().stop_at_depth(at);
    return {depth_, depth_ + levels};
  }
  static const ast::Span& place(const ast::Span& construct, const ast::Span& part) {
    return Language::rules.names_whole_constructs ? construct : part;
  }

  // Special variables.
  void set_special(Symbol name, Value value, size_t from) {
    for (size_t i = from; i < specials_.size(); ++i) {
      if (specials_[i].first != name) continue;
      specials_[i].second = std::move(value);
      return;
    }
    specials_.emplace_back(name, std::move(value));
  }
  const Value* find_special(Symbol name) const {
    for (size_t i = specials_.size(); i > 0; --i)
      if (specials_[i - 1].first == name) return &specials_[i - 1].second;
    return nullptr;
  }
  void set_variable(const ast::Name& name, Value value, Scope& scope, size_t specials_from) {
    if (name.symbol && name.is_special())
      set_special(name.symbol, std::move(value), specials_from);
    else if (name.symbol)
      scope.set(name.symbol, std::move(value));
  }

  // Returns the file of `use` in this scope for which `has` is true, or null.
  template <class Has>
  static const Unit* find_used(const Scope& scope, const Has& has) {
    const size_t count = scope.unit() ? scope.unit()->uses.size() : 0;
    for (size_t n = 0; n < count; ++n) {
      const Unit* used = scope.unit()->uses[Language::rules.prefers_last_use ? count - 1 - n : n];
      if (has(*used)) return used;
    }
    return nullptr;
  }

  // Defined in evaluation_expressions.h.
  Value eval(const ast::Expr& expr, const ScopePtr& scope);
  Value eval_compound(const ast::Expr& expr, const ScopePtr& scope);
  const Value* find_variable(Symbol name, const Scope& scope);
  Value eval_variable(const ast::Name& name, const Scope& scope);
  Value eval_list(const ast::List& list, const ScopePtr& scope);
  Value eval_chain(const ast::Chain& chain, const ScopePtr& scope);
  Value eval_logic(const ast::Chain& chain, const ScopePtr& scope);
  Value eval_index(const ast::Index& index, const ScopePtr& scope);
  Value eval_member(const ast::Member& member, const ScopePtr& scope);
  Value character(const std::string& text, double index);
  bool holds(const ast::Expr& condition, const ScopePtr& scope);
  const ast::Expr* choose(const ast::Conditional& conditional, const ScopePtr& scope, Value& chosen);
  Value otherwise(const ast::Conditional& conditional, size_t first, const ScopePtr& scope);
  Value choice(const Value& condition, const Value& yes, const Value& no, const ast::Span& where);

  // Defined in evaluation_calls.h.
  // Evaluates calls, conditions and let. If one ends with another, continues in a loop instead of recursively.
  Value eval_tail(const ast::Expr& expr, const ScopePtr& scope);
  const ast::Expr* enter_prefix(const ast::Prefix& prefix, ScopePtr& scope, size_t specials_from);
  bool find_callee(const ast::Call& call, const ScopePtr& scope, Callee& callee);
  bool find_function(Symbol name, const ScopePtr& scope, Callee& callee);
  std::optional<bool> tests_variable(std::string_view function, const ast::Call& call, const Scope& scope);
  std::optional<Value> result_of_objects(std::string_view function, std::span<const Value> arguments);
  void bind(const std::vector<ast::Parameter>& parameters, const std::vector<ast::Argument>& arguments,
            const ScopePtr& caller, const ScopePtr& home, const ScopePtr& into, const ast::Span& callee,
            size_t specials_from);
  void check_arguments(const Declaration& declaration, const std::vector<ast::Argument>& arguments, const Scope& bound);
  void bind_let(const std::vector<ast::Argument>& arguments, const ScopePtr& scope, size_t specials_from);
  void echo(const std::vector<ast::Argument>& arguments, const ScopePtr& scope);

  template <class Seen>
  void node_arguments(const std::vector<ast::Argument>& arguments, const ScopePtr& scope, Invocation& invocation,
                      const Seen& seen);
  static std::optional<Data> named_value(const std::string& name, const Scope& scope);
  static Invocation::Braces braces_of(const ast::CallStatement& statement);
  Data to_data(const Value& value, const SourceRange& where, const ast::Span& argument);
  Data to_list(const Value& value, const SourceRange& where, const ast::Span& argument);

  // Defined in evaluation_loops.h.
  void generate(const ast::Expr& expr, const ScopePtr& scope, ListBuilder& out);
  void generate_for(const ast::GenerateFor& loop, size_t variable, const ScopePtr& scope, ListBuilder& out);
  void generate_loop(const ast::GenerateLoop& loop, const ScopePtr& scope, ListBuilder& out);
  void generate_each(const ast::GenerateEach& each, const ScopePtr& scope, ListBuilder& out);
  // Calls `body` with each element of a range, list or string. `expected` begins the message about other values.
  template <class Body>
  void for_each(const Value& values, const ast::Span& where, const char* expected, const Body& body);
  // Calls `body` with a scope for each value of a loop's variable.
  template <class Body>
  void for_each_scope(const ast::Argument& loop, const ast::Span& whole, const ScopePtr& scope, const Body& body);

  // Defined in evaluation_statements.h.
  const ScopePtr& unit_scope(const Unit& unit);
  void assign(const ast::Plan& plan, const ScopePtr& scope);
  // `more` is passed to the language's run_actions.
  template <class... More>
  void run_block(const ast::Block& block, const ScopePtr& outer, Products& out, More... more) {
    if (block.plan.defines_nothing()) return self().run_actions(block.plan, outer, out, more...);
    const ScopePtr scope = make_scope(outer, &block.plan);
    const SpecialsMark mark(*this);
    assign(block.plan, scope);
    self().run_actions(block.plan, scope, out, more...);
  }
  void dispatch(const ast::Statement& statement, const ScopePtr& scope, Products& out);
  void run_loop(const ast::CallStatement& statement, size_t variable, const ScopePtr& scope, Products& out);
  void run_let(const ast::CallStatement& statement, const ScopePtr& scope, Products& out);
  void call(const ast::CallStatement& statement, const ScopePtr& scope, Products& out);
  void call_module(const ast::ModuleDef& module, const ScopePtr& home, const Unit* used,
                   const ast::CallStatement& statement, const ScopePtr& scope, Products& out);

  const Program& program_;
  Meter meter_;
  CapturedScopes captured_;
  Symbol facets_name_;
  std::unordered_map<Symbol, Value> constants_;
  std::unordered_map<const Unit*, ScopePtr> unit_scopes_;
  // Special variables of the calls that are being evaluated, innermost last.
  std::vector<std::pair<Symbol, Value>> specials_;
  std::vector<const ast::CallStatement*> module_calls_;  // calls that are being evaluated, innermost last
  int depth_ = 0;
  ast::Span at_;                 // position of the current evaluation
  uint64_t argument_bytes_ = 0;  // bytes in the arguments of the current call
};

}  // namespace ombre::lang

// The syntax tree of a script. Every part knows its position.
//
// Constructs that can be long without nesting (sums, else-if chains) are lists, not deep trees, so that walking a tree
// needs no more stack than the parser's limit of nesting allows.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/text/source_text.h"

namespace ombre::lang {

struct Declaration;

// A table of names in which equal names are equal pointers.
using Symbol = const std::string*;

class Names {
 public:
  bool contains(std::string_view text) const { return names_.contains(text); }
  Symbol intern(std::string_view text) {
    const auto known = names_.find(text);
    return known != names_.end() ? &*known : &*names_.emplace(text).first;
  }

 private:
  struct Hash : std::hash<std::string_view> {
    using is_transparent = void;
  };
  std::unordered_set<std::string, Hash, std::equal_to<>> names_;
};

namespace ast {

// A range of a source, which the file keeps alive. Cheap to copy.
struct Span {
  const SourcePtr* source = nullptr;
  uint32_t begin = 0, end = 0;

  SourceRange range() const { return source ? SourceRange{*source, begin, end} : SourceRange{}; }
  Span to(const Span& last) const { return {source, begin, last.end}; }
};

struct Name {
  Symbol symbol = nullptr;
  Span span;

  const std::string& text() const { return *symbol; }
  bool is_special() const { return symbol->front() == '$'; }
};

// A node of the tree of a script: its kind, which tells its type, and where it stands.
template <class KindOfNode>
struct Node {
  using Kind = KindOfNode;
  Node(Kind k, Span s) : kind(k), span(s) {}
  virtual ~Node() = default;

  Kind kind;
  Span span;
};

enum class ExprKind : uint8_t {
  undef,
  boolean,
  number,
  string,
  variable,
  range,
  list,
  unary,
  chain,
  power,
  conditional,
  call,
  index,
  member,
  function,
  prefix,
  generate_for,
  generate_loop,
  generate_if,
  generate_each
};

struct Expr : Node<ExprKind> {
  using Node::Node;
};
using ExprPtr = std::unique_ptr<Expr>;

struct Undef : Expr {
  explicit Undef(Span s) : Expr(Kind::undef, s) {}
};

struct Boolean : Expr {
  Boolean(Span s, bool v) : Expr(Kind::boolean, s), value(v) {}
  bool value;
};

struct Number : Expr {
  Number(Span s, double v) : Expr(Kind::number, s), value(v) {}
  double value;
};

struct String : Expr {
  String(Span s, std::string v, bool plain) : Expr(Kind::string, s), value(std::move(v)), is_plain(plain) {}
  std::string value;
  bool is_plain;  // the characters between the quotes are the value

  Span inside() const { return {span.source, span.begin + 1, span.end - 1}; }
};

struct Variable : Expr {
  explicit Variable(Name n) : Expr(Kind::variable, n.span), name(n) {}
  Name name;
};

struct Range : Expr {
  explicit Range(Span s) : Expr(Kind::range, s) {}
  ExprPtr begin, step, end;  // step 1 if absent
};

struct List : Expr {
  explicit List(Span s) : Expr(Kind::list, s) {}
  std::vector<ExprPtr> elements;
  bool is_tuple = false;
  bool has_generators = false;  // the value may have more or fewer elements than are written
};

enum class Operator : uint8_t {
  add,
  subtract,
  multiply,
  divide,
  modulo,
  power,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  logical_and,
  logical_or,
  bit_or,
  bit_and,
  shift_left,
  shift_right,
  negate,
  plus,
  logical_not,
  bit_not
};

const char* spelling(Operator op);

struct Unary : Expr {
  Unary(Span s, Operator o, ExprPtr e) : Expr(Kind::unary, s), op(o), operand(std::move(e)) {}
  Operator op;
  ExprPtr operand;
};

// Operators of one precedence, from left to right.
struct Chain : Expr {
  struct Link {
    Operator op;
    Span op_span;
    ExprPtr operand;
  };
  explicit Chain(ExprPtr f) : Expr(Kind::chain, f->span), first(std::move(f)) {}
  ExprPtr first;
  std::vector<Link> links;
};

struct Power : Expr {
  Power(ExprPtr b, Span op, ExprPtr e)
      : Expr(Kind::power, b->span.to(e->span)), base(std::move(b)), op_span(op), exponent(std::move(e)) {}
  ExprPtr base;
  Span op_span;
  ExprPtr exponent;
};

// Conditionals a ? b : c ? d : e, with their branches in one list.
struct Conditional : Expr {
  explicit Conditional(Span s) : Expr(Kind::conditional, s) {}
  std::vector<std::pair<ExprPtr, ExprPtr>> branches;  // condition and value
  ExprPtr otherwise;
};

struct Argument {
  Name name;  // has no symbol if positional
  ExprPtr value;
};

struct Parameter {
  Name name;
  ExprPtr value;    // the default; may be absent
  Span whole = {};  // range from the name to the end of the default
};

struct Call : Expr {
  explicit Call(ExprPtr c) : Expr(Kind::call, c->span), callee(std::move(c)) {}
  ExprPtr callee;
  std::vector<Argument> arguments;
};

struct Index : Expr {
  explicit Index(ExprPtr b) : Expr(Kind::index, b->span), base(std::move(b)) {}
  ExprPtr base, index;
};

struct Member : Expr {
  Member(ExprPtr b, Name m) : Expr(Kind::member, b->span.to(m.span)), base(std::move(b)), member(m) {}
  ExprPtr base;
  Name member;
};

struct Function : Expr {
  explicit Function(Span s) : Expr(Kind::function, s) {}
  std::vector<Parameter> parameters;
  ExprPtr body;
};

enum class PrefixKind : uint8_t { let, assertion, echo };
const char* spelling(PrefixKind kind);

// Prefixes of a value: let(...), assert(...) or echo(...).
struct Prefix : Expr {
  Prefix(Span s, PrefixKind w) : Expr(Kind::prefix, s), which(w) {}
  PrefixKind which;
  std::vector<Argument> arguments;
  ExprPtr value;  // may be absent, except after let
};

// A loop in list brackets: for (a = ..., b = ...) element.
struct GenerateFor : Expr {
  explicit GenerateFor(Span s) : Expr(Kind::generate_for, s) {}
  std::vector<Argument> loops;
  ExprPtr element;
};

// A loop in list brackets: for (init; condition; next) element.
struct GenerateLoop : Expr {
  explicit GenerateLoop(Span s) : Expr(Kind::generate_loop, s) {}
  std::vector<Argument> init;
  ExprPtr condition;
  std::vector<Argument> next;
  ExprPtr element;
};

struct GenerateIf : Expr {
  explicit GenerateIf(Span s) : Expr(Kind::generate_if, s) {}
  ExprPtr condition, element, otherwise;  // `otherwise` may be absent
};

struct GenerateEach : Expr {
  explicit GenerateEach(Span s) : Expr(Kind::generate_each, s) {}
  ExprPtr element;
};

// The modifiers before a statement, from "*!#%", each at most once, in the order written.
class Modifiers {
 public:
  void add(char modifier) {
    if (!has(modifier)) list_[text().size()] = modifier;
  }
  bool has(char modifier) const { return text().find(modifier) != std::string_view::npos; }
  bool empty() const { return list_[0] == 0; }
  std::string_view text() const { return list_.data(); }

 private:
  std::array<char, 5> list_{};
};

enum class StatementKind : uint8_t {
  assign,
  function,
  module,
  include,
  group,
  call,
  loop,
  let,
  assertion,
  echo,
  condition,
  deferred
};

struct Statement : Node<StatementKind> {
  using Node::Node;

  Modifiers modifiers;

  bool has(char modifier) const { return modifiers.has(modifier); }
};
using StatementPtr = std::unique_ptr<Statement>;

struct Assign;
struct FunctionDef;
struct ModuleDef;

// The order in which a scope's statements are evaluated: first the variables, each at its first position with its last
// value, then the calls. Braces that belong to no statement do not make a scope.
struct Plan {
  std::vector<const Assign*> assignments;
  std::vector<const FunctionDef*> functions;
  std::vector<const ModuleDef*> modules;
  std::vector<const Statement*> actions;
  // Pairs of a value that is never used, and the one that replaces it.
  std::vector<std::pair<const Assign*, const Assign*>> replaced;

  void add(const Statement& statement);
  // Returns the last definition with that name, or null.
  const FunctionDef* function(Symbol name) const;
  const ModuleDef* module(Symbol name) const;
  bool assigns(Symbol name) const;
  bool defines_nothing() const { return assignments.empty() && functions.empty() && modules.empty(); }

 private:
  void assign(const Assign& assignment);

  std::unordered_map<Symbol, size_t> places_;  // positions in `assignments`
  std::unordered_map<Symbol, const FunctionDef*> functions_by_name_;
  std::unordered_map<Symbol, const ModuleDef*> modules_by_name_;
};

struct Block {
  std::vector<StatementPtr> statements;
  bool has_braces = false;
  Plan plan;
};

struct Assign : Statement {
  Assign(Name n, ExprPtr v) : Statement(Kind::assign, n.span.to(v->span)), name(n), value(std::move(v)) {}
  Name name;
  ExprPtr value;
};

// A function or a module.
struct Definition : Statement {
  using Statement::Statement;
  Name name;
  std::vector<Parameter> parameters;
  std::shared_ptr<const Declaration> declaration;  // null if comments declare nothing
};

struct FunctionDef : Definition {
  explicit FunctionDef(Span s) : Definition(Kind::function, s) {}
  ExprPtr body;
};

struct ModuleDef : Definition {
  explicit ModuleDef(Span s) : Definition(Kind::module, s) {}
  Block body;
};

struct Include : Statement {
  Include(Span s, bool use, std::string p, Span at)
      : Statement(Kind::include, s), is_use(use), path(std::move(p)), path_span(at) {}
  bool is_use;
  std::string path;
  Span path_span;
};

// Braces that belong to no statement.
struct Group : Statement {
  explicit Group(Span s) : Statement(Kind::group, s) {}
  std::vector<StatementPtr> statements;
};

// A statement name(arguments) { children }. for, let, assert and echo are calls, too, of other kinds.
struct CallStatement : Statement {
  CallStatement(Kind k, Name n) : Statement(k, n.span), name(n), whole(n.span) {}
  Name name;
  Span whole;  // range from the name to the closing parenthesis
  std::vector<Argument> arguments;
  Block children;
};

// A call of which only the position is kept. It is read again when it is evaluated (parser.h).
struct Deferred : Statement {
  explicit Deferred(const Statement& call) : Statement(Kind::deferred, call.span) { modifiers = call.modifiers; }
};

struct Condition : Statement {
  explicit Condition(Span s) : Statement(Kind::condition, s) {}
  std::vector<std::pair<ExprPtr, Block>> branches;  // condition and statements
  Block otherwise;
  bool has_otherwise = false;
};

struct File {
  std::unique_ptr<const SourcePtr> source;  // allocated on the heap, since spans point to it
  std::shared_ptr<Names> names;
  std::vector<StatementPtr> statements;
};

}  // namespace ast
}  // namespace ombre::lang

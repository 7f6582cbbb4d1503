// Lists the items of a script's syntax tree.
#include <algorithm>

#include "base/text/text.h"
#include "lang/edit/script_graph.h"
#include "lang/syntax/parser.h"

namespace ombre::lang {

using namespace ast;

namespace {

struct Lock {
  std::string by;
  Span at;
};

bool is_word_character(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; }

}  // namespace

class GraphReader {
 public:
  explicit GraphReader(ScriptGraph& graph) : graph_(graph) {}

  void run() {
    for (const StatementPtr& one : graph_.file_.statements) statement(*one, nullptr, std::nullopt, {});
    for (size_t n = 0; n < graph_.items_.size(); ++n)
      if (const GraphItem& item = graph_.items_[n]; item.kind == GraphItem::Kind::variable)
        graph_.variables_[item.variable].push_back(n);
    for (Mention& mention : graph_.mentions_)
      if (!mention.is_local) mention.target = graph_.find(mention.name, scope_of(mention));
  }

 private:
  // The place of an expression in an item.
  struct Holder {
    size_t item = ScriptGraph::no_item, argument = 0;
    const Expr* whole = nullptr;  // the value of the argument
    Lock lock;
  };
  using Parent = std::optional<size_t>;

  std::optional<size_t> scope_of(const Mention& mention) const {
    if (mention.item == ScriptGraph::no_item) return std::nullopt;
    return graph_.items_[graph_.statement_of(mention.item)].parent;
  }

  // Adds an item, unless the graph is full.
  std::optional<size_t> add(GraphItem item) {
    if (graph_.items_.size() >= ScriptGraph::most_items) {
      graph_.is_cut_ = true;
      return std::nullopt;
    }
    graph_.items_.push_back(std::move(item));
    return graph_.items_.size() - 1;
  }

  static GraphItem item_of(GraphItem::Kind kind, const Statement& from, const Block* container, Parent parent,
                           const Lock& lock) {
    GraphItem item;
    item.kind = kind;
    item.span = from.span;
    item.statement = &from;
    item.container = container;
    item.parent = parent;
    item.locked_by = lock.by;
    item.locked_at = lock.at;
    return item;
  }

  void block(const Block& inside, Parent parent, const Lock& lock) {
    for (const StatementPtr& one : inside.statements) statement(*one, &inside, parent, lock);
  }

  void statement(const Statement& one, const Block* container, Parent parent, const Lock& lock) {
    switch (one.kind) {
      case Statement::Kind::assign:
        return assignment(static_cast<const Assign&>(one), container, parent, lock);
      case Statement::Kind::call:
        return call(static_cast<const CallStatement&>(one), container, parent, lock);
      case Statement::Kind::loop:
      case Statement::Kind::let:
        return loop(static_cast<const CallStatement&>(one), container, parent, lock);
      case Statement::Kind::assertion:
      case Statement::Kind::echo:
        return test(static_cast<const CallStatement&>(one), container, parent, lock);
      case Statement::Kind::condition:
        return condition(static_cast<const Condition&>(one), container, parent, lock);
      case Statement::Kind::group:
        return braces(static_cast<const Group&>(one), container, parent, lock);
      case Statement::Kind::module:
        return module(static_cast<const ModuleDef&>(one), container, parent, lock);
      case Statement::Kind::function:
        return function(static_cast<const FunctionDef&>(one));
      case Statement::Kind::include:
      case Statement::Kind::deferred:
        return;
    }
  }

  static std::vector<GraphArgument> arguments_of(const std::vector<Argument>& arguments) {
    std::vector<GraphArgument> result;
    for (const Argument& argument : arguments) {
      const bool has_name = argument.name.symbol != nullptr;
      const Span whole = has_name ? argument.name.span.to(argument.value->span) : argument.value->span;
      result.push_back({has_name ? argument.name.text() : "", argument.value.get(), whole});
    }
    return result;
  }

  // Reads the expressions of an item's arguments.
  void read_arguments(size_t item, const Lock& lock) {
    const std::vector<GraphArgument> arguments = graph_.items_[item].arguments;  // a copy: items are added meanwhile
    for (size_t n = 0; n < arguments.size(); ++n) expression(*arguments[n].value, {item, n, arguments[n].value, lock});
  }

  void assignment(const Assign& assign, const Block* container, Parent parent, const Lock& lock) {
    GraphItem item = item_of(GraphItem::Kind::variable, assign, container, parent, lock);
    item.variable = assign.name.text();
    item.expression = assign.value.get();
    const Call* called = named_call(*assign.value);
    if (called) {
      item.callee = static_cast<const Variable&>(*called->callee).name.text();
      item.arguments = arguments_of(called->arguments);
    } else {
      item.arguments.push_back({"", assign.value.get(), assign.value->span});
    }
    const auto added = add(std::move(item));
    if (!added) return;
    if (called) mention_of(static_cast<const Variable&>(*called->callee).name, {*added, 0, nullptr, lock}, "");
    read_arguments(*added, lock);
  }

  void call(const CallStatement& one, const Block* container, Parent parent, const Lock& lock) {
    GraphItem item = item_of(GraphItem::Kind::call, one, container, parent, lock);
    item.callee = one.name.text();
    item.arguments = arguments_of(one.arguments);
    const auto added = add(std::move(item));
    if (!added) return;
    read_arguments(*added, lock);
    block(one.children, added, lock);
  }

  std::optional<size_t> group(const Statement& one, std::string word, const Block* container, Parent parent,
                              const Lock& lock) {
    GraphItem item = item_of(GraphItem::Kind::group, one, container, parent, lock);
    item.callee = std::move(word);
    return add(std::move(item));
  }

  void loop(const CallStatement& one, const Block* container, Parent parent, const Lock& lock) {
    const auto added = group(one, one.name.text(), container, parent, lock);
    if (!added) return;
    const Lock inside = lock.by.empty() ? Lock{one.kind == Statement::Kind::loop ? "a loop" : "let()", one.span} : lock;
    const size_t before = locals_.size();
    for (const Argument& argument : one.arguments) {
      expression(*argument.value, {*added, 0, nullptr, inside});
      if (argument.name.symbol) locals_.push_back(argument.name.text());
    }
    block(one.children, added, inside);
    locals_.resize(before);
  }

  void test(const CallStatement& one, const Block* container, Parent parent, const Lock& lock) {
    const auto added = group(one, one.name.text(), container, parent, lock);
    if (!added) return;
    const Lock inside = lock.by.empty() ? Lock{one.name.text() + "()", one.span} : lock;
    for (const Argument& argument : one.arguments) expression(*argument.value, {*added, 0, nullptr, inside});
    block(one.children, added, inside);
  }

  void condition(const Condition& one, const Block* container, Parent parent, const Lock& lock) {
    const auto added = group(one, "if", container, parent, lock);
    if (!added) return;
    const Lock inside = lock.by.empty() ? Lock{"a condition", one.span} : lock;
    for (const auto& [test, branch] : one.branches) {
      expression(*test, {*added, 0, nullptr, inside});
      block(branch, added, inside);
    }
    block(one.otherwise, added, inside);
  }

  void braces(const Group& one, const Block* container, Parent parent, const Lock& lock) {
    const auto added = group(one, "{ }", container, parent, lock);
    if (!added) return;
    const Lock inside = lock.by.empty() ? Lock{"braces", one.span} : lock;
    for (const StatementPtr& each : one.statements) statement(*each, nullptr, added, inside);
  }

  void module(const ModuleDef& one, const Block* container, Parent parent, const Lock& lock) {
    graph_.definitions_.push_back({one.name.text(), true, &one.parameters, one.span});
    const auto added = group(one, "module", container, parent, lock);
    if (!added) return;
    graph_.items_[*added].variable = one.name.text();
    const Lock inside = lock.by.empty() ? Lock{"the module " + one.name.text(), one.span} : lock;
    const size_t before = locals_.size();
    parameters(one.parameters, {*added, 0, nullptr, inside});
    block(one.body, added, inside);
    locals_.resize(before);
  }

  void function(const FunctionDef& one) {
    graph_.definitions_.push_back({one.name.text(), false, &one.parameters, one.span});
    const size_t before = locals_.size();
    const Holder outside{ScriptGraph::no_item, 0, nullptr, {"the function " + one.name.text(), one.span}};
    parameters(one.parameters, outside);
    expression(*one.body, outside);
    locals_.resize(before);
  }

  void parameters(const std::vector<Parameter>& list, const Holder& holder) {
    for (const Parameter& parameter : list) {
      if (parameter.value) expression(*parameter.value, holder);
      locals_.push_back(parameter.name.text());
    }
  }

  // Returns the expression as a call of a name, or null.
  static const Call* named_call(const Expr& expr) {
    if (expr.kind != Expr::Kind::call) return nullptr;
    const auto& call = static_cast<const Call&>(expr);
    return call.callee->kind == Expr::Kind::variable ? &call : nullptr;
  }

  void mention_of(const Name& name, const Holder& holder, const std::string& output, const Expr* as = nullptr) {
    Mention mention;
    mention.name = name.text();
    mention.span = name.span;
    mention.item = holder.item;
    mention.argument = holder.argument;
    mention.output = output;
    mention.is_whole = as != nullptr && as == holder.whole;
    mention.is_local = std::ranges::find(locals_, mention.name) != locals_.end();
    graph_.mentions_.push_back(std::move(mention));
  }

  // Reads an expression: which names it uses, and the calls in it.
  void expression(const Expr& expr, const Holder& holder) {
    switch (expr.kind) {
      case Expr::Kind::undef:
      case Expr::Kind::boolean:
      case Expr::Kind::number:
        return;
      case Expr::Kind::string:
        return formula(static_cast<const String&>(expr), holder);
      case Expr::Kind::variable:
        return mention_of(static_cast<const Variable&>(expr).name, holder, "", &expr);
      case Expr::Kind::range: {
        const auto& range = static_cast<const Range&>(expr);
        expression(*range.begin, holder);
        if (range.step) expression(*range.step, holder);
        return expression(*range.end, holder);
      }
      case Expr::Kind::list:
        for (const ExprPtr& element : static_cast<const List&>(expr).elements) expression(*element, holder);
        return;
      case Expr::Kind::unary:
        return expression(*static_cast<const Unary&>(expr).operand, holder);
      case Expr::Kind::chain:
        expression(*static_cast<const Chain&>(expr).first, holder);
        for (const Chain::Link& link : static_cast<const Chain&>(expr).links) expression(*link.operand, holder);
        return;
      case Expr::Kind::power:
        expression(*static_cast<const Power&>(expr).base, holder);
        return expression(*static_cast<const Power&>(expr).exponent, holder);
      case Expr::Kind::conditional:
        for (const auto& [test, value] : static_cast<const Conditional&>(expr).branches) {
          expression(*test, holder);
          expression(*value, holder);
        }
        return expression(*static_cast<const Conditional&>(expr).otherwise, holder);
      case Expr::Kind::call:
        return value_call(static_cast<const Call&>(expr), holder);
      case Expr::Kind::index:
        expression(*static_cast<const Index&>(expr).base, holder);
        return expression(*static_cast<const Index&>(expr).index, holder);
      case Expr::Kind::member:
        return member(static_cast<const Member&>(expr), holder);
      default:
        return local_expression(expr, holder);
    }
  }

  void member(const Member& member, const Holder& holder) {
    if (member.base->kind != Expr::Kind::variable) return expression(*member.base, holder);
    mention_of(static_cast<const Variable&>(*member.base).name, holder, member.member.text(), &member);
  }

  void value_call(const Call& call, const Holder& holder) {
    const Call* named = named_call(call);
    if (!named || holder.item == ScriptGraph::no_item) {
      if (named)
        mention_of(static_cast<const Variable&>(*call.callee).name, holder, "");
      else
        expression(*call.callee, holder);
      for (const Argument& argument : call.arguments) expression(*argument.value, holder);
      return;
    }
    GraphItem item;
    item.kind = GraphItem::Kind::value;
    item.callee = static_cast<const Variable&>(*call.callee).name.text();
    item.span = call.span;
    item.expression = &call;
    item.parent = holder.item;
    item.argument = holder.argument;
    item.locked_by = holder.lock.by;
    item.locked_at = holder.lock.at;
    item.arguments = arguments_of(call.arguments);
    const auto added = add(std::move(item));
    if (!added) return;
    mention_of(static_cast<const Variable&>(*call.callee).name, {*added, 0, nullptr, holder.lock}, "");
    read_arguments(*added, holder.lock);
  }

  // Reads an expression that has variables of its own.
  void local_expression(const Expr& expr, Holder holder) {
    const size_t before = locals_.size();
    if (holder.lock.by.empty()) holder.lock = {lock_word(expr), expr.span};
    switch (expr.kind) {
      case Expr::Kind::function: {
        const auto& function = static_cast<const Function&>(expr);
        parameters(function.parameters, holder);
        expression(*function.body, holder);
        break;
      }
      case Expr::Kind::prefix: {
        const auto& prefix = static_cast<const Prefix&>(expr);
        named(prefix.arguments, holder);
        if (prefix.value) expression(*prefix.value, holder);
        break;
      }
      case Expr::Kind::generate_for: {
        const auto& loop = static_cast<const GenerateFor&>(expr);
        named(loop.loops, holder);
        expression(*loop.element, holder);
        break;
      }
      case Expr::Kind::generate_loop: {
        const auto& loop = static_cast<const GenerateLoop&>(expr);
        named(loop.init, holder);
        expression(*loop.condition, holder);
        named(loop.next, holder);
        expression(*loop.element, holder);
        break;
      }
      case Expr::Kind::generate_if: {
        const auto& choice = static_cast<const GenerateIf&>(expr);
        expression(*choice.condition, holder);
        expression(*choice.element, holder);
        if (choice.otherwise) expression(*choice.otherwise, holder);
        break;
      }
      case Expr::Kind::generate_each:
        expression(*static_cast<const GenerateEach&>(expr).element, holder);
        break;
      default:
        break;
    }
    locals_.resize(before);
  }

  static std::string lock_word(const Expr& expr) {
    if (expr.kind == Expr::Kind::function) return "a function";
    if (expr.kind == Expr::Kind::prefix) return std::string(spelling(static_cast<const Prefix&>(expr).which)) + "()";
    return expr.kind == Expr::Kind::generate_for || expr.kind == Expr::Kind::generate_loop ? "a loop" : "a list";
  }

  void named(const std::vector<Argument>& arguments, const Holder& holder) {
    for (const Argument& argument : arguments) {
      expression(*argument.value, holder);
      if (argument.name.symbol) locals_.push_back(argument.name.text());
    }
  }

  // Reads the names in a string, which may be a formula.
  void formula(const String& string, const Holder& holder) {
    if (!string.is_plain || string.value.empty()) return;
    constexpr std::string_view before = "_=", after = "\n;";
    const SourcePtr text = make_source("", std::string(before) + string.value + std::string(after));
    Diagnostics mistakes;
    const File read = parse(text, mistakes, Dialect::vcad);
    const bool is_formula = !mistakes.has_errors() && read.statements.size() == 1;
    const auto at = [&](size_t begin, size_t end) {
      return Span{string.span.source, static_cast<uint32_t>(string.inside().begin + begin),
                  static_cast<uint32_t>(string.inside().begin + end)};
    };
    for (size_t begin = 0; begin < string.value.size();) {
      size_t end = begin;
      while (end < string.value.size() && is_word_character(string.value[end])) ++end;
      const bool is_name = end > begin && std::isdigit(static_cast<unsigned char>(string.value[begin])) == 0;
      if (is_name) {
        const bool is_all = end - begin == string.value.size();
        mention_in_string(string.value.substr(begin, end - begin), at(begin, end), is_formula && !is_all, holder);
      }
      begin = std::max(end, begin + 1);
    }
  }

  void mention_in_string(std::string name, const Span& span, bool is_formula, const Holder& holder) {
    Mention mention;
    mention.name = std::move(name);
    mention.span = span;
    mention.item = holder.item;
    mention.argument = holder.argument;
    mention.is_bare_text = !is_formula;
    mention.is_local = std::ranges::find(locals_, mention.name) != locals_.end();
    graph_.mentions_.push_back(std::move(mention));
  }

  ScriptGraph& graph_;
  std::vector<std::string> locals_;  // parameters, and variables of loops and of let()
};

std::optional<ScriptGraph> ScriptGraph::read(const SourcePtr& source, Dialect dialect, Diagnostics& diagnostics) {
  const size_t before = diagnostics.error_count();
  ScriptGraph graph;
  graph.dialect_ = dialect;
  graph.file_ = parse(source, diagnostics, dialect);
  if (diagnostics.error_count() > before) return std::nullopt;
  GraphReader(graph).run();
  return graph;
}

size_t ScriptGraph::end_of(size_t item) const {
  size_t end = item + 1;
  while (end < items_.size() && is_within(end, item)) ++end;
  return end;
}

bool ScriptGraph::is_within(size_t item, size_t ancestor) const {
  for (std::optional<size_t> at = item; at; at = items_[*at].parent)
    if (*at == ancestor) return true;
  return false;
}

size_t ScriptGraph::statement_of(size_t item) const {
  while (items_[item].kind == GraphItem::Kind::value) item = *items_[item].parent;
  return item;
}

std::optional<size_t> ScriptGraph::find(const std::string& name, std::optional<size_t> scope) const {
  const auto found = variables_.find(name);
  if (found == variables_.end()) return std::nullopt;
  const std::vector<size_t>& same = found->second;
  for (;;) {
    const auto last = std::find_if(same.rbegin(), same.rend(), [&](size_t n) { return items_[n].parent == scope; });
    if (last != same.rend()) return *last;
    if (!scope) return std::nullopt;
    scope = items_[*scope].parent;
  }
}

}  // namespace ombre::lang

// List comprehensions.
#include <cmath>

#include "lang/engine/for_each.h"
#include "lang/engine/interpreter.h"

namespace ombre::lang {

using ast::Expr;

void Interpreter::check_count(double count, const ast::Span& where, const char* what) {
  const auto most = static_cast<double>(options_.limits.elements);
  if (count <= most) return;
  const std::string counted = count < 1e18 ? format_count(static_cast<unsigned long long>(count)) : number_text(count);
  fail(where,
       "this " + std::string(what) + " has " + counted + " elements, more than " +
           format_count(options_.limits.elements),
       "choose a larger step or a nearer end");
}

void Interpreter::generate(const Expr& expr, const ScopePtr& scope, ListBuilder& out) {
  const Level level(*this, expr.span);
  switch (expr.kind) {
    case Expr::Kind::generate_for:
      return generate_for(static_cast<const ast::GenerateFor&>(expr), 0, scope, out);
    case Expr::Kind::generate_loop:
      return generate_loop(static_cast<const ast::GenerateLoop&>(expr), scope, out);
    case Expr::Kind::generate_each:
      return generate_each(static_cast<const ast::GenerateEach&>(expr), scope, out);
    case Expr::Kind::generate_if: {
      const auto& choice = static_cast<const ast::GenerateIf&>(expr);
      if (holds(*choice.condition, scope)) return generate(*choice.element, scope, out);
      if (choice.otherwise) generate(*choice.otherwise, scope, out);
      return;
    }
    case Expr::Kind::prefix: {
      const auto& prefix = static_cast<const ast::Prefix&>(expr);
      if (prefix.which != ast::PrefixKind::let) return out.push(eval(expr, scope));
      const ScopePtr inner = make_scope(scope);
      const SpecialsMark mark(*this);
      bind_let(prefix.arguments, inner, mark.size());
      return generate(*prefix.value, inner, out);
    }
    default:
      return out.push(eval(expr, scope));
  }
}

void Interpreter::generate_for(const ast::GenerateFor& loop, size_t variable, const ScopePtr& scope, ListBuilder& out) {
  if (variable == loop.loops.size()) return generate(*loop.element, scope, out);
  const Level level(*this, loop.span);
  for_each_scope(loop.loops[variable], scope,
                 [&](const ScopePtr& inner) { generate_for(loop, variable + 1, inner, out); });
}

// Each pass has its own scope. The values of "next" are computed from the previous pass.
void Interpreter::generate_loop(const ast::GenerateLoop& loop, const ScopePtr& scope, ListBuilder& out) {
  const SpecialsMark mark(*this);
  ScopePtr pass = make_scope(scope);
  bind_let(loop.init, pass, mark.size());
  for (uint64_t count = 0; holds(*loop.condition, pass); ++count) {
    check_count(static_cast<double>(count), loop.condition->span, "loop");
    meter_.spend();
    generate(*loop.element, pass, out);
    ScopePtr next = make_scope(scope);
    for (const auto& [name, value] : pass->variables()) next->set(name, value);
    bind_let(loop.next, next, mark.size());
    pass = std::move(next);
  }
}

void Interpreter::generate_each(const ast::GenerateEach& each, const ScopePtr& scope, ListBuilder& out) {
  ListBuilder inner(meter_);
  generate(*each.element, scope, inner);
  const Value values = inner.finish();
  for (const Value& value : values.list()->items)
    for_each(value, each.element->span, "\"each\" needs a range, a list or a string",
             [&](const Value& element) { out.push(element); });
}

}  // namespace ombre::lang

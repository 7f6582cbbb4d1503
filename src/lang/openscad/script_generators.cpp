// List comprehensions.
#include "lang/openscad/loops.h"

namespace ombre::lang::openscad {

using ast::Expr;

void Evaluator::generate(const Expr& expr, const ScopePtr& scope, ListBuilder& out) {
  const Level level(*this);
  switch (expr.kind) {
    case Expr::Kind::generate_for:
      return generate_for(static_cast<const ast::GenerateFor&>(expr), 0, scope, out);
    case Expr::Kind::generate_loop:
      return generate_loop(static_cast<const ast::GenerateLoop&>(expr), scope, out);
    case Expr::Kind::generate_each:
      return generate_each(static_cast<const ast::GenerateEach&>(expr), scope, out);
    case Expr::Kind::generate_if: {
      const auto& choice = static_cast<const ast::GenerateIf&>(expr);
      if (truth(eval(*choice.condition, scope))) return generate(*choice.element, scope, out);
      if (choice.otherwise) generate(*choice.otherwise, scope, out);
      return;
    }
    case Expr::Kind::prefix: {
      const auto& prefix = static_cast<const ast::Prefix&>(expr);
      ScopePtr inner = scope;
      const SpecialsMark mark(*this);
      if (const Expr* element = enter_prefix(prefix, inner, mark.size())) return generate(*element, inner, out);
      return out.push(Value());
    }
    default:
      return out.push(eval(expr, scope));
  }
}

void Evaluator::generate_for(const ast::GenerateFor& loop, size_t variable, const ScopePtr& scope, ListBuilder& out) {
  if (variable == loop.loops.size()) return generate(*loop.element, scope, out);
  for_each_scope(loop.loops[variable], scope, loop.span,
                 [&](const ScopePtr& inner) { generate_for(loop, variable + 1, inner, out); });
}

// Each pass has its own scope. The values of "next" are computed from the previous pass.
void Evaluator::generate_loop(const ast::GenerateLoop& loop, const ScopePtr& scope, ListBuilder& out) {
  const SpecialsMark mark(*this);
  ScopePtr pass = make_scope(scope);
  bind_let(loop.init, pass, mark.size());
  for (uint64_t count = 0; truth(eval(*loop.condition, pass)); ++count) {
    if (count >= static_cast<uint64_t>(most_range_elements)) stop("For loop counter exceeded limit", loop.span);
    meter_.spend();
    generate(*loop.element, pass, out);
    ScopePtr next = make_scope(scope);
    for (const auto& [name, value] : pass->variables()) next->set(name, value);
    bind_let(loop.next, next, mark.size());
    pass = std::move(next);
  }
}

void Evaluator::generate_each(const ast::GenerateEach& each, const ScopePtr& scope, ListBuilder& out) {
  ListBuilder inner(meter_);
  generate(*each.element, scope, inner);
  const Value values = inner.finish();
  for (const Value& value : values.list()->items)
    for_each(value, each.span, [&](const Value& element) { out.push(element); });
}

}  // namespace ombre::lang::openscad

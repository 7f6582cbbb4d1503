// Any bytes are an expression: it parses or says where it is wrong, prints stably, lowers and has a value.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "expr/expression.h"
#include "fuzz/checks.h"
#include "program/evaluate.h"

namespace {

using namespace ombre;

constexpr size_t longest = 4096;  // longer ones only take longer

using fuzz::require;

void check_places(const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    const SourceRange& where = diagnostic.where;
    require(!where.source || (where.begin <= where.end && where.end <= where.source->text().size()));
  }
  (void)to_text(diagnostics);
}

SourceRange place_of(const std::string& text) {
  const std::string before = "sphere(\"";
  const auto begin = static_cast<uint32_t>(before.size());
  return {make_source("fuzz.vcad", before + text + "\");"), begin, begin + static_cast<uint32_t>(text.size())};
}

std::optional<expr::Expression> parse(const std::string& text) {
  Diagnostics diagnostics;
  auto expression = expr::Expression::parse(text, place_of(text), diagnostics);
  require(expression.has_value() == !diagnostics.has_errors());
  check_places(diagnostics);
  return expression;
}

double value(const expr::Expression& expression, Vec3 p) {
  program::Builder builder;
  const program::Point frame = program::Point::origin_frame(builder);
  const auto distance = [&](std::string_view name) -> std::optional<program::Field> {
    if (name != "d") return std::nullopt;
    return frame.x - 1.0;
  };
  const program::Field field = expression.lower(frame, distance);
  const program::Program program = builder.finish({{"value", field}});
  std::vector<double> values;
  program::evaluate_point(program, p, values);
  return values[program.outputs[0]];
}

bool same_bits(double a, double b) { return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size > longest) return 0;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto expression = parse(text);
  if (!expression) return 0;
  const auto reread = parse(expression->text());
  require(reread && reread->text() == expression->text());
  (void)expression->constant_value();

  std::vector<std::string> known = expr::coordinate_names();
  known.emplace_back("d");
  Diagnostics diagnostics;
  const bool all_known = expression->check_variables(known, text, place_of(text), diagnostics);
  check_places(diagnostics);
  require(all_known == !diagnostics.has_errors());
  if (!all_known) return 0;
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, -2, 0.5}, Vec3{-1e300, 1e-300, 3}})
    require(same_bits(value(*expression, p), value(*reread, p)));
  return 0;
}

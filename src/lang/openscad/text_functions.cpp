// Functions that measure texts and fonts. OpenSCAD 2021.01 does not have them.
#include <algorithm>
#include <span>

#include "lang/openscad/script_functions.h"
#include "lang/openscad/text_parameters.h"
#include "solids/texts.h"

namespace ombre::lang::openscad {
namespace {

// The arguments of a call by name: first those that may be positional, then the others.
class NamedArguments {
 public:
  NamedArguments(const FunctionCall& call, std::span<const std::string_view> positional,
                 std::span<const std::string_view> named)
      : call_(call) {
    size_t position = 0;
    for (size_t n = 0; n < call.size(); ++n) {
      const Symbol symbol = call.written.arguments[n].name.symbol;
      if (!symbol && position == positional.size()) {
        call.fail("Too many unnamed arguments supplied");
        return;
      }
      const std::string_view name = symbol ? std::string_view(*symbol) : positional[position++];
      const auto is_one_of = [&](const auto& names) { return std::ranges::find(names, name) != names.end(); };
      if (!is_one_of(positional) && !is_one_of(named) && !name.starts_with('$'))
        call.fail("variable " + std::string(name) + " not specified as parameter");
      values_.emplace_back(name, n);
    }
  }

  double number(std::string_view name, double otherwise) const {
    const Value* value = find(name);
    return value && value->number() ? *value->number() : otherwise;
  }
  std::string text(std::string_view name, const std::string& otherwise = "") const {
    const Value* value = find(name);
    return value && value->text() ? value->text()->text : otherwise;
  }
  const std::vector<std::string>& font_files() const { return call_.files.fonts; }

 private:
  const Value* find(std::string_view name) const {
    for (const auto& [known, n] : values_)
      if (known == name) return &call_[n];
    return nullptr;
  }

  const FunctionCall& call_;
  std::vector<std::pair<std::string_view, size_t>> values_;
};

constexpr std::array<std::string_view, 3> text_names{"text", "size", "font"};
constexpr std::array<std::string_view, 6> other_text_names{"direction", "language", "script",
                                                           "halign",    "valign",   "spacing"};

// Returns undef, and says what is wrong.
Value reported(const FunctionCall& call, const Diagnostics& found) {
  for (const Diagnostic& diagnostic : found.list()) call.fail(sentence_of(diagnostic));
  return {};
}

Value pair_of(const FunctionCall& call, Vec2 v) { return make_list({v.x, v.y}, call.meter); }

Value textmetrics(const FunctionCall& call) {
  Diagnostics found;
  const auto measures = solids::measures_of(text_of(NamedArguments(call, text_names, other_text_names)), {}, found);
  if (!measures) return reported(call, found);
  RecordBuilder result(call.meter);
  result.set("position", pair_of(call, measures->low));
  result.set("size", pair_of(call, measures->high - measures->low));
  result.set("ascent", measures->ascent);
  result.set("descent", measures->descent);
  result.set("offset", pair_of(call, measures->offset));
  result.set("advance", pair_of(call, measures->advance));
  return result.finish();
}

Value heights(const FunctionCall& call, double ascent, double descent) {
  RecordBuilder result(call.meter);
  result.set("ascent", ascent);
  result.set("descent", descent);
  return result.finish();
}

Value fontmetrics(const FunctionCall& call) {
  Diagnostics found;
  const auto measures =
      solids::font_measures_of(text_of(NamedArguments(call, std::span(text_names).subspan(1), {})), {}, found);
  if (!measures) return reported(call, found);
  RecordBuilder font(call.meter);
  font.set("family", make_text(measures->family, call.meter));
  font.set("style", make_text(measures->style, call.meter));
  RecordBuilder result(call.meter);
  result.set("nominal", heights(call, measures->ascent, measures->descent));
  result.set("max", heights(call, measures->highest, measures->lowest));
  result.set("interline", measures->line_height);
  result.set("font", font.finish());
  return result.finish();
}

}  // namespace

std::vector<NamedFunction> text_functions() { return {{"textmetrics", textmetrics}, {"fontmetrics", fontmetrics}}; }

}  // namespace ombre::lang::openscad

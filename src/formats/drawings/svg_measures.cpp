#include "formats/drawings/svg_measures.h"

#ifdef OMBRE_3MF

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/drawings/svg_page.h"

namespace ombre::formats {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

std::string_view svg_attribute(pugi::xml_node node, const char* name) { return trim(node.attribute(name).value()); }

std::string_view svg_value(const SvgValues& values, std::string_view name) {
  const auto found = values.find(name);
  return found == values.end() ? std::string_view() : found->second;
}

double SvgMeasures::length(pugi::xml_node node, std::string_view text, double whole, double otherwise) const {
  if (text.empty() || text == "auto" || text == "inherit") return otherwise;
  const auto length = read_svg_length(text);
  if (length && (length->unit.empty() || length->unit == "px")) return length->number;
  if (length && length->unit == "%") {
    if (whole > 0) return length->number / 100 * whole;
    file_.fail_at(node, quoted(text) + " has no length, since the drawing has no size",
                  "give <svg> a viewBox or a width and a height");
  }
  const auto unit = length ? millimetres_of_unit(length->unit) : std::nullopt;
  if (!unit) file_.fail_at(node, "expected a length, found " + quoted(text), "write for example 12.5 or 3mm");
  return length->number * *unit / unit_mm_;
}

double diagonal_of(const Vec2& view) { return std::sqrt((view.x * view.x + view.y * view.y) / 2); }

}  // namespace ombre::formats

#endif

#include "jobs/picture/picture_request.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"

namespace ombre::compile {
namespace {

std::optional<CutSide> parse_side(std::string_view text) {
  const size_t sign = text.find_first_of("=<>");
  if (sign == std::string_view::npos) return std::nullopt;
  const std::string_view axis = trim(text.substr(0, sign));
  const std::optional<double> mm = parse_number(trim(text.substr(sign + 1)));
  if (axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z' || !mm || !std::isfinite(*mm)) return std::nullopt;
  return CutSide{axis[0] - 'x', text[sign], *mm};
}

}  // namespace

std::optional<CutRequest> parse_cut(std::string_view text) {
  CutRequest cut;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    const auto side = parse_side(text.substr(begin, comma - begin));
    if (!side) return std::nullopt;
    if (std::ranges::find(cut, side->axis, &CutSide::axis) != cut.end()) return std::nullopt;
    cut.push_back(*side);
    begin = comma + 1;
  }
  return cut;
}

std::optional<SliceView> parse_slice(std::string_view text) {
  const auto plane = parse_side(text);
  if (!plane || plane->removed != '=') return std::nullopt;
  return SliceView{plane->axis, plane->mm};
}

}  // namespace ombre::compile

// Reads lengths and viewports of SVG.
#include "formats/drawings/svg_page.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/math/math.h"
#include "base/text/text.h"
#include "formats/drawings/svg_path.h"

namespace ombre::formats {
namespace {

constexpr double inch = 25.4;

// Returns the map of one transform, or null if it is invalid.
std::optional<PlaneMap> map_of(std::string_view name, const std::vector<double>& v) {
  const auto number = [&](size_t n, double otherwise) { return n < v.size() ? v[n] : otherwise; };
  if (name == "matrix" && v.size() == 6) return PlaneMap{v[0], v[1], v[2], v[3], v[4], v[5]};
  if (v.empty()) return std::nullopt;
  if (name == "translate") return PlaneMap{1, 0, 0, 1, v[0], number(1, 0)};
  if (name == "translateX") return PlaneMap{1, 0, 0, 1, v[0], 0};
  if (name == "translateY") return PlaneMap{1, 0, 0, 1, 0, v[0]};
  if (name == "scale") return PlaneMap{v[0], 0, 0, number(1, v[0]), 0, 0};
  const double angle = v[0] * math::degree;
  if (name == "skewX") return PlaneMap{1, 0, std::tan(angle), 1, 0, 0};
  if (name == "skewY") return PlaneMap{1, std::tan(angle), 0, 1, 0, 0};
  if (name != "rotate") return std::nullopt;
  const double c = math::cos(angle), s = math::sin(angle), x = number(1, 0), y = number(2, 0);
  return PlaneMap{1, 0, 0, 1, x, y} * PlaneMap{c, s, -s, c, 0, 0} * PlaneMap{1, 0, 0, 1, -x, -y};
}

// Reads the arguments of a transform, where CSS may write px and deg. Returns none if something else is there.
std::vector<double> arguments_of(std::string_view text) {
  std::vector<double> numbers;
  while (!(text = trim(text)).empty()) {
    const std::vector<double> next = read_svg_numbers(text, 1);
    if (next.empty() || numbers.size() == 6) return {};
    numbers.push_back(next[0]);
    for (const std::string_view unit : {"px", "deg"})
      if (text.starts_with(unit)) text.remove_prefix(unit.size());
  }
  return numbers;
}

// Returns the share of the free length that lies before the box: 0, 0.5 or 1; -1 if the word is no alignment.
double share_of(std::string_view word) {
  if (word == "Min") return 0;
  if (word == "Mid") return 0.5;
  return word == "Max" ? 1 : -1;
}

}  // namespace

std::optional<SvgLength> read_svg_length(std::string_view text) {
  const std::vector<double> numbers = read_svg_numbers(text, 1);
  if (numbers.empty()) return std::nullopt;
  return SvgLength{numbers[0], trim(text)};
}

std::optional<double> millimetres_of_unit(std::string_view unit) {
  constexpr std::array<std::pair<std::string_view, double>, 6> units{
      {{"mm", 1}, {"cm", 10}, {"Q", 0.25}, {"in", inch}, {"pt", inch / 72}, {"pc", inch / 6}}};
  for (const auto& [name, size] : units)
    if (name == unit) return size;
  return std::nullopt;
}

std::optional<SvgBox> read_svg_box(std::string_view text) {
  const std::vector<double> v = read_svg_numbers(text, 4);
  if (v.size() < 4 || !(v[2] > 0) || !(v[3] > 0)) return std::nullopt;
  return SvgBox{{v[0], v[1]}, {v[2], v[3]}};
}

std::optional<PlaneMap> fit_svg_box(const SvgBox& box, const SvgBox& viewport, std::string_view aspect) {
  double sx = viewport.size.x / box.size.x, sy = viewport.size.y / box.size.y;
  std::vector<std::string> words;
  for (std::string& word : split(aspect, ' '))
    if (!word.empty() && word != "defer") words.push_back(std::move(word));
  std::string align = words.empty() ? "xMidYMid" : words[0];
  Vec2 share;
  if (align != "none") {
    if (align.size() != 8 || align[0] != 'x' || align[4] != 'Y') return std::nullopt;
    share = {share_of(align.substr(1, 3)), share_of(align.substr(5))};
    const bool is_slice = words.size() > 1 && words[1] == "slice";
    const bool is_known = is_slice || words.size() < 2 || words[1] == "meet";
    if (share.x < 0 || share.y < 0 || !is_known) return std::nullopt;
    sx = sy = is_slice ? std::max(sx, sy) : std::min(sx, sy);
  }
  const Vec2 free{viewport.size.x - sx * box.size.x, viewport.size.y - sy * box.size.y};
  return PlaneMap{sx,
                  0,
                  0,
                  sy,
                  viewport.corner.x - sx * box.corner.x + share.x * free.x,
                  viewport.corner.y - sy * box.corner.y + share.y * free.y};
}

std::optional<PlaneMap> read_svg_transform(std::string_view text, std::string& wrong) {
  PlaneMap map;
  for (;;) {
    const size_t begin = text.find_first_not_of(", \t\r\n");
    if (begin == std::string_view::npos) return map;
    text.remove_prefix(begin);
    const size_t open = text.find('('), close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return std::nullopt;
    const std::string_view name = trim(text.substr(0, open));
    const auto next = map_of(name, arguments_of(text.substr(open + 1, close - open - 1)));
    if (!next) {
      wrong = name;
      return std::nullopt;
    }
    map = map * *next;
    text.remove_prefix(close + 1);
  }
}

}  // namespace ombre::formats

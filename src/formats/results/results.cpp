#include "formats/results/results.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"

namespace ombre::formats {

void Results::add_element(ElementKind kind, const uint32_t* first_node) {
  kinds.push_back(kind);
  first.push_back(nodes.size());
  nodes.insert(nodes.end(), first_node, first_node + node_count(kind));
  if (kind != ElementKind::wedge6) return;
  uint32_t* const own = nodes.data() + first.back();
  const Vec3 a = points[own[0]];
  const bool is_upside_down = dot(cross(points[own[1]] - a, points[own[2]] - a), points[own[3]] - a) < 0;
  if (is_upside_down) std::swap_ranges(own, own + 3, own + 3);
}

void leave_out(Results& results, const std::string& file, uint64_t count, const std::string& what,
               Diagnostics& diagnostics) {
  if (count == 0) return;
  results.left_out.push_back({what, count});
  diagnostics.warning({make_source(file, ""), 0, 0}, format_count(count) + ' ' + what + " are left out");
}

void set_name(ResultField& field, std::string_view text) {
  const size_t open = text.rfind('[');
  const bool has_unit = open != std::string_view::npos && open > 0 && text.back() == ']';
  field.name = trim(has_unit ? text.substr(0, open) : text);
  field.unit = has_unit ? std::string(text.substr(open + 1, text.size() - open - 2)) : std::string();
}

std::string folded_field_name(std::string_view name) {
  std::string folded;
  for (const char c : to_lower(name))
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) folded += c;
  return folded;
}

const ResultField* find_field(const Results& results, std::string_view name) {
  const std::string wanted = folded_field_name(name);
  const ResultField* found = nullptr;
  size_t count = 0;
  for (const ResultField& field : results.fields) {
    const std::string folded = folded_field_name(field.name);
    if (folded == wanted) return &field;
    if (wanted.empty() || !folded.starts_with(wanted)) continue;
    found = &field;
    ++count;
  }
  return count == 1 ? found : nullptr;
}

bool deform(Results& results, double factor) {
  const ResultField* moves = find_field(results, "displacement");
  if (!moves || moves->components != 3 || moves->is_of_elements) return false;
  for (size_t n = 0; n < results.points.size(); ++n) {
    const double* const move = &moves->values[3 * n];
    const Vec3 moved = results.points[n] + factor * Vec3{move[0], move[1], move[2]};
    if (!is_finite(moved)) return false;
    results.points[n] = moved;
  }
  return true;
}

double von_mises(const double* t) {
  const double a = t[0] - t[1], b = t[1] - t[2], c = t[2] - t[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]));
}

}  // namespace ombre::formats

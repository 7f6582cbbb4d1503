#include "formats/results.h"

#include <cmath>
#include <set>

#include "base/text.h"
#include "formats/results_readers.h"
#include "formats/text_scanner.h"

namespace ombre::formats {
namespace {

// The second field of a name gets a number.
void make_names_unique(std::vector<ResultField>& fields) {
  std::set<std::string> taken;
  for (ResultField& field : fields) {
    const std::string name = field.name;
    for (int n = 2; !taken.insert(folded_field_name(field.name)).second; ++n)
      field.name = name + " " + std::to_string(n);
  }
}

// Von Mises' stress of stresses, where the file has none.
void add_von_mises(Results& results) {
  if (find_field(results, "von_mises")) return;
  const ResultField* stress = find_field(results, "stress");
  if (!stress) stress = find_field(results, "S");
  if (!stress || stress->components != 6) return;
  ResultField added{"von Mises stress", stress->unit, 1, stress->is_of_elements, {}};
  for (size_t n = 0; n + 6 <= stress->values.size(); n += 6) added.values.push_back(von_mises(&stress->values[n]));
  results.fields.push_back(std::move(added));
}

// Nodes and elements that the file names after a field have no value there.
void fill_up_fields(Results& results) {
  for (ResultField& field : results.fields) {
    const size_t count = field.is_of_elements ? results.kinds.size() : results.points.size();
    field.values.resize(count * field.components, std::nan(""));
  }
}

Results read_any(const std::string& name, std::string_view bytes, const std::optional<ResultsFile>& values,
                 Diagnostics& diagnostics) {
  const std::string_view text = trim(bytes.substr(0, std::min<size_t>(bytes.size(), 4096)));
  const bool is_deck = text.starts_with('*');
  if (text.starts_with('<') && text.find("<Xdmf") != std::string_view::npos)
    return read_xdmf(name, bytes, values, diagnostics);
  if (values && !is_deck)
    fail(diagnostics, name, "a table of values belongs to a mesh in an .inp file", "leave \"values\" out");
  if (text.starts_with('<')) return read_vtu(name, bytes, diagnostics);
  if (text.starts_with("1C")) return read_frd(name, bytes, diagnostics);
  if (!is_deck) return read_csv_points(name, bytes, diagnostics);
  NumberedResults mesh = read_inp(name, bytes, diagnostics);
  if (mesh.results.kinds.empty()) fail(diagnostics, name, "the deck has no solid elements");
  if (values) add_csv_values(values->name, values->bytes, mesh, diagnostics);
  return std::move(mesh.results);
}

}  // namespace

void Results::add_element(ElementKind kind, const uint32_t* first_node) {
  kinds.push_back(kind);
  first.push_back(nodes.size());
  nodes.insert(nodes.end(), first_node, first_node + node_count(kind));
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

std::optional<Results> read_results(const std::string& name, std::string_view bytes,
                                    const std::optional<ResultsFile>& values, Diagnostics& diagnostics) {
  try {
    Results results = read_any(name, bytes, values, diagnostics);
    if (results.points.empty()) fail(diagnostics, name, "the file holds no points");
    fill_up_fields(results);
    make_names_unique(results.fields);
    add_von_mises(results);
    return results;
  } catch (const DesignError&) {
    return std::nullopt;
  }
}

}  // namespace ombre::formats

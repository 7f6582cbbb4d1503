// Reads results of simulations by the content of their files.
#include <algorithm>
#include <cmath>
#include <set>

#include "base/text/text.h"
#include "formats/containers/file_kinds.h"
#include "formats/containers/text_scanner.h"
#include "formats/results/result_formats.h"

namespace ombre::formats {
namespace {

// Appends a number to the second and further fields of a name.
void make_names_unique(std::vector<ResultField>& fields) {
  std::set<std::string> taken;
  for (ResultField& field : fields) {
    const std::string name = field.name;
    for (int n = 2; !taken.insert(folded_field_name(field.name)).second; ++n)
      field.name = name + " " + std::to_string(n);
  }
}

// Adds the von Mises stress of stresses, if the file has none.
void add_von_mises(Results& results) {
  if (find_field(results, "von_mises")) return;
  const ResultField* stress = find_field(results, "stress");
  if (!stress) stress = find_field(results, "S");
  if (!stress || stress->components != 6) return;
  ResultField added{"von Mises stress", stress->unit, 1, stress->is_of_elements, {}, stress->step};
  for (size_t n = 0; n + 6 <= stress->values.size(); n += 6) added.values.push_back(von_mises(&stress->values[n]));
  results.fields.push_back(std::move(added));
}

// Fills up fields: nodes and elements that the file lists after a field have no value in it.
void fill_up_fields(Results& results) {
  for (ResultField& field : results.fields) {
    const size_t count = field.is_of_elements ? results.kinds.size() : results.points.size();
    field.values.resize(count * field.components, std::nan(""));
  }
}

Results read_any(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                 Diagnostics& diagnostics) {
  if (const auto foreign = foreign_file(bytes)) fail(diagnostics, name, "this is " + foreign->what, foreign->hint);
  const std::string_view text = trim(without_byte_order_mark(bytes).substr(0, 4096));
  const auto rows = result_formats();
  const auto found = std::ranges::find_if(rows, [&](const ResultFormat& row) { return row.recognises(text); });
  return found->read(name, bytes, beside, diagnostics);
}

}  // namespace

std::optional<Results> read_results(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                                    Diagnostics& diagnostics) {
  try {
    Results results = read_any(name, bytes, beside, diagnostics);
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

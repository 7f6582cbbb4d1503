// Reads tables of results (.csv) with a line for each node, element or point.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/mesh.h"
#include "formats/results/results_readers.h"

namespace ombre::formats {
namespace {

struct CsvTable {
  std::vector<std::string> names;  // names of columns
  bool has_names = false;          // true if the file has names
  std::vector<std::vector<double>> rows;
  std::vector<std::pair<size_t, size_t>> places;  // by row: its bytes in the file
};

class CsvReader {
 public:
  CsvReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : scanner_(name, bytes, diagnostics), bytes_(bytes) {}

  CsvTable run() {
    for (size_t begin = bytes_.size() - without_byte_order_mark(bytes_).size(); begin < bytes_.size();) {
      const size_t end = std::min(bytes_.find_first_of("\r\n", begin), bytes_.size());
      const std::string_view line = trim(bytes_.substr(begin, end - begin));
      if (!line.empty() && line.front() != '#') take(line, begin, end);
      begin = end + 1;
    }
    if (table_.rows.empty()) scanner_.fail_at(0, 0, "the table holds no numbers");
    leave_out_words();
    return std::move(table_);
  }

 private:
  void take(std::string_view line, size_t begin, size_t end) {
    if (table_.names.empty() && tells_separator(line)) return;
    if (table_.names.empty()) separator_ = separator_of(line);
    std::vector<std::string> words;
    for (const std::string& word : split(std::string(line), separator_)) words.emplace_back(unquoted(trim(word)));
    if (table_.names.empty()) {
      table_.has_names = !number_in(words.front());
      is_of_words_.assign(words.size(), false);
      for (size_t n = 0; n < words.size(); ++n)
        table_.names.push_back(table_.has_names ? words[n] : "column " + std::to_string(n + 1));
      if (table_.has_names) return;
    }
    if (words.size() != table_.names.size())
      scanner_.fail_at(begin, end,
                       "this line has " + std::to_string(words.size()) + " values, the first has " +
                           std::to_string(table_.names.size()));
    std::vector<double> row;
    for (size_t n = 0; n < words.size(); ++n) {
      const auto value = number_in(words[n]);
      if (table_.rows.empty()) is_of_words_[n] = !value;
      if (!value && !is_of_words_[n])
        scanner_.fail_at(begin, end,
                         words[n].empty() ? "the column " + formats::quoted(table_.names[n]) + " has no number here"
                                          : formats::quoted(words[n]) + " is no number");
      if (value && is_of_words_[n])
        scanner_.fail_at(begin, end,
                         "the column " + formats::quoted(table_.names[n]) + " has words, and here a number");
      row.push_back(value.value_or(0));
    }
    table_.rows.push_back(std::move(row));
    table_.places.emplace_back(begin, end);
  }

  // Excel's first line may say "sep=;", which the next line shows as well.
  static bool tells_separator(std::string_view line) { return line.size() == 5 && to_lower(line).starts_with("sep="); }

  static char separator_of(std::string_view line) {
    for (const char separator : {';', '\t'})
      if (line.find(separator) != std::string_view::npos) return separator;
    return ',';
  }

  // Where commas do not separate, they are decimal.
  std::optional<double> number_in(std::string word) const {
    if (separator_ != ',') std::ranges::replace(word, ',', '.');
    return parse_number(word);
  }

  // Columns of words cannot be asked for.
  void leave_out_words() {
    const auto erase = [&](auto& list) {
      size_t n = 0;
      std::erase_if(list, [&](const auto&) { return is_of_words_[n++]; });
    };
    erase(table_.names);
    for (std::vector<double>& row : table_.rows) erase(row);
  }

  static std::string_view unquoted(std::string_view word) {
    if (word.size() >= 2 && word.front() == '"' && word.back() == '"') word = word.substr(1, word.size() - 2);
    return trim(word);
  }

  TextScanner scanner_;
  std::string_view bytes_;
  char separator_ = ',';
  std::vector<bool> is_of_words_;  // by column: true if its first row has no number
  CsvTable table_;
};

// Columns that belong together by the endings of their names, in our order of components.
struct ColumnGroup {
  std::string name;
  std::vector<size_t> columns;
};
using Ends = std::vector<std::string_view>;

// Returns the common beginning of the names of columns from `first` on that have these endings in this order; empty if
// they do not.
std::string common_stem(const std::vector<std::string>& names, size_t first, const Ends& ends) {
  std::string stem;
  for (size_t n = 0; n < ends.size(); ++n) {
    if (first + n >= names.size()) return "";
    const std::string name = to_lower(names[first + n]);
    if (!name.ends_with(ends[n]) || name.size() == ends[n].size()) return "";
    const std::string own = names[first + n].substr(0, name.size() - ends[n].size());
    if (n > 0 && own != stem) return "";
    stem = own;
  }
  while (!stem.empty() && std::string_view("._-: ").find(stem.back()) != std::string_view::npos) stem.pop_back();
  return stem;
}

std::string group_name(const std::string& stem) {
  const std::string small = to_lower(stem);
  if (small == "d" || small == "u" || small == "disp") return "displacement";
  return small == "s" ? "stress" : small == "e" ? "strain" : stem;
}

std::vector<ColumnGroup> groups_of(const std::vector<std::string>& names, size_t first) {
  struct Pattern {
    Ends ends;
    std::vector<size_t> order;
  };
  static const std::vector<Pattern> patterns{{{"xx", "yy", "zz", "xy", "yz", "zx"}, {0, 1, 2, 3, 4, 5}},
                                             {{"xx", "yy", "zz", "xy", "xz", "yz"}, {0, 1, 2, 3, 5, 4}},
                                             {{"11", "22", "33", "12", "13", "23"}, {0, 1, 2, 3, 5, 4}},
                                             {{":0", ":1", ":2", ":3", ":4", ":5"}, {0, 1, 2, 3, 4, 5}},
                                             {{":0", ":1", ":2"}, {0, 1, 2}},
                                             {{"_0", "_1", "_2", "_3", "_4", "_5"}, {0, 1, 2, 3, 4, 5}},
                                             {{"_0", "_1", "_2"}, {0, 1, 2}},
                                             {{"x", "y", "z"}, {0, 1, 2}},
                                             {{"1", "2", "3"}, {0, 1, 2}}};
  std::vector<ColumnGroup> groups;
  for (size_t at = first; at < names.size();) {
    ColumnGroup group{names[at], {at}};
    for (const Pattern& pattern : patterns) {
      const std::string stem = common_stem(names, at, pattern.ends);
      if (stem.empty()) continue;
      group = {group_name(stem), {}};
      for (const size_t n : pattern.order) group.columns.push_back(at + n);
      break;
    }
    at += group.columns.size();
    groups.push_back(std::move(group));
  }
  return groups;
}

// Adds fields: row n of the table belongs to places[n] of `count`; the others have no value.
void add_fields(const CsvTable& table, size_t first_column, const std::vector<uint32_t>& places, size_t count,
                bool is_of_elements, Results& results) {
  for (const ColumnGroup& group : groups_of(table.names, first_column)) {
    ResultField field;
    set_name(field, group.name);
    field.components = group.columns.size();
    field.is_of_elements = is_of_elements;
    field.values.assign(count * field.components, std::nan(""));
    for (size_t n = 0; n < table.rows.size(); ++n)
      for (size_t c = 0; c < group.columns.size(); ++c)
        field.values[places[n] * field.components + c] = table.rows[n][group.columns[c]];
    results.fields.push_back(std::move(field));
  }
}

}  // namespace

void add_csv_values(const std::string& name, std::string_view bytes, NumberedResults& mesh, Diagnostics& diagnostics) {
  CsvTable table = CsvReader(name, bytes, diagnostics).run();
  const TextScanner scanner(name, bytes, diagnostics);
  if (table.names.size() < 2) scanner.fail_at(0, 0, "expected a column of numbers of nodes, and columns of values");
  // In a table without names, three values are a displacement.
  if (!table.has_names && table.names.size() == 4) table.names = {"node", "dx", "dy", "dz"};
  if (!table.has_names && table.names.size() == 2) table.names = {"node", "value"};
  if (mesh.is_of_several_parts)
    scanner.fail_at(0, 0, "the deck has several parts or instances, so that a number may stand for several nodes",
                    "take the results from a .vtu, .frd or .xdmf file");
  const bool is_of_elements = to_lower(table.names[0]).starts_with("el");
  const auto& known = is_of_elements ? mesh.element_places : mesh.node_places;
  const std::string what = is_of_elements ? "element" : "node";
  std::vector<uint32_t> places;
  std::vector<bool> is_given(is_of_elements ? mesh.results.kinds.size() : mesh.results.points.size(), false);
  for (size_t n = 0; n < table.rows.size(); ++n) {
    const auto [begin, end] = table.places[n];
    const double number = table.rows[n][0];
    const bool is_number = number >= 0 && number < 1e15 && number == std::floor(number);
    const auto found = is_number ? known.find(static_cast<uint64_t>(number)) : known.end();
    if (found == known.end()) scanner.fail_at(begin, end, "the mesh has no " + what + " " + format_number(number));
    if (is_given[found->second]) scanner.fail_at(begin, end, what + " " + format_number(number) + " comes twice");
    is_given[found->second] = true;
    places.push_back(found->second);
  }
  add_fields(table, 1, places, is_given.size(), is_of_elements, mesh.results);
  if (is_of_elements) return;
  for (ResultField& field : mesh.results.fields)
    for (const auto& [to, from] : mesh.copies)
      std::copy_n(field.values.begin() + static_cast<ptrdiff_t>(from * field.components), field.components,
                  field.values.begin() + static_cast<ptrdiff_t>(to * field.components));
}

namespace {

// The names of the columns of coordinates: ParaView names them Points:0 to Points:2 or Points_0 to Points_2.
constexpr std::array<std::array<std::string_view, 3>, 3> names_of_points{
    {{"points:0", "points:1", "points:2"}, {"points_0", "points_1", "points_2"}, {"x", "y", "z"}}};

// Moves the columns of coordinates to the front, if all three are there.
void put_points_first(CsvTable& table) {
  for (const auto& names : names_of_points) {
    const auto place_of = [&](std::string_view name) {
      return std::ranges::find_if(table.names, [&](const std::string& own) { return to_lower(own) == name; });
    };
    if (std::ranges::any_of(names, [&](std::string_view name) { return place_of(name) == table.names.end(); }))
      continue;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto place = place_of(names[axis]) - table.names.begin();
      const auto move = [&](auto& list) {
        const auto to = list.begin() + static_cast<ptrdiff_t>(axis);
        if (list.begin() + place > to) std::rotate(to, list.begin() + place, list.begin() + place + 1);
      };
      move(table.names);
      for (std::vector<double>& row : table.rows) move(row);
      table.names[axis] = std::string(1, "xyz"[axis]);
    }
    return;
  }
}

}  // namespace

Results read_csv_points(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  CsvTable table = CsvReader(name, bytes, diagnostics).run();
  const TextScanner scanner(name, bytes, diagnostics);
  put_points_first(table);
  if (table.names.size() < 4) scanner.fail_at(0, 0, "expected the columns x, y and z, and columns of values");
  for (size_t axis = 0; axis < 3 && table.has_names; ++axis)
    if (to_lower(table.names[axis]).substr(0, 1) != std::string(1, "xyz"[axis]))
      scanner.fail_at(0, 0, "expected columns x, y and z, found " + formats::quoted(table.names[axis]),
                      "numbers of nodes need the mesh as well: results(\"mesh.inp\", values=\"" + name + "\")");
  if (!table.has_names && table.names.size() == 4) table.names[3] = "value";
  Results results;
  std::vector<uint32_t> places;
  for (size_t n = 0; n < table.rows.size(); ++n) {
    results.points.push_back({table.rows[n][0], table.rows[n][1], table.rows[n][2]});
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(results.points.back()[axis]) > greatest_coordinate)
        scanner.fail_at(table.places[n].first, table.places[n].second, "a coordinate is beyond 1e15");
    places.push_back(static_cast<uint32_t>(n));
  }
  add_fields(table, 3, places, places.size(), false, results);
  return results;
}

}  // namespace ombre::formats

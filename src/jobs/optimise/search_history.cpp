// The designs that a search has measured.
#include "jobs/optimise/search_history.h"

#include <limits>

#include "base/text/text.h"

namespace ombre::compile {
namespace {

// Returns a text for a table, in quotes if it has commas or quotes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : c == '\n' || c == '\r' ? " " : std::string(1, c);
  return result + "\"";
}

Data number_list(const std::vector<double>& values) { return DataList(values.begin(), values.end()); }

// Returns nothing unless the data is a list of `count` numbers. What is not a number was written as null.
std::optional<std::vector<double>> numbers(const Data* data, size_t count) {
  if (!data || !data->list() || data->list()->size() != count) return std::nullopt;
  std::vector<double> values;
  for (const Data& element : *data->list()) {
    if (!element.number() && !element.is_null()) return std::nullopt;
    values.push_back(element.number() ? *element.number() : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

}  // namespace

std::optional<History::Row> measured_design(const stores::Entry& entry, const OptimiseStudy& study) {
  const Data record(entry.record);
  const auto values = numbers(record.find("values"), study.variables.size());
  if (!values || entry.id < 1 || !entry.files.empty()) return std::nullopt;
  History::Row row{entry.id, *values, {}};
  if (const Data* failure = record.find("failure")) {
    if (!failure->string() || failure->string()->empty()) return std::nullopt;
    row.measured.failure = *failure->string();
    return row;
  }
  const auto measures = numbers(record.find("measures"), study.measures().size());
  if (!measures) return std::nullopt;
  row.measured.values = *measures;
  return row;
}

void History::read(const stores::Entries& finished) {
  for (const auto& [number, entry] : finished) {
    Row row = *measured_design(entry, study_);
    numbers_.emplace(row.values, number);
    rows_.emplace(number, std::move(row));
  }
}

const History::Row* History::find(const std::vector<double>& values) const {
  const auto found = numbers_.find(values);
  return found == numbers_.end() ? nullptr : &rows_.at(found->second);
}

const History::Row& History::add(std::vector<double> values, Measured measured) {
  while (rows_.contains(free_)) ++free_;
  numbers_.emplace(values, free_);
  return rows_.emplace(free_, Row{free_, std::move(values), std::move(measured)}).first->second;
}

std::vector<const History::Row*> History::rows() const {
  std::vector<const Row*> rows;
  for (const auto& [number, row] : rows_) rows.push_back(&row);
  return rows;
}

stores::Piece History::piece(const Row& row) {
  const bool failed = !row.measured.failure.empty();
  return {row.number,
          {},
          {{"values", number_list(row.values)},
           failed ? std::pair<std::string, Data>("failure", row.measured.failure)
                  : std::pair<std::string, Data>("measures", number_list(row.measured.values))}};
}

std::string History::header() const {
  std::vector<std::string> names{"design"};
  for (const DesignVariable& variable : study_.variables) names.push_back(quoted(variable.name));
  for (const Measure& measure : study_.measures()) names.push_back(quoted(measure.label()));
  names.emplace_back("failure");
  return join(names, ",") + "\n";
}

std::string History::line(const Row& row) const {
  std::vector<std::string> cells{std::to_string(row.number)};
  for (const double value : row.values) cells.push_back(format_number(value));
  const bool failed = !row.measured.failure.empty();
  for (size_t n = 0; n < study_.measures().size(); ++n)
    cells.push_back(failed ? "" : format_number(row.measured.values[n]));
  cells.push_back(failed ? quoted(row.measured.failure) : "");
  return join(cells, ",") + "\n";
}

std::string History::table() const {
  std::string text = header();
  for (const auto& [number, row] : rows_) text += line(row);
  return text;
}

}  // namespace ombre::compile

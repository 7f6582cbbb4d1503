#include "nodes/common/number_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/key_place.h"
#include "base/math/monotone_cubic.h"
#include "base/system/assert.h"
#include "base/text/text.h"

namespace ombre::nodes {
namespace {

class Table final : public program::FieldSource {
 public:
  Table(TableKeys keys, TableMode mode) : keys_(std::move(keys)), mode_(mode) {
    std::string bytes = "table " + std::to_string(static_cast<int>(mode)) + " " + std::to_string(keys_.axes.size());
    const auto add = [&](const std::vector<double>& list) {
      bytes += " " + std::to_string(list.size()) + " ";
      bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(double));
    };
    for (const auto& axis : keys_.axes) add(axis);
    for (const auto& values : keys_.values) {
      add(values);
      if (mode == TableMode::cubic) slopes_.push_back(monotone_slopes(keys_.axes[0], values));
    }
    content_ = hash_bytes(bytes);
  }

  std::string name() const override { return "table"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override {
    for (size_t n = 0; n < keys_.values.size(); ++n)
      if (channel_name == std::to_string(n)) return static_cast<int>(n);
    return -1;
  }

  double sample(int channel, Vec3 p) const override {
    std::array<KeyPlace, 3> at;
    for (size_t axis = 0; axis < keys_.axes.size(); ++axis) {
      const double input = p[static_cast<int>(axis)];
      if (std::isnan(input)) return input;
      at[axis] = place_among(keys_.axes[axis], input);
      if (mode_ == TableMode::step) at[axis] = {at[axis].below + (at[axis].share >= 1 ? 1 : 0), 0};
    }
    return mode_ == TableMode::cubic ? cubic(static_cast<size_t>(channel), at[0])
                                     : linear(static_cast<size_t>(channel), at, 0, 0);
  }

  // Interpolated values lie between those of the surrounding keys.
  Interval range(int channel, const Box& box) const override {
    std::array<std::pair<size_t, size_t>, 3> keys{};
    for (size_t axis = 0; axis < keys_.axes.size(); ++axis) {
      const Interval input = box.axis(static_cast<int>(axis));
      if (std::isnan(input.lo) || std::isnan(input.hi) || input.is_everything()) return Interval::everything();
      const std::vector<double>& list = keys_.axes[axis];
      keys[axis] = {place_among(list, input.lo).below,
                    std::min(place_among(list, input.hi).below + 1, list.size() - 1)};
    }
    Interval found = Interval(Box::inf, -Box::inf);
    widen(found, static_cast<size_t>(channel), keys, 0, 0);
    return {round_down(round_down(found.lo)), round_up(round_up(found.hi))};
  }

 private:
  // Interpolates over the inputs from `axis` on. `offset` is the combined position of the keys of the inputs before.
  double linear(size_t output, const std::array<KeyPlace, 3>& at, size_t axis, size_t offset) const {
    if (axis == keys_.axes.size()) return keys_.values[output][offset];
    const size_t next = offset * keys_.axes[axis].size() + at[axis].below;
    const double low = linear(output, at, axis + 1, next);
    if (at[axis].share == 0) return low;
    const double high = linear(output, at, axis + 1, next + 1);
    return at[axis].share == 1 ? high : low + at[axis].share * (high - low);
  }

  double cubic(size_t output, const KeyPlace& at) const {
    const std::vector<double>&x = keys_.axes[0], &y = keys_.values[output], &slope = slopes_[output];
    if (x.size() == 1) return y[0];
    return cubic_between(x, y, slope, at.below, at.share);
  }

  void widen(Interval& found, size_t output, const std::array<std::pair<size_t, size_t>, 3>& keys, size_t axis,
             size_t offset) const {
    if (axis == keys.size() || axis == keys_.axes.size()) {
      found = hull(found, Interval(keys_.values[output][offset]));
      return;
    }
    for (size_t n = keys[axis].first; n <= keys[axis].second; ++n)
      widen(found, output, keys, axis + 1, offset * keys_.axes[axis].size() + n);
  }

  TableKeys keys_;
  TableMode mode_;
  std::vector<std::vector<double>> slopes_;  // slopes of each output at the keys
  Hash content_;
};

std::string row_text(size_t row) { return "row " + std::to_string(row + 1); }

TableProblem unsorted(double key, double before, size_t row) {
  return {"the table is not sorted: " + row_text(row) + " has the key " + format_number(key) + " after " +
              format_number(before),
          "sort its rows by their first number, each once"};
}

std::string keys_text(const std::vector<double>& row, size_t inputs) {
  std::vector<std::string> words;
  for (size_t n = 0; n < inputs; ++n) words.push_back(format_number(row[n]));
  return "(" + join(words, ", ") + ")";
}

}  // namespace

std::variant<TableKeys, TableProblem> table_of(const std::vector<std::vector<double>>& rows, size_t inputs) {
  if (rows.empty()) return TableProblem{"the table has no rows", "write for example [[0, 1], [10, 5]]"};
  TableKeys table;
  table.axes.resize(inputs);
  for (size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].size() != rows.front().size() || rows[r].size() <= inputs)
      return TableProblem{row_text(r) + " of the table has " + std::to_string(rows[r].size()) + " numbers",
                          "all rows have a key for each of the " + std::to_string(inputs) +
                              " inputs and then a value or several, alike in all rows"};
    for (const double number : rows[r])
      if (!std::isfinite(number)) return TableProblem{row_text(r) + " of the table is not finite", ""};
    if (inputs == 1 && r > 0 && !(rows[r][0] > rows[r - 1][0])) return unsorted(rows[r][0], rows[r - 1][0], r);
    for (size_t n = 0; n < inputs; ++n) table.axes[n].push_back(rows[r][n]);
  }
  size_t combinations = 1;
  for (std::vector<double>& axis : table.axes) {
    std::sort(axis.begin(), axis.end());
    axis.erase(std::unique(axis.begin(), axis.end()), axis.end());
    combinations *= axis.size();
    if (combinations > rows.size()) break;
  }
  const std::string full = "a table of several inputs has a row for each combination of their keys";
  if (combinations != rows.size())
    return TableProblem{
        "the table has gaps: " + std::to_string(rows.size()) + " rows are not " + "all combinations of its keys", full};
  table.values.assign(rows.front().size() - inputs, std::vector<double>(combinations));
  std::vector<bool> is_known(combinations, false);
  for (size_t r = 0; r < rows.size(); ++r) {
    size_t at = 0;
    for (size_t n = 0; n < inputs; ++n) {
      const std::vector<double>& axis = table.axes[n];
      at =
          at * axis.size() + static_cast<size_t>(std::lower_bound(axis.begin(), axis.end(), rows[r][n]) - axis.begin());
    }
    if (is_known[at])
      return TableProblem{row_text(r) + " of the table repeats the keys " + keys_text(rows[r], inputs), full};
    is_known[at] = true;
    for (size_t v = 0; v < table.values.size(); ++v) table.values[v][at] = rows[r][inputs + v];
  }
  return table;
}

program::SourceField make_table(TableKeys keys, TableMode mode) {
  ASSERT(!keys.axes.empty() && keys.axes.size() <= 3 && (mode != TableMode::cubic || keys.axes.size() == 1));
  return std::make_shared<Table>(std::move(keys), mode);
}

}  // namespace ombre::nodes

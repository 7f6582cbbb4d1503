// Tables of numbers over one, two or three inputs. They are field sources whose space is that of the inputs.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "program/field_source.h"

namespace ombre::nodes {

enum class TableMode : uint8_t {
  step,    // value at the greatest key that is not above the input
  linear,  // linear interpolation between keys
  cubic,   // cubics of a single input that are monotone where the values are (F. N. Fritsch and J. Butland, 1984)
};

struct TableKeys {
  std::vector<std::vector<double>> axes;  // the keys of each of one to three inputs, in ascending order
  // For each output, the values for all combinations of keys. The last input varies fastest.
  std::vector<std::vector<double>> values;
};

// Returns the table for rows of keys followed by values. Returns the problem if rows lack combinations of keys or
// repeat them.
struct TableProblem {
  std::string message, hint;
};
std::variant<TableKeys, TableProblem> table_of(const std::vector<std::vector<double>>& rows, size_t inputs);

// Makes a table with the channels "0", "1", ... for its outputs. Beyond the keys it has the values of the nearest key.
program::SourceField make_table(TableKeys keys, TableMode mode);

}  // namespace ombre::nodes

// Tables of numbers over one, two or three inputs, as field sources whose space is that of the inputs.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "program/field_source.h"

namespace ombre::nodes {

enum class TableMode : uint8_t {
  step,    // the value of the greatest key that is not above the input
  linear,  // straight from key to key
  cubic,   // F. N. Fritsch and J. Butland, 1984: cubics that are monotone where the values are; of one input
};

struct TableKeys {
  std::vector<std::vector<double>> axes;    // the keys of each input, ascending; one to three inputs
  std::vector<std::vector<double>> values;  // of each output, for all combinations of keys, the last input's fastest
};

// Of rows of keys and then values. Nothing, and what is wrong, where rows lack combinations of keys or repeat them.
struct TableProblem {
  std::string message, hint;
};
std::variant<TableKeys, TableProblem> table_of(const std::vector<std::vector<double>>& rows, size_t inputs);

// Channels "0", "1", ... for the outputs. Beyond the keys the values of the nearest.
program::SourceField make_table(TableKeys keys, TableMode mode);

}  // namespace ombre::nodes

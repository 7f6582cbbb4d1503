// Finds the calibrations that lead from what a design gives to what a process needs.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "calibration/calibration.h"

namespace ombre::calibration {

// One use of a calibration. Quantities are attributes, or the fractions of the materials.
struct Step {
  CalibrationPtr calibration;
  std::optional<size_t> input;  // the input that is found from the property; nothing: the property, from its inputs

  std::vector<std::string> from() const;  // quantities
  std::string to() const;
  // Returns for example "modulus to fractions by agilus-vero-modulus".
  std::string text() const;
};

// Steps in the order in which they are taken.
using Chain = std::vector<Step>;
std::string chain_text(const Chain& chain);

struct ChainProblem {
  enum class Kind { none, several } kind = Kind::none;
  std::string message, hint;
};

// Returns the shortest chain from given quantities to the wanted one, which is empty if that is given. Returns a
// problem if there is none, or if several are equally short.
std::variant<Chain, ChainProblem> find_chain(const std::vector<CalibrationPtr>& calibrations,
                                             const std::vector<std::string>& given, const std::string& wanted);

}  // namespace ombre::calibration

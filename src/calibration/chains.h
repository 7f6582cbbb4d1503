// Finds the calibrations that lead from what a design gives to what a process needs.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "calibration/calibration.h"

namespace ombre::calibration {

// One use of a calibration. Quantities are attributes, or the fractions of the materials.
struct Step {
  CalibrationPtr calibration;
  std::optional<size_t> input;      // the input that is found from the property; nothing: the property, from its inputs
  CalibrationPtr beside = nullptr;  // another one of the same materials: both properties give all fractions (joint.h)

  std::vector<std::string> from() const;  // quantities
  std::string to() const;
  std::vector<CalibrationPtr> calibrations() const;  // one or two
  std::string names() const;                         // of the calibrations
  // Returns for example "modulus to fractions by agilus-vero-modulus".
  std::string text() const;
};

// Steps in the order in which they are taken.
using Chain = std::vector<Step>;
std::string chain_text(const Chain& chain);
// Returns the quantities that a chain begins with, each once.
std::vector<std::string> begins_with(const Chain& chain);

struct ChainProblem {
  std::string message, hint;
};

// Returns the shortest chains from given quantities to the wanted one, at most eight: a single empty one if that is
// given. Returns a problem if there is none.
std::variant<std::vector<Chain>, ChainProblem> find_chains(const std::vector<CalibrationPtr>& calibrations,
                                                           const std::vector<std::string>& given,
                                                           const std::string& wanted);
// Returns for example "two chains of calibrations lead to fractions: ...; and ...".
std::string several_text(const std::vector<Chain>& chains, const std::string& wanted);

}  // namespace ombre::calibration

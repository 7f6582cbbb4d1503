// A use of a calibration on a design.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/math/interval.h"
#include "calibration/chains.h"
#include "calibration/joint.h"
#include "design/source_loader.h"

namespace ombre::compile {

// An attribute that a step reads, in the calibration's unit, and its values for which the calibration is valid.
struct ReadAttribute {
  std::string attribute, unit;
  Interval reach;
};

// A step of a chain, on a design.
struct ResolvedStep {
  calibration::Step step;
  std::string attribute, unit;  // the attribute that it reads, in the calibration's unit; of several the property
  Interval reach;               // the attribute's values for which it is valid, wherever the others are
  std::vector<ReadAttribute> others = {};  // the other attributes that it reads
  // An attribute of the resolved design that is 1 to 2 where what is asked for is reached; empty unless the reach
  // varies with the others.
  std::string place_in_reach = {};
  std::optional<double> rounds_to = {};  // a step of the machine, whose multiples it gives
  bool is_over_inks = false;  // the varied material is the mixture of inks that the steps before gave the solid
  std::vector<std::string> materials = {};  // of the inputs' fractions, "" for others, then of the rest; then clear
  std::shared_ptr<const design::InkShares> inks = {};  // of a calibration of inks
  // A step with two calibrations has their laws, for the rest and the inputs of the first one.
  std::optional<std::pair<calibration::MixtureLaw, calibration::MixtureLaw>> joint = {};

  // True if the place in reach, not the attribute's own reach, says whether a value of the attribute is reached.
  bool is_placed(const std::string& name) const {
    return !place_in_reach.empty() && (name == attribute || (joint && name == others[0].attribute));
  }
};

}  // namespace ombre::compile

// A use of a calibration on a design.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "calibration/chains.h"
#include "design/source_loader.h"

namespace ombre::compile {

// A step of a chain, on a design.
struct ResolvedStep {
  calibration::Step step;
  std::string attribute, unit;         // the attribute that it reads, in the calibration's unit
  Interval reach;                      // the attribute's values for which it is valid
  std::vector<std::string> materials;  // of the inputs' fractions, "" for other inputs, then of the rest; then clear
  std::shared_ptr<const design::InkShares> inks;  // of a calibration of inks
};

}  // namespace ombre::compile

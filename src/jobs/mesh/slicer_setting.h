// Settings for slicers, as --setting gives them for the bodies of a mesh.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "formats/slicers/flavour.h"
#include "jobs/common/session.h"

namespace ombre::jobs {

// A setting: "fill_density=20%" is for all bodies, "fill_density=10%..60%" goes from the first region to the last,
// "fill_pattern=grid,gyroid" lists a value for each region.
class SlicerSetting {
 public:
  // Throws WrongArgument.
  explicit SlicerSetting(const std::string& text);

  // Throws WrongArgument if the program does not know the setting, or not for each body by itself, or if a value is
  // none that it takes.
  void check(formats::SlicerFlavour flavour) const;
  bool is_of_object(formats::SlicerFlavour flavour) const;

  const std::string& key() const { return key_; }
  // Returns the number of listed values; 0 if there is one for all.
  size_t listed() const { return values_.size() == 1 ? 0 : values_.size(); }
  // Returns the value for region `number`, counted from 0, which lies at `share` between the first (0) and the last
  // (1). Settings that count something get whole numbers.
  std::string value(formats::SlicerFlavour flavour, size_t number, double share) const;

 private:
  // Throws WrongArgument if a value is not of the setting's kind.
  void check_values(formats::SlicerFlavour flavour) const;

  std::string key_;
  std::vector<std::string> values_;
  bool is_range_ = false;
  double first_ = 0, last_ = 0;
  std::string unit_;
};

}  // namespace ombre::jobs

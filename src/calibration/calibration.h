// Calibrations: how a property of a part depends on fractions of materials and settings of a machine, as somebody has
// measured it. They are read from data/calibrations/*.json; docs/reference/printers.md lists their members.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "base/text/diagnostic.h"
#include "calibration/interpolant.h"
#include "ink/profile.h"

namespace ombre {
struct MemberInfo;
}

namespace ombre::calibration {

// The name of the fractions of all materials together, beside names of attributes.
inline constexpr std::string_view fractions = "fractions";

// The attributes that calibrations of inks read: one without, and one with alpha.
inline constexpr std::string_view colour_property = "color_rgb", colour_with_alpha = "color_rgba";

// An input of a calibration: an attribute, or the fraction of a material.
struct Input {
  std::string attribute;               // empty for a fraction
  std::vector<std::string> materials;  // a fraction is that of the first of these that a materials file has
  std::string unit;
  std::optional<double> usual;    // value where a design gives none
  std::optional<Interval> valid;  // as written; of a calibration that was read: set

  bool is_fraction() const { return attribute.empty(); }
  // Returns for example "temperature" or "the fraction of VeroClear".
  std::string text() const;
};

struct Measurement {
  std::vector<double> inputs;
  double value = 0;
  std::optional<double> sd;  // standard deviation of `count` specimens
  int count = 1;
  SourceRange where = {};
};

// An input that gives a value.
struct Inverse {
  double input = 0;        // the input that gives the nearest value
  double nearest = 0;      // the value that is reached
  bool is_within = false;  // whether that is the value itself
};

// An ICC output profile, which gives the shares of inks for a colour. The calibration's inputs are the inks, in the
// order of the profile's channels.
struct InkUse : ink::Rendering {
  std::string profile;                     // path
  std::vector<std::string> clear = {};     // takes what alpha leaves, as Input::materials; none: there is no alpha
  std::vector<std::string> channels = {};  // names of the channels, in their order
};

// A calibration, complete and checked. Values have its unit, and `at` has a number for each input.
struct Calibration {
  std::string name, title, property, unit, printer, method, date, citation, licence;
  std::vector<std::string> lots;  // of the materials
  bool is_illustrative = false;   // interpolates between few points, or points of others' machines
  std::vector<Input> inputs;
  std::vector<std::string> rest;  // the material that takes what fractions leave, as Input::materials
  std::optional<InkUse> inks;     // then the property is a colour, and what follows has no meaning
  Interpolant interpolant = Interpolant::pchip;
  std::vector<Measurement> points;
  Constants constants;
  std::optional<double> sd, relative_sd;  // spread of a law: absolute, or as a share of the value
  Grid grid, spreads;                     // of the points; for log_linear the grid holds logarithms
  SourceRange where = {};

  bool has_fractions() const { return !rest.empty(); }
  // True if the calibration reads or gives the attribute.
  bool concerns(std::string_view attribute) const;
  // Returns the value at inputs, which are limited to those that are valid.
  double value(std::span<const double> at) const;
  // Returns the expected standard deviation, if it is known.
  std::optional<double> spread(std::span<const double> at) const;

  // Returns the values of an input that keep it valid beside the others. Empty (lo > hi) if there are none.
  Interval choices(size_t input, std::span<const double> at) const;
  // True if each value comes from one value of the input, whatever the others are.
  bool is_invertible(size_t input) const;
  // Returns the values that the choices of an input reach.
  Interval reach(size_t input, std::span<const double> at) const;
  // Returns the values that all mixtures of a law of mixtures reach.
  Interval reach_of_mixtures() const;
  // Returns the values that an input reaches for some values of the inputs that have no usual one.
  Interval whole_reach(size_t input) const;
  // Returns the choice of an input that gives the value, or the nearest one that there is; is_invertible(input). The
  // input is exact to the last places of the value.
  Inverse inverse(size_t input, double value, std::span<const double> at) const;
  // Returns the number of the input that is this attribute, or how many inputs there are if none is.
  size_t input_called(std::string_view attribute) const;
  // Returns the inputs' usual values; 0 for inputs that have none.
  std::vector<double> usual() const;
};
using CalibrationPtr = std::shared_ptr<const Calibration>;

// Returns the members of a calibration, for its reference, and those of a calibration of inks.
const std::vector<MemberInfo>& calibration_members();
const std::vector<MemberInfo>& ink_members();
const std::vector<MemberInfo>& input_members();
const std::vector<MemberInfo>& point_members();
const std::vector<MemberInfo>& constant_members();

// Returns null and adds diagnostics if the text is not a valid calibration.
CalibrationPtr parse_calibration(const SourcePtr& source, Diagnostics& diagnostics);

}  // namespace ombre::calibration

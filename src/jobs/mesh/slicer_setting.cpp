#include "jobs/mesh/slicer_setting.h"

#include <cmath>
#include <optional>

#include "base/text/text.h"
#include "formats/slicers/known_keys.h"
#include "formats/slicers/slicer_settings.h"
#include "jobs/common/session.h"

namespace ombre::jobs {
namespace {

// A number with its unit: "12.5%" is 12.5 and "%".
struct Amount {
  double number = 0;
  std::string unit;
};

std::optional<Amount> parse_amount(std::string_view text) {
  const size_t end = text.find_last_of("0123456789.");
  if (end == std::string_view::npos) return std::nullopt;
  const auto number = parse_number(text.substr(0, end + 1));
  if (!number) return std::nullopt;
  return Amount{*number, std::string(text.substr(end + 1))};
}

}  // namespace

SlicerSetting::SlicerSetting(const std::string& text) {
  const WrongArgument wrong("--setting " + text +
                            " is not understood; write for example --setting fill_density=20%, =10%..60% from the "
                            "first region to the last, or =10%,30%,60% for each region");
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) throw wrong;
  key_ = std::string(trim(text.substr(0, equals)));
  const std::string value = text.substr(equals + 1);
  const size_t dots = value.find("..");
  if (dots == std::string::npos) {
    for (const std::string& one : split(value, ',')) values_.emplace_back(trim(one));
    return;
  }
  const auto first = parse_amount(trim(value.substr(0, dots))), last = parse_amount(trim(value.substr(dots + 2)));
  if (!first || !last || (first->unit != last->unit && !first->unit.empty())) throw wrong;
  is_range_ = true;
  first_ = first->number;
  last_ = last->number;
  unit_ = last->unit;
}

bool SlicerSetting::is_of_object(formats::SlicerFlavour flavour) const {
  return formats::scope_of(flavour, formats::key_in(flavour, key_)) == formats::KeyScope::object;
}

void SlicerSetting::check(formats::SlicerFlavour flavour) const {
  const std::string program(
      formats::program_of(flavour == formats::SlicerFlavour::generic ? formats::SlicerFlavour::prusa : flavour));
  const Phrase written = spelled::option("--setting", key_);
  if (formats::key_in(flavour, key_).empty()) {
    const std::string close = did_you_mean(key_, formats::known_keys(flavour));
    throw WrongArgument(
        written + ": " + program + " has no such setting for a body of a part" +
        (close.empty() ? "; its keys for printer and filaments belong to the slicer's profiles" : "; " + close));
  }
  if (is_of_object(flavour) && (is_range_ || values_.size() > 1))
    throw WrongArgument(written + ": in " + program + " this setting is one for all bodies of a part; write one value");
  check_values(flavour);
  if (key_ != "extruder") return;
  for (const std::string& value : values_) {
    const auto extruder = parse_number(value);
    if (!extruder || *extruder < 1 || *extruder > static_cast<double>(formats::most_filaments) ||
        *extruder != std::floor(*extruder))
      throw WrongArgument(written + "=" + value + ": extruders are numbered from 1 to " +
                          std::to_string(formats::most_filaments));
  }
}

void SlicerSetting::check_values(formats::SlicerFlavour flavour) const {
  const formats::ValueKind* const kind = formats::kind_of(flavour, formats::key_in(flavour, key_));
  if (!kind) return;
  const auto refuse = [&](const std::string& value) {
    throw WrongArgument(spelled::option("--setting", key_ + "=" + value) + ": this setting is " +
                        std::string(kind->name) + "; write for example " +
                        spelled::option("--setting", key_ + "=" + std::string(kind->example)));
  };
  for (const std::string& value : values_) {
    const auto amount = parse_amount(value);
    if (!amount || !kind->takes(amount->number, amount->unit)) refuse(value);
  }
  if (!is_range_) return;
  for (const double end : {first_, last_})
    if (!kind->takes(end, unit_)) refuse(format_rounded(end, 4) + unit_);
}

std::string SlicerSetting::value(formats::SlicerFlavour flavour, size_t number, double share) const {
  if (is_range_) {
    const formats::ValueKind* const kind = formats::kind_of(flavour, formats::key_in(flavour, key_));
    const double between = first_ + share * (last_ - first_);
    return format_rounded(kind && kind->limits.is_whole ? std::round(between) : between, 4) + unit_;
  }
  return values_.size() == 1 ? values_[0] : values_[number];
}

}  // namespace ombre::jobs

// Parsers of option values: exact lengths, resolutions, sizes of memory, boxes.
#include "options/option_values.h"

#include <charconv>
#include <cmath>
#include <functional>

#include "base/text/text.h"

namespace ombre::options {
namespace {

using spelled::option;

using ReadPitch = std::function<std::optional<Pitch>(const std::string&)>;

std::vector<Pitch> parse_list(const std::string& name, const std::string& text, const ReadPitch& read,
                              const Phrase& example) {
  std::vector<Pitch> pitches;
  for (const std::string& part : split(text, ',')) {
    const std::optional<Pitch> pitch = read(part);
    if (!pitch) throw WrongValue(option(name, text) + " is not understood; write for example " + example);
    pitches.push_back(*pitch);
  }
  return pitches;
}

}  // namespace

Pitches parse_voxel(const std::string& text, const std::string& name) {
  const Phrase example = option(name, "0.1") + " or " + option(name, "25.4/600,25.4/300,0.027") + " (mm)";
  const std::vector<Pitch> list = parse_list(
      name, text, [](const std::string& s) { return Pitch::parse(s); }, example);
  if (list.size() == 1) return {list[0], list[0], list[0]};
  if (list.size() == 3) return {list[0], list[1], list[2]};
  throw WrongValue(option(name) + " takes one length or three, x,y,z; write for example " + example);
}

Pitches parse_dpi(const std::string& text, const std::string& name) {
  const Phrase example = option(name, "600") + " or " + option(name, "600,300");
  const std::vector<Pitch> list = parse_list(
      name, text, [](const std::string& s) { return Pitch::from_dpi(s); }, example);
  if (list.size() == 1) return {list[0], list[0], std::nullopt};
  if (list.size() == 2) return {list[0], list[1], std::nullopt};
  if (list.size() == 3) return {list[0], list[1], list[2]};
  throw WrongValue(option(name) + " takes one to three numbers, x,y,z; write for example " + example);
}

Pitch parse_layer_height(const std::string& text, const std::string& name) {
  if (const std::optional<Pitch> pitch = Pitch::parse(text)) return *pitch;
  throw WrongValue(option(name, text) + " is not a length; write for example " + option(name, "0.027") + " (mm)");
}

double parse_length(const std::string& text, const std::string& name) {
  if (const std::optional<Pitch> length = Pitch::parse(text)) return length->mm();
  throw WrongValue(option(name, text) + " is not a length; write for example " + option(name, "0.05") + " (mm)");
}

size_t parse_memory(const std::string& text, const std::string& name) {
  const size_t end = text.find_first_not_of("0123456789.");
  const std::optional<double> number = parse_number(text.substr(0, end));
  const std::string unit = end == std::string::npos ? "" : to_lower(trim(text.substr(end)));
  double factor = 0;
  if (unit.empty() || unit == "b") factor = 1;
  if (unit == "k" || unit == "kb" || unit == "kib") factor = 1024.0;
  if (unit == "m" || unit == "mb" || unit == "mib") factor = 1024.0 * 1024;
  if (unit == "g" || unit == "gb" || unit == "gib") factor = 1024.0 * 1024 * 1024;
  if (unit == "t" || unit == "tb" || unit == "tib") factor = 1024.0 * 1024 * 1024 * 1024;
  const double bytes = number ? *number * factor : 0;
  if (bytes >= 1024.0 * 1024 && bytes < 1e18) return static_cast<size_t>(bytes);
  throw WrongValue(option(name, text) + " is not a size of a megabyte or more; write for example " +
                   option(name, "2G"));
}

std::vector<double> parse_numbers(const std::string& text) {
  std::vector<double> values;
  for (const std::string& part : split(text, ',')) {
    const std::optional<double> value = parse_number(trim(part));
    if (!value || !std::isfinite(*value)) return {};
    values.push_back(*value);
  }
  return values;
}

Box parse_box(const std::string& text, const std::string& name) {
  const std::vector<double> v = parse_numbers(text);
  if (v.size() == 6 && v[0] < v[3] && v[1] < v[4] && v[2] < v[5]) return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  throw WrongValue(option(name, text) + " is not a box x0,y0,z0,x1,y1,z1; write for example " +
                   option(name, "-5,-5,0,5,5,2") + " (mm)");
}

Box parse_rectangle(const std::string& text, const std::string& name) {
  const std::vector<double> v = parse_numbers(text);
  if (v.size() == 4 && v[0] < v[2] && v[1] < v[3]) return {{v[0], v[1], 0}, {v[2], v[3], 0}};
  throw WrongValue(option(name, text) + " is not a box x0,y0,x1,y1; write for example " + option(name, "-5,-5,5,5") +
                   " (mm)");
}

Vec3 parse_angles(const std::string& text, const std::string& name) {
  const std::vector<double> angles = parse_numbers(text);
  if (angles.size() == 3) return {angles[0], angles[1], angles[2]};
  throw WrongValue(option(name, text) + " is not three angles, about x, y and z; write for example " +
                   option(name, "90,0,45") + " (degrees)");
}

Interval parse_range(const std::string& text, const std::string& name) {
  const std::vector<double> ends = parse_numbers(text);
  if (ends.size() == 2 && ends[0] < ends[1]) return {ends[0], ends[1]};
  throw WrongValue(option(name, text) + " is not two numbers, the lesser first; write for example " +
                   option(name, "0,1"));
}

int parse_whole(const std::string& text, const std::string& name) {
  const std::optional<double> number = parse_number(text);
  if (number && *number == std::floor(*number) && std::abs(*number) <= 1e9) return static_cast<int>(*number);
  throw WrongValue(option(name, text) + " is not a whole number");
}

double parse_real(const std::string& text, const std::string& name) {
  if (const std::optional<double> number = parse_number(text)) return *number;
  throw WrongValue(option(name, text) + " is not a number");
}

uint64_t parse_seed(const std::string& text, const std::string& name) {
  uint64_t seed = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (status == std::errc() && end == text.data() + text.size()) return seed;
  throw WrongValue(option(name, text) + " is not a whole number from 0 to 18446744073709551615");
}

double parse_height(const std::string& text, const std::string& name) {
  if (const std::optional<double> z = parse_number(text)) return *z;
  throw WrongValue(option(name, text) + " is not a height; write for example " + option(name, "3.2") + " (mm)");
}

}  // namespace ombre::options

// Values of options: lengths as exact text, resolutions, sizes of memory.
#include "ombre/arguments.h"

#include <cmath>
#include <functional>
#include <vector>

#include "base/text.h"
#include "ombre/commands.h"

namespace ombre::cli {
namespace {

using ReadPitch = std::function<std::optional<Pitch>(const std::string&)>;

std::vector<Pitch> parse_list(const std::string& option, const std::string& text, const ReadPitch& read,
                              const char* example) {
  std::vector<Pitch> pitches;
  for (const std::string& part : split(text, ',')) {
    const std::optional<Pitch> pitch = read(part);
    if (!pitch)
      throw WrongArgument(
          join(std::vector<std::string>{option, text, "is not understood; write for example", example}, " "));
    pitches.push_back(*pitch);
  }
  return pitches;
}

}  // namespace

Pitches parse_voxel(const std::string& text) {
  constexpr const char* example = "--voxel 0.1 or --voxel 25.4/600,25.4/300,0.027 (mm)";
  const std::vector<Pitch> list = parse_list(
      "--voxel", text, [](const std::string& s) { return Pitch::parse(s); }, example);
  if (list.size() == 1) return {list[0], list[0], list[0]};
  if (list.size() == 3) return {list[0], list[1], list[2]};
  throw WrongArgument("--voxel takes one length or three, x,y,z; write for example " + std::string(example));
}

Pitches parse_dpi(const std::string& text) {
  constexpr const char* example = "--dpi 600 or --dpi 600,300";
  const std::vector<Pitch> list = parse_list(
      "--dpi", text, [](const std::string& s) { return Pitch::from_dpi(s); }, example);
  if (list.size() == 1) return {list[0], list[0], std::nullopt};
  if (list.size() == 2) return {list[0], list[1], std::nullopt};
  if (list.size() == 3) return {list[0], list[1], list[2]};
  throw WrongArgument("--dpi takes one to three numbers, x,y,z; write for example " + std::string(example));
}

Pitch parse_layer_height(const std::string& text) {
  if (const std::optional<Pitch> pitch = Pitch::parse(text)) return *pitch;
  throw WrongArgument("--layer-height " + text + " is not a length; write for example --layer-height 0.027 (mm)");
}

size_t parse_memory(const std::string& text) {
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
  throw WrongArgument("--memory " + text + " is not a size of a megabyte or more; write for example --memory 2G");
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

Box parse_box(const std::string& text) {
  const std::vector<double> v = parse_numbers(text);
  if (v.size() == 6 && v[0] < v[3] && v[1] < v[4] && v[2] < v[5]) return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  throw WrongArgument("--box " + text + " is not a box x0,y0,z0,x1,y1,z1; write for example --box -5,-5,0,5,5,2 (mm)");
}

}  // namespace ombre::cli

// Parsers of option values: exact lengths, resolutions, sizes of memory, boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/math/box.h"
#include "base/math/interval.h"
#include "base/math/pitch.h"
#include "base/text/code.h"
#include "base/text/phrase.h"

namespace ombre::options {

// Thrown for a value that an option does not take. The message names the option and says what to write instead.
class WrongValue : public std::runtime_error {
 public:
  explicit WrongValue(Phrase message, Code code = Code::option)
      : std::runtime_error(message.text()), message_(std::move(message)), code_(code) {}

  const Phrase& message() const { return message_; }
  Code code() const { return code_; }

 private:
  Phrase message_;
  Code code_;
};

using Pitches = std::array<std::optional<Pitch>, 3>;

// The parsers throw WrongValue, which names `option` and gives an example of what to write.

// Reads voxel sizes in mm: "0.1" for all axes, or "x,y,z".
Pitches parse_voxel(const std::string& text, const std::string& option = "--voxel");
// Reads resolutions in dpi: "600" for x and y, "600,300", or "600,300,940".
Pitches parse_dpi(const std::string& text, const std::string& option = "--dpi");
Pitch parse_layer_height(const std::string& text, const std::string& option = "--layer-height");
// Reads a length in mm, which must be above 0.
double parse_length(const std::string& text, const std::string& option);
// Reads a size of memory in bytes: "2G", "512M", "1.5GiB". It must be at least a megabyte.
size_t parse_memory(const std::string& text, const std::string& option = "--memory");
// Reads a box in mm: "x0,y0,z0,x1,y1,z1". Its size along each axis must be above 0.
Box parse_box(const std::string& text, const std::string& option = "--box");
// Reads a rectangle in mm: "x0,y0,x1,y1". Its z range is 0 to 0.
Box parse_rectangle(const std::string& text, const std::string& option);
// Reads three angles in degrees, about x, y and z: "90,0,45".
Vec3 parse_angles(const std::string& text, const std::string& option = "--rotate");
// Reads two numbers, the lesser first: "0,1".
Interval parse_range(const std::string& text, const std::string& option = "--range");
int parse_whole(const std::string& text, const std::string& option);
double parse_real(const std::string& text, const std::string& option);
uint64_t parse_seed(const std::string& text, const std::string& option = "--seed");
// Reads a height along z in mm.
double parse_height(const std::string& text, const std::string& option);

// Reads numbers: "1,2.5,-3". Returns an empty list if one of them is not a finite number.
std::vector<double> parse_numbers(const std::string& text);

// A kind of value: its name in documents and other languages, and the function that reads it.
template <class T>
struct Kind {
  const char* name;
  T (*read)(const std::string& text, const std::string& option);
};

namespace kind {

inline constexpr Kind<std::string> text{"text", [](const std::string& text, const std::string&) { return text; }};
inline constexpr Kind<std::string> file{"file", [](const std::string& text, const std::string&) { return text; }};
inline constexpr Kind<int> whole{"whole number", parse_whole};
inline constexpr Kind<double> number{"number", parse_real};
inline constexpr Kind<uint64_t> seed{"whole number", parse_seed};
inline constexpr Kind<Pitches> voxel{"lengths", parse_voxel};
inline constexpr Kind<Pitches> dpi{"resolutions", parse_dpi};
inline constexpr Kind<Pitch> layer_height{"length", parse_layer_height};
inline constexpr Kind<double> length{"length", parse_length};
inline constexpr Kind<double> height{"number", parse_height};
inline constexpr Kind<size_t> memory{"size of memory", parse_memory};
inline constexpr Kind<Box> box{"6 numbers", parse_box};
inline constexpr Kind<Box> rectangle{"4 numbers", parse_rectangle};
inline constexpr Kind<Vec3> angles{"3 numbers", parse_angles};
inline constexpr Kind<Interval> range{"2 numbers", parse_range};

}  // namespace kind
}  // namespace ombre::options

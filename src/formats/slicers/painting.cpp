#include "formats/slicers/painting.h"

#include <algorithm>
#include <map>

#include "base/system/assert.h"

namespace ombre::formats {
namespace {

constexpr uint32_t first_of_long_codes = 3;
constexpr int deepest_division = 64;

// Reads the tree, and sums the areas of the parts of each extruder, as shares of the triangle.
class PaintReader {
 public:
  explicit PaintReader(std::string_view code) : code_(code) {}

  bool read() { return read_node(1, 0) && left_ == 0; }
  const std::map<uint32_t, double>& areas() const { return areas_; }

 private:
  std::optional<uint32_t> digit() {
    if (left_ == 0) return std::nullopt;
    const char c = code_[--left_];
    if (c >= '0' && c <= '9') return static_cast<uint32_t>(c - '0');
    if (c >= 'A' && c <= 'F') return static_cast<uint32_t>(c - 'A' + 10);
    return std::nullopt;
  }

  bool read_node(double area, int depth) {
    const auto code = digit();
    if (!code || depth > deepest_division) return false;
    const uint32_t split_sides = *code & 3;
    if (split_sides == 0) return read_leaf(*code >> 2, area);
    for (uint32_t n = 0; n <= split_sides; ++n)
      if (!read_node(area / (split_sides + 1), depth + 1)) return false;
    return true;
  }

  bool read_leaf(uint32_t extruder, double area) {
    if (extruder == first_of_long_codes) {
      const auto more = digit();
      if (!more) return false;
      extruder += *more;
      if (*more == 14) {
        const auto low = digit(), high = digit();
        if (!low || !high) return false;
        extruder += *low + 16 * *high;
      }
    }
    areas_[extruder] += area;
    return true;
  }

  std::string_view code_;
  size_t left_ = code_.size();
  std::map<uint32_t, double> areas_;
};

}  // namespace

std::string paint_code(uint32_t extruder) {
  ASSERT(extruder > 0 && extruder <= most_painted);
  constexpr std::string_view digits = "0123456789ABCDEF";
  if (extruder < first_of_long_codes) return std::string(1, digits[4 * size_t{extruder}]);
  return std::string(1, digits[extruder - first_of_long_codes]) + "C";
}

std::optional<Paint> read_paint(std::string_view code) {
  PaintReader reader(code);
  if (!reader.read()) return std::nullopt;
  const auto by_area = [](const auto& a, const auto& b) { return a.second < b.second; };
  return Paint{std::ranges::max_element(reader.areas(), by_area)->first, reader.areas().size() > 1};
}

}  // namespace ombre::formats

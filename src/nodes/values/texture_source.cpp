#include "nodes/values/texture_source.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/srgb.h"
#include "base/system/assert.h"

namespace ombre::nodes {
namespace {

constexpr std::string_view texture_channels[] = {"red", "green", "blue", "alpha", "value"};
constexpr int value_number = 4;

class TextureSource final : public program::FieldSource {
 public:
  TextureSource(size_t columns, size_t rows, const std::vector<uint8_t>& rgba, const Hash& content,
                const TextureUse& use)
      : columns_(static_cast<int64_t>(columns)), rows_(static_cast<int64_t>(rows)), rgba_(rgba), use_(use) {
    ASSERT(columns > 0 && rows > 0 && rgba.size() == 4 * columns * rows);
    content_ =
        hash_bytes("texture " + content.hex() + (use.repeats ? " repeats" : "") + (use.is_linear ? " light" : ""));
    for (size_t n = 0; n < level_.size(); ++n) {
      const double share = static_cast<double>(n) / 255;
      level_[n] = use.is_linear ? linear_of_srgb(share) : share;
    }
  }

  std::string name() const override { return "texture"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override {
    const auto* const found = std::find(std::begin(texture_channels), std::end(texture_channels), channel_name);
    return found == std::end(texture_channels) ? -1 : static_cast<int>(found - std::begin(texture_channels));
  }
  Interval range(int, const Box&) const override { return {0, 1}; }

  double sample(int channel, Vec3 p) const override {
    if (!(std::abs(p.x) < 1e15 && std::abs(p.y) < 1e15)) return 0;
    const double x = p.x - 0.5, y = p.y - 0.5, i = std::floor(x), j = std::floor(y);
    const double across = x - i, up = y - j;
    const auto column = static_cast<int64_t>(i), row = static_cast<int64_t>(j);
    const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
    return std::clamp(mix(mix(pixel(channel, column, row), pixel(channel, column + 1, row), across),
                          mix(pixel(channel, column, row + 1), pixel(channel, column + 1, row + 1), across), up),
                      0.0, 1.0);
  }

 private:
  int64_t placed(int64_t at, int64_t count) const {
    if (!use_.repeats) return std::clamp<int64_t>(at, 0, count - 1);
    const int64_t rest = at % count;
    return rest < 0 ? rest + count : rest;
  }

  double pixel(int channel, int64_t column, int64_t row) const {
    const int64_t from_top = rows_ - 1 - placed(row, rows_);
    const uint8_t* at = rgba_.data() + 4 * (from_top * columns_ + placed(column, columns_));
    if (channel == value_number) return 0.2126 * level_[at[0]] + 0.7152 * level_[at[1]] + 0.0722 * level_[at[2]];
    return channel == 3 ? at[3] / 255.0 : level_[at[channel]];
  }

  int64_t columns_, rows_;
  std::vector<uint8_t> rgba_;
  TextureUse use_;
  std::array<double, 256> level_{};  // value of each byte, from 0 to 1
  Hash content_;
};

}  // namespace

program::SourceField make_texture(size_t columns, size_t rows, const std::vector<uint8_t>& rgba, const Hash& content,
                                  const TextureUse& use) {
  return std::make_shared<TextureSource>(columns, rows, rgba, content, use);
}

}  // namespace ombre::nodes

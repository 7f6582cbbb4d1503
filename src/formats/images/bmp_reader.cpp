#include <array>
#include <bit>
#include <cstring>

#include "base/text/error.h"
#include "formats/images/bmp.h"

namespace ombre::formats {
namespace {

constexpr uint64_t most_pixels_of_bmp = 1'000'000'000;
constexpr size_t file_header = 14;  // bytes before the header that describes the image

class BmpReader {
 public:
  BmpReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  BmpImage run() {
    read_header();
    const uint64_t row_bytes = (uint64_t{bits_} * image_.width + 31) / 32 * 4;
    const auto begin = number<uint32_t>(10);
    if (begin > bytes_.size() || (bytes_.size() - begin) / row_bytes < image_.height) fail("it is cut off");
    image_.rgba.resize(size_t{4} * image_.width * image_.height);
    for (uint32_t row = 0; row < image_.height; ++row) {
      const uint32_t line = goes_down_ ? row : image_.height - 1 - row;
      read_row(bytes_.substr(begin + line * row_bytes, row_bytes), &image_.rgba[size_t{4} * image_.width * row]);
    }
    return std::move(image_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(Code::file_content, "the image \"" + name_ + "\" cannot be read: " + reason, {{"file", name_}});
  }

  template <class T>
  T number(size_t at) const {
    T value{};
    if (at + sizeof value > bytes_.size()) fail("it is cut off in its header");
    std::memcpy(&value, bytes_.data() + at, sizeof value);
    return value;
  }

  void read_header() {
    constexpr uint32_t oldest = 12, usual = 40, most = 1024;
    const auto size = number<uint32_t>(file_header);
    const bool is_old = size == oldest;
    if (!is_old && (size < usual || size > most)) fail("it has a header of a kind that is not known");
    const int64_t width = is_old ? int64_t{number<uint16_t>(18)} : int64_t{number<int32_t>(18)},
                  height = is_old ? int64_t{number<uint16_t>(20)} : int64_t{number<int32_t>(22)};
    goes_down_ = height < 0;
    if (width < 1 || height == 0) fail("it has no pixels");
    if (static_cast<uint64_t>(width) * static_cast<uint64_t>(goes_down_ ? -height : height) > most_pixels_of_bmp)
      fail("it has more than 10^9 pixels");
    image_.width = static_cast<uint32_t>(width);
    image_.height = static_cast<uint32_t>(goes_down_ ? -height : height);
    bits_ = number<uint16_t>(is_old ? 24 : 28);
    const uint32_t packing = is_old ? 0 : number<uint32_t>(30);
    constexpr uint32_t plain = 0, by_masks = 3, by_masks_with_opacity = 6;
    if (packing != plain && packing != by_masks && packing != by_masks_with_opacity)
      fail("it is compressed; save it without compression, or as PNG");
    if (bits_ != 1 && bits_ != 4 && bits_ != 8 && bits_ != 16 && bits_ != 24 && bits_ != 32)
      fail("it has " + std::to_string(bits_) + " bits a pixel; 1, 4, 8, 16, 24 and 32 are read");
    if (bits_ <= 8) return read_palette(file_header + size, is_old);
    read_masks(packing != plain, size);
  }

  void read_palette(size_t at, bool is_old) {
    const size_t entry = is_old ? 3 : 4, most = size_t{1} << bits_;
    size_t count = is_old ? 0 : number<uint32_t>(46);
    if (count == 0 || count > most) count = most;
    for (size_t n = 0; n < count; ++n) {
      const size_t place = at + n * entry;
      palette_[n] = {number<uint8_t>(place + 2), number<uint8_t>(place + 1), number<uint8_t>(place)};
    }
  }

  void read_masks(bool are_given, uint32_t size) {
    masks_ = bits_ == 16 ? std::array<uint32_t, 4>{0x7c00, 0x3e0, 0x1f, 0}
                         : std::array<uint32_t, 4>{0xff0000, 0xff00, 0xff, 0};
    if (!are_given || bits_ == 24) return;
    constexpr uint32_t with_opacity = 56;
    for (size_t n = 0; n < (size >= with_opacity ? 4U : 3U); ++n) masks_[n] = number<uint32_t>(54 + 4 * n);
  }

  // Returns the masked part of a pixel, scaled to 0 ... 255.
  static uint8_t part(uint32_t pixel, uint32_t mask) {
    const uint32_t most = mask >> std::countr_zero(mask), value = (pixel & mask) >> std::countr_zero(mask);
    return static_cast<uint8_t>((uint64_t{value} * 255 + most / 2) / most);
  }

  void read_row(std::string_view row, uint8_t* to) const {
    constexpr uint8_t opaque = 255;
    for (uint32_t n = 0; n < image_.width; ++n, to += 4) {
      if (bits_ <= 8) {
        const size_t bit = size_t{n} * bits_, shift = 8 - bits_ - bit % 8;
        const auto byte = static_cast<uint8_t>(row[bit / 8]);
        const auto& colour = palette_[(byte >> shift) & ((1U << bits_) - 1)];
        std::copy(colour.begin(), colour.end(), to);
        to[3] = opaque;
        continue;
      }
      uint32_t pixel = 0;
      std::memcpy(&pixel, row.data() + size_t{n} * bits_ / 8, bits_ / 8);
      for (size_t c = 0; c < 4; ++c) to[c] = masks_[c] != 0 ? part(pixel, masks_[c]) : c == 3 ? opaque : uint8_t{0};
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  BmpImage image_;
  uint16_t bits_ = 0;
  bool goes_down_ = false;
  std::array<std::array<uint8_t, 3>, 256> palette_{};
  std::array<uint32_t, 4> masks_{};  // masks of red, green, blue and opacity
};

}  // namespace

bool is_bmp(std::string_view bytes) { return bytes.starts_with("BM"); }

BmpImage decode_bmp(std::string_view bytes, const std::string& name) { return BmpReader(bytes, name).run(); }

}  // namespace ombre::formats

// Any bytes are a layer, a palette and a layout: what is read back from its PNG file are its voxels.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "base/math/run.h"
#include "formats/images/png.h"
#include "fuzz/checks.h"

namespace {

using namespace ombre;
using namespace ombre::formats;

constexpr size_t longest = 4096;           // longer ones only take longer
constexpr uint32_t most_voxels = 1 << 15;  // three of the longest rows, longer than matches reach

using fuzz::require;

// Steps through the input; behind its end there are zeros.
class Bytes {
 public:
  explicit Bytes(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  bool is_empty() const { return bytes_.empty(); }
  uint8_t next() {
    if (bytes_.empty()) return 0;
    const uint8_t byte = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return byte;
  }
  uint32_t next_two() {
    const uint32_t low = next();
    return low | uint32_t{next()} << 8;
  }

 private:
  std::span<const uint8_t> bytes_;
};

struct Image {
  uint32_t width;
  std::vector<MaterialId> voxels;
};

// Each stroke is noise, one material, or voxels from before, so that little input makes large layers.
Image read_image(Bytes& bytes, uint32_t materials) {
  Image image{1 + bytes.next_two() % 10000, {}};
  const uint32_t most = std::max(image.width, most_voxels);
  std::vector<MaterialId>& voxels = image.voxels;
  uint32_t noise = bytes.next_two();
  while (!bytes.is_empty() && voxels.size() < most) {
    const uint32_t kind = bytes.next(), scale = kind >> 4;
    const uint32_t length = 1 + (uint32_t{bytes.next()} << scale / 2);
    const auto material = static_cast<MaterialId>(bytes.next() % (materials + 1));
    const size_t back = 1 + bytes.next_two() + (kind & 4 ? image.width : 0);
    for (uint32_t i = 0; i < length; ++i) {
      noise = noise * 1664525 + 1013904223;
      MaterialId voxel = material;
      if (kind % 4 == 1) voxel = static_cast<MaterialId>((noise >> 16) % (materials + 1));
      if (kind % 4 == 2 && noise >> 29 == 0) voxel = 0;
      if (kind % 4 == 3 && back <= voxels.size()) voxel = voxels[voxels.size() - back];
      voxels.push_back(voxel);
    }
  }
  const size_t rows = std::clamp<size_t>(voxels.size() / image.width, 1, most / image.width);
  voxels.resize(rows * image.width);
  return image;
}

RunLayer layer_of(const Image& image) {
  RunLayer layer(image.width);
  for (size_t i = 0; i < image.voxels.size(); i += image.width) layer.append_row(&image.voxels[i]);
  return layer;
}

// Colours that are hard to tell apart, too.
Palette palette_of(uint32_t materials, uint8_t spread) {
  Palette palette({spread, 0, 0, spread});
  for (uint32_t id = 1; id <= materials; ++id) {
    const auto channel = [&](uint32_t factor) { return static_cast<uint8_t>(id * factor * spread); };
    palette.add(static_cast<MaterialId>(id), {channel(1), channel(7), channel(31), static_cast<uint8_t>(255 - spread)});
  }
  return palette;
}

PngLayout layout_of(uint8_t bits, uint32_t materials) {
  PngLayout layout;
  layout.format = static_cast<ImageFormat>(bits % 4);
  layout.flip_x = bits & 4;
  layout.flip_y = bits & 8;
  layout.mask_of = static_cast<MaterialId>((bits >> 4) % (materials + 1));
  return layout;
}

Rgba seen(MaterialId id, const Palette& palette, const PngLayout& layout) {
  const Rgba colour = palette.colours()[palette.entry(id)];
  if (layout.format == ImageFormat::rgba || layout.format == ImageFormat::indexed) return colour;
  const uint8_t gray = layout.format == ImageFormat::gray ? luminance(colour) : id == layout.mask_of ? 255 : 0;
  return {gray, gray, gray, 255};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size > longest) return 0;
  Bytes bytes({data, size});
  const uint32_t materials = bytes.next();
  const PngLayout layout = layout_of(bytes.next(), materials);
  const Palette palette = palette_of(materials, bytes.next());
  const Image image = read_image(bytes, materials);

  const std::string file = encode_png(layer_of(image), palette, layout);
  const PngImage decoded = decode_png(file, "fuzz.png");
  const uint32_t width = image.width, height = static_cast<uint32_t>(image.voxels.size() / width);
  require(decoded.width == width && decoded.height == height);
  for (uint32_t row = 0; row < height; ++row) {
    for (uint32_t column = 0; column < width; ++column) {
      const uint32_t i = layout.flip_x ? width - 1 - column : column, j = layout.flip_y ? row : height - 1 - row;
      require(decoded.colour(column, row) == seen(image.voxels[size_t{j} * width + i], palette, layout));
    }
  }
  return 0;
}

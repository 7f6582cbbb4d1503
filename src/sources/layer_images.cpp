#include "sources/layer_images.h"

#include <algorithm>
#include <array>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/images/bmp.h"
#include "formats/images/png.h"
#include "formats/volumes/volume_parts.h"
#include "tiff/pages.h"

namespace ombre::sources {
namespace {

bool is_png_image(std::string_view bytes) { return bytes.starts_with("\x89PNG"); }

LayerColours colours_of(const formats::PngImage& png) {
  LayerColours layer{png.width, png.height, {}};
  layer.rgba.reserve(size_t{4} * png.width * png.height);
  for (uint32_t row = 0; row < png.height; ++row)
    for (uint32_t column = 0; column < png.width; ++column) {
      const formats::Rgba colour = png.colour(column, row);
      layer.rgba.insert(layer.rgba.end(), colour.begin(), colour.end());
    }
  return layer;
}

LayerColours colours_of(formats::BmpImage bmp) { return {bmp.width, bmp.height, std::move(bmp.rgba)}; }

// Returns one channel of an image.
LayerNumbers channel_of(const LayerColours& image, int channel) {
  LayerNumbers layer{image.width, image.height, "uint16", 4, {}};
  std::vector<uint16_t> values;
  values.reserve(image.rgba.size() / 4);
  for (size_t n = static_cast<size_t>(channel); n < image.rgba.size(); n += 4) values.push_back(image.rgba[n]);
  layer.values = std::move(values);
  return layer;
}

[[noreturn]] void fail_coloured(const std::string& path, size_t channels) {
  throw Error(Code::file_content,
              "the image \"" + path + "\" is in colour; choose one of its values by channel=0, up to " +
                  std::to_string(channels - 1) + ", or save it in shades of grey",
              {{"file", path}});
}

// Returns the common channel of an image whose red, green and blue are equal; otherwise fails.
LayerNumbers shades_of(const LayerColours& image, const std::string& path) {
  for (size_t n = 0; n < image.rgba.size(); n += 4)
    if (image.rgba[n] != image.rgba[n + 1] || image.rgba[n] != image.rgba[n + 2]) fail_coloured(path, 4);
  LayerNumbers layer = channel_of(image, 0);
  layer.channels = 1;
  return layer;
}

void check_channel(const std::string& path, int channel, size_t channels) {
  if (channel >= static_cast<int>(channels))
    throw Error(Code::file_content,
                "the image \"" + path + "\" has no channel " + std::to_string(channel) + "; 0 to " +
                    std::to_string(channels - 1) + " are there",
                {{"file", path}});
}

LayerNumbers numbers_of(const tiff::Page& page, const std::string& path, int channel) {
  check_channel(path, channel, page.channels);
  if (page.channels > 1 && channel < 0) fail_coloured(path, page.channels);
  LayerNumbers layer{page.width, page.height, page.type, page.channels, formats::values_of_type(path, page.type)};
  std::visit(
      [&]<class T>(std::vector<T>& list) {
        const formats::Numbers<T> numbers(page.bytes.data(), page.bytes.size() / sizeof(T));
        list.reserve(numbers.size() / page.channels);
        for (auto n = static_cast<size_t>(std::max(channel, 0)); n < numbers.size(); n += page.channels)
          list.push_back(numbers[n]);
      },
      layer.values);
  return layer;
}

}  // namespace

bool has_image_name(const std::string& path) {
  const std::string name = to_lower(path);
  constexpr std::array<std::string_view, 4> endings{".png", ".tif", ".tiff", ".bmp"};
  return std::ranges::any_of(endings, [&](std::string_view ending) { return name.ends_with(ending); });
}

bool is_image(std::string_view bytes) { return is_png_image(bytes) || tiff::is_tiff(bytes) || formats::is_bmp(bytes); }

std::vector<LayerNumbers> read_layer_numbers(const std::string& path, std::string_view bytes, int channel,
                                             const StopFlag* stop) {
  std::vector<LayerNumbers> layers;
  if (tiff::is_tiff(bytes)) {
    for (const tiff::Page& page : tiff::read_pages(path, bytes, tiff::Wanted::numbers, stop))
      layers.push_back(numbers_of(page, path, channel));
    return layers;
  }
  check_channel(path, channel, 4);
  const bool is_bitmap = formats::is_bmp(bytes);
  if (channel >= 0) {
    const LayerColours image =
        is_bitmap ? colours_of(formats::decode_bmp(bytes, path)) : colours_of(formats::decode_png(bytes, path));
    layers.push_back(channel_of(image, channel));
  } else if (is_bitmap) {
    layers.push_back(shades_of(colours_of(formats::decode_bmp(bytes, path)), path));
  } else {
    formats::GrayImage image = formats::decode_gray_png(bytes, path);
    layers.push_back({image.width, image.height, "uint16", 1, std::move(image.pixels)});
  }
  return layers;
}

std::vector<LayerColours> read_layer_colours(const std::string& path, std::string_view bytes, const StopFlag* stop) {
  std::vector<LayerColours> layers;
  if (tiff::is_tiff(bytes)) {
    for (tiff::Page& page : tiff::read_pages(path, bytes, tiff::Wanted::colours, stop))
      layers.push_back({page.width, page.height, std::vector<uint8_t>(page.bytes.begin(), page.bytes.end())});
    return layers;
  }
  layers.push_back(formats::is_bmp(bytes) ? colours_of(formats::decode_bmp(bytes, path))
                                          : colours_of(formats::decode_png(bytes, path)));
  return layers;
}

}  // namespace ombre::sources

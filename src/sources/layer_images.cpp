#include "sources/layer_images.h"

#include <algorithm>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/images/bmp.h"
#include "formats/images/png.h"
#include "formats/volumes/volume_parts.h"
#include "sources/tiff_stack.h"
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

LayerColours png_colours(const std::string& path, std::string_view bytes) {
  return colours_of(formats::decode_png(bytes, path));
}
LayerColours bmp_colours(const std::string& path, std::string_view bytes) {
  return colours_of(formats::decode_bmp(bytes, path));
}

// The indices of an image with a palette, which are labels.
LayerNumbers indices_of(const formats::PngImage& png) {
  return {png.width, png.height, "uint16", 1, std::vector<uint16_t>(png.pixels.begin(), png.pixels.end())};
}

bool has_palette(std::string_view bytes) {
  constexpr size_t colour_type = 25;  // in the header chunk, which comes first
  constexpr char indexed = 3;
  return is_png_image(bytes) && bytes.size() > colour_type && bytes[colour_type] == indexed;
}

LayerNumbers png_shades(const std::string& path, std::string_view bytes) {
  formats::GrayImage image = formats::decode_gray_png(bytes, path);
  return {image.width, image.height, "uint16", 1, std::move(image.pixels)};
}
LayerNumbers bmp_shades(const std::string& path, std::string_view bytes) {
  return shades_of(bmp_colours(path, bytes), path);
}

// Numbers of the pixels, or those of one of four channels.
template <auto colours, auto shades>
LayerStack numbers_of_image(const std::string& path, std::string_view bytes, const formats::VolumeChoice& choice,
                            const StopFlag*) {
  check_channel(path, choice.channel, 4);
  LayerStack stack;
  if (choice.channel >= 0)
    stack.layers.push_back(channel_of(colours(path, bytes), choice.channel));
  else if (choice.are_labels && has_palette(bytes))
    stack.layers.push_back(indices_of(formats::decode_png(bytes, path)));
  else
    stack.layers.push_back(shades(path, bytes));
  return stack;
}

template <auto colours>
std::vector<LayerColours> colours_of_image(const std::string& path, std::string_view bytes, const StopFlag*) {
  std::vector<LayerColours> layers;
  layers.push_back(colours(path, bytes));
  return layers;
}

LayerStack tiff_numbers(const std::string& path, std::string_view bytes, const formats::VolumeChoice& choice,
                        const StopFlag* stop) {
  const tiff::Document document =
      tiff::read_document(path, bytes, choice.are_labels ? tiff::Wanted::indices : tiff::Wanted::numbers, stop);
  const ChosenPages chosen = chosen_pages(path, document, choice);
  LayerStack stack{{}, chosen.spacing_mm, chosen.warnings};
  for (const size_t page : chosen.pages) stack.layers.push_back(numbers_of(document.pages[page], path, chosen.channel));
  return stack;
}

std::vector<LayerColours> tiff_colours(const std::string& path, std::string_view bytes, const StopFlag* stop) {
  const tiff::Document document = tiff::read_document(path, bytes, tiff::Wanted::colours, stop);
  std::vector<LayerColours> layers;
  for (const size_t n : chosen_pages(path, document, {}).pages) {
    const tiff::Page& page = document.pages[n];
    layers.push_back({page.width, page.height, std::vector<uint8_t>(page.bytes.begin(), page.bytes.end())});
  }
  return layers;
}

struct ImageFormat {
  FileFormat file;
  bool (*recognises)(std::string_view bytes);
  LayerStack (*numbers)(const std::string&, std::string_view, const formats::VolumeChoice&, const StopFlag*);
  std::vector<LayerColours> (*colours)(const std::string&, std::string_view, const StopFlag*);
};

const std::vector<ImageFormat>& image_formats() {
  static const std::vector<ImageFormat> rows{
      {{"PNG", {".png"}, Content::image, true, true},
       is_png_image,
       numbers_of_image<png_colours, png_shades>,
       colours_of_image<png_colours>},
      {tiff::file_format(), tiff::is_tiff, tiff_numbers, tiff_colours},
      {{"Windows bitmap", {".bmp"}, Content::image, true},
       formats::is_bmp,
       numbers_of_image<bmp_colours, bmp_shades>,
       colours_of_image<bmp_colours>},
  };
  return rows;
}

const ImageFormat* find_image_format(std::string_view bytes) {
  const auto& rows = image_formats();
  const auto found = std::ranges::find_if(rows, [&](const ImageFormat& row) { return row.recognises(bytes); });
  return found == rows.end() ? nullptr : &*found;
}

// Returns PNG for files that are not images at all, since the reader of PNG says what is wrong.
const ImageFormat& format_of_image(std::string_view bytes) {
  const ImageFormat* format = find_image_format(bytes);
  return format ? *format : image_formats().front();
}

}  // namespace

std::vector<FileFormat> image_file_formats() {
  std::vector<FileFormat> formats;
  for (const ImageFormat& row : image_formats()) formats.push_back(row.file);
  return formats;
}

bool has_image_name(const std::string& path) {
  return std::ranges::any_of(image_formats(), [&](const ImageFormat& row) { return has_ending(path, row.file); });
}

bool is_image(std::string_view bytes) { return find_image_format(bytes) != nullptr; }

LayerStack read_layer_numbers(const std::string& path, std::string_view bytes, const formats::VolumeChoice& choice,
                              const StopFlag* stop) {
  return format_of_image(bytes).numbers(path, bytes, choice, stop);
}

std::vector<LayerColours> read_layer_colours(const std::string& path, std::string_view bytes, const StopFlag* stop) {
  return format_of_image(bytes).colours(path, bytes, stop);
}

}  // namespace ombre::sources

#include "formats/images/read_picture.h"

#include "base/text/error.h"
#include "formats/images/png.h"
#include "jpeg/orientation.h"

namespace ombre::formats {
namespace {

constexpr uint64_t most_pixels = uint64_t{1} << 27;  // 0.5 GB

Picture picture_of(const PngImage& png) {
  Picture picture{png.width, png.height, {}};
  picture.rgba.reserve(size_t{4} * png.width * png.height);
  for (uint32_t row = 0; row < png.height; ++row)
    for (uint32_t column = 0; column < png.width; ++column) {
      const Rgba colour = png.colour(column, row);
      picture.rgba.insert(picture.rgba.end(), colour.begin(), colour.end());
    }
  return picture;
}

Picture read_jpeg(const std::string& name, std::string_view bytes, Turning turning) {
  jpeg::Picture picture = jpeg::decode(name, bytes, most_pixels);
  if (turning == Turning::as_seen) picture = jpeg::turned(std::move(picture), jpeg::orientation_of(bytes));
  return {picture.width, picture.height, std::move(picture.rgba)};
}

}  // namespace

Picture read_picture(const std::string& name, std::string_view bytes, Turning turning) {
  if (jpeg::is_jpeg(bytes)) return read_jpeg(name, bytes, turning);
  if (bytes.starts_with("\x89PNG")) return picture_of(decode_png(bytes, name, most_pixels));
  throw Error(Code::file_content,
              "cannot read " + name + ": it is neither a PNG nor a JPEG image; convert it to one of these",
              {{"file", name}});
}

}  // namespace ombre::formats

// Loads the module for JPEG files when the first is read.
#include "base/system/module_loader.h"
#include "jpeg/jpeg_image.h"
#include "jpeg/libjpeg_calls.h"

namespace ombre::jpeg {
namespace {

constexpr Module libjpeg{"ombre_libjpeg", "libjpeg-turbo", "JPEG images",
                         "libjpeg-dev",   "OMBRE_JPEG",    "save the images as PNG"};

}  // namespace

FileFormat file_format() {
  return {"JPEG",
          {".jpg", ".jpeg"},
          Content::image,
          true,
          false,
          &libjpeg,
          "inks (CMYK); more than 8 bits; damaged or missing data",
          "profiles of colours; the orientation of images that meshes name"};
}

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"); }

Picture decode(const std::string& name, std::string_view bytes, uint64_t most_pixels) {
  static const auto read = load_function<decltype(ombre_read_jpeg)>(libjpeg, "ombre_read_jpeg");
  Picture picture;
  read(&name, &bytes, most_pixels, &picture);
  return picture;
}

}  // namespace ombre::jpeg

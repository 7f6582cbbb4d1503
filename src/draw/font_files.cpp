// Locations of the system's fonts, with which pictures are labelled.
#include "draw/font_files.h"

#include <filesystem>

namespace ombre::draw {
namespace {

// Paths on Debian, Fedora, Arch and macOS: plain sans-serif fonts, those with many letters first.
constexpr const char* files[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
    "/usr/share/fonts/liberation-sans/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/freefont/FreeSans.ttf",
    "/usr/share/fonts/opentype/urw-base35/NimbusSans-Regular.otf",
    "/Library/Fonts/Arial.ttf",
    "/System/Library/Fonts/Supplemental/Arial.ttf",
};

}  // namespace

bool is_usual(const std::string& font_file) { return std::filesystem::path(font_file).filename() == "DejaVuSans.ttf"; }

std::optional<std::string> find_font_file() {
  for (const char* file : files) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return std::nullopt;
}

}  // namespace ombre::draw

// Loads the module for TIFF files when the first is read.
#include "tiff/pages.h"

#include "base/system/module_loader.h"
#include "tiff/libtiff_calls.h"

namespace ombre::tiff {
namespace {

constexpr Module libtiff{"ombre_libtiff", "libtiff",    "TIFF images",
                         "libtiff-dev",   "OMBRE_TIFF", "save the images as PNG"};

}  // namespace

FileFormat file_format() { return {"TIFF", {".tif", ".tiff"}, Content::image, true, false, &libtiff}; }

bool is_tiff(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv) || bytes.starts_with("II+\0"sv) ||
         bytes.starts_with("MM\0+"sv);
}

std::vector<Page> read_pages(const std::string& name, std::string_view bytes, Wanted wanted, const StopFlag* stop) {
  static const auto read = load_function<decltype(ombre_read_tiff)>(libtiff, "ombre_read_tiff");
  std::vector<Page> pages;
  read(&name, &bytes, wanted, stop, &pages);
  return pages;
}

}  // namespace ombre::tiff

// Loads the module for TIFF files when the first is read.
#include "tiff/pages.h"

#include "base/system/module_loader.h"
#include "tiff/libtiff_calls.h"

namespace ombre::tiff {
namespace {

constexpr Module libtiff{"ombre_libtiff", "libtiff",    "TIFF images",
                         "libtiff-dev",   "OMBRE_TIFF", "save the images as PNG"};

}  // namespace

FileFormat file_format() {
  return {"TIFF",
          {".tif", ".tiff"},
          Content::image,
          true,
          false,
          &libtiff,
          "half floats; complex numbers; several channels or frames without a choice; planes in several OME files",
          "thumbnails; smaller copies; masks; OME images after the first"};
}

bool is_tiff(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv) || bytes.starts_with("II+\0"sv) ||
         bytes.starts_with("MM\0+"sv);
}

Document read_document(const std::string& name, std::string_view bytes, Wanted wanted, const StopFlag* stop) {
  static const auto read = load_function<decltype(ombre_read_tiff)>(libtiff, "ombre_read_tiff");
  Document document;
  read(&name, &bytes, wanted, stop, &document);
  return document;
}

std::vector<Page> read_pages(const std::string& name, std::string_view bytes, Wanted wanted, const StopFlag* stop) {
  return read_document(name, bytes, wanted, stop).pages;
}

}  // namespace ombre::tiff

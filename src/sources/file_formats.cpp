#include "sources/file_formats.h"

#include <algorithm>

#include "cad/solids.h"
#include "dicom/series.h"
#include "formats/packages/mesh_formats.h"
#include "formats/results/result_formats.h"
#include "formats/volumes/volume_formats.h"
#include "jpeg/jpeg_image.h"
#include "sources/layer_images.h"
#include "tiff/pages.h"
#include "vdb/dense_grid.h"

namespace ombre::sources {
namespace {

std::vector<FileFormat> make_table() {
  std::vector<FileFormat> all;
  const auto add = [&](const std::vector<FileFormat>& formats) {
    all.insert(all.end(), formats.begin(), formats.end());
  };
  add(formats::mesh_file_formats());
  add(cad::file_formats());
  for (const formats::VolumeFormat& row : formats::volume_formats()) all.push_back(row.file);
  add({dicom::file_format()});
  add(vdb::file_formats());
  add(image_file_formats());
  add({jpeg::file_format()});
  FileFormat pages = tiff::file_format();
  pages.name = "TIFF of many pages";
  pages.content = Content::volume;
  add({pages});
  add({{"SVG",
        {".svg"},
        Content::drawing,
        true,
        true,
        nullptr,
        "masks; references to other files; clip paths in units of a box; attribute selectors of styles; @media; "
        "@import; "
        "transform-origin; lengths in em, ex or rem",
        "texts; images; outlines without a fill and a stroke; gaps of dashed lines; markers; effects of filters"},
       {"DXF",
        {".dxf"},
        Content::drawing,
        true,
        true,
        nullptr,
        "the binary form; text in UTF-16; splines whose knots do not fit",
        "paper space; invisible entities; texts; dimensions; meshes and solids in space; inserts of missing blocks; "
        "hatches within closed lines"},
       {"Common Layer Interface", {".cli"}, Content::outlines, false, true}});
  for (const formats::ResultFormat& row : formats::result_formats()) all.push_back(row.file);
  std::ranges::stable_sort(all, {}, &FileFormat::content);
  return all;
}

}  // namespace

const std::vector<FileFormat>& file_formats() {
  static const std::vector<FileFormat> all = make_table();
  return all;
}

bool is_read_as(const std::string& path, Content content) {
  return std::ranges::any_of(file_formats(), [&](const FileFormat& format) {
    return format.is_read && format.content == content && has_ending(path, format);
  });
}

}  // namespace ombre::sources

// Writes 3MF: an archive with a model, the relationships to it, and slicers' own files.
#include "formats/containers/xml_text.h"
#include "formats/containers/zip_archive.h"
#include "formats/packages/package_writers.h"
#include "formats/packages/three_mf_text.h"

namespace ombre::formats {
namespace {

std::string content_types() {
  return std::string(xml_declaration) +
         "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
         "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
         "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
         "<Default Extension=\"config\" ContentType=\"application/xml\"/>\n"
         "</Types>\n";
}

std::string relationships() {
  return std::string(xml_declaration) +
         "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
         "<Relationship Id=\"model\" Target=\"/" +
         three_mf_model_path +
         "\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n"
         "</Relationships>\n";
}

ZipEntry entry(const char* name, std::string text) {
  ZipEntry entry{name, {}};
  entry.bytes.add(std::move(text));
  return entry;
}

}  // namespace

bool can_write_3mf() { return can_write_zip(); }

void write_3mf(const std::string& path, const MeshDocument& document, SlicerFlavour flavour) {
  std::vector<ZipEntry> entries{entry("[Content_Types].xml", content_types()),
                                entry("_rels/.rels", relationships()),
                                {three_mf_model_path, three_mf_model(document, flavour)}};
  if (flavour != SlicerFlavour::bambu) entries.push_back(entry(prusa_settings_path, prusa_settings(document, flavour)));
  if (flavour != SlicerFlavour::prusa) entries.push_back(entry(bambu_settings_path, bambu_settings(document)));
  write_zip(path, entries);
}

}  // namespace ombre::formats

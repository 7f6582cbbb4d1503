// Writes 3MF: an archive with a model, the relationships to it, and slicers' own files.
#include "formats/containers/xml_text.h"
#include "formats/containers/zip_archive.h"
#include "formats/packages/package_writers.h"
#include "formats/packages/three_mf_text.h"
#include "formats/slicers/bambu_project.h"
#include "formats/slicers/height_ranges.h"
#include "formats/slicers/prusa_project.h"

namespace ombre::formats {
namespace {

std::string content_types() {
  return std::string(xml_declaration) +
         "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
         "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
         "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
         "<Default Extension=\"config\" ContentType=\"application/xml\"/>\n"
         "<Default Extension=\"json\" ContentType=\"application/json\"/>\n"
         "<Default Extension=\"xml\" ContentType=\"application/xml\"/>\n"
         "</Types>\n";
}

// Returns the relationship of the package, or of its main model, to a model.
std::string relationship_to(const std::string& model) {
  return std::string(xml_declaration) +
         "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
         "<Relationship Id=\"model\" Target=\"/" +
         model +
         "\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n"
         "</Relationships>\n";
}

constexpr const char* bambu_model_relations_path = "3D/_rels/3dmodel.model.rels";

ZipEntry entry(const char* name, std::string text) {
  ZipEntry entry{name, {}};
  entry.bytes.add(std::move(text));
  return entry;
}

void add_ranges(const MeshDocument& document, SlicerFlavour flavour, std::vector<ZipEntry>& entries) {
  std::string ranges = height_ranges(document, flavour, whole_object(document, flavour));
  if (ranges.empty()) return;
  entries.push_back(entry(is_of_bambu(flavour) ? bambu_ranges_path : prusa_ranges_path, std::move(ranges)));
}

void add_prusa_project(const MeshDocument& document, std::vector<ZipEntry>& entries) {
  entries.push_back(entry(prusa_project_path, prusa_project(document)));
  if (!document.project.mixtures.empty()) entries.push_back(entry(prusa_mixtures_path, prusa_mixtures(document)));
}

void add_bambu_project(const MeshDocument& document, SlicerFlavour flavour, std::vector<ZipEntry>& entries) {
  entries.push_back(entry(bambu_model_relations_path, relationship_to(bambu_objects_path)));
  entries.push_back({bambu_objects_path, bambu_objects(document)});
  entries.push_back(entry(bambu_project_path, bambu_project(document, flavour)));
}

}  // namespace

bool can_write_3mf() { return can_write_zip(); }

void write_3mf(const std::string& path, const MeshDocument& document, SlicerFlavour flavour) {
  std::vector<ZipEntry> entries{entry("[Content_Types].xml", content_types()),
                                entry("_rels/.rels", relationship_to(three_mf_model_path)),
                                {three_mf_model_path, three_mf_model(document, flavour)}};
  if (!is_of_bambu(flavour)) entries.push_back(entry(prusa_settings_path, prusa_settings(document, flavour)));
  if (flavour != SlicerFlavour::prusa) entries.push_back(entry(bambu_settings_path, bambu_settings(document, flavour)));
  if (flavour == SlicerFlavour::prusa) add_prusa_project(document, entries);
  if (is_of_bambu(flavour)) add_bambu_project(document, flavour, entries);
  if (is_project(flavour)) add_ranges(document, flavour, entries);
  write_zip(path, entries);
}

}  // namespace ombre::formats

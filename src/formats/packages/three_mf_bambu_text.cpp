// Writes the models of a project for Bambu Studio and OrcaSlicer.
#include <cstdio>

#include "formats/containers/xml_text.h"
#include "formats/packages/three_mf_mesh_text.h"
#include "formats/packages/three_mf_text.h"
#include "formats/slicers/bambu_project.h"
#include "formats/slicers/project_filaments.h"

namespace ombre::formats {
namespace {

// The first eight digits of an id count; the rest are those by which both programs mark objects of a kind.
constexpr std::string_view part_mark = "-61cb-4c03-9d28-80fed5dfa1dc", mesh_mark = "-81cb-4c03-9d28-80fed5dfa1dc",
                           component_mark = "-b206-40ff-9872-83e8017abed1", item_mark = "-b1ec-4553-aec9-835e5b724bb4",
                           build_mark = "2c7c17d8-22b5-4d84-8835-1976022ea369";

std::string unique_id(uint64_t count, std::string_view kind) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%08llx", static_cast<unsigned long long>(count));
  return xml_attribute("p:UUID", digits + std::string(kind));
}

std::string bambu_model_begin(const std::string& metadata) {
  return std::string(xml_declaration) +
         "<model unit=\"millimeter\" xml:lang=\"en-US\""
         " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\""
         " xmlns:BambuStudio=\"http://schemas.bambulab.com/package/2021\""
         " xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" requiredextensions=\"p\">\n" +
         metadata + "<metadata name=\"BambuStudio:3mfVersion\">1</metadata>\n<resources>\n";
}

size_t count_bodies(const MeshDocument& document) {
  size_t count = 0;
  for (const MeshBody& body : document.bodies)
    if (!body.triangles.empty()) ++count;
  return count;
}

}  // namespace

uint64_t whole_object(const MeshDocument& document, SlicerFlavour flavour) {
  return flavour == SlicerFlavour::prusa ? 1 : count_bodies(document) + 1;
}

LazyBytes bambu_model(const MeshDocument& document, SlicerFlavour flavour) {
  const uint64_t whole = count_bodies(document) + 1;
  std::string text =
      bambu_model_begin("<metadata name=\"Application\">BambuStudio-" + bambu_version(document, flavour) +
                        "</metadata>\n<metadata name=\"Generator\">ombre</metadata>\n<metadata name=\"Title\">" +
                        xml_escaped(document.title) + "</metadata>\n");
  text += "<object" + xml_attribute("id", std::to_string(whole)) + unique_id(1, part_mark) + " type=\"model\"" +
          xml_attribute("name", document.title) + ">\n<components>\n";
  for (uint64_t id = 1; id < whole; ++id)
    text += "<component" + xml_attribute("p:path", "/" + std::string(bambu_objects_path)) +
            xml_attribute("objectid", std::to_string(id)) + unique_id(0x10000 + id - 1, component_mark) + "/>\n";
  text += "</components>\n</object>\n</resources>\n<build" + xml_attribute("p:UUID", build_mark) + ">\n<item" +
          xml_attribute("objectid", std::to_string(whole)) + unique_id(whole, item_mark) +
          xml_attribute("transform", placement_on_bed(document, bambu_bed_mm)) +
          " printable=\"1\"/>\n</build>\n</model>\n";
  LazyBytes bytes;
  bytes.add(std::move(text));
  return bytes;
}

LazyBytes bambu_objects(const MeshDocument& document) {
  LazyBytes bytes;
  bytes.add(bambu_model_begin(""));
  uint64_t id = 1;
  for (const MeshBody& body : document.bodies) {
    if (body.triangles.empty()) continue;
    bytes.add("<object" + xml_attribute("id", std::to_string(id)) + unique_id(0x10000 + id - 1, mesh_mark) +
              " type=\"model\"" + xml_attribute("name", body.name) + ">\n");
    add_mesh(bytes, body, {.paint_attribute = "paint_color"});
    bytes.add("</object>\n");
    ++id;
  }
  bytes.add("</resources>\n<build/>\n</model>\n");
  return bytes;
}

}  // namespace ombre::formats

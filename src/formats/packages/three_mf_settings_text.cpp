// Writes slicers' own files for settings that 3MF does not support: the extruder and the infill of a region.
#include "formats/containers/xml_text.h"
#include "formats/packages/package_writers.h"
#include "formats/packages/three_mf_text.h"
#include "formats/slicers/slicer_settings.h"

namespace ombre::formats {
namespace {

std::string metadata(std::string_view type, std::string_view key, std::string_view value) {
  const std::string of = type.empty() ? "" : xml_attribute("type", type);
  return "<metadata" + of + xml_attribute("key", key) + xml_attribute("value", value) + "/>\n";
}

std::string prusa_object_begin(const MeshDocument& document, uint64_t id, const std::string& name) {
  std::string text = "<object" + xml_attribute("id", std::to_string(id)) + " instances_count=\"1\">\n" +
                     metadata("object", "name", name);
  for (const auto& [key, value] : in_words_of(SlicerFlavour::prusa, document.project.object_settings))
    text += metadata("object", key, value);
  return text;
}

std::string prusa_volume(const MeshBody& body, uint64_t first) {
  std::string text = "<volume" + xml_attribute("firstid", std::to_string(first)) +
                     xml_attribute("lastid", std::to_string(first + body.triangles.size() - 1)) + ">\n" +
                     metadata("volume", "name", body.name) + metadata("volume", "volume_type", "ModelPart");
  for (const auto& [key, value] : slicer_settings(body, SlicerFlavour::prusa)) text += metadata("volume", key, value);
  return text + "</volume>\n";
}

std::string bambu_part(const MeshBody& body, uint64_t id, SlicerFlavour flavour) {
  std::string text = "<part" + xml_attribute("id", std::to_string(id)) + " subtype=\"normal_part\">\n" +
                     metadata("", "name", body.name);
  for (const auto& [key, value] : slicer_settings(body, flavour)) text += metadata("", key, value);
  return text + "</part>\n";
}

// Returns the plate that holds the object.
std::string bambu_plate(uint64_t object) {
  return "<plate>\n" + metadata("", "plater_id", "1") + metadata("", "plater_name", "") +
         metadata("", "locked", "false") + "<model_instance>\n" + metadata("", "object_id", std::to_string(object)) +
         metadata("", "instance_id", "0") + metadata("", "identify_id", std::to_string(object)) +
         "</model_instance>\n</plate>\n<assemble>\n</assemble>\n";
}

}  // namespace

// Components become separate objects in PrusaSlicer; each then has one volume.
std::string prusa_settings(const MeshDocument& document, SlicerFlavour flavour) {
  const bool is_joint = flavour == SlicerFlavour::prusa;
  std::string text = std::string(xml_declaration) + "<config>\n";
  if (is_joint) text += prusa_object_begin(document, 1, document.title);
  uint64_t first = 0, id = 1;
  for (const MeshBody& body : document.bodies) {
    if (body.triangles.empty()) continue;
    if (!is_joint) text += prusa_object_begin(document, id++, body.name);
    text += prusa_volume(body, is_joint ? first : 0);
    if (!is_joint) text += "</object>\n";
    first += body.triangles.size();
  }
  if (is_joint) text += "</object>\n";
  return text + "</config>\n";
}

std::string bambu_settings(const MeshDocument& document, SlicerFlavour flavour) {
  // Generic files are read by both programs, whose settings have the same names.
  const SlicerFlavour words = is_of_bambu(flavour) ? flavour : SlicerFlavour::bambu;
  std::string parts;
  uint64_t id = 1;
  for (const MeshBody& body : document.bodies)
    if (!body.triangles.empty()) parts += bambu_part(body, id++, words);
  std::string text = std::string(xml_declaration) + "<config>\n<object" + xml_attribute("id", std::to_string(id)) +
                     ">\n" + metadata("", "name", document.title);
  for (const auto& [key, value] : in_words_of(words, document.project.object_settings))
    text += metadata("", key, value);
  text += parts + "</object>\n";
  if (is_project(flavour)) text += bambu_plate(id);
  return text + "</config>\n";
}

}  // namespace ombre::formats

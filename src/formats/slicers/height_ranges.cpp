#include "formats/slicers/height_ranges.h"

#include "base/text/text.h"
#include "formats/containers/xml_text.h"
#include "formats/slicers/slicer_settings.h"

namespace ombre::formats {

std::string height_ranges(const MeshDocument& document, SlicerFlavour flavour, uint64_t object) {
  if (document.project.ranges.empty()) return "";
  std::string text =
      std::string(xml_declaration) + "<objects>\n<object" + xml_attribute("id", std::to_string(object)) + ">\n";
  for (const HeightRange& range : document.project.ranges) {
    text += "<range" + xml_attribute("min_z", format_rounded(range.from_mm, 9)) +
            xml_attribute("max_z", format_rounded(range.to_mm, 9)) + ">\n";
    // Slicers expect both keys in every range; extruder 0 leaves bodies theirs.
    text += "<option opt_key=\"extruder\">0</option>\n";
    for (const auto& [key, value] : in_words_of(flavour, range.settings))
      text += "<option" + xml_attribute("opt_key", key) + '>' + xml_escaped(value) + "</option>\n";
    text += "</range>\n";
  }
  return text + "</object>\n</objects>\n";
}

}  // namespace ombre::formats

#include "formats/mesh/slicer_settings.h"

#include <algorithm>

namespace ombre::formats {

Settings slicer_settings(const MeshBody& body) {
  Settings settings = body.settings;
  const bool has_extruder =
      std::any_of(settings.begin(), settings.end(), [](const auto& setting) { return setting.first == "extruder"; });
  if (body.material && !has_extruder)
    settings.insert(settings.begin(), {"extruder", std::to_string(*body.material + 1)});
  return settings;
}

}  // namespace ombre::formats

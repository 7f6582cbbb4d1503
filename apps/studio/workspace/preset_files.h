// Recognises files of presets by their names and beginnings.
#pragma once

#include <filesystem>
#include <string>

namespace ombre::studio {

// The member of such a file that holds the presets.
inline constexpr const char* presets_member = "parameterSets";

// Returns the name of the presets file: part.scad has part.json, where OpenSCAD keeps them; part.vcad and others have
// part.presets.json.
std::string presets_file_of(const std::string& design);
// True if the file holds presets, by its name, and by its beginning if a script beside it has the same name.
bool is_presets_file(const std::filesystem::path& file);

}  // namespace ombre::studio

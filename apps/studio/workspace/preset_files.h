// Files of presets, by their names and beginnings.
#pragma once

#include <filesystem>
#include <string>

namespace ombre::studio {

// The member of such a file that holds the presets.
inline constexpr const char* presets_member = "parameterSets";

// part.scad has part.json, where OpenSCAD keeps them; part.vcad and others have part.presets.json.
std::string presets_file_of(const std::string& design);
// Does the file hold presets? By its name, and by what it begins with where a script beside it has the same name.
bool is_presets_file(const std::filesystem::path& file);

}  // namespace ombre::studio

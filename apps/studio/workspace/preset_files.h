// Recognizes files of presets by their names and first bytes.
#pragma once

#include <filesystem>
#include <string>

namespace ombre::studio {

// The member of a file of presets that contains them.
inline constexpr const char* presets_member = "parameterSets";

// Returns part.json for part.scad, as OpenSCAD does, and part.presets.json for part.vcad and others.
std::string presets_file_of(const std::string& design);
// Returns true if the file holds presets, judged by its name, and by its first bytes if there is a script of the same
// name beside it.
bool is_presets_file(const std::filesystem::path& file);

}  // namespace ombre::studio

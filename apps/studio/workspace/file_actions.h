// Actions on whole files of the folder: rename, duplicate, delete, make a folder.
#pragma once

#include <string>

#include "studio/workspace/workspace.h"

namespace ombre::studio {

// The folder, beside the designs, into which deleted files are moved. It is hidden, so the studio does not list it.
inline constexpr const char* trash_folder = ".ombre-trash";

// Each function throws RequestError "exists" if there is a file of the new name, "gone" if there is none of the old
// one, and "name" for names out of the folder; they throw Error if the system refuses. Presets go with their design.
void rename_file(const Workspace& workspace, const std::string& from, const std::string& to);
void duplicate_file(const Workspace& workspace, const std::string& from, const std::string& to);
void make_folder(const Workspace& workspace, const std::string& name);
// Moves a file into the trash and returns its path there.
std::string delete_file(const Workspace& workspace, const std::string& name);

}  // namespace ombre::studio

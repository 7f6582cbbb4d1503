// Studies as options give them.
#pragma once

#include <string>

#include "base/text/source_text.h"

namespace ombre::jobs {

// Whether the option holds the study itself, {"materials": ...}, in place of the path of a file.
bool is_study_text(const std::string& study);
// The text of a study, by whichever of both. Throws Error where the file cannot be read.
SourcePtr study_source(const std::string& study);
// The folder in which relative paths of the study begin: that of its file, or the working folder.
std::string study_folder(const std::string& study);

}  // namespace ombre::jobs

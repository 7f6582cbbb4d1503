// Reads studies, which options give as files or texts.
#pragma once

#include <string>

#include "base/text/source_text.h"

namespace ombre::jobs {

// True if the option holds the study itself, {"materials": ...}, instead of the path of a file.
bool is_study_text(const std::string& study);
// Returns the text of a study, from the option or the file. Throws Error if the file cannot be read.
SourcePtr study_source(const std::string& study);
// Returns the folder in which relative paths of the study begin: that of its file, or the working folder.
std::string study_folder(const std::string& study);

}  // namespace ombre::jobs

#include "jobs/common/study_source.h"

#include <filesystem>

#include "formats/containers/file.h"

namespace ombre::jobs {

bool is_study_text(const std::string& study) { return study.starts_with("{"); }

SourcePtr study_source(const std::string& study) {
  return is_study_text(study) ? make_source("study", study) : make_source(study, formats::read_file(study));
}

std::string study_folder(const std::string& study) {
  return is_study_text(study) ? "" : std::filesystem::path(study).parent_path().string();
}

}  // namespace ombre::jobs

// Describes files that designs read: meshes, CAD files, drawings, tables and images.
#pragma once

#include <optional>
#include <string>

#include "base/system/file_format.h"
#include "jobs/common/session.h"

namespace ombre::jobs {

// Returns the kind of the content of a file, by its name, if `show_summary` describes it.
std::optional<Content> summarised_content(const std::string& path);
// Prints what such a file holds; returns an exit code. Throws Error.
int show_summary(const std::string& path, Content content, Session& session);

}  // namespace ombre::jobs

#include "jobs/grid/scan_files.h"

#include <filesystem>

#include "base/text/json.h"
#include "jobs/common/session.h"
#include "load/load.h"
#include "sources/file_formats.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;

// Less than all numbers that a file may hold.
constexpr const char* least_number = "-1e300";

}  // namespace

bool is_scan(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return true;
  return sources::is_read_as(path, Content::volume);
}

compile::LoadedPtr load_scan(const compile::DesignOptions& arguments, Session& session, Diagnostics& diagnostics,
                             int threads) {
  const fs::path path = fs::absolute(arguments.design).lexically_normal();
  const fs::path file = path.has_filename() ? path : path.parent_path();
  const std::string name = print_json_line(Data(file.filename().string()));
  const std::string script = "scan = volume(" + name + ");\nattribute(\"number\", scan.value) attribute(\"nearest\", " +
                             "scan.nearest) volume_solid(" + name + ", level=" + least_number + ");\n";
  compile::LoadOptions options = arguments.load();
  options.stop = &session.stop;
  options.threads = threads;
  options.cache = &session.cache;
  return compile::load_text(script, (file.parent_path() / (file.filename().string() + ".vcad")).string(), options,
                            diagnostics);
}

}  // namespace ombre::jobs

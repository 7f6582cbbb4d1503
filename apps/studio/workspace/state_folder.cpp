#include "studio/workspace/state_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <string>

#include "base/system/environment.h"
#include "base/system/hash.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "export/output_file.h"
#include "formats/containers/file.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

std::string hash_of(const fs::path& root) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(root, error);
  return hash_bytes(error ? root.string() : whole.string()).hex();
}

}  // namespace

fs::path state_folder(const fs::path& root) {
  fs::path base = environment("XDG_STATE_HOME");
  const std::string home = environment("HOME");
  if (!base.is_absolute()) base = home.empty() ? fs::path() : fs::path(home) / ".local/state";
  return base.is_absolute() ? base / "ombre/studio" / hash_of(root) : fs::path();
}

uint16_t usual_port(const fs::path& root) {
  constexpr unsigned long first = 20000, count = 10000;
  constexpr size_t digits = 8;
  constexpr int hexadecimal = 16;
  return static_cast<uint16_t>(first + std::stoul(hash_of(root).substr(0, digits), nullptr, hexadecimal) % count);
}

void make_private_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) fs::permissions(folder, fs::perms::owner_all, error);
  if (error)
    throw Error(Code::cannot_write, "cannot make the folder " + folder.string() + ": " + error.message(),
                {{"file", folder.string()}});
}

void write_state(const fs::path& state, const std::string& name, const Data& data) {
  make_private_folder(state);
  exporting::write_file((state / name).string(), print_json_line(data), exporting::Durability::flushed);
}

std::optional<Data> read_state(const fs::path& state, const std::string& name) {
  std::error_code ignored;
  const fs::path file = state / name;
  if (!fs::is_regular_file(file, ignored)) return std::nullopt;
  try {
    Diagnostics none;
    return parse_json(make_source(file.string(), formats::read_file(file.string())), none);
  } catch (const Error&) {
    return std::nullopt;
  }
}

StateLock::StateLock(const fs::path& state) {
  if (state.empty()) return;
  try {
    make_private_folder(state);
  } catch (const Error&) {
    return;
  }
  constexpr mode_t own = 0600;
  file_ = ::open((state / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, own);
  if (file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(file_);
  file_ = -1;
}

StateLock::~StateLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace ombre::studio

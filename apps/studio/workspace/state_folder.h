// Keeps the state of a folder between starts of the studio, and says at which port the folder is shown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/system/not_copied.h"
#include "base/text/data.h"

namespace ombre::studio {

// Returns the folder for drafts and jobs of the designs in `root`, which only this user can read: in XDG_STATE_HOME, or
// else in .local/state of the user's home. Returns an empty path if the user has neither.
std::filesystem::path state_folder(const std::filesystem::path& root);

// Returns the port of a folder, from 20000 to 29999. It follows from the folder's path, so that the browser finds under
// the same address what it kept for the page.
uint16_t usual_port(const std::filesystem::path& root);

// The right to keep a folder's jobs, which one studio has at a time. It ends with the program, however that ends.
class StateLock : NotCopied {
 public:
  // Makes the folder. Without a folder, or where it cannot be written, nobody has the right.
  explicit StateLock(const std::filesystem::path& state);
  ~StateLock();

  bool is_held() const { return file_ >= 0; }

 private:
  int file_ = -1;
};

// Writes JSON to a file of the folder, which survives a power failure. Throws Error.
void write_state(const std::filesystem::path& state, const std::string& name, const Data& data);
// Returns nothing if there is no such file, or it holds no JSON.
std::optional<Data> read_state(const std::filesystem::path& state, const std::string& name);

// Creates a folder, with those above it, that only this user can read. Throws Error.
void make_private_folder(const std::filesystem::path& folder);

}  // namespace ombre::studio

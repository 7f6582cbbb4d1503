// Files that come in from the page, piece by piece.
#pragma once

#include <cstdint>
#include <list>
#include <mutex>
#include <string>

#include "base/system/not_copied.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// A piece of a file. The pieces of one file have the same id, and come in order.
struct UploadPiece {
  std::string id;    // letters and digits
  std::string file;  // name in the folder
  uint64_t at = 0;   // place of the first byte
  std::string_view bytes;
  bool is_last = false, replaces = false;
};

// Writes uploads beside their places, under a hidden name, and gives them their names when they are complete.
// Thread-safe.
class Uploads : NotCopied {
 public:
  static constexpr uint64_t most_bytes = uint64_t{8} << 30;
  static constexpr size_t most_open = 64;  // beyond it, the oldest unfinished file is given up

  explicit Uploads(const Workspace& workspace) : workspace_(workspace) {}
  ~Uploads();

  // Throws RequestError "exists" if there is a file of that name and it is not to be replaced, and others for names out
  // of the folder, unknown kinds of files and pieces out of order. Throws Error if the file cannot be written.
  void take(const UploadPiece& piece);

 private:
  struct Open {
    std::string id, part;
    uint64_t bytes = 0;
  };
  Open& open_one(const UploadPiece& piece, const std::filesystem::path& file);
  void forget(const std::string& id);

  const Workspace& workspace_;
  std::mutex mutex_;
  std::list<Open> open_;
};

}  // namespace ombre::studio

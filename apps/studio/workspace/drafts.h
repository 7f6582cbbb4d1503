// Texts that were typed and are not in their files yet. They outlive the page and the server.
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace ombre::studio {

struct Draft {
  std::string file;  // name in the folder; a file that was never saved has one too
  std::string text;
  std::string version;  // version of the file that the text was typed into; empty for a new file
  double time = 0;      // seconds since 1970
};

// Keeps one draft for each file, each in a file of its own. Without a folder nothing is kept. Thread-safe.
class Drafts {
 public:
  static constexpr size_t most = 200, most_bytes = size_t{8} << 20;

  explicit Drafts(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Replaces the draft of the file. Throws RequestError if it is too long or there are too many, and Error if it cannot
  // be written.
  void keep(const Draft& draft);
  void remove(const std::string& file);
  // Moves the draft of a renamed file.
  void rename(const std::string& from, const std::string& to);
  std::optional<Draft> find(const std::string& file) const;
  // Lists the drafts, the newest first. Files that hold no draft are passed over.
  std::vector<Draft> list() const;

 private:
  std::filesystem::path place(const std::string& file) const;

  std::filesystem::path folder_;
  mutable std::mutex mutex_;
};

}  // namespace ombre::studio

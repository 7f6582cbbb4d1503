// Files that the page has asked for and the browser is about to fetch.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "base/system/temporary_folder.h"

namespace ombre::studio {

// A file to be sent. One that was made for this purpose lies in a folder that is removed with it.
struct Download {
  std::string path;
  std::shared_ptr<const TemporaryFolder> holder = nullptr;
};

// Gives each file a random key, which works once. Keys that nobody uses are forgotten. Thread-safe.
class Downloads {
 public:
  static constexpr size_t most = 16;

  std::string add(Download download);
  // Returns null if there is no such key.
  std::shared_ptr<const Download> take(const std::string& key);

 private:
  struct Waiting {
    std::string key;
    std::shared_ptr<const Download> download;
  };
  std::mutex mutex_;
  std::list<Waiting> waiting_;  // the newest first
};

// Packs a folder with all files in it into a zip archive at `path`. Links, pipes, devices and hidden files are left
// out. `report` gets the share that is packed, 0 to 1. Throws RequestError if there are too many files, Cancelled if
// `report` throws it, and Error.
void zip_folder(const std::string& folder, const std::string& path, const std::function<void(double)>& report);

}  // namespace ombre::studio

// Keeps two runs from writing into one folder, or into one journal.
#include "stores/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/text/error.h"
#include "export/output_file.h"

namespace ombre::stores {
namespace {

// Returns false if another run holds the lock. Some network disks have no locks; there the user is trusted.
bool try_lock(int descriptor, int kind) { return ::flock(descriptor, kind | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

}  // namespace

FolderLock::FolderLock(const std::string& folder, Kind kind) {
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw Error(Code::cannot_read, "cannot open the folder " + folder + ": " + std::generic_category().message(errno),
                {{"file", folder}});
  if (try_lock(descriptor_, kind == Kind::alone ? LOCK_EX : LOCK_SH)) return;
  ::close(descriptor_);
  throw Error(Code::other_job, "another run is writing into " + folder + "; wait for it, or choose another folder",
              {{"file", folder}});
}

FolderLock::~FolderLock() { ::close(descriptor_); }

FileLock::FileLock(std::string path) : path_(std::move(path)) {
  // A run that ends between the opening and the lock removes the file; then the lock is of no file, and is taken again.
  do {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw exporting::write_error(path_, errno);
    if (try_lock(descriptor_, LOCK_EX)) continue;
    ::close(descriptor_);
    throw Error(Code::other_job, "another run does the same share of the job and holds " + path_ + "; wait for it",
                {{"file", path_}});
  } while (!is_current());
}

FileLock::~FileLock() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
}

bool FileLock::is_current() const {
  struct stat ours {
  }, there{};
  return ::fstat(descriptor_, &ours) == 0 && ::stat(path_.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
         ours.st_dev == there.st_dev;
}

}  // namespace ombre::stores

// Keeps two runs from writing into one folder.
#include "jobs/slice/job_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/text/error.h"

namespace ombre::compile {

FolderLock::FolderLock(const std::string& folder) {
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw Error(Code::cannot_read, "cannot open the folder " + folder + ": " + std::generic_category().message(errno),
                {{"file", folder}});
  // Some network disks have no locks; there the user is trusted.
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw Error(Code::other_job, "another run is writing into " + folder + "; wait for it, or choose another folder",
              {{"file", folder}});
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace ombre::compile

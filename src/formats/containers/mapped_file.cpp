#include "formats/containers/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/text/error.h"

namespace ombre::formats {

MappedFile::MappedFile(const std::string& path) {
  const auto fail = [&] {
    throw Error(Code::cannot_read, "cannot read " + path + ": " + std::generic_category().message(errno),
                {{"file", path}});
  };
  // A pipe would wait for somebody who writes to it; without waiting, it has no size and maps to nothing.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) fail();
  struct stat status {};
  const bool has_size = ::fstat(file, &status) == 0;
  size_ = has_size ? static_cast<size_t>(status.st_size) : 0;
  begin_ = size_ > 0 ? ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, file, 0) : nullptr;
  const int reason = errno;
  ::close(file);
  errno = reason;
  if (!has_size || begin_ == MAP_FAILED) fail();
}

MappedFile::~MappedFile() {
  if (begin_) ::munmap(begin_, size_);
}

}  // namespace ombre::formats

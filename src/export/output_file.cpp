// Writes files atomically: they appear complete or not at all.
#include "export/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace ombre::exporting {
namespace {

std::string advice(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "; free some space there and try again, or choose another folder";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; choose a folder that you may write to";
    case ENOTDIR:
      return "; part of the path is a file, choose another folder";
    case ENOENT:
      return "; the folder is missing";
    case EISDIR:
    case ENOTEMPTY:
      return "; a folder has this name, choose another";
    case ENAMETOOLONG:
      return "; choose a shorter name";
    default:
      return "";
  }
}

// Returns 0 or an errno.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return 0;
}

}  // namespace

Error write_error(const std::string& path, int error) {
  return {error == ENOSPC || error == EDQUOT ? Code::disk_space : Code::cannot_write,
          "cannot write " + path + ": " + std::generic_category().message(error) + advice(error),
          {{"file", path}}};
}

PendingFile::~PendingFile() {
  if (!is_committed_) ::unlink(part_.c_str());
}

void PendingFile::commit() {
  if (std::rename(part_.c_str(), path_.c_str()) != 0) throw write_error(path_, errno);
  is_committed_ = true;
}

NewFile::NewFile(std::string path) : file_(std::move(path)) {
  descriptor_ = ::open(file_.part().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw write_error(file_.path(), errno);
}

NewFile::~NewFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void NewFile::append(std::string_view bytes) {
  if (const int error = write_all(descriptor_, bytes); error != 0) throw write_error(file_.path(), error);
}

void NewFile::write_at(uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw write_error(file_.path(), errno);
    offset += static_cast<uint64_t>(written);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
}

void NewFile::close(Durability durability) {
  int error = 0;
  if (durability == Durability::flushed && ::fsync(descriptor_) != 0) error = errno;
  // Network file systems report a full disk only when a file is closed.
  if (::close(std::exchange(descriptor_, -1)) != 0 && error == 0) error = errno;
  if (error != 0) throw write_error(file_.path(), error);
}

void write_file(const std::string& path, std::string_view bytes, Durability durability) {
  NewFile file(path);
  file.append(bytes);
  file.close(durability);
  file.commit();
}

AppendFile::AppendFile(std::string path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw write_error(path_, errno);
}

AppendFile::~AppendFile() { ::close(descriptor_); }

void AppendFile::append(std::string_view bytes) {
  if (const int error = write_all(descriptor_, bytes); error != 0) throw write_error(path_, error);
}

}  // namespace ombre::exporting

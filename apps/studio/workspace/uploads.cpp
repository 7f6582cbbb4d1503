#include "studio/workspace/uploads.h"

#include <algorithm>
#include <cerrno>
#include <fstream>

#include "export/output_file.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

bool is_sound_id(const std::string& id) {
  return !id.empty() && id.size() <= 64 &&
         std::ranges::all_of(id, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; });
}

}  // namespace

Uploads::~Uploads() {
  std::error_code ignored;
  for (const Open& open : open_) fs::remove(open.part, ignored);
}

void Uploads::forget(const std::string& id) {
  std::error_code ignored;
  std::erase_if(open_, [&](const Open& open) { return open.id == id && (fs::remove(open.part, ignored), true); });
}

Uploads::Open& Uploads::open_one(const UploadPiece& piece, const fs::path& file) {
  if (piece.at == 0) {
    forget(piece.id);
    if (open_.size() >= most_open) forget(open_.front().id);
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    open_.push_back({piece.id, (file.parent_path() / (".upload_" + piece.id)).string()});
    const std::ofstream empty(open_.back().part, std::ios::binary | std::ios::trunc);
    return open_.back();
  }
  const auto found = std::ranges::find(open_, piece.id, &Open::id);
  if (found == open_.end() || found->bytes != piece.at)
    throw RequestError("request", "a piece of " + piece.file + " is out of order; send the file again");
  return *found;
}

void Uploads::take(const UploadPiece& piece) {
  if (!is_sound_id(piece.id)) throw RequestError("request", "\"upload\" is a name of letters and digits");
  const fs::path file = workspace_.path(piece.file);
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) throw RequestError("exists", piece.file + " is a folder");
  if (fs::exists(file, ignored) && !piece.replaces) throw RequestError("exists", piece.file + " is there already");
  const std::lock_guard lock(mutex_);
  Open& open = open_one(piece, file);
  if (open.bytes + piece.bytes.size() > most_bytes) {
    forget(piece.id);
    throw RequestError("size", piece.file + " is too large to come in by the page; copy it into the folder");
  }
  errno = 0;
  std::ofstream stream(open.part, std::ios::binary | std::ios::app);
  stream.write(piece.bytes.data(), static_cast<std::streamsize>(piece.bytes.size()));
  stream.close();
  if (!stream) {
    const int problem = errno;
    forget(piece.id);
    throw exporting::write_error(file.string(), problem);
  }
  open.bytes += piece.bytes.size();
  if (!piece.is_last) return;
  std::error_code error;
  fs::rename(open.part, file, error);
  forget(piece.id);
  if (error) throw exporting::write_error(file.string(), error.value());
}

}  // namespace ombre::studio

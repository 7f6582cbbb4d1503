#include "studio/workspace/drafts.h"

#include <algorithm>
#include <chrono>

#include "base/system/hash.h"
#include "studio/workspace/state_folder.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* ending = ".json";

double now() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

std::string text_in(const Data& data, std::string_view name) {
  const Data* found = data.find(name);
  return found && found->string() ? *found->string() : "";
}

// Returns null for a file that holds no draft, for example one that the user changed.
std::optional<Draft> read_draft(const fs::path& path) {
  const auto data = read_state(path.parent_path(), path.filename().string());
  if (!data || !data->members() || text_in(*data, "file").empty()) return std::nullopt;
  const Data* time = data->find("time");
  return Draft{text_in(*data, "file"), text_in(*data, "text"), text_in(*data, "version"),
               time && time->number() ? *time->number() : 0};
}

}  // namespace

fs::path Drafts::place(const std::string& file) const { return folder_ / (hash_bytes(file).hex() + ending); }

void Drafts::keep(const Draft& draft) {
  if (folder_.empty()) return;
  if (draft.text.size() > most_bytes) throw RequestError("size", "the text is too long to be kept as a draft");
  const std::lock_guard lock(mutex_);
  make_private_folder(folder_);
  const fs::path path = place(draft.file);
  std::error_code error;
  const auto count = std::distance(fs::directory_iterator(folder_, error), fs::directory_iterator());
  if (static_cast<size_t>(count) >= most && !fs::exists(path, error))
    throw RequestError("busy", "there are too many drafts; save some files");
  write_state(folder_, path.filename().string(),
              DataMembers{{"file", draft.file},
                          {"text", draft.text},
                          {"version", draft.version},
                          {"time", draft.time > 0 ? draft.time : now()}});
}

void Drafts::remove(const std::string& file) {
  if (folder_.empty()) return;
  const std::lock_guard lock(mutex_);
  std::error_code ignored;
  fs::remove(place(file), ignored);
}

void Drafts::rename(const std::string& from, const std::string& to) {
  auto draft = find(from);
  if (!draft) return;
  draft->file = to;
  keep(*draft);
  remove(from);
}

std::optional<Draft> Drafts::find(const std::string& file) const {
  if (folder_.empty()) return std::nullopt;
  const std::lock_guard lock(mutex_);
  auto draft = read_draft(place(file));
  return draft && draft->file == file ? draft : std::nullopt;
}

std::vector<Draft> Drafts::list() const {
  std::vector<Draft> found;
  if (folder_.empty()) return found;
  const std::lock_guard lock(mutex_);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    if (found.size() >= most) break;
    if (entry.path().extension() != ending) continue;
    if (auto draft = read_draft(entry.path())) found.push_back(std::move(*draft));
  }
  std::ranges::sort(found, std::ranges::greater(), &Draft::time);
  return found;
}

}  // namespace ombre::studio

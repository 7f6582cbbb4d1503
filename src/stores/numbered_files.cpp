#include "stores/numbered_files.h"

#include <charconv>

namespace ombre::stores {

std::string NumberedFiles::name_of(int64_t id, int64_t count) const {
  return words_.id_name + "_" + piece_number(id, count) + words_.file_ending;
}

bool NumberedFiles::is_piece(std::string_view name, int64_t count) const {
  const size_t prefix = words_.id_name.size() + 1;
  int64_t id = -1;
  if (name.size() > prefix) std::from_chars(name.data() + prefix, name.data() + name.size(), id);
  return id >= 0 && id < count && name == name_of(id, count);
}

std::string NumberedFiles::description(const Entries& finished) const {
  return described({{words_.pieces, number(count_)}, {"status", is_complete(finished) ? "complete" : "unfinished"}});
}

bool NumberedFiles::accepts(const Entry& entry) const {
  return entry.id >= 0 && entry.id < count_ && entry.files.size() == 1 && entry.files[0].name == file_name(entry.id);
}

std::optional<NameTest> NumberedFiles::files_of(const Data& description) const {
  constexpr uint64_t most_files = 1'000'000;
  const auto count = whole_number(description.find(words_.pieces));
  if (!count || *count == 0 || *count > most_files) return std::nullopt;
  return [*this, count](std::string_view name) { return is_piece(name, static_cast<int64_t>(*count)); };
}

}  // namespace ombre::stores

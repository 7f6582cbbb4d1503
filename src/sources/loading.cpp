#include "sources/loading.h"

#include <filesystem>

#include "base/system/assert.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "sources/find_file.h"

namespace ombre::sources {

namespace {

// Returns the code of an error, or `otherwise` if it has none, as those of file readers.
Code code_of(const Error& error, Code otherwise) { return error.code() == Code::machine ? otherwise : error.code(); }

}  // namespace

bool Loader::is_new(const Hash& key) {
  const std::scoped_lock lock(mutex_);
  return reported_.insert(key).second;
}

std::string Loader::first_with_other_axes(const std::string& path, design::PatientSpace space) {
  const bool is_patient = space == design::PatientSpace::ras || space == design::PatientSpace::lps;
  if (!is_patient) return "";
  const std::scoped_lock lock(mutex_);
  first_in_space_.try_emplace(space, path);
  if (has_reported_axes_ || first_in_space_.size() < 2) return "";
  has_reported_axes_ = true;
  const bool is_ras = space == design::PatientSpace::ras;
  return first_in_space_.at(is_ras ? design::PatientSpace::lps : design::PatientSpace::ras);
}

std::shared_ptr<const void> Loader::find(design::SourceRequest request, const design::Reader& reader) {
  Loading loading(*this, reader);
  return std::visit([&](auto* kind) -> std::shared_ptr<const void> { return kind->load(loading); }, request);
}

std::string hint_of_names(const std::string& name, std::vector<std::string> names, const std::string& without_names) {
  if (names.empty()) return without_names;
  if (std::string meant = did_you_mean(name, names); !meant.empty()) return meant;
  constexpr size_t most_listed = 20;
  const bool is_cut = names.size() > most_listed;
  if (is_cut) names.resize(most_listed);
  return "there are \"" + join(names, "\", \"") + '"' + (is_cut ? " and more" : "");
}

Key& Key::add(std::string_view word) {
  text_.append(std::to_string(word.size())).append(" ").append(word);
  return *this;
}

Key& Key::add(double number) { return add(format_number(number)); }

bool Loading::find(design::FilePath& file) {
  const auto found = find_file(file.path, reader_.where, reader_.diagnostics);
  if (found) file.path = *found;
  return found.has_value();
}

std::optional<std::string> Loading::included(const std::string& path) { return read_included(path, loader_.cache()); }

bool Loading::read_content(design::FilePath& file) {
  try {
    const auto content = loader_.cache().files().content(file.path);
    contents_[file.path] = content;
    file.content = content.hash;
    return true;
  } catch (const Error& error) {
    reader_.diagnostics.error(code_of(error, Code::cannot_read), reader_.where, error.what(), {},
                              {{"file", file.path}});
    return false;
  }
}

design::FilePath beside(const design::FilePath& file, const std::string& name) {
  return {(std::filesystem::path(file.path).parent_path() / name).string(), {}};
}

std::optional<FilesBeside> Loading::read_beside(design::FilePath& file, std::string_view kind, NamesOfFiles names) {
  FilesBeside files;
  if (!names) return files;
  using Names = std::vector<std::string>;
  const Hash key = Key("names of files").add(kind).add(file.content).hash();
  const auto named = cached<Names>(key, file.path, [&](const design::Reader&) {
    return Made<Names>{std::make_shared<const Names>(names(file.path, *bytes(file))), 0};
  });
  if (!named) return std::nullopt;
  Key content("file and files beside it");
  content.add(file.content);
  for (const std::string& name : *named) {
    design::FilePath other = beside(file, name);
    if (!read_content(other)) return std::nullopt;
    content.add(name).add(other.content);
    files[name] = bytes(other);
  }
  if (!files.empty()) file.content = content.hash();
  return files;
}

std::shared_ptr<const std::string> Loading::bytes(const design::FilePath& file) {
  const auto content = contents_.find(file.path);
  ASSERT(content != contents_.end());
  return loader_.cache().files().bytes(file.path, content->second);
}

FileView Loading::view(const design::FilePath& file) {
  const auto content = contents_.find(file.path);
  ASSERT(content != contents_.end());
  return loader_.cache().files().view(file.path, content->second);
}

CacheEntryPtr Loading::entry_for(const Hash& key, const std::string& name, const MakeAny& make) {
  CacheEntryPtr known = loader_.cache().find(key);
  // Cached remarks under another name cannot be reused.
  const bool is_usable = known && (known->name == name || known->remarks.list().empty());
  const bool is_new = loader_.is_new(key);
  if (is_usable) {
    if (is_new) report_again(*known);
    return known;
  }
  CacheEntry entry{nullptr, 0, name, reader_.where, {}};
  const design::Reader reader{reader_.materials, entry.remarks, reader_.loader,
                              reader_.where,     reader_.node,  reader_.name};
  try {
    std::tie(entry.value, entry.bytes) = make(reader);
  } catch (const Error& error) {
    reader.diagnostics.error(code_of(error, Code::file_content), reader.where, error.what(), {}, error.values());
  }
  entry.remarks.tell_code(0, Code::file_content, {{"file", name}});
  reader_.diagnostics.add_all(entry.remarks);
  if (!entry.value || entry.remarks.has_errors()) return nullptr;
  if (known) return std::make_shared<const CacheEntry>(std::move(entry));
  return loader_.cache().add(key, std::move(entry));
}

void Loading::report_again(const CacheEntry& entry) const {
  for (Diagnostic remark : entry.remarks.list()) {
    if (remark.where == entry.where) remark.where = reader_.where;
    reader_.diagnostics.add(std::move(remark));
  }
}

}  // namespace ombre::sources

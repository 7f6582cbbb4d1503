#include "load/bundle.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "base/system/named_files.h"
#include "base/system/temporary_folder.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/record.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "formats/containers/zip_archive.h"
#include "load/data_folder.h"
#include "load/files_read.h"
#include "load/library_folders.h"
#include "load/load.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

constexpr const char* note_name = "bundle.json";
constexpr const char* how_to_make_one = "ombre bundle part.vcad -o part.ombre makes a bundle";
constexpr uint64_t any_ratio = 1100;  // deflate packs at most 1032 to 1; the size of a bundle is bounded elsewhere

bool is_within(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

fs::path common_folder(const fs::path& a, const fs::path& b) {
  fs::path common;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end() && *i == *j; ++i, ++j) common /= *i;
  return common;
}

// True for the materials files that come with Ombre.
bool is_of_ombre(const fs::path& file) {
  return is_within(file, fs::weakly_canonical(fs::path(data_folder()) / "materials"));
}

bool is_of_system(const fs::path& file) { return is_within(file, "/usr") || is_of_ombre(file); }

// True for a path that cannot lead out of the bundle, on any system.
bool is_sound(const std::string& name) {
  constexpr size_t longest = 1000;
  if (name.empty() || name.size() > longest || name.front() == '/') return false;
  for (const char c : name)
    if (static_cast<unsigned char>(c) < ' ' || c == '\\' || c == ':') return false;
  return std::ranges::none_of(split(name, '/'),
                              [](const std::string& part) { return part.empty() || part == "." || part == ".."; });
}

std::string note_of(const std::string& design, const std::string& materials) {
  DataMembers members{{"ombre_bundle", 1.0}, {"design", design}};
  if (!materials.empty()) members.emplace_back("materials", materials);
  return print_json(Data(std::move(members))) + "\n";
}

class Packer {
 public:
  Packer(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics)
      : design_(whole_path(path)), options_(options), diagnostics_(diagnostics) {
    if (!options.materials.empty()) materials_ = whole_path(options.materials);
  }

  std::optional<BundleContents> pack(const std::string& output) {
    const auto files = files_read(design_.string(), options_, diagnostics_);
    if (!files) return std::nullopt;
    choose(*files);
    std::vector<formats::ZipEntry> entries;
    for (const fs::path& file : chosen_) {
      if (!is_sound(name_of(file))) return refuse(file.string() + " has a name that not every system allows");
      add(name_of(file), formats::read_file(file.string()), entries);
    }
    add(note_name, note_of(name_of(design_), materials_.empty() ? "" : name_of(materials_)), entries);
    exporting::PendingFile pending(output);
    try {
      formats::write_zip(pending.part(), entries);
    } catch (const std::system_error& error) {
      throw exporting::write_error(output, error.code().value());
    }
    if (!opens_by_itself(pending.part())) return std::nullopt;
    pending.commit();
    return contents_;
  }

 private:
  void choose(const std::set<fs::path>& files) {
    root_ = design_.parent_path();
    for (const fs::path& file : files) {
      if (const auto name = name_in_library(file)) {
        libraries_[file] = *name;
        continue;
      }
      if (is_of_system(file) && !is_within(file, design_.parent_path())) {
        if (!is_of_ombre(file)) contents_.left_outside.push_back(file.string());
        continue;
      }
      root_ = common_folder(root_, file.parent_path());
      chosen_.insert(file);
    }
    chosen_.insert(design_);
    contents_.design = name_of(design_);
    for (const auto& [file, name] : libraries_) chosen_.insert(file);
    for (const fs::path& file : chosen_) contents_.files.push_back(name_of(file));
    std::ranges::sort(contents_.files);
  }

  // Libraries lie beside the design, where `use` looks for them first.
  std::string name_of(const fs::path& file) const {
    const auto library = libraries_.find(file);
    const fs::path place = library == libraries_.end() ? file : design_.parent_path() / library->second;
    return place.lexically_relative(root_).generic_string();
  }

  static void add(const std::string& name, std::string bytes, std::vector<formats::ZipEntry>& entries) {
    formats::LazyBytes lazy;
    lazy.add(std::move(bytes));
    entries.push_back({name, std::move(lazy)});
  }

  std::nullopt_t refuse(const std::string& problem, const Phrase& hint = {}) {
    diagnostics_.error(Code::file_content, {make_source(design_.string(), ""), 0, 0}, problem, hint,
                       {{"file", design_.string()}});
    return std::nullopt;
  }

  // True if a bundle's design reads only files of the bundle.
  bool opens_by_itself(const std::string& bundle) {
    const TemporaryFolder folder;
    const auto unpacked = unpack_bundle(bundle, formats::read_file(bundle), folder.path() / "bundle", diagnostics_);
    if (!unpacked) return false;
    LoadOptions options = options_;
    options.materials = unpacked->materials.string();
    options.echo = nullptr;
    const fs::path own = fs::canonical(folder.path());
    Diagnostics found;
    const auto files = files_read(unpacked->design.string(), options, found);
    if (!files) {
      diagnostics_.add_all(found);
      refuse("the design does not find its files in the bundle",
             "write their names relative to the script, as in mesh(\"models/part.stl\")");
      return false;
    }
    for (const fs::path& file : *files) {
      if (is_within(file, own) || is_of_system(file)) continue;
      refuse("the design reads " + file.string() + ", which it would not find in a bundle",
             "name it relative to the script, as in mesh(\"models/part.stl\")");
      return false;
    }
    return true;
  }

  fs::path design_, materials_, root_;
  LoadOptions options_;
  Diagnostics& diagnostics_;
  std::set<fs::path> chosen_;
  std::map<fs::path, std::string> libraries_;  // files of libraries, and their names in these
  BundleContents contents_;
};

// The files that a bundle's note names.
struct Note {
  std::string design, materials;
};

std::optional<std::string> read_name(const Data& data, const MemberReader& reader) {
  if (data.string() && is_sound(*data.string())) return *data.string();
  reader.fail(data, "this names no file of the bundle, but " + describe(data));
  return std::nullopt;
}

// Reads the paths in a bundle's note. Returns nothing, and adds a diagnostic, if the text is not a note.
std::optional<UnpackedBundle> read_note(const std::string& name, const std::string& text, const fs::path& folder,
                                        Diagnostics& diagnostics) {
  static const Record<Note> record =
      Record<Note>("the note of a bundle", {field::value("design", &Note::design, read_name).required(how_to_make_one),
                                            field::value("materials", &Note::materials, read_name)})
          .knows({"ombre_bundle"});
  const size_t known = diagnostics.list().size();
  const auto data = parse_json(make_source(name + "/" + note_name, text), diagnostics);
  Note note;
  const bool is_note = data && record.read(*data, note, MemberReader(diagnostics));
  diagnostics.tell_code(known, Code::file_content, {{"file", name}});
  if (!is_note) return std::nullopt;
  UnpackedBundle unpacked{folder / note.design, note.materials.empty() ? fs::path() : folder / note.materials};
  for (const fs::path& file : {unpacked.design, unpacked.materials}) {
    if (file.empty() || fs::is_regular_file(file)) continue;
    diagnostics.error(Code::file_content, {make_source(name, ""), 0, 0},
                      "it lacks its file " + file.filename().string(), how_to_make_one, {{"file", name}});
    return std::nullopt;
  }
  return unpacked;
}

void unpack_all(formats::ZipReader& archive, const fs::path& folder,
                const std::function<void(const std::string&)>& wrong) {
  for (const std::string& entry : archive.names()) {
    if (entry.ends_with('/') && is_sound(entry.substr(0, entry.size() - 1))) continue;
    if (!is_sound(entry)) wrong("it has a file whose name leads out of it, or that not every system allows: " + entry);
    if (archive.is_link(entry)) wrong("its file " + entry + " is a link, which could lead out of it");
    const fs::path file = folder / entry;
    if (fs::exists(file)) wrong("it has two files called " + entry);
    fs::create_directories(file.parent_path());
    exporting::write_file(file.string(), archive.read(entry));
  }
}

}  // namespace

bool is_bundle(const std::string& path) { return to_lower(path).ends_with(bundle_ending); }

std::optional<BundleContents> write_bundle(const std::string& path, const std::string& output,
                                           const LoadOptions& options, Diagnostics& diagnostics) {
  return Packer(path, options, diagnostics).pack(output);
}

std::optional<UnpackedBundle> unpack_bundle(const std::string& name, std::string_view bytes, const fs::path& folder,
                                            Diagnostics& diagnostics) {
  const auto wrong = [&](const std::string& problem) {
    diagnostics.error(Code::file_content, {make_source(name, ""), 0, 0}, problem, {}, {{"file", name}});
    throw DesignError();
  };
  try {
    if (!formats::is_zip(bytes)) wrong("this is no bundle: expected a zip archive, as ombre bundle makes it");
    formats::ZipReader archive(name, bytes, diagnostics, {.ratio = any_ratio});
    if (!archive.has(note_name)) wrong("this zip archive is no bundle: it has no " + std::string(note_name));
    fs::create_directories(folder);
    unpack_all(archive, folder, wrong);
    return read_note(name, formats::read_file((folder / note_name).string()), folder, diagnostics);
  } catch (const DesignError&) {
    return std::nullopt;
  } catch (const fs::filesystem_error& error) {
    throw exporting::write_error(folder.string(), error.code().value());
  }
}

std::optional<UnpackedBundle> find_unpacked(const fs::path& folder) {
  Diagnostics ignored;
  if (!fs::is_regular_file(folder / note_name)) return std::nullopt;
  return read_note(folder.string(), formats::read_file((folder / note_name).string()), folder, ignored);
}

LoadedPtr load_bundle(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics) {
  const auto folder = std::make_shared<const TemporaryFolder>();
  // In messages, paths of its files begin with the name of the bundle.
  const fs::path inside = folder->path() / fs::path(path).filename();
  const auto unpacked = unpack_bundle(path, formats::read_file(path), inside, diagnostics);
  if (!unpacked) return nullptr;
  LoadOptions own = options;
  if (own.materials.empty()) own.materials = unpacked->materials.string();
  LoadedPtr loaded = load_design(unpacked->design.string(), own, diagnostics);
  if (!loaded) return nullptr;
  const auto kept = std::make_shared<std::pair<std::shared_ptr<const TemporaryFolder>, LoadedPtr>>(folder, loaded);
  return {kept, kept->second.get()};
}

}  // namespace ombre::compile

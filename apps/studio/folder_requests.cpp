// Requests about whole files of the folder: drafts, names, files that come in and go out.
#include "base/text/error.h"
#include "formats/containers/base64.h"
#include "formats/containers/zip_archive.h"
#include "studio/data_scripts.h"
#include "studio/studio.h"
#include "studio/workspace/file_actions.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t most_offset = uint64_t{1} << 53;

// Returns a name for a design beside a file that is not taken yet: part.vcad, part_2.vcad, ...
std::string free_name(const Workspace& workspace, const std::string& file, const std::string& ending) {
  constexpr int most_tries = 1000;
  const std::string stem = fs::path(file).replace_extension().generic_string();
  for (int n = 1; n <= most_tries; ++n) {
    std::string name = stem;
    if (n > 1) name += "_" + std::to_string(n);
    name += ending;
    if (!fs::exists(workspace.path(name))) return name;
  }
  throw RequestError("exists", "there are too many designs called " + stem);
}

}  // namespace

void Studio::tell_list() { broadcast("list", listed()); }

Answer Studio::keep_draft(const Request& request, const StopFlag&) {
  const std::string& file = request.text("file");
  (void)workspace_.path(file);  // refuses names out of the folder
  drafts_.keep({file, request.text("text"), request.text("version", "")});
  return {};
}

Answer Studio::drop_draft(const Request& request, const StopFlag&) {
  drafts_.remove(request.text("file"));
  return {};
}

Answer Studio::rename(const Request& request, const StopFlag&) {
  const std::string &from = request.text("file"), &to = request.text("to");
  rename_file(workspace_, from, to);
  drafts_.rename(from, to);
  tell_list();
  return {};
}

Answer Studio::duplicate(const Request& request, const StopFlag&) {
  duplicate_file(workspace_, request.text("file"), request.text("to"));
  tell_list();
  return {};
}

Answer Studio::remove_file(const Request& request, const StopFlag&) {
  const std::string& file = request.text("file");
  const std::string place = delete_file(workspace_, file);
  drafts_.remove(file);
  tell_list();
  return {{{"trash", place}}, {}};
}

Answer Studio::make_folder(const Request& request, const StopFlag&) {
  studio::make_folder(workspace_, request.text("name"));
  return {};
}

// Lists those of the files that are there, before uploads replace them.
Answer Studio::is_there(const Request& request, const StopFlag&) {
  DataList found;
  for (const std::string& file : request.texts("files"))
    if (std::error_code ignored; fs::exists(workspace_.path(file), ignored)) found.emplace_back(file);
  return {{{"files", std::move(found)}}, {}};
}

Answer Studio::upload(const Request& request, const StopFlag&) {
  const auto bytes = formats::from_base64(request.text("bytes"));
  if (!bytes) throw RequestError("request", "\"bytes\" is a piece of the file in base64");
  UploadPiece piece;
  piece.id = request.text("upload");
  piece.file = request.text("file");
  piece.at = static_cast<uint64_t>(request.whole("at", 0, most_offset));
  piece.bytes = *bytes;
  piece.is_last = request.flag("last");
  piece.replaces = request.flag("replace");
  uploads_.take(piece);
  if (piece.is_last) tell_list();
  return {};
}

// Makes a design that imports a file of the folder, and returns its name.
Answer Studio::import(const Request& request, const StopFlag&) {
  const std::string& file = request.text("file");
  const fs::path path = workspace_.plain_path(file);
  if (!fs::exists(path)) throw RequestError("gone", "there is no file " + file);
  const ImportingDesign design = importing_design(file, path);
  const std::string name = free_name(workspace_, file, design.ending);
  workspace_.save(name, design.text, "");
  tell_list();
  return {{{"file", name}}, {}};
}

// Answers with an address from which the browser fetches a file of the folder, or what a job has written, once.
Answer Studio::download(const Request& request, const StopFlag&) {
  Download made;
  if (request.body.find("job"))
    made = exports_.output(request.whole("job", 0, most_offset));
  else
    made.path = workspace_.plain_path(request.text("file")).string();
  if (!fs::is_regular_file(made.path)) throw RequestError("gone", "there is no file " + made.path);
  const std::string name = fs::path(made.path).filename().string();
  return {{{"address", "/download/" + downloads_.add(std::move(made))}, {"name", name}}, {}};
}

// Packs a folder, or the one that a job has written, for a download.
Answer Studio::zip(const Request& request, const StopFlag& stop) {
  const bool is_of_job = request.body.find("job") != nullptr;
  const fs::path folder = is_of_job ? fs::path(exports_.output(request.whole("job", 0, most_offset)).path)
                                    : workspace_.path(request.text("folder"));
  if (!fs::is_directory(folder)) throw RequestError("gone", "there is no folder " + folder.string());
  if (!formats::can_write_zip()) throw RequestError("unsupported", "this studio was built without zip archives");
  const auto holder = std::make_shared<const TemporaryFolder>();
  const std::string name = folder.filename().string() + ".zip", path = holder->file(name);
  const double id = request.id;
  Stopwatch since;
  zip_folder(folder.string(), path, [&](double share) {
    constexpr double interval_s = 0.2;
    if (stop.requested()) throw Cancelled();
    if (since.seconds() < interval_s) return;
    since = {};
    broadcast("zipping", {{"name", name}, {"request", id}, {"share", share}});
  });
  return {{{"address", "/download/" + downloads_.add({path, holder})}, {"name", name}}, {}};
}

}  // namespace ombre::studio

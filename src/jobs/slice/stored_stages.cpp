// Keeps the values of a slice job's stages beside its layers.
#include "jobs/slice/stored_stages.h"

#include <algorithm>
#include <filesystem>

#include "base/text/json.h"
#include "formats/containers/file.h"
#include "stores/gather.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view stage_ending = ".stage";
constexpr const char* made_from_member = "made_from";

std::string file_name(int64_t id) { return std::to_string(id) + std::string(stage_ending); }

const std::string* made_from_of(const stores::Entry& entry) {
  const auto member = std::ranges::find(entry.record, made_from_member, &DataMembers::value_type::first);
  return member == entry.record.end() ? nullptr : member->second.string();
}

// The values of each stage are a piece. What they are made from is in their record, so that the folder may hold values
// of other designs, too.
class StageJob : public stores::StoredJob {
 public:
  const stores::JobWords& words() const override {
    static const stores::JobWords words{"set of stages", "ombre stages", "stages",
                                        "stages.json",   "stage",        std::string(stage_ending)};
    return words;
  }
  std::string description(const stores::Entries&) const override {
    return print_json(DataMembers{{"format", words().format + ", version 1"}});
  }
  bool is_complete(const stores::Entries&) const override { return true; }
  void check_same(const std::string&, const DataMembers&) const override {}
  bool accepts(const stores::Entry& entry) const override {
    return made_from_of(entry) && entry.files.size() == 1 && entry.files[0].name == file_name(entry.id);
  }
  bool owns(std::string_view name) const override { return name.ends_with(stage_ending); }
  std::optional<stores::NameTest> files_of(const Data&) const override {
    return [](std::string_view name) { return name.ends_with(stage_ending); };
  }
};

std::string stages_folder(const std::string& job_folder) { return (fs::path(job_folder) / "stages").string(); }

std::optional<std::string> values_in(const std::string& folder, const stores::Entries& kept, const Hash& made_from) {
  for (const auto& [id, entry] : kept)
    if (*made_from_of(entry) == made_from.hex()) return formats::read_file((fs::path(folder) / file_name(id)).string());
  return std::nullopt;
}

}  // namespace

class StoredStages::Job : public StageJob {};

StoredStages::StoredStages(const std::string& job_folder, stores::FolderUse use, stores::Checking checking)
    : folder_(stages_folder(job_folder)),
      use_(use == stores::FolderUse::resume ? use : stores::FolderUse::replace),
      checking_(checking),
      job_(std::make_unique<Job>()) {}

StoredStages::~StoredStages() = default;

stores::FolderStore& StoredStages::store() {
  if (!store_) store_ = std::make_unique<stores::FolderStore>(folder_, *job_, use_, checking_);
  return *store_;
}

std::optional<std::string> StoredStages::find(const Hash& made_from) {
  return values_in(folder_, store().finished(), made_from);
}

void StoredStages::keep(const Hash& made_from, std::string values) {
  const stores::Entries& finished = store().finished();
  const int64_t id = finished.empty() ? 0 : finished.rbegin()->first + 1;
  stores::Piece piece{id, {}, {{made_from_member, made_from.hex()}}};
  piece.files.emplace_back(file_name(id), std::move(values));
  store().put(std::move(piece));
}

void StoredStages::remove() {
  if (!store_ && !fs::exists(fs::path(folder_) / job_->words().description_file)) return;
  store().remove();
  store_.reset();
}

SharedStages::SharedStages(const std::string& job_folder, stores::Checking checking)
    : folder_(stages_folder(job_folder)), checking_(checking) {}

std::optional<std::string> SharedStages::find(const Hash& made_from) {
  if (!kept_ && fs::exists(folder_)) kept_ = stores::gather(folder_, StageJob(), {}, checking_).finished;
  return kept_ ? values_in(folder_, *kept_, made_from) : std::nullopt;
}

}  // namespace ombre::compile

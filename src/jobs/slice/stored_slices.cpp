// A slice job as a job whose pieces are stored.
#include "jobs/slice/stored_slices.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/system/assert.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "jobs/slice/channel_counts.h"
#include "jobs/slice/job_description.h"
#include "jobs/slice/sl1_files.h"

namespace ombre::compile {
namespace {

// Adds the names of a list's elements from `first` on. Returns false if the data is none.
bool add_names(const Data* elements, size_t first, std::vector<std::string>& names) {
  if (!elements) return true;
  if (!elements->list() || elements->list()->size() < first) return false;
  for (size_t n = first; n < elements->list()->size(); ++n) {
    const Data* name = (*elements->list())[n].find("name");
    if (!name || !name->string()) return false;
    names.push_back(*name->string());
  }
  return true;
}

// Returns the names of the job's materials, without void, and of its other channels.
std::optional<std::vector<std::string>> shown_names(const Data& job) {
  std::vector<std::string> names;
  if (!add_names(job.find("materials"), 1, names) || !add_names(job.find("channels"), 0, names) || names.empty())
    return std::nullopt;
  return names;
}

// Returns the names of the layers' files by a folder's job.json.
std::optional<LayerFiles> layer_files(const Data& job) {
  const Data* images = job.find("images");
  const Data* sampling = job.find("sampling");
  const Data* files = images ? images->find("files") : nullptr;
  const Data* first = images ? images->find("first_index") : nullptr;
  const Data* voxels = sampling ? sampling->find("voxels") : nullptr;
  if (!files || !files->string() || !first || !first->number()) return std::nullopt;
  if (!voxels || !voxels->list() || voxels->list()->size() != 3 || !voxels->list()->back().number())
    return std::nullopt;
  const auto pattern = voxel::NamePattern::parse(*files->string());
  const auto names = shown_names(job);
  const double first_index = *first->number(), count = *voxels->list()->back().number();
  if (!pattern || !names || std::abs(first_index) > 1e9 || !(count >= 0 && count < 1e9)) return std::nullopt;
  return LayerFiles(*pattern, *names, static_cast<int64_t>(first_index), static_cast<int64_t>(count));
}

// A member of job.json that only earlier versions wrote, in jobs of values.
constexpr const char* old_member = "shades";

}  // namespace

const stores::JobWords& slice_words() {
  static const stores::JobWords words{"slice job", std::string(job_format), "layers", job_file, layer_member, ".png"};
  return words;
}

stores::Piece StoredSlices::piece(const LayerEntry& layer, std::vector<std::string> images) const {
  const std::vector<std::string> names = files_.names(layer.layer);
  ASSERT(images.empty() || images.size() == names.size());
  stores::Piece piece{layer.layer, {}, record_of(layer)};
  for (size_t i = 0; i < images.size(); ++i) piece.files.emplace_back(names[i], std::move(images[i]));
  return piece;
}

std::map<int64_t, LayerEntry> StoredSlices::layers(const stores::Entries& finished) const {
  std::map<int64_t, LayerEntry> layers;
  for (const auto& [id, entry] : finished) layers.emplace(id, *layer_of(entry));
  return layers;
}

std::string StoredSlices::description(const stores::Entries& finished) const {
  DataMembers job = describe_job(request_);
  const bool complete = is_complete(finished);
  job.emplace_back("status", complete ? "complete" : "unfinished");
  if (complete) job.emplace_back("totals", describe_totals(request_, layers(finished)));
  return print_json(job);
}

bool StoredSlices::is_complete(const stores::Entries& finished) const {
  return static_cast<int64_t>(finished.size()) == request_.lattice.count[2];
}

void StoredSlices::check_same(const std::string& folder, const DataMembers& there) const {
  if (Data(there).find(old_member))
    throw Error(Code::other_job,
                folder + " holds shades of gray by an earlier version of Ombre, which counted them as materials, so " +
                    "this one cannot go on; replace it with " + spelled::option("--force") +
                    ", or choose another folder",
                {{"file", folder}});
  DataMembers job = there;
  std::erase_if(job, [](const auto& member) { return member.first == "status" || member.first == "totals"; });
  if (const std::string difference = first_difference(job, describe_job(request_)); !difference.empty())
    throw Error(Code::other_job,
                folder + " holds another job: " + difference + "; replace it with " + spelled::option("--force") +
                    ", or choose another folder",
                {{"file", folder}});
}

bool StoredSlices::accepts(const stores::Entry& entry) const {
  const std::optional<LayerEntry> layer = layer_of(entry);
  if (!layer || layer->layer >= request_.lattice.count[2]) return false;
  if (layer->files.empty() && layer->counts.is_empty() && request_.drop_empty_layers) return true;
  const std::vector<std::string> names = files_.names(layer->layer);
  const auto is_named = [](const stores::StoredFile& file, const std::string& name) { return file.name == name; };
  return std::equal(layer->files.begin(), layer->files.end(), names.begin(), names.end(), is_named);
}

std::vector<std::pair<std::string, std::string>> StoredSlices::further_files(const std::string& ending,
                                                                             const stores::Entries& finished) const {
  if (ending != sl1_ending) return {};
  VoxelCounts counts = no_counts(request_);
  for (const auto& [id, layer] : layers(finished)) counts.add(layer.counts);
  const double shades = static_cast<double>(std::accumulate(counts.shades.begin(), counts.shades.end(), uint64_t{0}));
  return sl1_files(request_, shades / 255 * voxel_mm3(request_.lattice));
}

std::optional<stores::NameTest> StoredSlices::files_of(const Data& description) const {
  const std::optional<LayerFiles> files = layer_files(description);
  if (!files) return std::nullopt;
  return [files = *files](std::string_view name) { return files.contains(name); };
}

std::optional<LayerEntry> StoredSlices::layer_of(const stores::Entry& entry) const {
  return compile::layer_of(entry, layer_sizes(request_));
}

}  // namespace ombre::compile

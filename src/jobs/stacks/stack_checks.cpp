#include "jobs/stacks/stack_checks.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "base/system/hash.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "jobs/slice/channel_counts.h"
#include "jobs/slice/job_description.h"
#include "jobs/slice/sl1_files.h"
#include "jobs/slice/stored_slices.h"
#include "stores/journal_folder.h"
#include "stores/shard.h"

namespace ombre::compile {
namespace {

// The result of checking one layer.
struct LayerCheck {
  Findings findings;
  bool is_read = false;
  uint64_t files = 0, bytes = 0;
  std::vector<uint64_t> counts;  // empty if its images were not read
};

class StackChecker {
 public:
  StackChecker(const Stack& stack, LayerRange layers, const LayerReader& reader, const CheckWork& work)
      : stack_(stack), layers_(layers), reader_(reader), work_(work), counts_(reader.counted().size()) {
    for (const auto& [layer, entry] : stack.entries)
      for (const stores::StoredFile& file : entry.files) file_of_hash_.emplace(file.hash, file.name);
  }

  StackCheck run() {
    find_extra_files();
    const auto produce = [&](size_t n) {
      if (work_.stop && work_.stop->requested()) throw Cancelled();
      return check(layers_.begin + static_cast<int64_t>(n));
    };
    const auto consume = [&](size_t n, LayerCheck& layer) { take(n, layer); };
    constexpr size_t window = 64;
    run_ordered<LayerCheck>(static_cast<size_t>(layers_.end - layers_.begin), work_.threads, window, produce, consume);
    if (layers_ == LayerRange{0, stack_.layer_count()})
      check_totals();
    else
      result_.unchecked.push_back("other layers than " + to_text(layers_) + ", and totals, are not checked");
    return std::move(result_);
  }

 private:
  bool holds(const std::string& name) const { return stack_.names.contains(name); }

  // Appearance for images that are of no layer, and lists files of others.
  void find_extra_files() {
    uint64_t others = 0;
    for (const std::string& name : stack_.names) {
      if (name == job_file || name == stores::journal_file || stores::is_of_shard(name)) continue;
      if (stack_.files.contains(name) || is_sl1_file(name)) continue;
      if (name.ends_with(slice_words().file_ending))
        result_.findings.push_back({"extra", name + " is in the folder, but no layer of the job has that name"});
      else
        ++others;
    }
    if (others > 0) result_.unchecked.push_back(format_count(others) + " files in the folder are not of the job");
    if (!stack_.has_journal)
      result_.unchecked.push_back(
          "there is no journal, so hashes of files and counts of single layers are not checked");
    if (!stack_.job.is_complete)
      result_.unchecked.push_back("the job is unfinished: layers that are not there yet, and totals, are not checked");
    if (!reader_.appearance().hidden().empty())
      result_.unchecked.push_back("the images do not tell " + join(reader_.appearance().hidden(), ", ") +
                                  " from other materials or from void");
  }

  LayerCheck check(int64_t layer) const {
    LayerCheck result;
    const auto found = stack_.entries.find(layer);
    const stores::Entry* entry = found == stack_.entries.end() ? nullptr : &found->second;
    const std::vector<std::string> names = stack_.files.names(layer);
    if (entry && entry->files.empty()) return check_dropped(*entry, names);
    if (stack_.has_journal && !entry) return without_entry(layer, names);
    std::vector<std::string> bytes;
    for (size_t n = 0; n < names.size(); ++n) {
      if (!holds(names[n])) {
        add_missing(layer, names[n], result);
        continue;
      }
      bytes.push_back(stack_.read(names[n]));
      ++result.files;
      result.bytes += bytes.back().size();
      if (entry) check_hash(layer, entry->files[n], bytes.back(), result.findings);
    }
    if (bytes.size() != names.size()) return result;
    const auto channels = reader_.read(layer, names, bytes, result.findings);
    if (!channels) return result;
    result.is_read = true;
    result.counts = reader_.counts(*channels);
    if (entry) reader_.compare_counts(*channels, *entry, result.findings);
    return result;
  }

  LayerCheck check_dropped(const stores::Entry& entry, const std::vector<std::string>& names) const {
    LayerCheck result{{}, true, 0, 0, std::vector<uint64_t>(counts_.size())};
    for (const std::string& name : names)
      if (holds(name))
        result.findings.push_back(
            {"extra", name + " is in the folder, but the journal says that the layer is empty " + "and left out",
             entry.id});
    return result;
  }

  LayerCheck without_entry(int64_t layer, const std::vector<std::string>& names) const {
    LayerCheck result;
    for (const std::string& name : names)
      if (holds(name))
        result.findings.push_back({"extra", name + " is in the folder, but no journal names its layer", layer});
    if (result.findings.empty() && stack_.job.is_complete)
      result.findings.push_back({"missing", "layer " + std::to_string(layer) + " is in no journal", layer});
    return result;
  }

  void add_missing(int64_t layer, const std::string& name, LayerCheck& result) const {
    if (stack_.has_journal || (stack_.job.is_complete && !stack_.request().drop_empty_layers))
      result.findings.push_back({"missing", name + " is missing", layer});
  }

  void check_hash(int64_t layer, const stores::StoredFile& file, const std::string& bytes, Findings& findings) const {
    const std::string hash = hash_bytes(bytes).hex();
    if (bytes.size() == file.bytes && hash == file.hash) return;
    std::string text = file.name + " is not the file that the journal names: ";
    const auto same = file_of_hash_.find(hash);
    if (same != file_of_hash_.end())
      text += "it has the bytes of " + same->second;
    else if (bytes.size() != file.bytes)
      text += "it has " + format_count(bytes.size()) + " bytes, not " + format_count(file.bytes);
    else
      text += "its hash is " + hash + ", not " + file.hash;
    findings.push_back({"hash", text, layer});
  }

  void take(size_t n, LayerCheck& layer) {
    std::ranges::move(layer.findings, std::back_inserter(result_.findings));
    result_.layers += layer.is_read ? 1 : 0;
    result_.files += layer.files;
    result_.bytes += layer.bytes;
    for (size_t i = 0; i < layer.counts.size(); ++i) counts_[i] += layer.counts[i];
    if (work_.progress) work_.progress->update({n + 1, static_cast<uint64_t>(layers_.end - layers_.begin)});
  }

  // Compares the totals of job.json with the sums of the journal, and with what the images show.
  void check_totals() {
    if (!stack_.job.is_complete) return;
    const DataMembers* stated = stack_.job.totals.members();
    if (!stated) return add_total("job.json has no totals, but says that the job is complete");
    if (stack_.has_journal) {
      const StoredSlices slices(stack_.request());
      const Data sums = describe_totals(stack_.request(), slices.layers(stack_.entries));
      if (const std::string text = difference(*stated, *sums.members()); !text.empty()) add_total(text);
    }
    if (result_.layers == stack_.layer_count()) compare_totals();
  }

  static std::string difference(const DataMembers& stated, const DataMembers& sums) {
    const std::string text = first_difference(stated, sums);
    return text.empty() ? "" : "the totals of job.json (there) are not those of the journal (here): " + text;
  }

  void compare_totals() {
    std::vector<uint64_t> voxels;
    for (const char* list : {"materials", "channels"})
      if (const Data* counted = stack_.job.totals.find(list); counted && counted->list())
        for (const Data& element : *counted->list())
          voxels.push_back(stores::whole_number(element.find("voxels")).value_or(0));
    const std::vector<std::string> names = reader_.counted();
    if (voxels.size() != names.size()) return add_total("the totals of job.json do not count each material");
    const std::vector<uint64_t> together = reader_.seen_together(voxels);
    for (size_t n = 0; n < names.size(); ++n)
      if (together[n] != counts_[n])
        add_total("the images have " + format_count(counts_[n]) + " voxels of " + names[n] + "; job.json says " +
                  format_count(together[n]));
  }

  void add_total(const std::string& text) { result_.findings.push_back({"totals", text}); }

  const Stack& stack_;
  LayerRange layers_;
  const LayerReader& reader_;
  const CheckWork& work_;
  std::multimap<std::string, std::string> file_of_hash_;
  std::vector<uint64_t> counts_;
  StackCheck result_;
};

}  // namespace

CheckWork fitting(CheckWork work, const voxel::Lattice& lattice) {
  // A pixel of an image, and what it shows, beside what it is to show.
  constexpr double bytes_for_voxel = 16;
  const double layer = bytes_for_voxel * static_cast<double>(lattice.count[0]) * static_cast<double>(lattice.count[1]);
  const double layers = std::max(1.0, static_cast<double>(work.memory_bytes) / layer);
  const int threads = work.threads > 0 ? work.threads : core_count();
  work.threads = static_cast<int>(std::min<double>(threads, layers));
  return work;
}

StackCheck check_stack(const Stack& stack, LayerRange layers, const LayerReader& reader, const CheckWork& work) {
  return StackChecker(stack, layers, reader, work).run();
}

std::optional<std::vector<Shown>> read_layer(const Stack& stack, const LayerReader& reader, int64_t layer) {
  const auto entry = stack.entries.find(layer);
  if (entry != stack.entries.end() && entry->second.files.empty()) return reader.blank();
  std::vector<std::string> bytes;
  const std::vector<std::string> names = stack.files.names(layer);
  for (const std::string& name : names) {
    if (!stack.names.contains(name)) return std::nullopt;
    bytes.push_back(stack.read(name));
  }
  Findings ignored;  // check_stack() tells them
  return reader.read(layer, names, bytes, ignored);
}

}  // namespace ombre::compile

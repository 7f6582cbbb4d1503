#include "jobs/grid/shared_grid.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "formats/containers/file.h"
#include "jobs/common/events.h"
#include "jobs/common/overwrite.h"
#include "stores/folder_store.h"
#include "stores/numbered_files.h"
#include "stores/open_store.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;
using stores::PieceRange;

const stores::JobWords& slab_words() {
  static const stores::JobWords words{"grid", "ombre slabs", "slabs", "slabs.json", "slab", ".bin"};
  return words;
}

constexpr const char* inside_member = "inside";

// The slabs of a grid. Each has the same layers, whatever the threads and the memory.
class Slabs {
 public:
  explicit Slabs(const compile::GridJob& job)
      : layers_(compile::most_slab_layers(job)),
        first_(voxel::multiple_below(job.region.lo[2], layers_)),
        begin_(job.region.lo[2]),
        end_(job.region.hi[2]) {}

  int64_t count() const { return (end_ - first_ + layers_ - 1) / layers_; }
  int64_t begin(int64_t slab) const { return std::max(begin_, first_ + slab * layers_); }
  int64_t end(int64_t slab) const { return std::min(end_, first_ + (slab + 1) * layers_); }
  int64_t of_layer(int64_t layer) const { return (layer - first_) / layers_; }

 private:
  int64_t layers_, first_, begin_, end_;
};

class SharedGrid final : public SharedJob {
 public:
  SharedGrid(const compile::GridChoices& choices, DenseGrid grid, stores::JobKey key, TellReport tell)
      : choices_(choices),
        grid_(std::move(grid)),
        slabs_(grid_.job),
        key_(std::move(key)),
        stored_(slab_words(), slabs_.count(), key_),
        tell_(std::move(tell)) {}

  std::string folder() const override { return choices_.output + ".slabs"; }
  const stores::StoredJob& stored() const override { return stored_; }
  PieceRange pieces() const override { return {0, slabs_.count()}; }
  DataMembers description() const override { return {{"slabs", number(slabs_.count())}, {"key", key_.data()}}; }
  std::string difference(const DataMembers& earlier) const override {
    return key_.difference(Data(earlier).find("key"));
  }
  // How long a slab takes is not known before one is made.
  PieceCosts costs(Session&) const override { return {std::vector<double>(static_cast<size_t>(slabs_.count())), 0}; }

  int make(PieceRange range, const stores::Shard& shard, Session& session) const override {
    if (!fs::exists(folder())) refuse_joined(grid_.paths);
    JobProgress progress(session.events);
    const auto store = stores::open_shard(folder(), stored_, shard, {choices_.work.threads, &progress, &session.stop});
    add_slabs(*store, range, progress, session);
    session.events.say("slabs " + std::to_string(range.begin) + ":" + std::to_string(range.end) + " are in " +
                       folder());
    return done;
  }

  int join(Session& session) const override {
    refuse_joined(grid_.paths);
    const Stopwatch watch;
    JobProgress progress(session.events);
    stores::FolderStore store(folder(), stored_, stores::FolderUse::resume,
                              {choices_.work.threads, &progress, &session.stop});
    add_slabs(store, pieces(), progress, session);
    compile::GridReport report{grid_.paths, 0, false, 0};
    compile::VolumeFiles files(grid_.job, grid_.paths, grid_.format);
    for (const auto& [slab, entry] : store.finished()) {
      if (session.stop.requested()) throw Cancelled();
      append(slab, files);
      const Data record(entry.record);
      const Data* const inside = record.find(inside_member);
      report.has_inside = report.has_inside || (inside && *inside == Data(true));
    }
    report.bytes_written = files.commit();
    report.seconds = watch.seconds();
    store.remove();
    tell_(session.events, report);
    return done;
  }

 private:
  // Makes the slabs of the range that the store lacks.
  void add_slabs(stores::Store& store, PieceRange range, JobProgress& progress, Session& session) const {
    const auto is_missing = [&](int64_t slab) { return slab < range.end && !store.finished().contains(slab); };
    for (int64_t slab = range.begin; slab < range.end;) {
      int64_t end = slab;
      while (is_missing(end)) ++end;
      if (end > slab) add_missing(store, {slab, end}, progress, session);
      slab = end + 1;
    }
    progress.finish();
  }

  void add_missing(stores::Store& store, PieceRange range, JobProgress& progress, Session& session) const {
    compile::GridJob part = grid_.job;
    part.region.lo[2] = slabs_.begin(range.begin);
    part.region.hi[2] = slabs_.end(range.end - 1);
    std::vector<std::string> bytes(part.grids.size());
    bool has_inside = false;
    const auto take = [&](const compile::SlabOfNumbers& numbers) {
      for (size_t n = 0; n < bytes.size(); ++n) bytes[n] += numbers.bytes[n];
      has_inside = has_inside || numbers.has_inside;
      const int64_t slab = slabs_.of_layer(numbers.box.lo[2]);
      if (numbers.box.hi[2] < slabs_.end(slab)) return;
      std::string file;
      for (std::string& of_grid : bytes) file += std::exchange(of_grid, {});
      store.put(
          {slab, {{stored_.file_name(slab), std::move(file)}}, {{inside_member, std::exchange(has_inside, false)}}});
    };
    compile::each_numbers(part, choices_.work.threads, take, &progress, &session.stop);
  }

  // Appends the numbers of a slab to the files. Throws Error if its file has another size.
  void append(int64_t slab, compile::VolumeFiles& files) const {
    const std::string path = (fs::path(folder()) / stored_.file_name(slab)).string();
    const std::string bytes = formats::read_file(path);
    const std::vector<uint64_t> sizes = compile::numbers_bytes(grid_.job, slabs_.end(slab) - slabs_.begin(slab));
    size_t at = 0;
    for (size_t n = 0; n < sizes.size() && at + sizes[n] <= bytes.size(); at += sizes[n++])
      files.append(n, std::string_view(bytes).substr(at, sizes[n]));
    if (at != bytes.size())
      throw Error(Code::cannot_read, path + " is not as long as the slab; remove it, and run its share again",
                  {{"file", path}});
  }

  compile::GridChoices choices_;
  DenseGrid grid_;
  Slabs slabs_;
  stores::JobKey key_;
  stores::NumberedFiles stored_;
  TellReport tell_;
};

}  // namespace

SharedJobPtr share_grid(const compile::GridChoices& choices, DenseGrid grid, stores::JobKey key, TellReport tell) {
  return std::make_unique<SharedGrid>(choices, std::move(grid), std::move(key), std::move(tell));
}

}  // namespace ombre::jobs

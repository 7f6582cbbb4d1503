#include "jobs/printable/print_check.h"

#include <algorithm>
#include <deque>
#include <iterator>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "jobs/slice/slice_work.h"

namespace ombre::compile {
namespace {

// The flags of one layer.
struct LayerFlags {
  BitLayer solid;
  std::map<MaterialId, BitLayer> of_material;
};

class CheckedJob {
 public:
  CheckedJob(const Plan& plan, const std::vector<PrintCheck>& checks, const CheckRun& run)
      : plan_(plan), checks_(checks), run_(run), count_(plan.request.lattice.count) {
    for (const PrintCheck& check : checks) {
      reach_ = std::max(reach_, check.reach);
      materials_.insert(materials_.end(), check.materials.begin(), check.materials.end());
      finders_.emplace_back(check.found == FoundPieces::enclosed ? is_enclosed : FlagPieceFinder::Counts());
    }
    std::ranges::sort(materials_);
    materials_.erase(std::unique(materials_.begin(), materials_.end()), materials_.end());
    findings_.resize(checks.size());
    most_flagged_.resize(checks.size());
    first_ = -margin();
  }

  std::vector<PrintFinding> run() {
    SliceOptions options;
    options.threads = run_.threads;
    options.memory_bytes = run_.memory_bytes;
    const WorkSize work = size_work(plan_.request, options);
    const int64_t layers = count_[2], step = work.slab_layers;
    // Void lies below the lowest layer and above the highest.
    for (int64_t k = 0; k < margin(); ++k) waiting_.push_back(empty());
    run_ordered<std::vector<LayerFlags>>(
        static_cast<size_t>((layers + step - 1) / step), work.threads, work.window,
        [&](size_t n) {
          const int64_t begin = static_cast<int64_t>(n) * step;
          return flags_of(plan_.producer(begin, std::min(layers, begin + step), run_.stop));
        },
        [&](size_t n, std::vector<LayerFlags>& made) {
          std::ranges::move(made, std::back_inserter(waiting_));
          take(false);
          if (run_.progress)
            run_.progress->update({static_cast<uint64_t>(n + 1) * static_cast<uint64_t>(step) * voxels_of_layer(),
                                   static_cast<uint64_t>(layers) * voxels_of_layer()});
        });
    for (int64_t k = 0; k < margin(); ++k) waiting_.push_back(empty());
    take(true);
    return finished();
  }

 private:
  int64_t margin() const { return reach_ + 1; }
  uint64_t voxels_of_layer() const { return static_cast<uint64_t>(count_[0] * count_[1]); }
  BitLayer empty_bits() const { return {count_[0] + 2 * margin(), count_[1] + 2 * margin()}; }

  LayerFlags empty() const {
    LayerFlags flags{empty_bits(), {}};
    for (const MaterialId id : materials_) flags.of_material.emplace(id, empty_bits());
    return flags;
  }

  // The void outside reaches the layer below the lowest one.
  static bool is_enclosed(const FlagPiece& piece) { return piece.box.lo[2] >= 0; }

  std::vector<LayerFlags> flags_of(const std::vector<voxel::LayerResult>& layers) const {
    std::vector<LayerFlags> result;
    std::vector<MaterialId> row(static_cast<size_t>(count_[0]));
    for (const voxel::LayerResult& layer : layers) {
      if (run_.stop && run_.stop->requested()) throw Cancelled();
      LayerFlags flags = empty();
      const auto& voxels = std::get<RunLayer>(layer.channels.front());
      for (int64_t j = 0; j < count_[1]; ++j) {
        voxels.row(static_cast<uint32_t>(j)).unpack(row.data());
        flag_row(row, j + margin(), flags);
      }
      result.push_back(std::move(flags));
    }
    return result;
  }

  void flag_row(const std::vector<MaterialId>& row, int64_t j, LayerFlags& flags) const {
    for (size_t i = 0; i < row.size();) {
      size_t end = i + 1;
      while (end < row.size() && row[end] == row[i]) ++end;
      const auto from = static_cast<int64_t>(i) + margin(), to = static_cast<int64_t>(end) + margin();
      if (row[i] != 0) flags.solid.set(j, from, to);
      if (const auto its = flags.of_material.find(row[i]); its != flags.of_material.end()) its->second.set(j, from, to);
      i = end;
    }
  }

  // Checks layers around which all that the checks read is there. Many at a time are less work.
  void take(bool is_last) {
    const int64_t ready = static_cast<int64_t>(waiting_.size()) - 2 * reach_;
    if (ready < 1 || (!is_last && ready < std::max<int64_t>(16, 2 * reach_))) return;
    if (run_.stop && run_.stop->requested()) throw Cancelled();
    const SolidLayers layers = gathered();
    const int64_t begin = first_ + reach_, end = begin + ready;
    run_parallel(checks_.size(), run_.threads, [&](size_t n) { check(n, layers, begin, end); });
    waiting_.erase(waiting_.begin(), waiting_.begin() + ready);
    first_ += ready;
  }

  SolidLayers gathered() const {
    SolidLayers layers{{first_, {}}, {}};
    for (const MaterialId id : materials_) layers.of_material[id].first = first_;
    for (const LayerFlags& flags : waiting_) {
      layers.solid.layers.push_back(flags.solid);
      for (const auto& [id, bits] : flags.of_material) layers.of_material[id].layers.push_back(bits);
    }
    return layers;
  }

  void check(size_t n, const SolidLayers& layers, int64_t begin, int64_t end) {
    BitLayers flags = checks_[n].flags(layers, begin, end);
    for (int64_t k = begin; k < end; ++k) {
      const BitLayer& layer = flags.at(k);
      finders_[n].add(k, layer);
      const uint64_t flagged = checks_[n].found == FoundPieces::all && k >= 0 && k < count_[2] ? layer.count() : 0;
      if (flagged <= most_flagged_[n]) continue;
      most_flagged_[n] = flagged;
      findings_[n].layer = k;
      findings_[n].flags = layer;
    }
  }

  std::vector<PrintFinding> finished() {
    std::vector<PrintFinding> found;
    for (size_t n = 0; n < checks_.size(); ++n) {
      PrintFinding& finding = findings_[n];
      finding.pieces = finders_[n].finish();
      FlagPieces& pieces = finding.pieces;
      if (checks_[n].found == FoundPieces::but_largest && pieces.count > 0) {
        pieces.voxels -= pieces.largest.front().voxels;
        pieces.largest.erase(pieces.largest.begin());
        --pieces.count;
      }
      if (pieces.count == 0) continue;
      for (FlagPiece& piece : pieces.largest)
        for (size_t axis = 0; axis < 2; ++axis) {
          piece.box.lo[axis] -= margin();
          piece.box.hi[axis] -= margin();
        }
      finding.kind = checks_[n].kind, finding.text = checks_[n].text, finding.remedy = checks_[n].remedy;
      finding.is_error = checks_[n].is_error;
      if (finding.flags.height() > 0) finding.flags = without_margin(finding.flags);
      found.push_back(std::move(finding));
    }
    std::stable_partition(found.begin(), found.end(), [](const PrintFinding& finding) { return finding.is_error; });
    return found;
  }

  BitLayer without_margin(const BitLayer& flags) const {
    BitLayer inner(count_[0], count_[1]);
    for (int64_t j = 0; j < count_[1]; ++j)
      for (int64_t i = 0; i < count_[0]; ++i)
        if (flags.get(i + margin(), j + margin())) inner.set(i, j);
    return inner;
  }

  const Plan& plan_;
  const std::vector<PrintCheck>& checks_;
  const CheckRun& run_;
  std::array<int64_t, 3> count_;
  int64_t reach_ = 0;
  std::vector<MaterialId> materials_;
  std::deque<LayerFlags> waiting_;
  int64_t first_ = 0;  // number of the first waiting layer
  std::vector<FlagPieceFinder> finders_;
  std::vector<PrintFinding> findings_;
  std::vector<uint64_t> most_flagged_;
};

}  // namespace

std::vector<PrintFinding> run_print_checks(const Plan& plan, const std::vector<PrintCheck>& checks,
                                           const CheckRun& run) {
  return CheckedJob(plan, checks, run).run();
}

}  // namespace ombre::compile

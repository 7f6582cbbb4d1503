#include "jobs/printable/print_check.h"

#include <algorithm>

#include "base/system/tasks.h"
#include "jobs/printable/held_regions.h"

namespace ombre::compile {
namespace {

class CheckedJob {
 public:
  CheckedJob(const Plan& plan, const std::vector<PrintCheck>& checks, const CheckRun& run)
      : plan_(plan), checks_(checks), run_(run), count_(plan.request.lattice.count) {
    for (const PrintCheck& check : checks) {
      shape_.reach = std::max(shape_.reach, check.reach);
      shape_.materials.insert(shape_.materials.end(), check.materials.begin(), check.materials.end());
      finders_.emplace_back(check.found == FoundPieces::enclosed ? HeldRegionFinder::is_enclosed
                                                                 : FlagPieceFinder::Counts());
    }
    std::ranges::sort(shape_.materials);
    shape_.materials.erase(std::unique(shape_.materials.begin(), shape_.materials.end()), shape_.materials.end());
    held_.resize(checks.size());
    findings_.resize(checks.size());
    most_flagged_.resize(checks.size());
  }

  std::vector<PrintFinding> run() {
    each_window(plan_, shape_, run_, [&](const SolidLayers& layers, int64_t begin, int64_t end) {
      run_parallel(checks_.size(), run_.threads, [&](size_t n) { check(n, layers, begin, end); });
    });
    return finished();
  }

 private:
  int64_t margin() const { return shape_.margin(); }

  void check(size_t n, const SolidLayers& layers, int64_t begin, int64_t end) {
    BitLayers flags = checks_[n].flags(layers, begin, end);
    for (int64_t k = begin; k < end; ++k) {
      const BitLayer& layer = flags.at(k);
      if (checks_[n].found == FoundPieces::held) {
        show(n, k - 1, held_[n].add(k, layer));
        continue;
      }
      finders_[n].add(k, layer);
      if (checks_[n].found == FoundPieces::all) show(n, k, layer);
    }
  }

  // Keeps the flags of the layer that has the most.
  void show(size_t n, int64_t k, const BitLayer& layer) {
    const uint64_t flagged = k >= 0 && k < count_[2] ? layer.count() : 0;
    if (flagged <= most_flagged_[n]) return;
    most_flagged_[n] = flagged;
    findings_[n].layer = k;
    findings_[n].flags = layer;
  }

  std::vector<PrintFinding> finished() {
    std::vector<PrintFinding> found;
    for (size_t n = 0; n < checks_.size(); ++n) {
      PrintFinding& finding = findings_[n];
      finding.pieces = checks_[n].found == FoundPieces::held ? held_[n].finish() : finders_[n].finish();
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
  WindowShape shape_;
  std::vector<FlagPieceFinder> finders_;
  std::vector<HeldRegionFinder> held_;
  std::vector<PrintFinding> findings_;
  std::vector<uint64_t> most_flagged_;
};

}  // namespace

std::vector<PrintFinding> run_print_checks(const Plan& plan, const std::vector<PrintCheck>& checks,
                                           const CheckRun& run) {
  return CheckedJob(plan, checks, run).run();
}

}  // namespace ombre::compile

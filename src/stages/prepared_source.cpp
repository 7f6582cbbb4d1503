#include "stages/prepared_source.h"

#include <algorithm>

#include "base/system/steady_pace.h"
#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "stages/stage_hash.h"

namespace ombre::compile {

void PreparedSource::check_memory(const StageLoan& loan) const {
  if (is_prepared_ || least_bytes() <= static_cast<double>(loan.memory_bytes)) return;
  throw Error(Code::memory, name() + ": computing them takes about " + format_bytes(least_bytes()) +
                                " of memory, more than the " + format_bytes(static_cast<double>(loan.memory_bytes)) +
                                " allowed; allow more with " + spelled::option("--memory") +
                                ", choose larger voxels, or give them a larger pitch");
}

bool PreparedSource::is_remembered() const {
  const auto known = memory() ? memory()->find(*frame().made_from) : nullptr;
  if (known) take(known);
  return known != nullptr;
}

bool PreparedSource::is_kept(StageKeeper& keeper) const {
  const auto values = keeper.find(hash_of_values(frame()));
  return values && unpack(*values);
}

// Keeps the values where they are wanted later. The keeper gets them only if memory holds them twice.
void PreparedSource::keep(const StageLoan& loan) const {
  if (memory()) memory()->keep(*frame().made_from, made(), static_cast<size_t>(kept_bytes()));
  if (loan.keeper && 2 * kept_bytes() <= static_cast<double>(loan.memory_bytes))
    loan.keeper->keep(hash_of_values(frame()), pack());
}

void PreparedSource::prepare(const StageLoan& loan) const {
  const std::scoped_lock lock(mutex_);
  if (is_prepared_) return;
  if (is_remembered() || (loan.keeper && is_kept(*loan.keeper))) {
    is_prepared_ = true;
    return;
  }
  check_memory(loan);
  constexpr uint64_t steps = 1000;
  const Stopwatch watch;
  design::StageWork work{loan.threads, loan.stop, {}};
  work.tell = [&](double share) {
    const auto done = static_cast<uint64_t>(share * static_cast<double>(steps));
    if (loan.progress) loan.progress->preparing(name(), at_steady_pace(done, steps, watch.seconds()));
  };
  work.tell(0);
  compute(loan, work);
  work.tell(1);
  keep(loan);
  is_prepared_ = true;
}

void PreparedSource::read_cells(size_t channel, const CellIndex& first, std::span<float> values) const {
  if (!is_prepared_) {
    if (is_left_out_) {
      std::ranges::fill(values, 0.0f);
      return;
    }
    StageLoan loan;
    loan.stop = shared_->stop.load();
    loan.threads = shared_->threads.load();
    loan.memory_bytes = shared_->memory_bytes.load();
    prepare(loan);
  }
  read_made(channel, first, values);
}

Interval PreparedSource::range_of_cells(size_t channel, const IndexBox& cells) const {
  const Interval declared = declared_range(channel);
  if (!is_prepared_ || declared.is_everything()) return declared;
  return range_of_made(channel, cells);
}

}  // namespace ombre::compile

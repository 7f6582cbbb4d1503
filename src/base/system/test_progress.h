// Records what a job tells of its progress.
#pragma once

#include <mutex>
#include <vector>

#include "base/system/progress.h"

namespace ombre {

struct CheckRecorder : Progress {
  std::vector<HowFar> seen;
  std::mutex mutex;
  void update(const HowFar&) override {}
  void checking(const HowFar& how_far) override {
    const std::scoped_lock lock(mutex);
    seen.push_back(how_far);
  }
};

}  // namespace ombre

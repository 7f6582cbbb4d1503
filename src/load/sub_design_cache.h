// A running program's memory of sub-designs, in a cache of sources.
#pragma once

#include <atomic>

#include "design/sub_design_memory.h"
#include "sources/source_cache.h"

namespace ombre::compile {

// `cache` must outlive this object; its limit holds for the values kept here.
class SubDesignCache final : public design::SubDesignMemory {
 public:
  explicit SubDesignCache(sources::SourceCache& cache) : cache_(cache) {}

  std::shared_ptr<const void> find(const Hash& key) override;
  void keep(const Hash& key, std::shared_ptr<const void> made, size_t bytes) override;

  struct Counts {
    size_t found = 0, made = 0;
  };
  Counts counts() const { return {found_, made_}; }

 private:
  sources::SourceCache& cache_;
  std::atomic<size_t> found_ = 0, made_ = 0;
};

}  // namespace ombre::compile

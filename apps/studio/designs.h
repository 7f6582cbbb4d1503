// Keeps the open designs, and the plans of their jobs.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "base/math/box.h"
#include "jobs/slice/plan.h"
#include "load/sub_design_cache.h"
#include "studio/job_choices.h"

namespace ombre::studio {

struct CutDesign {
  compile::Plan plan;
  voxel::Printer printer;
  Diagnostics remarks;
};
using CutDesignPtr = std::shared_ptr<const CutDesign>;

// A loaded design. Thread-safe.
class OpenDesign {
 public:
  // `memory` must outlive the design.
  OpenDesign(std::string name, compile::LoadedPtr design, const Box& box, std::string program,
             design::SubDesignMemory& kept)
      : handle(std::move(name)), loaded(std::move(design)), bounds(box), memory(kept), program_(std::move(program)) {}

  const std::string handle;
  const compile::LoadedPtr loaded;
  const Box bounds;
  design::SubDesignMemory& memory;  // results of the design's parts, and of other designs'

  // Plans a job when it is first asked for, and keeps the plan. Throws RequestError if the design cannot be cut with
  // these choices.
  CutDesignPtr cut(const JobChoices& choices);

 private:
  struct Slot {
    std::mutex mutex;
    CutDesignPtr made;
  };
  CutDesignPtr make(const JobChoices& choices) const;

  std::string program_;  // the program that writes jobs: "ombre 0.1.0"
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Slot>> slots_;  // by the key of the choices
};
using OpenDesignPtr = std::shared_ptr<OpenDesign>;

// Keeps the designs that were loaded last, each with a handle. Thread-safe.
class Designs {
 public:
  static constexpr size_t most = 12;

  // `memory` must outlive all designs.
  explicit Designs(design::SubDesignMemory& memory) : memory_(memory) {}
  OpenDesignPtr add(const compile::LoadedPtr& loaded, const Box& bounds, const std::string& program);
  // Throws RequestError "gone" for a design that is no longer kept and has to be loaded again.
  OpenDesignPtr find(const std::string& handle);

 private:
  design::SubDesignMemory& memory_;
  std::mutex mutex_;
  std::list<OpenDesignPtr> kept_;  // the most recently used first
  uint64_t count_ = 0;
};

// Returns an error that lists the mistakes, one on each line.
RequestError design_error(const Diagnostics& diagnostics);

}  // namespace ombre::studio

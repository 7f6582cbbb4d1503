// The open designs, and the jobs planned for them.
#pragma once

#include <array>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

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

// The source of a design, by which a later start of the studio loads it again.
struct DesignOrigin {
  std::string file;                      // as the page names it
  std::vector<std::string> definitions;  // "name=value"
  std::array<double, 3> rotate{};        // degrees about x, then y, then z
};

// The solids and values that statements and expressions of a script gave when they ran first, for small pictures of
// them.
class ScriptResults {
 public:
  // A value that varies in space, or a solid, as data of a parameter.
  struct ExpressionValue {
    SourceRange expression;
    Data value;
  };

  void add(const SourceRange& statement, std::vector<design::NodePtr> solids);
  void add(const SourceRange& expression, Data value);
  // Returns the solids of statements, by where the statements begin in the text.
  const std::map<uint32_t, std::vector<design::NodePtr>>& solids() const { return solids_; }
  const std::vector<ExpressionValue>& values() const { return values_; }

 private:
  std::map<uint32_t, std::vector<design::NodePtr>> solids_;
  std::vector<ExpressionValue> values_;
};

// A design that was read, with what the studio knows of it.
struct ReadDesign {
  compile::LoadedPtr loaded;
  Box bounds;
  ScriptResults results;
};

// A loaded design. Thread-safe.
class OpenDesign {
 public:
  // Constructs an open design; the memory must outlive it.
  OpenDesign(std::string name, DesignOrigin from, ReadDesign design, std::string program, design::SubDesignMemory& kept)
      : handle(std::move(name)),
        origin(std::move(from)),
        loaded(std::move(design.loaded)),
        bounds(design.bounds),
        results(std::move(design.results)),
        memory(kept),
        program_(std::move(program)) {}

  const std::string handle;
  const DesignOrigin origin;
  const compile::LoadedPtr loaded;
  const Box bounds;
  const ScriptResults results;
  design::SubDesignMemory& memory;  // holds what was made of parts of this and other designs

  // Returns the plan for these choices, made on first use and cached. Throws RequestError with the reason if the design
  // cannot be sliced with them.
  CutDesignPtr cut(const JobChoices& choices);

 private:
  struct Slot {
    std::mutex mutex;
    CutDesignPtr made;
  };
  CutDesignPtr make(const JobChoices& choices) const;

  std::string program_;  // the program that writes jobs, such as "ombre 0.1.0"
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Slot>> slots_;  // by the key of the choices
};
using OpenDesignPtr = std::shared_ptr<OpenDesign>;

// Keeps the most recently loaded designs, each by a handle that no other collection gives, also after a restart of the
// program. Thread-safe.
class Designs {
 public:
  static constexpr size_t most = 12;

  // Constructs an empty collection; the memory must outlive all added designs.
  explicit Designs(design::SubDesignMemory& memory);
  OpenDesignPtr add(const DesignOrigin& origin, ReadDesign design, const std::string& program);
  // Returns the design of a handle. Throws RequestError "gone" if it is no longer kept and has to be loaded again.
  OpenDesignPtr find(const std::string& handle);

 private:
  design::SubDesignMemory& memory_;
  std::mutex mutex_;
  std::list<OpenDesignPtr> kept_;  // most recently used first
  const std::string start_;        // how all handles begin
  uint64_t count_ = 0;
};

// Returns an error that lists the mistakes, one on each line.
RequestError design_error(const Diagnostics& diagnostics);

}  // namespace ombre::studio

// Evaluates a design at many points at once, in double precision.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/system/progress.h"
#include "design/design.h"
#include "program/program.h"
#include "stages/job_stages.h"

namespace ombre::compile {

struct SampleQuery {
  bool inside = false;    // 1 inside, 0 outside
  bool distance = false;  // g, mm; negative inside
  bool fractions = false;
  bool parts = false;  // 1 in the part, 0 outside of it
  std::vector<std::string> attributes;
  bool checks = false;  // 1 where a check of the composition fails; it has a meaning inside only
};

// Thread-safe. Values have the bits of the reference evaluator.
class Sampler {
 public:
  // A column of the answer.
  struct Column {
    enum class Kind { inside, distance, fraction, attribute, part, check } kind;
    std::string name;  // name of the material, attribute or part; text of the check
    MaterialId material = 0;
    SourceRange where = {};  // place of the node that checks
  };

  // Builds a sampler whose columns have the order of the query, and fractions that of the ids. Returns nothing, and
  // adds diagnostics, if the design is too large or lacks an attribute.
  static std::optional<Sampler> build(const design::Design& design, const SampleQuery& query, Diagnostics& diagnostics);

  const std::vector<Column>& columns() const { return columns_; }

  // Writes the value of column c at points[n], mm, to columns[c][n]. Fractions have a meaning inside only. Runs on up
  // to `threads` threads, 0 for all cores. Throws Cancelled.
  void sample(std::span<const Vec3> points, std::span<double* const> columns, int threads = 0,
              const StopFlag* stop = nullptr) const;

 private:
  void sample_block(std::span<const Vec3> points, const uint32_t* order, size_t count,
                    std::span<double* const> columns) const;

  program::Program program_;
  JobStagesPtr stages_;
  std::vector<Column> columns_;
};

}  // namespace ombre::compile

// A multigrid preconditioner for bricks (Briggs, Henson and McCormick: A Multigrid Tutorial, 2000). Each level joins
// two by two by two bricks, whose moduli are means in which void is 0.
#pragma once

#include <memory>
#include <vector>

#include "base/system/progress.h"
#include "fea/solve/preconditioner.h"

namespace ombre::fea {

class Multigrid : public Preconditioner {
 public:
  // The operator, and `stop` if given, must outlive the object. The constructor and apply() throw Cancelled soon after
  // a request.
  explicit Multigrid(const BrickOperator& finest, const StopFlag* stop = nullptr);
  ~Multigrid() override;

  // Applies one V-cycle.
  void apply(const Vector& forces, Vector& displacements) override;
  size_t levels() const { return levels_.size(); }

 private:
  struct Level;
  void cycle(size_t level, const Vector& forces, Vector& displacements);

  const StopFlag* stop_;
  std::vector<std::unique_ptr<Level>> levels_;
};

}  // namespace ombre::fea

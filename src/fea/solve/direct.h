// The equations of bricks by a factorisation of their matrix as a preconditioner: one to three iterations are enough
// then, whatever the materials and shapes.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/system/helper_process.h"
#include "base/system/progress.h"
#include "base/system/temporary_folder.h"
#include "fea/solve/direct_module.h"
#include "fea/solve/preconditioner.h"

namespace ombre::fea {

// Is MUMPS in this build? What a person reads where it is not.
bool has_factorisations();
std::string without_factorisations();
// And can it be used for these bricks? Not where a brick touches itself.
bool can_factorise(const BrickOperator& stiffness);
// The memory that the matrices of the bricks take, less than all that a factorisation takes.
double element_matrix_bytes(const BrickOperator& stiffness);

// MUMPS cannot be stopped, and says nothing while it works: it runs in a process of its own.
class Factorisation : public Preconditioner {
 public:
  // Orders and counts. What is passed must live as long, and so must the thread; `progress` and `stop` may be null. A
  // request to stop ends all members soon with Cancelled.
  Factorisation(const BrickOperator& stiffness, Progress* progress, const StopFlag* stop);
  ~Factorisation() override;

  const FactorisationCost& cost() const { return cost_; }
  // Keeps the factor in a temporary folder or in memory. Returns false where the precision is not enough. Throws Error
  // when memory or the disk is short.
  bool factorise(bool on_disk, Precision precision);
  void apply(const Vector& forces, Vector& displacements) override;

 private:
  std::string ask(const std::string& request, const std::string& step, double expected_seconds);

  const BrickOperator& stiffness_;
  Progress* progress_;
  const StopFlag* stop_;
  std::optional<TemporaryFolder> folder_;
  std::unique_ptr<Helper> helper_;  // ends before its folder goes
  FactorisationCost cost_;
};

}  // namespace ombre::fea

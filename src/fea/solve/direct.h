// Factorises the matrix of bricks as a preconditioner. With it one to three iterations are enough, whatever the
// materials and shapes.
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

// has_factorisations() is true if this build has MUMPS; the text is for people if it does not.
bool has_factorisations();
std::string without_factorisations();
// True if these bricks can be factorised: no brick may touch itself.
bool can_factorise(const BrickOperator& stiffness);
// Returns the memory that the matrices of the bricks take, which is less than a factorisation takes.
double element_matrix_bytes(const BrickOperator& stiffness);

// A factorisation in a process of its own, since MUMPS cannot be stopped and reports nothing while it works.
class Factorisation : public Preconditioner {
 public:
  // Orders and counts the operations. The arguments and the thread must outlive the object; `progress` and `stop` may
  // be null. After a request to stop, all members end soon with Cancelled.
  Factorisation(const BrickOperator& stiffness, Progress* progress, const StopFlag* stop);
  ~Factorisation() override;

  const FactorisationCost& cost() const { return cost_; }
  // Factorises, and keeps the factor in a temporary folder or in memory. Returns false if the precision is not enough.
  // Throws Error when memory or the disk is short.
  bool factorise(bool on_disk, Precision precision);
  void apply(const Vector& forces, Vector& displacements) override;

 private:
  std::string ask(const std::string& request, const std::string& step, double expected_seconds);

  const BrickOperator& stiffness_;
  Progress* progress_;
  const StopFlag* stop_;
  std::optional<TemporaryFolder> folder_;
  std::unique_ptr<Helper> helper_;  // declared after its folder, so that it ends first
  FactorisationCost cost_;
};

}  // namespace ombre::fea

// The equations of bricks by a factorisation of their matrix in single precision, as a preconditioner: one to three
// iterations are enough then, whatever the materials and shapes.
#pragma once

#include <memory>

#include "base/progress.h"
#include "fea/direct_module.h"
#include "fea/preconditioner.h"

namespace ombre::fea {

// Is MUMPS in this build?
bool has_factorisations();
// And can it be used for these bricks? Not where a brick touches itself.
bool can_factorise(const BrickOperator& stiffness);
// The memory that the matrices of the bricks take, less than all that a factorisation takes.
double element_matrix_bytes(const BrickOperator& stiffness);

class Factorisation : public Preconditioner {
 public:
  // Orders and counts. The operator and the flag must live as long; a request ends all members soon with Cancelled,
  // though a thread of MUMPS may run on for a while, as MUMPS cannot be stopped.
  Factorisation(const BrickOperator& stiffness, const StopFlag* stop);
  ~Factorisation() override;

  const FactorisationCost& cost() const { return cost_; }
  // Keeps the factor in a temporary folder or in memory. Throws Error when memory or the disk is short, or the matrix
  // has no inverse in single precision.
  void factorise(bool on_disk);
  void apply(const Vector& forces, Vector& displacements) override;

 private:
  struct Work;
  template <class Body>
  void run(const Body& body);

  const BrickOperator& stiffness_;
  const StopFlag* stop_;
  std::shared_ptr<Work> work_;
  FactorisationCost cost_;
};

}  // namespace ombre::fea

// The interface between Factorisation and the module that holds MUMPS and METIS.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ombre::fea {

// A symmetric matrix as a sum over elements. Unknowns have numbers from 1.
struct ElementEquations {
  size_t nodes = 0, unknowns = 0;  // `unknowns`: of a node
  std::vector<int> numbers;        // number of each unknown of each node; 0: held
  size_t nodes_of_element = 0;
  std::vector<int> element_nodes;       // nodes from 0, of one element after another
  std::vector<int> begins{1}, members;  // the free unknowns of element n begin at members[begins[n] - 1]
  // The lower triangle of the matrix of one element after another, column by column, in the precision that is
  // factorised.
  std::vector<float> matrices;
  std::vector<double> double_matrices;

  int size = 0;  // number of free unknowns
};

// The precision of a factorisation. Single precision is enough for a preconditioner, unless the equations are too near
// to singular for it, as those of thin plates are.
enum class Precision : uint8_t { single, twofold };

// The cost of a factorisation in single precision.
struct FactorisationCost {
  double operations = 0;                // floating-point operations
  double bytes = 0, bytes_on_disk = 0;  // memory, with the factor in memory or on disk
  double factor_bytes = 0;
  double operations_a_second = 0;  // speed of a product of matrices on this machine; 0 if unknown
};

// A factorisation of element equations. All members throw Error.
class Factoriser {
 public:
  virtual ~Factoriser() = default;
  // Returns the cost by the analysis that the constructor makes; matrices may be empty until factorise().
  virtual FactorisationCost cost() const = 0;
  // Factorises. With a folder the factor is kept in files there. Returns false if the precision is not enough.
  virtual bool factorise(const std::string& folder, Precision precision) = 0;
  // Replaces the right side by the solution.
  virtual void solve(std::vector<double>& values) = 0;
};

}  // namespace ombre::fea

// The function that the module exports: orders and analyses equations, which must outlive the factoriser.
extern "C" void ombre_make_factoriser(ombre::fea::ElementEquations* equations,
                                      std::unique_ptr<ombre::fea::Factoriser>* made);

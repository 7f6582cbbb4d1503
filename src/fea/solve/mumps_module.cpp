// Sparse factorisations by MUMPS (Amestoy, Duff, L'Excellent and Koster, 2001) in an order by METIS' nested dissection
// (Karypis and Kumar, 1998).
#include <dmumps_c.h>
#include <metis.h>
#include <smumps_c.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <optional>
#include <string>

#include "base/system/not_copied.h"
#include "base/text/error.h"
#include "fea/solve/direct_module.h"

// Limits OpenBLAS, if that is the system's BLAS, to one thread, so that sums are reproducible.
extern "C" __attribute__((weak)) void openblas_set_num_threads(int threads);
// The product of matrices in single precision of any BLAS.
extern "C" __attribute__((weak)) void sgemm_(const char* of_a, const char* of_b, const int* rows, const int* columns,
                                             const int* inner, const float* alpha, const float* a, const int* a_rows,
                                             const float* b, const int* b_rows, const float* beta, float* c,
                                             const int* c_rows);

namespace ombre::fea {
namespace {

// Indices of MUMPS' control arrays, numbered from 1 as in its manual.
enum Control : size_t { errors = 1, diagnostics, information, verbosity, elemental, ordering = 7, out_of_core = 22 };
constexpr int start = -1, end = -2, analyse = 1, factorise_numbers = 2, solve_for = 3;
constexpr int positive_definite = 1, order_is_given = 1;
constexpr double bytes_of_megabyte = 1e6;
constexpr int out_of_disk = -90, out_of_memory = -13, singular = -10, not_positive = -40;

// Finds the neighbours of each node: nodes that share an element with it.
std::vector<idx_t> neighbours_of(const ElementEquations& equations, std::vector<idx_t>& begins) {
  const size_t each = equations.nodes_of_element, count = equations.element_nodes.size() / each;
  std::vector<size_t> first(equations.nodes + 1);
  for (const int node : equations.element_nodes) ++first[static_cast<size_t>(node) + 1];
  for (size_t n = 0; n < equations.nodes; ++n) first[n + 1] += first[n];
  std::vector<size_t> next(first.begin(), first.end() - 1);
  std::vector<uint32_t> elements(first.back());
  for (size_t element = 0; element < count; ++element)
    for (size_t n = 0; n < each; ++n)
      elements[next[static_cast<size_t>(equations.element_nodes[element * each + n])]++] =
          static_cast<uint32_t>(element);
  std::vector<idx_t> neighbours, own;
  begins.assign(1, 0);
  for (size_t node = 0; node < equations.nodes; ++node) {
    own.clear();
    for (size_t at = first[node]; at < first[node + 1]; ++at)
      for (size_t n = 0; n < each; ++n)
        if (const int other = equations.element_nodes[elements[at] * each + n]; static_cast<size_t>(other) != node)
          own.push_back(other);
    std::ranges::sort(own);
    own.erase(std::unique(own.begin(), own.end()), own.end());
    neighbours.insert(neighbours.end(), own.begin(), own.end());
    begins.push_back(static_cast<idx_t>(neighbours.size()));
  }
  return neighbours;
}

// Returns the place of each unknown in the order of elimination, from 1.
std::vector<int> order_of(const ElementEquations& equations) {
  std::vector<idx_t> begins, neighbours = neighbours_of(equations, begins);
  auto count = static_cast<idx_t>(equations.nodes);
  std::vector<idx_t> nodes(equations.nodes), places(equations.nodes);
  if (METIS_NodeND(&count, begins.data(), neighbours.data(), nullptr, nullptr, nodes.data(), places.data()) != METIS_OK)
    throw Error(Code::memory, "METIS found no order for the equations; memory may be short");
  std::vector<int> order(static_cast<size_t>(equations.size));
  int place = 0;
  for (const idx_t node : nodes)
    for (size_t n = 0; n < equations.unknowns; ++n)
      if (const int number = equations.numbers[static_cast<size_t>(node) * equations.unknowns + n]; number > 0)
        order[static_cast<size_t>(number) - 1] = ++place;
  return order;
}

// Measures the speed by a product that takes some milliseconds of processor time, the best of three.
double operations_a_second() {
  if (!sgemm_) return 0;
  constexpr int size = 384;
  constexpr float one = 1, zero = 0;
  const std::vector<float> a(size_t{size} * size, one), b(size_t{size} * size, one);
  std::vector<float> c(a.size());
  double best = 0;
  for (int run = 0; run < 3; ++run) {
    const std::clock_t begin = std::clock();
    sgemm_("N", "N", &size, &size, &size, &one, a.data(), &size, b.data(), &size, &zero, c.data(), &size);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (seconds > 0) best = std::max(best, 2.0 * size * size * size / seconds);
  }
  return best;
}

template <class Real>
struct Interface;
template <>
struct Interface<float> {
  using State = SMUMPS_STRUC_C;
  static void run(State& state) { smumps_c(&state); }
  static std::vector<float>& matrices(ElementEquations& equations) { return equations.matrices; }
};
template <>
struct Interface<double> {
  using State = DMUMPS_STRUC_C;
  static void run(State& state) { dmumps_c(&state); }
  static std::vector<double>& matrices(ElementEquations& equations) { return equations.double_matrices; }
};

// Equations in one precision, which the constructor analyses.
template <class Real>
class Factors : NotCopied {
 public:
  Factors(ElementEquations& equations, std::vector<int>& order) : equations_(equations) {
    std::memset(&mumps_, 0, sizeof mumps_);
    mumps_.par = 1;
    mumps_.sym = positive_definite;
    call(start);
    for (const Control stream : {errors, diagnostics, information}) control(stream) = -1;
    control(verbosity) = 0;
    control(elemental) = 1;
    control(ordering) = order_is_given;
    mumps_.perm_in = order.data();
    mumps_.n = equations_.size;
    mumps_.nelt = static_cast<int>(equations_.begins.size()) - 1;
    mumps_.eltptr = equations_.begins.data();
    mumps_.eltvar = equations_.members.data();
    try {
      call(analyse);
    } catch (...) {
      finish();
      throw;
    }
  }
  ~Factors() { finish(); }

  FactorisationCost cost() const {
    constexpr size_t in_core = 17, beside_disk = 27, entries = 3;
    FactorisationCost cost;
    cost.operations = mumps_.rinfog[0];
    cost.bytes = bytes_of_megabyte * mumps_.infog[in_core - 1];
    cost.bytes_on_disk = bytes_of_megabyte * mumps_.infog[beside_disk - 1];
    // MUMPS gives large counts as negative numbers of millions.
    const double count = mumps_.infog[entries - 1];
    cost.factor_bytes = sizeof(Real) * (count < 0 ? -1e6 * count : count);
    return cost;
  }

  // Returns false if the equations are not positive definite in this precision.
  bool factorise(const std::string& folder) {
    if (folder.size() >= sizeof mumps_.ooc_tmpdir)
      throw Error(Code::cannot_write, "the name of the folder " + folder + " is too long");
    if (!folder.empty()) {
      std::memcpy(mumps_.ooc_tmpdir, folder.c_str(), folder.size() + 1);
      std::memcpy(mumps_.ooc_prefix, "factor", sizeof "factor");
      control(out_of_core) = 1;
    }
    mumps_.a_elt = Interface<Real>::matrices(equations_).data();
    if (!call(factorise_numbers)) return false;
    constexpr size_t negative_pivots = 12;
    return mumps_.infog[negative_pivots - 1] == 0;
  }

  void solve(std::vector<Real>& values) {
    mumps_.rhs = values.data();
    mumps_.nrhs = 1;
    call(solve_for);
  }

 private:
  int& control(Control which) { return mumps_.icntl[which - 1]; }

  // Returns false if a matrix has no inverse.
  bool call(int job) {
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    mumps_.job = job;
    constexpr int of_sequential_mpi = -987654;
    mumps_.comm_fortran = of_sequential_mpi;
    Interface<Real>::run(mumps_);
    const int failure = mumps_.infog[0];
    if (failure < 0 && failure != singular && failure != not_positive) fail(failure);
    return failure >= 0;
  }

  [[noreturn]] void fail(int failure) const {
    if (failure == out_of_memory) throw Error(Code::memory, "memory ran out while the equations were factorised");
    if (failure == out_of_disk)
      throw Error(Code::cannot_write, "the factorisation could not be written to " + std::string(mumps_.ooc_tmpdir) +
                                          "; is there room? TMPDIR names another folder");
    throw Error(Code::not_solved, "the equations could not be factorised: MUMPS says " + std::to_string(failure) +
                                      ", " + std::to_string(mumps_.infog[1]));
  }

  void finish() {
    mumps_.job = end;
    Interface<Real>::run(mumps_);
  }

  ElementEquations& equations_;
  typename Interface<Real>::State mumps_;
};

class Mumps : public Factoriser {
 public:
  explicit Mumps(ElementEquations& equations)
      : equations_(equations), order_(order_of(equations)), single_(std::in_place, equations_, order_) {
    cost_ = single_->cost();
    cost_.operations_a_second = operations_a_second();
  }

  FactorisationCost cost() const override { return cost_; }

  bool factorise(const std::string& folder, Precision precision) override {
    if (precision == Precision::single) return single_->factorise(folder);
    single_.reset();
    twofold_.emplace(equations_, order_);
    return twofold_->factorise(folder);
  }

  void solve(std::vector<double>& values) override {
    if (twofold_) return twofold_->solve(values);
    std::vector<float> rounded;
    for (const double value : values) rounded.push_back(static_cast<float>(value));
    single_->solve(rounded);
    std::ranges::copy(rounded, values.begin());
  }

 private:
  ElementEquations& equations_;
  std::vector<int> order_;
  std::optional<Factors<float>> single_;
  std::optional<Factors<double>> twofold_;
  FactorisationCost cost_;
};

}  // namespace
}  // namespace ombre::fea

extern "C" void ombre_make_factoriser(ombre::fea::ElementEquations* equations,
                                      std::unique_ptr<ombre::fea::Factoriser>* made) {
  *made = std::make_unique<ombre::fea::Mumps>(*equations);
}

#include "fea/solve/direct.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/system/byte_pack.h"
#include "base/system/module_loader.h"
#include "base/system/stopwatch.h"
#include "base/text/error.h"

namespace ombre::fea {
namespace {

constexpr Module mumps{"ombre_mumps",      "MUMPS",
                       "direct solutions", "libmumps-seq-dev and libmetis-dev",
                       "OMBRE_MUMPS",      "solve by multigrid"};

// Speed of a factorisation, as a share of that of a product of matrices: measured 0.4 to 0.8.
constexpr double usual_share = 0.5;

enum class Step : uint8_t { analyse, factorise, solve };

void number_unknowns(const BrickOperator& stiffness, ElementEquations& equations) {
  const Bricks& bricks = stiffness.bricks();
  equations.nodes = bricks.node_count();
  equations.unknowns = stiffness.unknowns();
  equations.nodes_of_element = 8;
  equations.numbers.reserve(stiffness.size());
  for (const uint8_t free : stiffness.free()) equations.numbers.push_back(free != 0 ? ++equations.size : 0);
  for (const auto& nodes : bricks.nodes) {
    for (const uint32_t node : nodes) {
      equations.element_nodes.push_back(static_cast<int>(node));
      for (size_t n = 0; n < equations.unknowns; ++n)
        if (const int number = equations.numbers[node * equations.unknowns + n]; number > 0)
          equations.members.push_back(number);
    }
    equations.begins.push_back(static_cast<int>(equations.members.size()) + 1);
  }
}

// Computes the stiffness matrix of a brick, row by row.
void brick_matrix(const BrickOperator& stiffness, size_t brick, std::vector<double>& matrix) {
  const size_t size = 8 * stiffness.unknowns();
  matrix.resize(size * size);
  BrickVector unit{};
  for (size_t n = 0; n < size; ++n) {
    unit[n] = 1;
    stiffness.brick_forces(brick, unit.data(), matrix.data() + n * size);
    unit[n] = 0;
  }
}

// The addition to a node's diagonal comes with its first brick.
template <class Real>
std::vector<Real> element_matrices(const BrickOperator& stiffness, const ElementEquations& equations) {
  std::vector<Real> matrices;
  const Bricks& bricks = stiffness.bricks();
  const size_t unknowns = stiffness.unknowns(), size = 8 * unknowns;
  Vector more = stiffness.more_diagonal();
  std::optional<Moduli> last;
  std::vector<double> matrix;
  for (size_t brick = 0; brick < bricks.count(); ++brick) {
    const Moduli& moduli = stiffness.moduli()[brick];
    const bool is_cut = stiffness.has_own_matrix(brick);
    if (is_cut || !last || last->shear != moduli.shear || last->bulk != moduli.bulk) {
      brick_matrix(stiffness, brick, matrix);
      last = is_cut ? std::nullopt : std::optional(moduli);
    }
    const auto place = [&](size_t n) { return bricks.nodes[brick][n / unknowns] * unknowns + n % unknowns; };
    for (size_t column = 0; column < size; ++column) {
      if (equations.numbers[place(column)] == 0) continue;
      for (size_t row = column; row < size; ++row) {
        if (equations.numbers[place(row)] == 0) continue;
        double value = matrix[row * size + column];
        if (row == column && !more.empty()) value += std::exchange(more[place(row)], 0);
        matrices.push_back(static_cast<Real>(value));
      }
    }
  }
  return matrices;
}

}  // namespace

bool has_factorisations() { return has_module(mumps); }

std::string without_factorisations() { return without(mumps); }

bool can_factorise(const BrickOperator& stiffness) {
  return has_factorisations() && std::ranges::find(stiffness.bricks().period, 1) == stiffness.bricks().period.end();
}

double element_matrix_bytes(const BrickOperator& stiffness) {
  const double size = 8.0 * static_cast<double>(stiffness.unknowns());
  const double of_brick = size * (size + 1) / 2 * sizeof(float) + size * sizeof(int) + 8 * sizeof(int);
  return of_brick * static_cast<double>(stiffness.bricks().count());
}

namespace {

// The factorisation within the helper process.
class Server {
 public:
  Server(const BrickOperator& stiffness, decltype(ombre_make_factoriser)* make) : stiffness_(stiffness), make_(make) {}

  std::string answer(const std::string& request) {
    ByteUnpacker unpacker(request);
    BytePacker packer;
    switch (unpacker.get<Step>()) {
      case Step::analyse:
        number_unknowns(stiffness_, equations_);
        make_(&equations_, &factoriser_);
        packer.add(factoriser_->cost());
        break;
      case Step::factorise: {
        const auto precision = unpacker.get<Precision>();
        packer.add(factorise(precision, std::string(unpacker.get_text())));
      } break;
      case Step::solve:
        std::vector<double> values = unpacker.get_list<double>();
        factoriser_->solve(values);
        packer.add_list(values);
        break;
    }
    return packer.take();
  }

 private:
  bool factorise(Precision precision, const std::string& folder) {
    if (precision == Precision::single)
      equations_.matrices = element_matrices<float>(stiffness_, equations_);
    else
      equations_.double_matrices = element_matrices<double>(stiffness_, equations_);
    const bool is_done = factoriser_->factorise(folder, precision);
    equations_.matrices = {};
    equations_.double_matrices = {};
    return is_done;
  }

  const BrickOperator& stiffness_;
  decltype(ombre_make_factoriser)* make_;
  ElementEquations equations_;
  std::unique_ptr<Factoriser> factoriser_;
};

Error explain(HelperFailure) {
  return {
      Code::memory,
      "the factorisation of the equations ended early, most likely since memory ran out; solve by multigrid, choose "
      "larger bricks, or allow less memory, so that the factor goes to the disk"};
}

}  // namespace

Factorisation::Factorisation(const BrickOperator& stiffness, Progress* progress, const StopFlag* stop)
    : stiffness_(stiffness), progress_(progress), stop_(stop) {
  const auto make = load_function<decltype(ombre_make_factoriser)>(mumps, "ombre_make_factoriser");
  constexpr double a_week = 7 * 24 * 3600.0;
  const auto server = std::make_shared<Server>(stiffness, make);
  helper_ = std::make_unique<Helper>([server](const std::string& request) { return server->answer(request); },
                                     HelperLimits{a_week, 0}, explain);
  BytePacker request;
  request.add(Step::analyse);
  const std::string answer = ask(request.take(), "ordering the equations", 0);
  cost_ = ByteUnpacker(answer).get<FactorisationCost>();
  const double matrices = element_matrix_bytes(stiffness);
  cost_.bytes += matrices;
  cost_.bytes_on_disk += matrices;
}

Factorisation::~Factorisation() = default;

// While it waits, progress follows the expected time, if that is known.
std::string Factorisation::ask(const std::string& request, const std::string& step, double expected_seconds) {
  const Stopwatch watch;
  const auto tell = [&] {
    if (!progress_) return;
    constexpr uint64_t parts = 1000, last = 990;
    HowFar how_far{0, parts};
    const double left = expected_seconds - watch.seconds();
    if (expected_seconds > 0)
      how_far.done = std::min(last, static_cast<uint64_t>(parts * watch.seconds() / expected_seconds));
    if (left > 0) how_far.seconds_left = left;
    progress_->preparing(step, how_far);
  };
  return helper_->ask(request, stop_, tell);
}

bool Factorisation::factorise(bool on_disk, Precision precision) {
  folder_.reset();
  if (on_disk) folder_.emplace();
  BytePacker request;
  request.add(Step::factorise);
  request.add(precision);
  request.add_text(folder_ ? folder_->path().string() : "");
  const double rate = usual_share * cost_.operations_a_second;
  const double expected = rate > 0 ? cost_.operations / rate : 0;
  const std::string answer =
      ask(request.take(), "factorising the equations", precision == Precision::single ? expected : 2 * expected);
  return ByteUnpacker(answer).get<bool>();
}

void Factorisation::apply(const Vector& forces, Vector& displacements) {
  // The scale brings numbers into the range of single precision, however small they are.
  double scale = 0;
  for (const double force : forces) scale = std::max(scale, std::abs(force));
  displacements.assign(forces.size(), 0);
  if (!(scale > 0)) return;
  std::vector<double> values;
  for (size_t n = 0; n < forces.size(); ++n)
    if (stiffness_.free()[n] != 0) values.push_back(forces[n] / scale);
  BytePacker request;
  request.add(Step::solve);
  request.add_list(values);
  const std::string answer = helper_->ask(request.take(), stop_);
  values = ByteUnpacker(answer).get_list<double>();
  size_t next = 0;
  for (size_t n = 0; n < forces.size(); ++n)
    if (stiffness_.free()[n] != 0) displacements[n] = scale * values[next++];
}

}  // namespace ombre::fea

#include "fea/direct.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/module_loader.h"
#include "base/temporary_folder.h"

namespace ombre::fea {
namespace {

#ifdef OMBRE_MUMPS_MODULE
constexpr const char* mumps_module = OMBRE_MUMPS_MODULE;
#else
constexpr const char* mumps_module = nullptr;
#endif

constexpr std::chrono::milliseconds between_looks{50};

std::atomic<int> abandoned_threads{0};

// A thread that could not be stopped must not go on while the program takes its variables down.
void leave_at_once(int status, void*) {
  if (abandoned_threads == 0) return;
  std::cout.flush();
  std::fflush(nullptr);
  ::_exit(status);
}

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

// The stiffness of a brick, row by row.
void brick_matrix(const BrickOperator& stiffness, const Moduli& moduli, std::vector<double>& matrix) {
  const size_t size = 8 * stiffness.unknowns();
  matrix.assign(size * size, 0);
  if (stiffness.unknowns() == 1) {
    const BrickConductance brick = brick_conductance(stiffness.bricks().size_mm);
    for (size_t n = 0; n < size; ++n) {
      std::array<double, 8> unit{}, flows{};
      unit[n] = 1;
      brick.add_flows(moduli.shear, unit, flows);
      std::ranges::copy(flows, matrix.begin() + static_cast<std::ptrdiff_t>(n * size));
    }
    return;
  }
  const BrickStiffness brick = brick_stiffness(stiffness.bricks().size_mm);
  for (size_t n = 0; n < size; ++n)
    for (size_t m = 0; m < size; ++m)
      matrix[n * size + m] =
          moduli.shear * brick.shear[n][m] + moduli.bulk * brick.volume_mm3 * brick.dilation[n] * brick.dilation[m];
}

// What is added to the diagonal comes with the first brick of each node.
void fill_matrices(const BrickOperator& stiffness, ElementEquations& equations) {
  const Bricks& bricks = stiffness.bricks();
  const size_t unknowns = stiffness.unknowns(), size = 8 * unknowns;
  Vector more = stiffness.more_diagonal();
  std::optional<Moduli> last;
  std::vector<double> matrix;
  for (size_t brick = 0; brick < bricks.count(); ++brick) {
    const Moduli& moduli = stiffness.moduli()[brick];
    if (!last || last->shear != moduli.shear || last->bulk != moduli.bulk) {
      brick_matrix(stiffness, moduli, matrix);
      last = moduli;
    }
    const auto place = [&](size_t n) { return bricks.nodes[brick][n / unknowns] * unknowns + n % unknowns; };
    for (size_t column = 0; column < size; ++column) {
      if (equations.numbers[place(column)] == 0) continue;
      for (size_t row = column; row < size; ++row) {
        if (equations.numbers[place(row)] == 0) continue;
        double value = matrix[row * size + column];
        if (row == column && !more.empty()) value += std::exchange(more[place(row)], 0);
        equations.matrices.push_back(static_cast<float>(value));
      }
    }
  }
}

}  // namespace

bool has_factorisations() { return mumps_module != nullptr; }

bool can_factorise(const BrickOperator& stiffness) {
  return mumps_module && std::ranges::find(stiffness.bricks().period, 1) == stiffness.bricks().period.end();
}

double element_matrix_bytes(const BrickOperator& stiffness) {
  const double size = 8.0 * static_cast<double>(stiffness.unknowns());
  const double of_brick = size * (size + 1) / 2 * sizeof(float) + size * sizeof(int) + 8 * sizeof(int);
  return of_brick * static_cast<double>(stiffness.bricks().count());
}

// What a thread of MUMPS works on, which may outlive the factorisation that it was for.
struct Factorisation::Work {
  ElementEquations equations;
  std::optional<TemporaryFolder> folder;
  std::unique_ptr<Factoriser> factoriser;
  std::vector<float> values;

  std::mutex mutex;
  std::condition_variable ended;
  bool is_done = false, is_abandoned = false;
  std::exception_ptr thrown;
};

// In a thread, which is left alone when the work is not wanted any more.
template <class Body>
void Factorisation::run(const Body& body) {
  work_->is_done = false;
  std::thread thread([work = work_, body]() mutable {
    std::exception_ptr thrown;
    try {
      body(*work);
    } catch (...) {
      thrown = std::current_exception();
    }
    bool is_abandoned = false;
    {
      const std::lock_guard lock(work->mutex);
      work->thrown = thrown;
      work->is_done = true;
      is_abandoned = work->is_abandoned;
      work->ended.notify_all();
    }
    work.reset();
    if (is_abandoned) --abandoned_threads;
  });
  std::unique_lock lock(work_->mutex);
  while (!work_->ended.wait_for(lock, between_looks, [&] { return work_->is_done; })) {
    if (!stop_ || !stop_->requested()) continue;
    ++abandoned_threads;
    work_->is_abandoned = true;
    static const int registered = ::on_exit(leave_at_once, nullptr);
    static_cast<void>(registered);
    thread.detach();
    if (work_->folder) {
      std::error_code ignored;
      std::filesystem::remove_all(work_->folder->path(), ignored);
    }
    throw Cancelled();
  }
  lock.unlock();
  thread.join();
  if (work_->thrown) std::rethrow_exception(std::exchange(work_->thrown, nullptr));
}

Factorisation::Factorisation(const BrickOperator& stiffness, const StopFlag* stop)
    : stiffness_(stiffness), stop_(stop), work_(std::make_shared<Work>()) {
  const auto make =
      load_function<decltype(ombre_make_factoriser)>(mumps_module, "ombre_make_factoriser", "direct solutions");
  number_unknowns(stiffness, work_->equations);
  run([make](Work& work) { make(&work.equations, &work.factoriser); });
  cost_ = work_->factoriser->cost();
  const double matrices = element_matrix_bytes(stiffness);
  cost_.bytes += matrices;
  cost_.bytes_on_disk += matrices;
}

Factorisation::~Factorisation() = default;

void Factorisation::factorise(bool on_disk) {
  fill_matrices(stiffness_, work_->equations);
  if (on_disk) work_->folder.emplace();
  run([](Work& work) { work.factoriser->factorise(work.folder ? work.folder->path() : ""); });
  work_->equations.matrices = {};
}

void Factorisation::apply(const Vector& forces, Vector& displacements) {
  // Within what single precision holds, however small they are.
  double scale = 0;
  for (const double force : forces) scale = std::max(scale, std::abs(force));
  displacements.assign(forces.size(), 0);
  if (!(scale > 0)) return;
  std::vector<float>& values = work_->values;
  values.clear();
  for (size_t n = 0; n < forces.size(); ++n)
    if (stiffness_.free()[n] != 0) values.push_back(static_cast<float>(forces[n] / scale));
  run([](Work& work) { work.factoriser->solve(work.values); });
  size_t next = 0;
  for (size_t n = 0; n < forces.size(); ++n)
    if (stiffness_.free()[n] != 0) displacements[n] = scale * static_cast<double>(values[next++]);
}

}  // namespace ombre::fea

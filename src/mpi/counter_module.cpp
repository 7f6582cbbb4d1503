// A counter that processes of MPI share: a number in the memory of the first one, which the others read and increase
// without its help.
#include <mpi.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "base/system/not_copied.h"
#include "mpi/counter_calls.h"

namespace {

// Lets MPI answer the other processes while this one computes. Some networks need the owner of the memory for that.
class Answering : ombre::NotCopied {
 public:
  explicit Answering(bool answers) {
    if (answers) thread_ = std::thread([this] { run(); });
  }
  ~Answering() {
    is_over_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  void run() const {
    constexpr std::chrono::milliseconds pause{1};
    for (int is_there = 0; !is_over_; std::this_thread::sleep_for(pause))
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, MPI_STATUS_IGNORE);
  }

  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

class Counter {
 public:
  explicit Counter(bool is_owner) {
    int64_t* memory = nullptr;
    const MPI_Aint bytes = is_owner ? sizeof(int64_t) : 0;
    MPI_Win_allocate(bytes, sizeof(int64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &memory, &window_);
    if (is_owner) *memory = 0;
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Win_lock_all(0, window_);
  }
  // All processes have to call it.
  void free() {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }

  int64_t next() const {
    constexpr int owner = 0;
    const int64_t one = 1;
    int64_t number = 0;
    MPI_Fetch_and_op(&one, &number, MPI_INT64_T, owner, 0, MPI_SUM, window_);
    MPI_Win_flush(owner, window_);
    return number;
  }

 private:
  MPI_Win window_ = MPI_WIN_NULL;
};

// Returns false if the process is to leave at once.
bool take_all(int64_t count, int rank, const std::function<bool(int64_t)>& take) {
  Counter counter(rank == 0);
  const Answering answering(rank == 0);
  for (int64_t number = counter.next(); number < count; number = counter.next())
    if (!take(number)) return false;
  counter.free();
  return true;
}

}  // namespace

bool ombre_take_numbers(int64_t count, int64_t processes, const std::function<bool(int64_t number)>* take) {
  int threads = 0, rank = 0, size = 1;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_MULTIPLE, &threads);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  // A launcher of another MPI starts processes that do not know of each other.
  const bool is_ours = size == processes && threads == MPI_THREAD_MULTIPLE;
  // A process that leaves early does not wait for the others, as the end of MPI would.
  if (!is_ours || take_all(count, rank, *take)) MPI_Finalize();
  return is_ours;
}

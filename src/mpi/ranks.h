// The processes of a run of MPI, which take numbered pieces of work as they become free.
#pragma once

#include <cstdint>
#include <functional>

namespace ombre::mpi {

// Takes one piece of work; returns false if the process is to leave at once.
using TakeNumber = std::function<bool(int64_t number)>;

// Calls `take` with numbers from 0 to count - 1 until none is left. All processes of the run call it, and each number
// is taken by one of them. `processes` is their number, as their launcher says it. Returns false, and takes nothing, if
// this build has no MPI, or its MPI is not the launcher's.
bool take_numbers(int64_t count, int64_t processes, const TakeNumber& take);

}  // namespace ombre::mpi

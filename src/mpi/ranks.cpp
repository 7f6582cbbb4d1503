// Loads the module with MPI, in processes of MPI alone.
#include "mpi/ranks.h"

#include "base/system/module_loader.h"
#include "mpi/counter_calls.h"

namespace ombre::mpi {
namespace {

constexpr Module module{"ombre_mpi_counter", "MPI",       "shares that processes take as they become free",
                        "libopenmpi-dev",    "OMBRE_MPI", "each process takes the shares of its rank"};

}  // namespace

bool take_numbers(int64_t count, int64_t processes, const TakeNumber& take) {
  return has_module(module) &&
         load_function<decltype(ombre_take_numbers)>(module, "ombre_take_numbers")(count, processes, &take);
}

}  // namespace ombre::mpi

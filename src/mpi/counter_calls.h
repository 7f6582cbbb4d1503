// The interface between take_shares() and the module that holds MPI.
#pragma once

#include <cstdint>
#include <functional>

// A function that the module exports. `take` returns false if the process is to leave at once.
extern "C" bool ombre_take_numbers(int64_t count, int64_t processes, const std::function<bool(int64_t number)>* take);

// The interface between kernel() and the module with CGAL.
#pragma once

#include "solids/kernel.h"

// Returns the kernel, which lives as long as the program; the function that the module exports.
extern "C" const ombre::solids::Kernel* ombre_solids_kernel();

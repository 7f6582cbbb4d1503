// Between kernel() and the module that holds CGAL.
#pragma once

#include "solids/kernel.h"

// What the module exports. The kernel lives as long as the program.
extern "C" const ombre::solids::Kernel* ombre_solids_kernel();

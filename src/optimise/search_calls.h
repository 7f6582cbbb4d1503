// The interface between search() and the modules that hold NLopt and pagmo.
#pragma once

#include "optimise/problem.h"

// Functions that the modules export.
extern "C" void ombre_search_nlopt(const ombre::optimise::Problem* problem,
                                   const ombre::optimise::SearchOptions* options);
extern "C" void ombre_search_pagmo(const ombre::optimise::Problem* problem,
                                   const ombre::optimise::SearchOptions* options);

// The steps of a file of results.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/text/diagnostic.h"
#include "formats/results/results.h"

namespace ombre::formats {

// Returns a list such as "1 (time 0.5), 2 (time 1)", shortened if there are many.
std::string steps_text(std::span<const std::string> times);

// Returns the index of the step that is wanted by its number from 1, or of the last for 0. `times` has the time of each
// step, empty if the file does not say it. Reports an error that lists the steps, and throws DesignError, if there is
// no such step.
size_t step_index(const std::string& name, std::span<const std::string> times, uint64_t wanted,
                  Diagnostics& diagnostics);

// Writes down which steps the file has, and the index of the one that was read.
void set_steps(Results& results, std::vector<std::string> times, size_t index);

}  // namespace ombre::formats

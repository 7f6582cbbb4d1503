#include "formats/results/result_steps.h"

#include <algorithm>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {

std::string steps_text(std::span<const std::string> times) {
  constexpr size_t most_listed = 20;
  std::vector<std::string> steps;
  for (size_t n = 0; n < std::min(times.size(), most_listed); ++n)
    steps.push_back(std::to_string(n + 1) + (times[n].empty() ? "" : " (time " + times[n] + ")"));
  return join(steps, ", ") + (times.size() > most_listed ? ", ..." : "");
}

size_t step_index(const std::string& name, std::span<const std::string> times, uint64_t wanted,
                  Diagnostics& diagnostics) {
  if (times.empty()) fail(diagnostics, name, "the file has no steps");
  if (wanted <= times.size()) return (wanted == 0 ? times.size() : wanted) - 1;
  const std::string message = "there is no step " + std::to_string(wanted);
  if (times.size() == 1) fail(diagnostics, name, message + "; the file has one step", "leave step out");
  fail(diagnostics, name, message + "; the file has " + std::to_string(times.size()) + " steps: " + steps_text(times),
       "write a step from 1 to " + std::to_string(times.size()) + ", or leave step out for the last");
}

void set_steps(Results& results, std::vector<std::string> times, size_t index) {
  results.step_times = std::move(times);
  results.step = index + 1;
}

}  // namespace ombre::formats

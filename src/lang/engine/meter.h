// Counts the resources that a script uses, and stops it at the limits.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "base/system/progress.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "lang/engine/limits.h"

namespace ombre::lang {

// Thrown to stop the whole evaluation. It becomes a diagnostic at the current position.
struct LimitReached {
  std::string message, hint;
};

class Meter {
 public:
  Meter(const Limits& limits, const StopFlag* stop) : limits_(limits), stop_(stop) {}

  const Limits& limits() const { return limits_; }

  void spend(uint64_t steps = 1) {
    steps_ += steps;
    if (steps_ >= next_check_) check();
  }

  void claim_element() {
    if (++elements_ > limits_.elements) too_many_elements();
  }
  void release_elements(uint64_t count) { elements_ -= count; }
  [[noreturn]] void too_many_elements() const {
    throw LimitReached{"the lists of this design hold more than " + format_count(limits_.elements) + " elements",
                       "build fewer or shorter lists"};
  }

  void claim_text(uint64_t bytes) {
    text_ += bytes;
    check_text(0);
  }
  void release_text(uint64_t bytes) { text_ -= bytes; }
  // Called before a string of that size is built.
  void check_text(uint64_t bytes) const {
    if (text_ + bytes > limits_.text_bytes)
      throw LimitReached{
          "the strings and values of this design hold more than " + format_count(limits_.text_bytes) + " bytes",
          "build fewer or shorter ones"};
  }

  void count_call() {
    if (++calls_ > limits_.calls)
      throw LimitReached{"the design calls modules more than " + format_count(limits_.calls) + " times",
                         "look for a module that calls itself more than once, so that each level doubles the calls"};
  }

  void count_instance() {
    if (++instances_ > limits_.instances)
      throw LimitReached{"the design makes more than " + format_count(limits_.instances) + " nodes",
                         "repeat parts with fewer loops"};
  }

 private:
  static constexpr uint64_t check_interval = 1 << 16;

  void check() {
    if (stop_ && stop_->requested()) throw Cancelled{};
    if (steps_ > limits_.steps)
      throw LimitReached{"the evaluation takes more than " + format_count(limits_.steps) + " steps",
                         "look for a recursion or loop that does not end"};
    next_check_ = std::min(steps_ + check_interval, limits_.steps + 1);
  }

  const Limits& limits_;
  const StopFlag* stop_;
  uint64_t steps_ = 0, next_check_ = 0, elements_ = 0, text_ = 0, instances_ = 0, calls_ = 0;
};

}  // namespace ombre::lang

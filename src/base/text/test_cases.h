// Cases of tests as lines of text, which need no escapes.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "base/text/text.h"

namespace ombre {

// Calls check(input, expected) for each line "input => expected"; a long one may be broken before the arrow.
template <class Check>
void for_cases(std::string_view lines, const Check& check) {
  std::string input;
  for (const std::string& line : split(lines, '\n')) {
    const size_t arrow = line.find("=>");
    input += trim(std::string_view(line).substr(0, arrow));
    if (arrow == std::string::npos) continue;
    check(input, std::string(trim(std::string_view(line).substr(arrow + 2))));
    input.clear();
  }
  EXPECT_EQ(input, "") << "is followed by no arrow";
}

}  // namespace ombre

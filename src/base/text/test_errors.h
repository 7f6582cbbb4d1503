// Catches errors, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/text/error.h"

namespace ombre {

// Returns the message of the error that `act` throws.
template <class Act>
std::string failure_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

// Expects an error whose message contains the text.
template <class Act>
void expect_error(const Act& act, const std::string& part) {
  const std::string failure = failure_of(act);
  EXPECT_NE(failure.find(part), std::string::npos) << failure;
}

}  // namespace ombre

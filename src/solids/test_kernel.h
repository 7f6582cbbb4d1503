// Tests of solids.
#pragma once

#include <gtest/gtest.h>

#include "solids/kernel.h"

namespace ombre::solids {

// Tests that are left out where solids cannot be combined.
class KernelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_kernel()) GTEST_SKIP();
  }
};

}  // namespace ombre::solids

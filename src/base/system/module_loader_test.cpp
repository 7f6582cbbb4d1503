#include "base/system/module_loader.h"

#include <gtest/gtest.h>

#include "base/text/test_errors.h"

namespace ombre {
namespace {

TEST(ModuleLoader, SaysWhatCannotBeDoneWithoutAModule) {
  const Module module{"ombre_of_no_one", "zlib", "zip archives", "zlib1g-dev", "OMBRE_ZIP", "unpack them"};
  EXPECT_FALSE(has_module(module));
  EXPECT_EQ(failure_of([&] { load_symbol(module, "ombre_calls"); }),
            "this ombre was built without zlib, which zip archives need; ./dev build release makes it (zlib1g-dev, "
            "-DOMBRE_ZIP=ON), or unpack them");
}

TEST(ModuleLoader, SaysWhatCannotBeLoaded) {
  expect_error([] { load_symbol("/nowhere/libombre_of_no_one.so", "ombre_calls", "zip archives"); },
               "zip archives need /nowhere/libombre_of_no_one.so, which cannot be loaded: ");
}

TEST(ModuleLoader, FindsFunctionsOfLibraries) {
  void* const cosine = load_symbol("libm.so.6", "cos", "cosines");
  EXPECT_EQ(reinterpret_cast<double (*)(double)>(cosine)(0), 1);  // NOLINT
  EXPECT_THROW(load_symbol("libm.so.6", "no_such_function", "cosines"), Error);
}

}  // namespace
}  // namespace ombre

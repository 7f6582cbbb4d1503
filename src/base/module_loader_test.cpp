#include "base/module_loader.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace ombre {
namespace {

TEST(ModuleLoader, SaysWhatCannotBeDoneWithoutAModule) {
  try {
    load_symbol("/nowhere/libombre_of_no_one.so", "ombre_calls", "zip archives");
    FAIL() << "a module that is not there was loaded";
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what())
                    .starts_with("zip archives need /nowhere/libombre_of_no_one.so, which cannot be loaded: "))
        << error.what();
  }
}

TEST(ModuleLoader, FindsFunctionsOfLibraries) {
  const auto cosine = load_function<double(double)>("libm.so.6", "cos", "cosines");
  EXPECT_EQ(cosine(0), 1);
  EXPECT_THROW(load_symbol("libm.so.6", "no_such_function", "cosines"), Error);
}

}  // namespace
}  // namespace ombre

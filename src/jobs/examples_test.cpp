// Tests every example in float batches against the reference.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <tuple>

#include "base/system/test_source_files.h"
#include "jobs/slice/plan.h"
#include "jobs/test_designs.h"

namespace ombre::compile {
namespace {

std::vector<std::string> examples() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(source_file("examples")))
    if (entry.path().extension() == ".vcad") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// Slices an example into about a million voxels, whatever its size.
std::vector<MaterialId> slice_example(const LoadedPtr& loaded, voxel::Evaluator evaluator, voxel::Dither dither) {
  PlanOptions options;
  options.evaluator = evaluator;
  options.dither = dither;
  Diagnostics diagnostics;
  auto plan = plan_slice(loaded, options, diagnostics);
  if (!plan) return {};
  const double finer = std::cbrt(static_cast<double>(plan->request.lattice.voxels()) / 1e6);
  for (size_t axis = 0; axis < 3; ++axis)
    options.pitch[axis] = Pitch::from_mm(std::ceil(plan->request.lattice.pitch[axis].mm() * finer * 1e4) / 1e4);
  plan = plan_slice(loaded, options, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << to_text(diagnostics);
  return plan ? unpack(plan->producer(0, plan->request.lattice.count[2], nullptr)) : std::vector<MaterialId>();
}

class EveryExample : public testing::TestWithParam<std::tuple<std::string, voxel::Dither>> {};

}  // namespace

TEST_P(EveryExample, IsTheSameInBatchesAndByTheReference) {
  const auto& [example, dither] = GetParam();
  Diagnostics diagnostics;
  use_source_data();
  const LoadedPtr loaded = load_design(source_file("examples/") + example + ".vcad", {}, diagnostics);
  if (to_text(diagnostics).find("ombre was built without") != std::string::npos) GTEST_SKIP();
  ASSERT_TRUE(loaded) << to_text(diagnostics);
  const auto exact = slice_example(loaded, voxel::Evaluator::reference, dither);
  const auto fast = slice_example(loaded, voxel::Evaluator::batch, dither);
  ASSERT_EQ(exact.size(), fast.size());
  ASSERT_FALSE(exact.empty());
  size_t different = 0;
  for (size_t n = 0; n < exact.size(); ++n) different += exact[n] != fast[n];
  std::cout << different << " of " << exact.size() << " voxels lie within rounding of a boundary\n";
  // A float is off by some 10^-7 of the part's size, and a voxel is a hundredth of it.
  EXPECT_LE(static_cast<double>(different), 3e-5 * static_cast<double>(exact.size()));
}

INSTANTIATE_TEST_SUITE_P(Examples, EveryExample,
                         testing::Combine(testing::ValuesIn(examples()),
                                          testing::Values(voxel::Dither::stochastic, voxel::Dither::blue_noise,
                                                          voxel::Dither::threshold)),
                         [](const auto& test) {
                           std::string title =
                               std::get<0>(test.param) + "_" + std::string(name(std::get<1>(test.param)));
                           std::ranges::replace(title, '-', '_');
                           return title;
                         });

}  // namespace ombre::compile

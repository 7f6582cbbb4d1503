// Writes stacks of small designs, for tests.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "jobs/slice/plan.h"
#include "jobs/stacks/verify.h"
#include "jobs/test_designs.h"
#include "jobs/test_slices.h"

namespace ombre::compile {

// A ball and a block beside it, with no symmetry, mixed of red and blue by fractions that change with the height.
inline const std::string graded_text =
    "fgrade([\"(z + 2) / 4\", \"(2 - z) / 4\"], [red, blue]) union() {\n"
    "  sphere(2);\n"
    "  translate(2.5, 1, 0) rectprism([2, 1, 4]);\n"
    "}\n";

class StackTest : public Slice {
 protected:
  StackTest() {
    options_.pitch = {Pitch{1, 5}, Pitch{1, 5}, Pitch{1, 5}};
    options_.program = "ombre test";
  }

  LoadedPtr load(const std::string& text) {
    Diagnostics diagnostics;
    LoadedPtr loaded = load_text(text, diagnostics);
    EXPECT_TRUE(loaded) << to_text(diagnostics);
    return loaded;
  }

  Plan plan(const LoadedPtr& loaded) {
    Diagnostics diagnostics;
    auto plan = plan_slice(loaded, options_, diagnostics);
    EXPECT_TRUE(plan) << to_text(diagnostics);
    return std::move(*plan);
  }

  // Writes the stack, with the layers that a function makes in place of the design's, and the hashes and counts of
  // these.
  using LayerOf = std::function<voxel::LayerResult(const Plan& plan, int64_t layer)>;
  void write_stack(const LoadedPtr& loaded, const LayerOf& layer_of = right_layer) {
    const Plan planned = plan(loaded);
    const LayerProducer producer = [&](int64_t begin, int64_t end, const StopFlag*) {
      std::vector<voxel::LayerResult> layers;
      for (int64_t k = begin; k < end; ++k) layers.push_back(layer_of(planned, k));
      return layers;
    };
    SliceOptions use = options(FolderUse::replace);
    use.stages = planned.stages;
    slice(planned.request, producer, use);
  }

  static voxel::LayerResult right_layer(const Plan& plan, int64_t layer) {
    return std::move(plan.producer(layer, layer + 1, nullptr).front());
  }

  // Returns the layer after a function has changed its voxels.
  using Change = std::function<void(std::vector<MaterialId>& voxels, int64_t width)>;
  static voxel::LayerResult changed_layer(voxel::LayerResult layer, const Change& change) {
    const uint32_t width = layer.materials().width(), height = layer.materials().height();
    std::vector<MaterialId> voxels(size_t{width} * height);
    for (uint32_t j = 0; j < height; ++j) layer.materials().row(j).unpack(voxels.data() + size_t{j} * width);
    change(voxels, width);
    RunLayer runs(width);
    for (uint32_t j = 0; j < height; ++j) runs.append_row(voxels.data() + size_t{j} * width);
    layer.materials() = std::move(runs);
    return layer;
  }

  Verification verified(const LoadedPtr& design, const SampleChoice& choice = {}, const std::string& layers = "") {
    Diagnostics diagnostics;
    CheckWork work;
    work.threads = 2;
    auto result = verify({folder(), layers, design, choice, "ombre test"}, work, diagnostics);
    EXPECT_TRUE(result) << to_text(diagnostics);
    return std::move(*result);
  }

  static std::set<std::string> kinds(const Verification& verification) {
    std::set<std::string> kinds;
    for (const Finding& finding : verification.findings()) kinds.insert(finding.kind);
    return kinds;
  }
  static std::string texts(const Verification& verification) {
    std::string text;
    for (const Finding& finding : verification.findings()) text += finding.kind + ": " + finding.text + "\n";
    return text;
  }

  PlanOptions options_;
};

}  // namespace ombre::compile

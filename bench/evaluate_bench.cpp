// Evaluation by itself: voxels a second of some designs, from program to runs, by instruction set.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <string>

#include "jobs/slice/plan.h"
#include "load/find_printer.h"
#include "load/load.h"
#include "voxel/layers.h"

namespace {

using namespace ombre;

// Of 10 mm, cut into 1000 voxels along each side.
const std::map<std::string, std::string> designs{
    {"sphere", "sphere(5);"},
    {"graded_sphere", "fgrade([\"1/(1 + exp(x))\", \"1 - 1/(1 + exp(x))\"], [\"red\", \"blue\"]) sphere(5);"},
    {"gyroid", "intersection() { cube(10); function(\"sin(2*x)*cos(2*y) + sin(2*y)*cos(2*z) + sin(2*z)*cos(2*x)\"); }"},
    {"turned_gyroid",
     "intersection() { cube(10); rotate(10, 20, 30) function(\"sin(2*x)*cos(2*y) + sin(2*y)*cos(2*z) + "
     "sin(2*z)*cos(2*x)\", bounds=((-20, -20, -20), (20, 20, 20))); }"},
    {"turned_boxes",
     "for (i = [0:29]) rotate(i*7, i*31, i*53) rectprism((9, 0.3, 0.3), i % 2 == 0 ? \"red\" : \"blue\");"},
    {"struts_1000",
     "for (i = [0:999]) { x = 4*sin(i*137.5); y = 4*cos(i*71.3); z = 4*sin(i*29.1); strut((x, y, z), "
     "(x + sin(i), y + cos(i), z + 0.5), 0.1, i % 2 == 0 ? \"red\" : \"blue\"); }"},
};

std::optional<compile::Plan> plan(const std::string& text, compile::PlanOptions options) {
  const std::string path = "/tmp/ombre_evaluate_bench.vcad";
  std::ofstream(path) << text;
  Diagnostics diagnostics;
  const compile::LoadedPtr loaded = compile::load_design(path, {}, diagnostics);
  std::remove(path.c_str());
  if (!loaded) return std::nullopt;
  return compile::plan_slice(loaded, options, diagnostics);
}

// Every fourth slab of eight layers.
void evaluate(benchmark::State& state, const std::string& text, const voxel::EvaluatorOptions& evaluator) {
  compile::PlanOptions options;
  options.evaluator = evaluator.evaluator;
  options.speed = evaluator;
  for (auto& pitch : options.pitch) pitch = Pitch::parse("0.01");
  const auto job = plan(text, options);
  if (!job) return state.SkipWithError("the design is wrong");
  const auto& count = job->request.lattice.count;
  int64_t voxels = 0;
  for (auto _ : state) {
    for (int64_t k = 0; k + 8 <= count[2]; k += 32) {
      benchmark::DoNotOptimize(job->producer(k, k + 8, nullptr));
      voxels += 8 * count[0] * count[1];
    }
  }
  state.SetItemsProcessed(voxels);
}

// What a preview takes once the design is planned: 256 x 256 pixels in the middle of a printer's whole tray.
void preview(benchmark::State& state, const std::string& text) {
  Diagnostics diagnostics;
  compile::PlanOptions options;
  options.printer = compile::find_printer("j750", diagnostics).value();
  options.printer_given = true;
  options.place = voxel::Placement::center;
  const auto job = plan(text, options);
  if (!job) return state.SkipWithError("the design is wrong");
  const auto& count = job->request.lattice.count;
  const int64_t x = count[0] / 2 - 128, y = count[1] / 2 - 128, z = count[2] / 2;
  for (auto _ : state) benchmark::DoNotOptimize(job->regions({{x, y, z}, {x + 256, y + 256, z + 1}}, nullptr));
}

}  // namespace

int main(int argc, char** argv) {
  for (const auto& [name, text] : designs) {
    benchmark::RegisterBenchmark((name + "/preview").c_str(), [text](benchmark::State& state) {
      preview(state, text);
    })->Unit(benchmark::kMillisecond);
    for (const std::string& set : voxel::instruction_sets()) {
      voxel::EvaluatorOptions options;
      options.instruction_set = set;
      benchmark::RegisterBenchmark((name + "/" + set).c_str(), [text, options](benchmark::State& state) {
        evaluate(state, text, options);
      })->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

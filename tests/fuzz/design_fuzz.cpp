// Any bytes are a design file: what reads is written and read again the same, has bounds, and lowers.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "base/text/json.h"
#include "design/design.h"
#include "fuzz/checks.h"
#include "load/node_registry.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"
#include "questions/build.h"

namespace {

using namespace ombre;

using fuzz::check_places;
using fuzz::require;

std::optional<design::Design> read(const std::string& text) {
  Diagnostics diagnostics;
  const auto json = parse_json(make_source("fuzz.json", text), diagnostics);
  require(json.has_value() == !diagnostics.has_errors());
  auto design = json ? design::read_design(*json, compile::node_registry(), nullptr, diagnostics) : std::nullopt;
  require(design.has_value() == !diagnostics.has_errors());
  check_places(diagnostics);
  return design;
}

void check_printing(const design::Design& design) {
  const std::string printed = print_json(design::to_data(design));
  const auto again = read(printed);
  require(again.has_value());
  require(print_json(design::to_data(*again)) == printed);
  require(design::hash(*again) == design::hash(design));
  (void)design::to_tree(design);
}

// With the code of those of many parts that reach the point.
program::Program parts_written_out(const program::Program& program, Vec3 p) {
  if (!program.has_parts()) return program;
  std::vector<Interval> ranges;
  program::evaluate_intervals(program, Box{p, p}, ranges);
  return program::expand_parts(program, ranges, program::Precision::reference);
}

void check_lowering(const design::Design& design) {
  Diagnostics diagnostics;
  const auto box = compile::design_box(design, diagnostics);
  require(box.has_value() == !diagnostics.has_errors());
  check_places(diagnostics);
  Diagnostics of_build;
  const auto built = compile::build_flat_program(design, of_build);
  require(built.has_value() == !of_build.has_errors());
  if (!built) return;
  std::vector<double> values;
  const program::Program& program = built->materials.program;
  const auto inside = [&](Vec3 p) {
    const program::Program at_point = parts_written_out(program, p);
    program::evaluate_point(at_point, p, values);
    return values[at_point.outputs[0]];
  };
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 2, -3}, Vec3{1e5, 1, -1}}) {
    const double is_inside = inside(p);
    require(is_inside == 0 || is_inside == 1);
    // What is inside lies within the bounds.
    if (is_inside != 1 || !box || design.sampling) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double slack = 1e-6 * (1 + std::abs(p[axis]));
      require(p[axis] >= box->lo[axis] - slack && p[axis] <= box->hi[axis] + slack);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto design = read(std::string(reinterpret_cast<const char*>(data), size));
  if (!design) return 0;
  check_printing(*design);
  check_lowering(*design);
  return 0;
}

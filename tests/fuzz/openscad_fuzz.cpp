// Any bytes are an OpenSCAD script: it is read and run within small limits, and the tree that it makes is a script
// again.
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "lang/openscad/csg_text.h"
#include "lang/openscad/customizer.h"
#include "lang/openscad/run_script.h"

namespace {

using namespace ombre;
namespace openscad = lang::openscad;

openscad::Options small_options(const std::string& text) {
  openscad::Options options;
  options.limits.elements = 10'000;
  options.limits.text_bytes = 1'000'000;
  options.limits.instances = 10'000;
  options.limits.calls = 10'000;
  options.limits.steps = 100'000;
  options.limits.closures = 2'000;
  options.limits.depth = 2'000;
  options.limits.list_depth = 200;
  options.limits.files = 10;
  options.definitions = {"defined=3"};
  options.read_file = [text](const std::string& path) -> std::optional<std::string> {
    if (path == "self") return text;
    if (path == "lib") return "module m(a = 1) { children(); cube(a); } function f(x) = x + 1; v = 2;";
    return std::nullopt;
  };
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const SourcePtr source = make_source("fuzz.scad", text);
  openscad::Messages messages;
  const solids::TreePtr tree = openscad::run(source, small_options(text), messages);
  (void)messages.text();
  for (const openscad::Parameter& parameter : openscad::parameters_of(source)) (void)openscad::to_data(parameter);
  if (!tree) return 0;
  if (messages.list().empty() && messages.error_count() > 0) std::abort();
  (void)openscad::csg_text(*tree, "");
  return 0;
}

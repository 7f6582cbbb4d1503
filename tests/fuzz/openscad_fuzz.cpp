// Any bytes are an OpenSCAD script: it is read and run within small limits, and the tree that it makes is a script
// again.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/small_limits.h"
#include "lang/openscad/csg_text.h"
#include "lang/openscad/customizer.h"
#include "lang/openscad/run_script.h"

namespace {

using namespace ombre;
namespace openscad = lang::openscad;

openscad::Options small_options(const std::string& text) {
  openscad::Options options;
  options.limits = fuzz::small_limits();
  options.limits.depth = 2'000;
  options.definitions = {"defined=3"};
  options.read_file = [text](const std::string& path) { return fuzz::file_for_script(text, path); };
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

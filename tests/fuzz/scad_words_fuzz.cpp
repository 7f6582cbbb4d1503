// Any bytes are an OpenSCAD script with Ombre's words: within small limits it becomes a design, or says why not.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/checks.h"
#include "fuzz/small_limits.h"
#include "lang/openscad/csg_text.h"
#include "lang/openscad/run_script.h"
#include "lang/vcad/scad_words.h"
#include "load/node_registry.h"

namespace {

using namespace ombre;
namespace openscad = lang::openscad;

const design::MaterialTable& materials() {
  static const design::MaterialTable table = [] {
    DataList list;
    for (const char* name : {"red", "blue"})
      list.emplace_back(
          DataMembers{{"name", name}, {"r", Data(255.0)}, {"g", Data(0.0)}, {"b", Data(0.0)}, {"a", Data(255.0)}});
    Diagnostics none;
    auto read = design::MaterialTable::read(DataMembers{{"materials", std::move(list)}}, none);
    if (!read) std::abort();
    return *read;
  }();
  return table;
}

openscad::Options small_options() {
  openscad::Options options;
  options.limits = fuzz::small_limits();
  options.limits.instances = 2'000;
  options.limits.depth = 500;
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text = "use <ombre>\n" + std::string(reinterpret_cast<const char*>(data), size);
  const SourcePtr source = make_source("fuzz.scad", text);
  lang::ScadWords words(compile::node_registry(), materials(), nullptr, source->name());
  openscad::Options options = small_options();
  options.words = &words;
  openscad::Messages messages;
  const solids::TreePtr tree = openscad::run(source, options, messages);
  if (!tree) return 0;
  (void)openscad::csg_text(*tree, "");
  Diagnostics diagnostics;
  const auto made = words.finish(tree, {source, 0, 0}, diagnostics);
  if (!made && !diagnostics.has_errors() && messages.list().empty()) std::abort();
  fuzz::check_places(diagnostics);
  return 0;
}

#include "ombre/scad_files.h"

#include <algorithm>
#include <optional>

#include "compile/scad_job.h"
#include "ombre/command_line.h"
#include "ombre/interrupt.h"

namespace ombre::cli {
namespace {

constexpr const char* solid_formats[] = {"stl", "off", "obj", "ply", "amf", "3mf", "glb", "svg", "dxf"};

}  // namespace

std::vector<std::string> scad_formats() {
  std::vector<std::string> endings{".csg", ".echo", ".ast"};
  for (const char* format : solid_formats) endings.push_back(std::string(".") + format);
  return endings;
}

bool writes_solids(const std::string& format) {
  return std::ranges::find(solid_formats, format) != std::end(solid_formats);
}

bool write_solids(const solids::TreePtr& tree, const std::vector<std::string>& paths, bool no_overlap,
                  Session& session) {
  compile::ScadRequest request;
  request.tree = tree;
  for (const std::string& path : paths) {
    compile::SolidsExport output;
    output.path = path;
    request.outputs.push_back(output);
  }
  request.no_overlap = no_overlap;
  request.stop = &session.stop;
  Diagnostics messages;
  std::optional<QuitAtOnce> quits(std::in_place);
  request.before_writing = [&] { quits.reset(); };
  const compile::ScadResult result = compile::run_scad(request, messages);
  session.console.diagnose(messages);
  if (messages.has_errors()) return false;
  for (const std::string& file : result.files) {
    if (session.console.voice() == Voice::programs)
      session.console.event("written", {{"file", file}});
    else
      session.console.say("written to " + file);
  }
  return true;
}

}  // namespace ombre::cli

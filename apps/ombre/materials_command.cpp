// ombre materials: the materials that designs may name.
#include <cstdio>
#include <memory>

#include "base/text/json.h"
#include "base/text/text.h"
#include "load/load.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"

namespace ombre::cli {
namespace {

std::string colour_text(const design::Rgba& c) {
  char text[10];
  std::snprintf(text, sizeof text, "#%02x%02x%02x%02x", c[0], c[1], c[2], c[3]);
  return text;
}

int list_materials(const std::string& file, Session& session) {
  Diagnostics diagnostics;
  const auto table = compile::load_materials(file, diagnostics);
  session.console.diagnose(diagnostics);
  if (!table) return wrong_input;
  size_t width = 0;
  for (const auto& material : table->all()) width = std::max(width, material.name.size());
  for (const auto& material : table->all()) {
    if (session.console.voice() == Voice::programs) {
      session.console.event("material", {{"id", Data(static_cast<double>(material.id))},
                                         {"name", Data(material.name)},
                                         {"colour", Data(colour_text(material.colour))},
                                         {"properties", Data(material.properties)}});
      continue;
    }
    std::string line = std::to_string(material.id);
    line.insert(0, 3 - std::min<size_t>(3, line.size()), ' ');
    line += "  " + material.name + std::string(width + 2 - material.name.size(), ' ') + colour_text(material.colour);
    for (const auto& [key, value] : material.properties) line += "  " + key + " = " + print_json_line(value);
    session.console.print(line + "\n");
  }
  return done;
}

}  // namespace

Command add_materials(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("materials", "List the materials that designs may name, or those of a file");
  auto file = std::make_shared<std::string>();
  app->add_option("file", *file, "A materials file (default: the set that comes with Ombre)")->type_name("FILE");
  add_output_options(*app, output);
  return {app, [file](Session& session) { return list_materials(*file, session); }};
}

}  // namespace ombre::cli

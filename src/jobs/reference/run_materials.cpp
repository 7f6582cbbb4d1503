// `ombre materials` lists the materials that designs may name.
#include <cstdio>
#include <memory>

#include "base/text/json.h"
#include "base/text/text.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "load/load.h"

namespace ombre::jobs {
namespace {

std::string colour_text(const design::Rgba& c) {
  char text[10];
  std::snprintf(text, sizeof text, "#%02x%02x%02x%02x", c[0], c[1], c[2], c[3]);
  return text;
}

struct MaterialsChoices {
  std::string file;

  static const options::Spec<MaterialsChoices>& options() {
    using namespace options;
    static const options::Spec<MaterialsChoices> spec{
        option("file", &MaterialsChoices::file, kind::file, "A materials file (default: the set that comes with Ombre)",
               "FILE")};
    return spec;
  }
};

int list_materials(const MaterialsChoices& a, Session& session) {
  Diagnostics diagnostics;
  const auto table = compile::load_materials(a.file, diagnostics);
  session.events.diagnose(diagnostics);
  if (!table) return wrong_input;
  size_t width = 0;
  for (const auto& material : table->all()) width = std::max(width, material.name.size());
  for (const auto& material : table->all()) {
    if (session.events.wants_data()) {
      session.events.event("material", {{"id", Data(static_cast<double>(material.id))},
                                        {"name", Data(material.name)},
                                        {"colour", Data(colour_text(material.colour))},
                                        {"properties", Data(material.properties)}});
      continue;
    }
    std::string line = std::to_string(material.id);
    line.insert(0, 3 - std::min<size_t>(3, line.size()), ' ');
    line += "  " + material.name + std::string(width + 2 - material.name.size(), ' ') + colour_text(material.colour);
    for (const auto& [key, value] : material.properties) line += "  " + key + " = " + print_json_line(value);
    session.events.print(line + "\n");
  }
  return done;
}

}  // namespace

JobKind materials_kind() {
  return job_kind<MaterialsChoices>("materials", "List the materials that designs may name, or those of a file", "",
                                    list_materials);
}

}  // namespace ombre::jobs

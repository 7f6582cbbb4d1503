// Names for the parts of a design.
#include "design/spec.h"
#include "nodes/all_nodes.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Part {
  std::string name;

  static Spec<Part> spec() {
    return {"part",
            "parts",
            "Names a part of the design. Stands at the top level, or directly in root.",
            {{"name", &Part::name, "Its name", required()}},
            one_solid,
            "part(\"handle\") { cylinder(2, 20, \"red\"); }"};
  }

  bool complete(const Reader& reader) const {
    if (!name.empty()) return true;
    reader.diagnostics.error(reader.where, "a part needs a name");
    return false;
  }
};

}  // namespace

void add_parts(Registry& registry) { registry.add<Part>(); }

}  // namespace ombre::nodes

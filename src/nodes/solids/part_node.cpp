// Names for the parts of a design.
#include <algorithm>

#include "base/system/assert.h"
#include "design/spec.h"
#include "nodes/common/part_label.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Part {
  std::string name;

  static Spec<Part> spec() {
    return {"part",
            "Names a part of the design: sets the label \"part\" of everything in its braces. Outer names take "
            "precedence over inner ones.",
            {{"name", &Part::name, "Its name", required()}},
            one_solid,
            "part(\"handle\") { cylinder(2, 20, \"red\"); }"};
  }

  bool complete(const Reader& reader) const {
    if (!name.empty()) return true;
    return reader.refuse("a part needs a name");
  }

  AttributeDeclaration declares() const {
    AttributeDeclaration declared{std::string(label_name), "", 0, Overlap::first};
    declared.type = ValueType::label;
    declared.labels = {name};
    return declared;
  }

  Field attribute(const Inputs& in, std::string_view wanted, const Point& p, Demand demand) const {
    if (wanted != label_name) return in.attribute(0, wanted, p, demand);
    const std::vector<std::string> all = in.declaration(label_name).labels;
    const auto found = std::ranges::find(all, name);
    ASSERT(found != all.end());
    return p.constant(static_cast<double>(found - all.begin() + 1));
  }
};

}  // namespace

void add_parts(Registry& registry) { registry.add<Part>("parts"); }

}  // namespace ombre::nodes

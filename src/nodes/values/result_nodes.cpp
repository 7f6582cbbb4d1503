// Results of simulations as values.
#include <algorithm>
#include <array>

#include "base/text/text.h"
#include "design/source_loader.h"
#include "design/spec.h"

namespace ombre::nodes {
namespace {

using namespace design;

// Returns the names of a field's components.
std::vector<std::string> component_names(size_t count) {
  if (count == 3) return {"x", "y", "z"};
  if (count == 6) return {"xx", "yy", "zz", "xy", "yz", "zx"};
  if (count == 9) return {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
  std::vector<std::string> names;
  for (size_t n = 0; n < count; ++n) names.push_back(std::to_string(n + 1));
  return names;
}

struct Results : ResultsRequest {
  std::string component, values_file;
  std::shared_ptr<const ResultNumbers> loaded;  // set when the node is made
  size_t chosen = 0;                            // number of the chosen component

  static Spec<Results> spec() {
    return {
        "results",
        "Results of a simulation at the point where they are used: a field of a mesh's nodes or elements.",
        {{"path", &Results::file,
          "The file: .vtu, as ombre fea writes it, .pvd, .pvtu, .vtkhdf, .xdmf, .frd, .inp, or .csv; relative to "
          "the script, then to the working directory",
          required()},
         {"field", &Results::field,
          "Name of the field, or its beginning: displacement, von_mises; empty: the only one"},
         {"component", &Results::component,
          "Component that `value` gives: x, y or z of a vector (empty: its length); xx, yy, zz, xy, yz or zx of a "
          "tensor"},
         {"outside", &Results::outside,
          "Value where there is no element: none (not a number, with a warning of the job), nearest (that of the "
          "nearest point), or value (that of `otherwise`)",
          one_of({"none", "nearest", "value"})},
         {"within", &Results::within_mm, "Greatest distance to the nearest point; none: no limit", unit::positive_mm},
         {"otherwise", &Results::otherwise, "Value where there is no element, with outside=\"value\""},
         {"values", &Results::values_file,
          "A .csv file for an .inp file, with the numbers of nodes or elements and their values"},
         {"between", &Results::between,
          "Interpolation between points of a .csv file: weights (the mean of the nearest eight, weighted by their "
          "inverse squared distances), or nearest (the nearest point's value)",
          one_of({"weights", "nearest"})},
         {"deform", &Results::deform,
          "Factor of the displacement by which the mesh is deformed, as in mesh(path, deform=5)"},
         {"step", &Results::step, "Number of a step, counted from 1; 0: the last", from_to(0, 1e9)}},
        no_inputs,
        "sphere(8, mix(\"red\", \"blue\", results(\"models/bent_beam.vtu\", \"von_mises\", "
        "outside=\"nearest\").value / 20));",
        {{"value", &Results::value,
          "The number, interpolated between nodes by the elements' shape functions, or that of the element"},
         {"vector", &Results::vector, "Components x, y and z of a vector"},
         {"magnitude", &Results::magnitude, "Square root of the sum of the components' squares"},
         {"inside", &Results::is_inside, "1 where there is an element, else 0", {0, 1}}}};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("results cannot be read here");
    values.path = values_file;
    loaded = reader.loader->source(static_cast<ResultsRequest&>(*this), reader);
    if (!loaded) return false;
    file.content = loaded->source->content();  // includes the content of both files
    values_file = values.path;
    return choose(reader);
  }

  bool gives(size_t output) const { return output != 1 || loaded->channels.size() == 3; }

  Field value(const Ask& ask) const {
    return component.empty() && loaded->channels.size() > 1 ? magnitude(ask) : number(ask, chosen);
  }
  VectorField vector(const Ask& ask) const { return {number(ask, 0), number(ask, 1), number(ask, 2)}; }
  Field magnitude(const Ask& ask) const {
    Field sum = ask.p.constant(0);
    for (size_t n = 0; n < loaded->channels.size(); ++n) {
      const Field part = number(ask, n);
      sum = sum + part * part;
    }
    return sqrt(sum);
  }
  Field is_inside(const Ask& ask) const {
    return ask.p.builder().source(loaded->source, loaded->source->channel("inside"), ask.p.x, ask.p.y, ask.p.z);
  }

 private:
  bool choose(const Reader& reader) {
    const std::vector<std::string> names = component_names(loaded->channels.size());
    const std::string what = "the field \"" + loaded->name + '"';
    if (component.empty()) {
      if (names.size() <= 3) return true;
      return reader.refuse(
          what + " has " + std::to_string(names.size()) + " components, and which is meant is not said",
          "write " + spelled::parameter("component", '"' + names.front() + '"') + ", or another of " +
              join(names, ", "));
    }
    const auto found = std::ranges::find(names, component);
    chosen = static_cast<size_t>(found - names.begin());
    if (found != names.end() && names.size() > 1) return true;
    return reader.refuse(
        what + " has no component \"" + component + '"',
        names.size() > 1 ? "it has " + join(names, ", ") : "it is a single number: leave component out");
  }

  Field number(const Ask& ask, size_t n) const {
    return ask.p.builder().source(loaded->source, loaded->channels[n], ask.p.x, ask.p.y, ask.p.z);
  }
};

}  // namespace

void add_results(Registry& registry) { registry.add<Results>("values"); }

}  // namespace ombre::nodes

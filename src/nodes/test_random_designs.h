// Nodes with random parameters and inputs, for tests of all nodes.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "base/text/json.h"
#include "base/text/text.h"
#include "design/design.h"
#include "nodes/all_nodes.h"
#include "nodes/test_sources.h"

namespace ombre::nodes::test {

using namespace design;

inline MaterialTable test_materials() {
  Diagnostics diagnostics;
  const auto data = parse_json(make_source("materials", R"({"materials": [
      {"name": "red", "r": 255, "g": 0, "b": 0}, {"name": "blue", "r": 0, "g": 0, "b": 255}, {"name": "clear", "r": 0, "g": 9, "b": 255}]})"),
                               diagnostics);
  return *MaterialTable::read(*data, diagnostics);
}

class RandomDesign {
 public:
  explicit RandomDesign(unsigned seed) : random_(seed) {}

  NodePtr node(const NodeType& type, int depth) {
    // Random values may be invalid in combination (equal end points, an unbounded solid to repeat); then new ones are
    // drawn.
    for (int attempt = 0; attempt < 60; ++attempt) {
      std::vector<NodePtr> inputs;
      if (type.inputs.most > 0) {
        const size_t count = type.inputs.most == 1 ? 1 : std::clamp(1 + index(3), type.inputs.least, type.inputs.most);
        for (size_t i = 0; i < count; ++i) inputs.push_back(any_node(depth - 1));
      }
      Diagnostics diagnostics;
      const auto made = make_node(type, values(type, depth), inputs, {materials, diagnostics, &loader_, {}, "", ""});
      if (made) return made;
      last_message = to_text(diagnostics);
    }
    return nullptr;
  }

  NodePtr any_node(int depth) {
    const auto& types = registry().types();
    for (;;) {
      const NodeType& type = *types[index(types.size())];
      if (!type.is_solid() || (depth <= 0 && type.inputs.most > 0)) continue;
      if (NodePtr made = node(type, depth)) return made;
    }
  }

  // Returns a value node whose first output has the form, and is a single number if it has numbers.
  NodePtr value_node(OutputForm form, int depth) {
    const auto& types = registry().types();
    for (;;) {
      const NodeType& type = *types[index(types.size())];
      // Points of a large solid take long to scatter, and give no number that varies.
      if (type.is_solid() || type.name == "scattered_points") continue;
      const NodePtr made = node(type, depth);
      if (!made) continue;
      const OutputType& output = type.outputs[made->first_output()].type;
      if (output.form == form && !output.has_parts()) return made;
    }
  }

  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  size_t index(size_t count) { return std::uniform_int_distribution<size_t>(0, count - 1)(random_); }

  MaterialTable materials = test_materials();
  std::string last_message;

 private:
  static Data object(const NodePtr& node) { return Data(HostObjectPtr(std::make_shared<NodeObject>(node))); }

  // Returns a node with the attribute that all texts refer to.
  NodePtr lattice_node() {
    const NodeType& type = *registry().find("lattice");
    Diagnostics none;
    return make_node(type, {{&type.parameters[0], Data("bcc")}}, {}, {materials, none, nullptr, {}, "", ""});
  }

  NodePtr dense_node() {
    const NodeType& type = *registry().find("attribute");
    const auto named = [&](const char* name, Data data) {
      return NamedValue{&type.parameters[static_cast<size_t>(type.parameter(name))], std::move(data)};
    };
    Diagnostics none;
    return make_node(type, {named("name", Data("density")), named("value", Data("1 + x^2"))}, {any_node(0)},
                     {materials, none, nullptr, {}, "", ""});
  }

  // A rim runs along the border of a surface.
  NodePtr map_of_cells(const NodeType& user) {
    const char* maps[] = {"box_cells", "cylinder_cells", "frustum_cells", "ball_cells", "curve_cells"};
    for (;;)
      if (NodePtr made = node(*registry().find(user.name == "rim" ? "surface_cells" : maps[index(5)]), 0)) return made;
  }

  // Returns a number from 0.01 to 1 that depends on a node's output, since sizes must not be 0.
  Data share() {
    const NodePtr node = value_node(OutputForm::numbers, 0);
    const Data value(
        DataMembers{{"from", object(node)}, {"output", Data(node->type().outputs[node->first_output()].name)}});
    return Data(DataMembers{{"formula", Data("clamp(0.01, abs(v)/20, 1)")}, {"with", Data(DataMembers{{"v", value}})}});
  }

  std::vector<NamedValue> values(const NodeType& type, int depth) {
    depth_ = depth;
    std::vector<NamedValue> list;
    lists_ = 1 + index(3);
    for (const ParameterInfo& parameter : type.parameters)
      if (parameter.domain.required || index(2)) list.push_back({&parameter, value(type, parameter)});
    return list;
  }

  Data one_number(const Domain& domain, bool may_be_field) {
    const double lo = std::isfinite(domain.least) ? domain.least + 0.5 : -6, value = number(lo, lo + 6);
    if (!may_be_field || index(3)) return Data(value);
    if (depth_ > 0 && index(2)) {
      depth_ = 0;
      Data fraction = share();
      if (domain.least == 0) return fraction;
    }
    const char* waves[] = {" + 0.3*sin(x + y)", " + 0.2*cos(3*theta)", " + 0.1*rho/(1 + rho)",
                           " + 0.3*min(x, y, 1)/(1 + r)"};
    return Data(format_rounded(value + 1) + waves[index(4)]);
  }

  // Returns a formula for u, v or w that grows along x, y or z, so that cells have a volume.
  Data growing(std::string_view name) {
    const size_t axis = name == "u" ? 0 : name == "v" ? 1 : 2;
    constexpr std::string_view axes = "xyz";
    return Data(std::string(1, axes[axis]) + "/" + format_rounded(number(4, 7)) + " + 0.1*sin(" + axes[(axis + 1) % 3] +
                ")");
  }

  Data whole_number(const Domain& domain) { return Data(std::max(0.0, domain.least) + static_cast<double>(index(4))); }

  Data attribute_value(const Domain& domain) {
    if (lists_ == 1) return one_number(domain, true);
    if (lists_ == 2) return vector(domain, true);
    return Data(DataList(4, Data(0.5)));
  }

  Data vector(const Domain& domain, bool fields) {
    return Data(DataList{one_number(domain, fields), one_number(domain, fields), one_number(domain, fields)});
  }

  Data edges() {
    DataList list;
    for (size_t n = 1 + index(3); n > 0; --n) {
      DataList edge{vector({}, false), vector({}, false)};
      if (index(2)) edge.emplace_back(number(0.2, 2));
      list.emplace_back(std::move(edge));
    }
    return Data(std::move(list));
  }

  Data value(const NodeType& type, const ParameterInfo& parameter) {
    const Domain& domain = parameter.domain;
    const std::string_view kind = parameter.text.kind;
    if (kind == "list of pairs of words")
      return Data(DataList{Data(DataList{Data("density"), Data(domain.choices[index(domain.choices.size())])})});
    if (kind == "number, field, vector, colour or mixture") return attribute_value(domain);
    if (kind == "solid" && type.name == "output_of") return object(lattice_node());
    if (kind == "solid" && type.name == "scattered_points") return object(node(*registry().find("ellipsoid"), 0));
    if (kind == "solid") return object(type.name == "attribute_of" ? dense_node() : any_node(0));
    if (parameter.takes_other_names) return Data(DataMembers{{"width", Data(number(1, 9))}, {"name", Data("lid")}});
    if (kind == "rows of numbers, or a CSV file") return Data("table.csv");
    if (!domain.choices.empty()) return Data(domain.choices[index(domain.choices.size())]);
    if (kind == "number") return one_number(domain, false);
    if (kind == "whole number") return whole_number(domain);
    if (kind == "3 whole numbers")
      return Data(DataList{whole_number(domain), whole_number(domain), whole_number(domain)});
    if (type.name == "formula_cells" && kind == "number or field") return growing(parameter.name);
    if (kind == "number or field" && type.name == "function")
      return Data("x^2 + 2*y^2 + z^2 - " + format_rounded(number(4, 30)));
    if (kind == "number or field") return one_number(domain, true);
    if (kind == "3 numbers or fields" || kind == "number or 3 numbers, or fields") return vector(domain, true);
    if (type.name == "scattered_points" && parameter.name == "distance")  // avoids very many points
      return Data(number(4, 9));
    if (type.name == "scattered_points" && parameter.name == "density") return Data(number(0.001, 0.01));
    const bool is_low = parameter.name.ends_with("min"), is_high = parameter.name.ends_with("max");
    if (kind == "3 numbers" && (is_low || is_high) && (type.name == "function" || type.name == "surface_cells"))
      return Data(DataList(3, Data(is_low ? number(-6, -1) : number(1, 6))));
    if (kind == "3 numbers" && type.name == "tile" && parameter.name != "size") {
      const double sign = parameter.name == "first" ? -1 : 1;
      return Data(DataList{Data(sign * static_cast<double>(index(3))), Data(sign * static_cast<double>(index(3))),
                           Data(sign * static_cast<double>(index(3)))});
    }
    if (kind == "3 numbers" && type.name == "tile")  // avoids many copies of large children
      return Data(DataList{Data(number(6, 14)), Data(number(6, 14)), Data(number(6, 14))});
    if (kind == "3 numbers") return vector(domain, false);
    if (kind == "material or mixture" && depth_ > 0 && index(2)) {
      depth_ = 0;
      return object(value_node(OutputForm::mixture, 0));
    }
    if (kind == "material or mixture" || kind == "material") return Data("blue");
    if (kind == "number, field, material or mixture") {
      if (lists_ == 1) return Data(index(2) ? "red" : "clear");
      return one_number(domain, true);
    }
    if (kind == "file") return Data("ball.stl");
    if (type.name == "composition_of") return Data(index(2) ? "red" : "");
    if (type.name == "output_of") return Data("along");
    // A standard name would have a fixed type.
    if (kind == "text") return Data(type.name == "attribute" ? "own_density" : "density");
    if (kind == "map of cells") return object(map_of_cells(type));
    if (kind == "true or false") return Data(index(2) == 0);
    if (kind == "matrix") {
      DataList rows;
      for (int r = 0; r < 3; ++r)
        rows.emplace_back(DataList{Data(number(-1, 1) + (r == 0 ? 2 : 0)), Data(number(-1, 1) + (r == 1 ? 2 : 0)),
                                   Data(number(-1, 1) + (r == 2 ? 2 : 0)), Data(number(-3, 3))});
      return Data(std::move(rows));
    }
    if (kind == "list of edges") return edges();
    if (kind == "font") return Data("DejaVu Sans");
    if (kind == "list of points")
      return type.name == "revolve" ? star(true, 7, 6, 1)
                                    : points(type, type.name == "morph" ? 2 + index(2) : 4 + index(4));
    if (kind == "list of lists of points") return Data(DataList{star(true, 0, 0, 0.3)});
    if (kind == "lists of lists of numbers")
      return Data(DataList{Data(DataList{Data(DataList{Data(1.0), Data(number(0, 2)), Data(1.0)})})});
    if (kind == "list of texts") return Data(DataList{});
    if (kind == "list of numbers with materials")
      return Data(DataList{Data(DataList{Data(-1.0), Data("red")}), Data(DataList{Data(number(0, 9)), Data("blue")})});
    if (kind == "list of names with materials")
      return Data(DataList{Data(DataList{Data("PLA"), Data("red")}), Data(DataList{Data("TPU"), Data("blue")})});
    // Types that only one node has are at their default.
    if (!kind.starts_with("list of ")) return parameter.default_value;
    DataList list;
    for (size_t i = 0; i < lists_; ++i)
      list.push_back(kind == "list of materials" ? Data(i % 2 ? "red" : "clear")
                     : type.name == "morph"      ? one_number(domain, true)
                     : i % 2                     ? Data("0.1 + abs(d)/9")
                                                 : Data(number(0.1, 1)));
    return Data(std::move(list));
  }

  // Returns corners at varying distances around a centre.
  Data star(bool is_flat, double u, double v, double size) {
    DataList list;
    const size_t count = 3 + index(4);
    for (size_t n = 0; n < count; ++n) {
      const double angle = 6.283185307179586 * static_cast<double>(n) / static_cast<double>(count);
      const double r = size * number(2, 6), x = u + r * std::cos(angle), y = v + r * std::sin(angle);
      list.emplace_back(is_flat ? DataList{Data(x), Data(y)} : DataList{Data(x), Data(y), Data(0.5 * x - y)});
    }
    return Data(std::move(list));
  }

  Data points(const NodeType& type, size_t count) {
    if (type.name == "polygon_extrude") return star(index(2) == 0, 0, 0, 1);
    const bool is_smooth = type.name == "curve_cells";
    DataList list;
    for (size_t n = 0; n < count; ++n)
      list.emplace_back(is_smooth
                            ? DataList{Data(7.0 * static_cast<double>(n)), Data(number(-1, 1)), Data(number(-1, 1))}
                            : DataList{Data(number(-8, 8)), Data(number(-8, 8)), Data(number(-8, 8))});
    return Data(std::move(list));
  }

  std::mt19937 random_;
  BallLoader loader_;
  size_t lists_ = 1;
  int depth_ = 0;
};

}  // namespace ombre::nodes::test

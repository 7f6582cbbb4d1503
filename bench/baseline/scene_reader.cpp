#include "scene_reader.h"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "formula_nodes.h"
#include "mesh_grid.h"
#include "solids.h"

namespace baseline {
namespace {

using Json = nlohmann::json;

Point point(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }

class Reader {
 public:
  Reader(const Json& design, const Counts& voxels) {
    const Json& sampling = design.at("sampling");
    box_ = {point(sampling.at("min")), point(sampling.at("max"))};
    const Point size = box_.hi - box_.lo;
    mesh_spacing_ = std::max({size.x / static_cast<double>(voxels[0]), size.y / static_cast<double>(voxels[1]),
                              size.z / static_cast<double>(voxels[2])});
    for (const Json& node : design.at("nodes")) nodes_[node.at("id")] = &node;
    materials_ = {"void"};
    colours_ = {{0, 0, 0, 0}};
    for (const Json& m : design.at("materials")) {
      materials_.push_back(m.at("name"));
      colours_.push_back({m.at("r"), m.at("g"), m.at("b"), m.at("a")});
    }
  }

  Scene scene(const Json& design) const {
    return {build(design.at("parts").at(0).at("node")), box_, materials_, colours_};
  }

 private:
  NodePtr build(const std::string& id) const {
    const Json& node = *nodes_.at(id);
    const std::string type = node.at("type");
    const Json& p = node.at("parameters");
    if (NodePtr leaf = build_leaf(type, p)) return leaf;
    Nodes children;
    for (const Json& input : node.at("inputs")) children.push_back(build(input));
    if (type == "union") return unite(std::move(children));
    if (type == "intersection") return intersect(std::move(children));
    if (type == "difference") return subtract(std::move(children));
    if (type == "translate") return translate(point(p.at("by")), std::move(children.at(0)));
    if (type == "fgrade") return build_grade(p, std::move(children.at(0)));
    throw std::runtime_error("the baseline has no node \"" + type + "\"");
  }

  NodePtr build_leaf(const std::string& type, const Json& p) const {
    if (type == "sphere") return sphere(p.at("radius"), material(p));
    if (type == "cube") return block(Point{1, 1, 1} * p.at("side").get<double>(), material(p));
    if (type == "rectprism") return block(point(p.at("size")), material(p));
    if (type == "strut")
      return strut(point(p.at("start")), point(p.at("end")), p.at("radius"), p.at("caps") == "round", material(p));
    if (type == "mesh") return mesh(p.at("path"), mesh_spacing_, material(p));
    if (type != "function") return nullptr;
    const Box box = p.value("min", Json()).is_array() ? Box{point(p.at("min")), point(p.at("max"))} : Box{};
    return function(p.at("expression"), box, material(p));
  }

  NodePtr build_grade(const Json& p, NodePtr child) const {
    std::vector<size_t> materials;
    for (const Json& name : p.at("materials")) materials.push_back(material_index(name));
    std::vector<std::string> functions;
    for (const Json& f : p.at("functions")) functions.push_back(f.is_string() ? f.get<std::string>() : f.dump());
    return grade(functions, materials, p.at("mode") == "thresh", std::move(child));
  }

  size_t material(const Json& p) const { return material_index(p.at("material")); }

  size_t material_index(const std::string& name) const {
    const auto found = std::find(materials_.begin(), materials_.end(), name);
    if (found == materials_.end()) throw std::runtime_error("no material \"" + name + "\"");
    return static_cast<size_t>(found - materials_.begin());
  }

  Box box_;
  double mesh_spacing_ = 0;
  std::map<std::string, const Json*> nodes_;
  std::vector<std::string> materials_;
  std::vector<Colour> colours_;
};

}  // namespace

Scene read_scene(const std::string& path, const Counts& voxels) {
  std::ifstream file(path);
  const Json design = Json::parse(file);
  return Reader(design, voxels).scene(design);
}

}  // namespace baseline

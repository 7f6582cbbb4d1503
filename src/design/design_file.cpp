#include "design/design_file.h"

#include <filesystem>

#include "base/system/named_files.h"
#include "base/text/json.h"

namespace ombre::design {
namespace {

namespace fs = std::filesystem;

// A parameter that takes the path of a file is annotated so in Python. It may take something else, too, such as the
// name of a font: a path leads to a file, since the design was read.
bool names_file(const ParameterInfo& parameter, const Data& value) {
  std::error_code ignored;
  return parameter.text.python.find("Path") != std::string::npos && value.string() &&
         fs::exists(*value.string(), ignored);
}

class Mover {
 public:
  Mover(const Registry& registry, const std::string& path)
      : registry_(registry), folder_(whole_path(path).parent_path()) {}

  void move(DataMembers& design) const {
    for (auto& [name, value] : design) {
      if (name != "nodes") continue;
      DataList nodes = *value.list();
      for (Data& node : nodes) node = moved_node(*node.members());
      value = Data(std::move(nodes));
    }
  }

 private:
  Data moved_node(DataMembers node) const {
    const NodeType& type = *registry_.find(*Data(node).find("type")->string());
    for (auto& [name, value] : node)
      if (name == "parameters") value = moved_parameters(type, *value.members());
    return Data(std::move(node));
  }

  Data moved_parameters(const NodeType& type, DataMembers values) const {
    for (size_t n = 0; n < values.size(); ++n) {
      Data& value = values[n].second;
      if (names_file(type.parameters[n], value)) value = Data(moved(*value.string()));
    }
    return Data(std::move(values));
  }

  std::string moved(const std::string& path) const {
    if (fs::path(path).is_absolute()) return path;
    return whole_path(path).lexically_relative(folder_).generic_string();
  }

  const Registry& registry_;
  fs::path folder_;
};

}  // namespace

std::string design_text(const Data& data, const Registry& registry, const std::string& path) {
  DataMembers design = *data.members();
  Mover(registry, path).move(design);
  return print_json(Data(std::move(design)));
}

}  // namespace ombre::design

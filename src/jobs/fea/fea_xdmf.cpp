#include "jobs/fea/fea_xdmf.h"

#include <algorithm>
#include <set>

#include "base/text/text.h"
#include "formats/containers/hdf5.h"
#include "formats/containers/xml_text.h"

namespace ombre::compile {
namespace {

using formats::Hdf5Array;

const char* topology_of(fea::ElementKind kind) {
  if (kind == fea::ElementKind::c3d8) return "Hexahedron";
  return kind == fea::ElementKind::c3d4 ? "Tetrahedron" : "Tetrahedron_10";
}

const char* type_of(size_t components) {
  if (components == 1) return "Scalar";
  if (components == 3) return "Vector";
  return components == 6 ? "Tensor6" : "Matrix";
}

// Reorders components from xx, yy, zz, xy, yz, zx to xx, xy, xz, yy, yz, zz.
std::vector<float> in_order_of_xdmf(const fea::ValueField& field) {
  if (field.components != 6) return field.values;
  constexpr std::array<size_t, 6> places{0, 3, 5, 1, 4, 2};
  std::vector<float> values(field.values.size());
  for (size_t n = 0; n < values.size(); ++n) values[n] = field.values[n / 6 * 6 + places[n % 6]];
  return values;
}

class XdmfWriter {
 public:
  XdmfWriter(const fea::MeshView& mesh, std::string numbers_name)
      : mesh_(mesh), numbers_name_(std::move(numbers_name)) {}

  XdmfFiles write(const std::vector<fea::ValueField>& of_elements, const std::vector<fea::ValueField>& of_nodes) {
    const size_t each = mesh_.shape().nodes;
    text_ = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"mesh\" GridType=\"Uniform\">\n";
    std::vector<int64_t> nodes;
    nodes.reserve(each * mesh_.count());
    for (size_t n = 0; n < mesh_.count(); ++n)
      for (const uint32_t node : mesh_.nodes(n)) nodes.push_back(node);
    text_ += "<Topology TopologyType=\"" + std::string(topology_of(mesh_.kind())) + "\" NumberOfElements=\"" +
             std::to_string(mesh_.count()) + "\" NodesPerElement=\"" + std::to_string(each) + "\">";
    add_array({"/Mesh/topology", Hdf5Array::Kind::int64, {mesh_.count(), each}, nodes.data()});
    text_ += "</Topology>\n<Geometry GeometryType=\"XYZ\">";
    std::vector<double> points;
    points.reserve(3 * mesh_.node_count());
    for (size_t n = 0; n < mesh_.node_count(); ++n)
      for (int axis = 0; axis < 3; ++axis) points.push_back(mesh_.node(n)[axis]);
    add_array({"/Mesh/geometry", Hdf5Array::Kind::float64, {mesh_.node_count(), 3}, points.data()});
    text_ += "</Geometry>\n";
    std::vector<std::vector<float>> kept(of_nodes.size() + of_elements.size());
    size_t next = 0;
    for (const fea::ValueField& field : of_nodes) add_field(field, "Node", kept[next++]);
    for (const fea::ValueField& field : of_elements) add_field(field, "Cell", kept[next++]);
    text_ += "</Grid>\n</Domain>\n</Xdmf>\n";
    return {std::move(text_), formats::hdf5_file(arrays_)};
  }

 private:
  void add_array(Hdf5Array array) {
    std::string sizes;
    for (const uint64_t size : array.sizes) sizes += (sizes.empty() ? "" : " ") + std::to_string(size);
    const bool is_whole = array.kind == Hdf5Array::Kind::int64;
    text_ += "<DataItem Dimensions=\"" + sizes + "\" NumberType=\"" + (is_whole ? "Int" : "Float") + "\" Precision=\"" +
             (array.kind == Hdf5Array::Kind::float32 ? "4" : "8") + "\" Format=\"HDF\">" + escaped(numbers_name_) +
             ":" + escaped(array.path) + "</DataItem>";
    arrays_.push_back(std::move(array));
  }

  // Adds a field; the numbers must live until the file is made.
  void add_field(const fea::ValueField& field, const std::string& centre, std::vector<float>& kept) {
    kept = in_order_of_xdmf(field);
    const std::string name = field.unit.empty() ? field.name : field.name + " [" + field.unit + "]";
    text_ += "<Attribute Name=\"" + escaped(name) + "\" AttributeType=\"" + type_of(field.components) + "\" Center=\"" +
             centre + "\">";
    add_array({path_of(centre, field.name),
               Hdf5Array::Kind::float32,
               {kept.size() / field.components, field.components},
               kept.data()});
    text_ += "</Attribute>\n";
  }

  // Returns a path that no other field has.
  std::string path_of(const std::string& centre, std::string name) {
    std::ranges::replace(name, '/', '_');
    std::ranges::replace(name, ':', '_');
    const std::string path = "/" + centre + "Data/" + name;
    std::string free = path;
    for (int n = 2; !taken_.insert(free).second; ++n) free = path + "_" + std::to_string(n);
    return free;
  }

  static std::string escaped(const std::string& text) { return formats::xml_escaped(text); }

  const fea::MeshView& mesh_;
  std::string numbers_name_, text_;
  std::vector<Hdf5Array> arrays_;
  std::set<std::string> taken_;
};

}  // namespace

XdmfFiles fea_xdmf(const fea::MeshView& mesh, const std::vector<fea::ValueField>& of_elements,
                   const std::vector<fea::ValueField>& of_nodes, const std::string& numbers_name) {
  return XdmfWriter(mesh, numbers_name).write(of_elements, of_nodes);
}

}  // namespace ombre::compile

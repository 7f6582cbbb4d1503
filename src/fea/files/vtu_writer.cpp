#include "fea/files/vtu_writer.h"

#include <bit>
#include <cstring>
#include <functional>
#include <string>

#include "formats/containers/xml_text.h"

namespace ombre::fea {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says so");

// The arrays after the XML, each with its length before it.
class Appended {
 public:
  // Adds an array. `write` is called later, with a function that takes the array's bytes.
  std::string add(std::string_view type, const std::string& name, size_t components, uint64_t bytes,
                  std::function<void(const Sink&)> write) {
    const std::string tag = "<DataArray type=\"" + std::string(type) + "\" Name=\"" + formats::xml_escaped(name) +
                            "\" NumberOfComponents=\"" + std::to_string(components) +
                            "\" format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    offset_ += bytes + sizeof bytes;
    arrays_.push_back({bytes, std::move(write)});
    return tag;
  }
  template <class T>
  std::string add(std::string_view type, const std::string& name, size_t components, size_t count,
                  std::function<T(size_t)> value) {
    return add(type, name, components, count * sizeof(T), [count, value](const Sink& sink) {
      std::string piece;
      for (size_t n = 0; n < count; ++n) {
        const T number = value(n);
        piece.append(reinterpret_cast<const char*>(&number), sizeof number);
        if (piece.size() < (size_t{1} << 20) && n + 1 < count) continue;
        sink(piece);
        piece.clear();
      }
    });
  }

  void write(const Sink& sink) const {
    for (const auto& array : arrays_) {
      sink({reinterpret_cast<const char*>(&array.bytes), sizeof array.bytes});
      array.write(sink);
    }
  }

 private:
  struct Array {
    uint64_t bytes;
    std::function<void(const Sink&)> write;
  };
  std::vector<Array> arrays_;
  uint64_t offset_ = 0;
};

std::string fields_of(const std::vector<ValueField>& fields, Appended& appended) {
  std::string tags;
  for (const ValueField& field : fields) {
    const std::string name = field.unit.empty() ? field.name : field.name + " [" + field.unit + "]";
    tags += appended.add<float>("Float32", name, field.components, field.values.size(),
                                [&field](size_t n) { return field.values[n]; });
  }
  return tags;
}

}  // namespace

void write_vtu(const MeshView& mesh, const std::vector<ValueField>& of_elements,
               const std::vector<ValueField>& of_nodes, const Sink& sink) {
  Appended appended;
  const size_t each = mesh.shape().nodes;
  const uint8_t type = mesh.shape().vtk_type;
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
      std::to_string(mesh.node_count()) + "\" NumberOfCells=\"" + std::to_string(mesh.count()) + "\">\n";
  xml += "<Points>\n" + appended.add<double>("Float64", "points", 3, 3 * mesh.node_count(), [&](size_t n) {
    return mesh.node(n / 3)[static_cast<int>(n % 3)];
  }) + "</Points>\n<Cells>\n";
  xml += appended.add<int64_t>("Int64", "connectivity", 1, each * mesh.count(), [&mesh, each](size_t n) {
    return static_cast<int64_t>(mesh.nodes(n / each)[n % each]);
  });
  xml += appended.add<int64_t>("Int64", "offsets", 1, mesh.count(),
                               [each](size_t n) { return static_cast<int64_t>(each * (n + 1)); });
  xml += appended.add<uint8_t>("UInt8", "types", 1, mesh.count(), [type](size_t) { return type; });
  xml += "</Cells>\n<PointData>\n" + fields_of(of_nodes, appended) + "</PointData>\n<CellData>\n" +
         fields_of(of_elements, appended) +
         "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  sink(xml);
  appended.write(sink);
  sink("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace ombre::fea

// The readers of results, one for each format. Failures are reported and end the reading by DesignError.
#pragma once

#include <span>
#include <unordered_map>

#include "formats/results/results.h"

namespace ombre::formats {

// Unstructured grids of VTK: text, base64 or raw, packed by zlib or not.
Results read_vtu(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

// Uniform grids of XDMF 3. `numbers` is the file of HDF5 beside it, if there is one.
Results read_xdmf(const std::string& name, std::string_view bytes, const std::optional<ResultsFile>& numbers,
                  Diagnostics& diagnostics);

// Results of CalculiX, as text. Of several steps the last one's.
Results read_frd(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

// A mesh whose nodes and elements have numbers of their own.
struct NumberedResults {
  Results results;
  std::unordered_map<uint64_t, uint32_t> node_places, element_places;

  // False where the number is taken.
  bool add_node(uint64_t number, Vec3 point);
  // Empty, or what is wrong.
  std::string add_element(ElementKind kind, uint64_t number, std::span<const uint64_t> nodes);
};
// The mesh of a deck of Abaqus or CalculiX.
NumberedResults read_inp(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

// A CSV file whose first column has the numbers of nodes ("node"), or of elements ("element"), of the mesh.
void add_csv_values(const std::string& name, std::string_view bytes, NumberedResults& mesh, Diagnostics& diagnostics);
// A CSV file of points: columns x, y and z, and those of values.
Results read_csv_points(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace ombre::formats

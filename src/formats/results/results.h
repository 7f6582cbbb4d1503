// Results of simulations: meshes of elements, or points alone, with the numbers that belong to them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec.h"
#include "base/text/diagnostic.h"

namespace ombre::formats {

// Nodes are in the order of Abaqus' C3D4, C3D10, C3D8 and C3D20, which is that of VTK too.
enum class ElementKind : uint8_t { tetrahedron4, tetrahedron10, brick8, brick20 };

inline size_t node_count(ElementKind kind) {
  constexpr std::array<size_t, 4> counts{4, 10, 8, 20};
  return counts[static_cast<size_t>(kind)];
}

// Numbers of all nodes, or of all elements, `components` for each.
struct ResultField {
  std::string name, unit;  // "stress", "MPa"
  size_t components = 1;
  bool is_of_elements = false;
  std::vector<double> values;
};

struct Results {
  std::vector<Vec3> points;         // mm, as the file has them; finite
  std::vector<ElementKind> kinds;   // of elements; none: points alone
  std::vector<uint64_t> first;      // the place of an element's first node in `nodes`
  std::vector<uint32_t> nodes;      // numbers of points
  std::vector<ResultField> fields;  // no two with the same name

  void add_element(ElementKind kind, const uint32_t* first_node);
};

// Splits "stress [MPa]" into name and unit.
void set_name(ResultField& field, std::string_view text);
// Letters and digits alone, small: "von Mises stress" and "von_mises_stress" are called alike.
std::string folded_field_name(std::string_view name);
// The field that is called so, or the only one whose name begins so; null where there is none, or where several do.
const ResultField* find_field(const Results& results, std::string_view name);
// The von Mises stress of a tensor xx, yy, zz, xy, yz, zx.
double von_mises(const double* tensor);

// Moves the points by the displacement, times `factor`. False where the results have none.
bool deform(Results& results, double factor);

// A file beside another one.
struct ResultsFile {
  std::string name;
  std::string_view bytes;
};

// Reads .vtu, .xdmf, .frd, .inp and .csv files by their content. `values` is the .csv file with the fields of an .inp
// mesh, or the file of HDF5 with the numbers of an .xdmf one; nothing: there are none. Nothing, and diagnostics, where
// a file is wrong.
std::optional<Results> read_results(const std::string& name, std::string_view bytes,
                                    const std::optional<ResultsFile>& values, Diagnostics& diagnostics);

}  // namespace ombre::formats

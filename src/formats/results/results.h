// Results of simulations: meshes of elements, or only points, with their values.
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

// The kinds of elements; nodes are in the order of Abaqus' C3D4, C3D10, C3D8, C3D20, C3D6 and C3D5, which is also
// VTK's, except that either triangle of a wedge may come first.
enum class ElementKind : uint8_t { tetrahedron4, tetrahedron10, brick8, brick20, wedge6, pyramid5 };
inline constexpr size_t element_kinds = 6;

inline size_t node_count(ElementKind kind) {
  constexpr std::array<size_t, element_kinds> counts{4, 10, 8, 20, 6, 5};
  return counts[static_cast<size_t>(kind)];
}

// Values of all nodes or all elements, with `components` values each.
struct ResultField {
  std::string name, unit;  // such as "stress" and "MPa"
  size_t components = 1;
  bool is_of_elements = false;
  std::vector<double> values;
  uint64_t step = 0;  // number of its step, from 1, if fields may be of several; else 0
};

// A named set of nodes, elements or sides of elements in a deck.
struct ResultSet {
  enum class Of : uint8_t { nodes, elements, sides };
  std::string name;
  Of of = Of::nodes;
  uint64_t count = 0;
};

// A kind of thing in a file that is not read, of which a warning tells: "points, lines or faces of the grid".
struct LeftOut {
  std::string what;
  uint64_t count = 0;
};

struct Results {
  std::vector<Vec3> points;         // in the file's unit, taken as mm; finite
  std::vector<ElementKind> kinds;   // kinds of the elements; empty if there are only points
  std::vector<uint64_t> first;      // by element: index of its first node in `nodes`
  std::vector<uint32_t> nodes;      // numbers of points
  std::vector<ResultField> fields;  // names are unique

  // The times of the file's steps, empty texts where it does not say them; none for files without steps.
  std::vector<std::string> step_times = {};
  uint64_t step = 0;  // number of the step that was read, from 1; 0 if fields are of several, or there are no steps
  std::vector<ResultSet> sets = {};
  std::vector<LeftOut> left_out = {};

  // The nodes must be there. Puts the triangle of a wedge first from which the other lies above.
  void add_element(ElementKind kind, const uint32_t* first_node);
};

// Records what of a file is left out, and warns of it unless the count is 0.
void leave_out(Results& results, const std::string& file, uint64_t count, const std::string& what,
               Diagnostics& diagnostics);

// Splits a text such as "stress [MPa]" into name and unit.
void set_name(ResultField& field, std::string_view text);
// Returns the name in lower case with only letters and digits, so that "von Mises stress" and "von_mises_stress" are
// equal.
std::string folded_field_name(std::string_view name);
// Returns the field with this name, or the only field whose name begins with it; null if there is none, or several.
const ResultField* find_field(const Results& results, std::string_view name);
// Returns the von Mises stress of a tensor given as xx, yy, zz, xy, yz, zx.
double von_mises(const double* tensor);

// Moves the points by the displacement times `factor`. Returns false if the results have no displacement.
bool deform(Results& results, double factor);

// A file beside another one.
struct ResultsFile {
  std::string name;
  std::string_view bytes;
  std::string written = {};  // its name as the other file has it
};

// The other files that belong to a file of results, and the step of it that is wanted.
struct ResultsBeside {
  // The .csv file with the fields of an .inp mesh, or the HDF5 file with the numbers of an .xdmf file.
  std::optional<ResultsFile> values = {};
  std::vector<ResultsFile> named = {};  // those that files_named_in() returns, and those that they name
  uint64_t step = 0;                    // number of the step, counted from 1; 0 for the last
};

// Reads .vtu, .pvd, .pvtu, .vtkhdf, .xdmf, .frd, .inp and .csv files by their content. Returns null, with diagnostics,
// if a file is invalid.
std::optional<Results> read_results(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                                    Diagnostics& diagnostics);

// Returns false if the ending of the path says that such a file names no others.
bool may_name_files(const std::string& path);
// Returns the names of other files that a step needs, as the first file would write them; step 0 is the last. `written`
// is the name of this file in the one that names it; empty for the first.
std::vector<std::string> files_named_in(const std::string& path, std::string_view bytes, uint64_t step = 0,
                                        const std::string& written = "");

}  // namespace ombre::formats

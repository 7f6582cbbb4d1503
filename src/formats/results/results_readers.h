// Readers of results, one for each format. Errors are reported, and DesignError is thrown.
#pragma once

#include <span>
#include <unordered_map>

#include "formats/results/results.h"

namespace ombre::formats {

// Reads VTK's unstructured grids: text, base64 or raw, optionally compressed by zlib, LZ4 or LZMA.
Results read_vtu(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

// Reads a step of a collection of VTK's unstructured grids, whose parts are joined, or a grid in pieces. `beside` has
// the files that they name.
Results read_pvd(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                 Diagnostics& diagnostics);
Results read_pvtu(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                  Diagnostics& diagnostics);

// Reads a uniform grid of XDMF 3, or one of a temporal collection. `beside` has the HDF5 file, if there is one.
Results read_xdmf(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                  Diagnostics& diagnostics);

// Reads a step of an unstructured grid in VTK's file of HDF5; 0 is the last one.
Results read_vtkhdf(const std::string& name, std::string_view bytes, uint64_t step, Diagnostics& diagnostics);

// Reads results of CalculiX as text. `step` counts from 1; for 0, each field is that of the last step that has it.
Results read_frd(const std::string& name, std::string_view bytes, uint64_t step, Diagnostics& diagnostics);

// A mesh whose nodes and elements have arbitrary numbers.
struct NumberedResults {
  Results results;
  std::unordered_map<uint64_t, uint32_t> node_places, element_places;
  bool is_of_several_parts = false;                        // numbers may stand for several nodes and elements
  std::vector<std::pair<uint32_t, uint32_t>> copies = {};  // points that have the values of other points

  // Adds a node. Returns false if the number is already used.
  bool add_node(uint64_t number, Vec3 point);
  // Adds an element. Returns an error message, or an empty text.
  std::string add_element(ElementKind kind, uint64_t number, std::span<const uint64_t> nodes);
};
// Reads the mesh of an Abaqus or CalculiX deck. `beside` has the files that it includes.
NumberedResults read_inp(const std::string& name, std::string_view bytes, const std::vector<ResultsFile>& beside,
                         Diagnostics& diagnostics);

// Reads a CSV file whose first column contains numbers of nodes ("node") or elements ("element") of the mesh.
void add_csv_values(const std::string& name, std::string_view bytes, NumberedResults& mesh, Diagnostics& diagnostics);
// Reads a CSV file of points with columns x, y and z, and columns of values.
Results read_csv_points(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace ombre::formats

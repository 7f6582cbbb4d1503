// The border of a mesh of results as triangles.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/text/diagnostic.h"
#include "formats/mesh/mesh.h"
#include "formats/results/results.h"

namespace ombre::sources {

// Does a file of this name hold a mesh of elements: .vtu, .xdmf, .frd, .inp?
bool has_elements(const std::string& path);
// The file of HDF5 beside an .xdmf file that has its name; empty where there is none.
std::string numbers_beside(const std::string& path);

// The outer sides of a mesh of results, moved by its displacement times `deform`; closed where elements share nodes.
// `numbers` are those of an .xdmf file. Nothing, and diagnostics, where the file is wrong or has no elements.
std::optional<formats::Mesh> result_border(const std::string& name, std::string_view bytes,
                                           const std::optional<formats::ResultsFile>& numbers, double deform,
                                           Diagnostics& diagnostics);

}  // namespace ombre::sources

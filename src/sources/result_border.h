// The border of a mesh of results as triangles.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/text/diagnostic.h"
#include "formats/mesh/mesh.h"
#include "formats/results/results.h"

namespace ombre::sources {

// Returns true for names of files that contain meshes of elements: .vtu, .pvd, .pvtu, .vtkhdf, .xdmf, .frd, .inp.
bool has_elements(const std::string& path);
// Returns the HDF5 file beside an .xdmf file that belongs to it; empty if there is none.
std::string numbers_beside(const std::string& path);

// Returns the outer sides of a mesh of results, moved by its displacement times `deform`; closed if elements share
// nodes. Null, with diagnostics, if the file is invalid or has no elements.
std::optional<formats::Mesh> result_border(const std::string& name, std::string_view bytes,
                                           const formats::ResultsBeside& beside, double deform,
                                           Diagnostics& diagnostics);

// Returns the outer sides of the elements of results, as above; `name` is used in messages.
std::optional<formats::Mesh> border_of_elements(const std::string& name, formats::Results results,
                                                Diagnostics& diagnostics);

}  // namespace ombre::sources

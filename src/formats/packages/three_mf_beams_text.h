// Writes beams as text of a 3MF model (3MF Beam Lattice Extension 1.2).
#pragma once

#include <cstdint>
#include <optional>

#include "formats/containers/lazy_bytes.h"
#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

// Attributes of the extension for a model with beams.
inline constexpr std::string_view beam_lattice_space =
    " xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" requiredextensions=\"b\"";

// Returns the element that follows the vertices of a mesh. `clip` is the id of the clipping object if there is
// clipping, `materials` that of the group of materials. The beams must outlive the result.
LazyBytes beam_lattice_text(const WrittenBeams& written, std::optional<uint64_t> clip, uint64_t materials);

}  // namespace ombre::formats

// The borders of HATCH entities in DXF drawings.
#pragma once

#include "formats/drawings/dxf_curves.h"
#include "formats/drawings/dxf_entities.h"

namespace ombre::formats {

// Returns the closed rings of the hatch's borders in its own coordinates; an odd number of them encloses a hatched
// point. Throws DesignError, after reporting, if the values are invalid.
std::vector<Ring> borders_of_hatch(const TextScanner& scanner, const DxfEntity& entity, const ChordsOfRadius& chords);

}  // namespace ombre::formats

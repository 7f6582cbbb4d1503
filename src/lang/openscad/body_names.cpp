#include "lang/openscad/body_names.h"

#include "lang/openscad/colours.h"
#include "solids/colour_bytes.h"

namespace ombre::lang::openscad {

std::string body_name(const solids::Attributes& attributes) {
  if (!attributes.part.empty()) return attributes.part;
  if (!attributes.material.empty()) return attributes.material;
  return attributes.colour ? colour_name(solids::bytes_of(*attributes.colour)) : "";
}

}  // namespace ombre::lang::openscad

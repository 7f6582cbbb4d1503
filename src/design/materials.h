// The materials that a design may use: ids, colours, and other properties from a file.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/math/run.h"
#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre {
class MemberReader;
struct MemberInfo;
}  // namespace ombre

namespace ombre::design {

using Rgba = std::array<uint8_t, 4>;

struct Material {
  std::string name;
  MaterialId id = 0;
  Rgba colour{0, 0, 0, 255};
  DataMembers properties;   // modulus, density, support, ..., kept as written
  bool is_support = false;  // supports are made of it
};

// Returns the members of a material in a file, for its reference.
const std::vector<MemberInfo>& material_members();

// `void` has id 0. The other materials are numbered from 1 in the order of their file.
class MaterialTable {
 public:
  MaterialTable();
  // Reads {"materials": [{"name", "r", "g", "b", "a", "support", ...}, ...], ...}. Returns nothing and adds diagnostics
  // if it is wrong.
  static std::optional<MaterialTable> read(const Data& data, Diagnostics& diagnostics);
  // Returns the list in the form that `read` takes.
  Data to_data() const;

  const std::vector<Material>& all() const { return *all_; }  // indexed by id, with void first
  const Material* find(std::string_view name) const;          // case is ignored
  const Material* find(MaterialId id) const { return id < all_->size() ? &(*all_)[id] : nullptr; }
  // Returns the material that supports are made of, else the one named "support", else null.
  const Material* support() const;
  const Material& first() const { return (*all_)[all_->size() > 1 ? 1 : 0]; }  // the default where no material is given
  std::vector<std::string> names() const;

 private:
  // Adds the material that the entry describes, or reports what is wrong with it. Returns false if there are too many.
  bool add(const Data& entry, const MemberReader& reader);
  const Material* marked_as_support() const;

  std::shared_ptr<std::vector<Material>> all_;  // shared by copies, since nodes point to materials
};

}  // namespace ombre::design

// The materials that a design may name: ids, colours, and whatever else a file says of them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/math/run.h"
#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre::design {

using Rgba = std::array<uint8_t, 4>;

struct Material {
  std::string name;
  MaterialId id = 0;
  Rgba colour{};
  DataMembers properties;  // modulus, density, support, ...: kept as written
};

// `void` is id 0; the others count from 1 in the order of their file.
class MaterialTable {
 public:
  MaterialTable();
  // From {"materials": [{"name", "r", "g", "b", "a", ...}]}. Nothing, and diagnostics, when wrong.
  static std::optional<MaterialTable> read(const Data& data, Diagnostics& diagnostics);
  // The list in the form that `read` takes.
  Data to_data() const;

  const std::vector<Material>& all() const { return *all_; }  // by id, void first
  const Material* find(std::string_view name) const;          // names match without regard to case
  const Material* find(MaterialId id) const { return id < all_->size() ? &(*all_)[id] : nullptr; }
  // What holds parts up while they are printed: the material with the property "support": true, else the one of this
  // name; null if there is neither.
  const Material* support() const;
  const Material& first() const { return (*all_)[all_->size() > 1 ? 1 : 0]; }  // what is meant when none is given
  std::vector<std::string> names() const;

 private:
  std::shared_ptr<std::vector<Material>> all_;  // copies share it: nodes point at materials
  MaterialId support_ = 0;                      // the one that is marked; 0: none is
};

}  // namespace ombre::design

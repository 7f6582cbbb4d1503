#include "compile/grid_choices.h"

#include "base/text.h"

namespace ombre::compile {

GridWishes GridChoices::wishes(const std::string& usual, bool is_sparse) const {
  GridWishes wishes;
  wishes.narrow_band = is_sparse;
  for (const std::string& word : split(what.empty() ? usual : what, ',')) {
    const auto name = trim(word);
    if (name.empty())
      throw options::WrongValue(spelled::option("--what", what) +
                                " lacks a word; write materials, fractions, distance, attributes " +
                                "or an attribute's name, or several with commas");
    if (name == "materials")
      wishes.materials = true;
    else if (name == "fractions")
      wishes.fractions = true;
    else if (name == "distance")
      wishes.distance = true;
    else if (name == "attributes")
      wishes.all_attributes = true;
    else
      wishes.attributes.emplace_back(name);
  }
  return wishes;
}

}  // namespace ombre::compile

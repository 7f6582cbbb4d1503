#include "jobs/grid/grid_choices.h"

#include "base/text/text.h"

namespace ombre::compile {

GridQuery GridChoices::query(const std::string& usual, bool is_sparse) const {
  GridQuery query;
  query.narrow_band = is_sparse;
  for (const std::string& word : split(what.empty() ? usual : what, ',')) {
    const auto name = trim(word);
    if (name.empty())
      throw options::WrongValue(spelled::option("--what", what) +
                                " lacks a word; write materials, fractions, distance, attributes " +
                                "or an attribute's name, or several with commas");
    if (name == "materials")
      query.materials = true;
    else if (name == "fractions")
      query.fractions = true;
    else if (name == "distance")
      query.distance = true;
    else if (name == "attributes")
      query.all_attributes = true;
    else
      query.attributes.emplace_back(name);
  }
  return query;
}

}  // namespace ombre::compile

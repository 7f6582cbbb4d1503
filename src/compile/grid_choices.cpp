#include "compile/grid_choices.h"

#include "base/text.h"

namespace ombre::compile {

using options::flag;
using options::group;
using options::option;
namespace kind = options::kind;

const options::Spec<GridChoices>& GridChoices::options() {
  static const options::Spec<GridChoices> spec{
      group(&GridChoices::design),
      group(&GridChoices::sampling),
      option("-o,--output", &GridChoices::output, kind::file, "The file to write; its ending says the format", "FILE")
          .required(),
      option("--what", &GridChoices::what, kind::text,
             "What voxels hold: materials (default; .vdb, .nvdb: distance,fractions), fractions, distance, attributes\n"
             "or names of attributes; several with commas",
             "WHAT"),
      option("--box", &GridChoices::box, kind::box, "Only the voxels that touch this box; mm", "X0,Y0,Z0,X1,Y1,Z1"),
      group(&GridChoices::work,
            WorkOptions::options("Most memory for slabs of voxels in flight and stages (default 2G)")),
      flag("--gzip", &GridChoices::gzip, "Compress the numbers of a .nrrd file"),
      flag("--force", &GridChoices::force, "Replace files that are there, and write even if the disk seems too small")};
  return spec;
}

GridWishes GridChoices::wishes(const std::string& usual, bool is_sparse) const {
  GridWishes wishes;
  wishes.narrow_band = is_sparse;
  for (const std::string& word : split(what.empty() ? usual : what, ',')) {
    const auto name = trim(word);
    if (name.empty())
      throw options::WrongValue("--what " + what + " lacks a word; write materials, fractions, distance, attributes " +
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

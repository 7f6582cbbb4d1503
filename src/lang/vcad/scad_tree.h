// Converts trees of OpenSCAD scripts to nodes of a design.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "design/registry.h"
#include "lang/vcad/word_solids.h"
#include "solids/tree.h"

namespace ombre::lang {

// Reads trees that contain words. Operations above a word become nodes. A subtree without words becomes a leaf, which
// is computed as polyhedra.
class ScadTreeReader {
 public:
  // `script` is the path of the main file. All arguments must outlive this object.
  ScadTreeReader(const design::Registry& registry, const design::MaterialTable& materials, design::SourceLoader* loader,
                 const std::string& script, Diagnostics& diagnostics)
      : registry_(registry), materials_(materials), loader_(loader), script_(script), diagnostics_(diagnostics) {}

  // Returns the solids of a group, one for each part. Adds diagnostics if an operation needs polyhedra.
  WordSolids group(const std::vector<solids::TreePtr>& trees);
  // Returns the union of the solids, or null if there are none.
  design::NodePtr joined(const WordSolids& solids, const SourceRange& where);

 private:
  bool has_words(const solids::Tree& tree);
  WordSolids solids_of(const solids::TreePtr& tree);
  WordSolids leaf(const std::vector<solids::TreePtr>& trees);
  design::NodePtr leaf_node(const std::string& text, const std::string& part, const design::Reader& reader);
  WordSolids by_part(const WordSolids& solids, const SourceRange& where);
  WordSolids united(const solids::Tree& tree);
  WordSolids difference(const solids::Tree& tree);
  WordSolids intersection(const solids::Tree& tree);
  WordSolids with(const solids::Tree& tree, const char* type, const char* parameter, const Data& value);
  WordSolids needs_polyhedra(const solids::Tree& tree);
  design::NodePtr make(const char* type, const std::vector<design::NamedValue>& values,
                       std::vector<design::NodePtr> inputs, const SourceRange& where);
  design::Reader reader(const SourceRange& where, const char* type) const;

  const design::Registry& registry_;
  const design::MaterialTable& materials_;
  design::SourceLoader* loader_;
  const std::string& script_;
  Diagnostics& diagnostics_;
  std::map<const solids::Tree*, bool> has_words_;
};

}  // namespace ombre::lang

// The nodes of .vcad as words of OpenSCAD scripts with `use <ombre>`.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "design/design.h"
#include "lang/openscad/words.h"
#include "lang/vcad/vcad.h"
#include "lang/vcad/word_solids.h"

namespace ombre::lang {

// A word that takes one solid is applied to each part of its children. The result of a word that takes several belongs
// to the part of the first. Above a word, groups and transforms keep parts separate, and booleans combine solids of the
// same part.
class ScadWords final : public openscad::Words {
 public:
  // `script` is the path of the main file. All arguments must outlive this object.
  ScadWords(const design::Registry& registry, const design::MaterialTable& materials, design::SourceLoader* loader,
            std::string script);

  bool makes_solid(std::string_view word) const override;
  bool gives_value(std::string_view word) const override;
  std::vector<std::string> names() const override;
  std::shared_ptr<const void> make(Invocation call, const std::vector<solids::TreePtr>& children,
                                   Diagnostics& diagnostics) override;
  std::optional<Value> value(Invocation call, Diagnostics& diagnostics, Meter& meter) override;

  // Returns the design that a script's whole tree makes. Returns nothing and adds a diagnostic if there is none.
  std::optional<design::Design> finish(const solids::TreePtr& tree, const SourceRange& whole, Diagnostics& diagnostics);

 private:
  WordSolids made_for_parts(const Invocation& call, const std::vector<solids::TreePtr>& children,
                            Diagnostics& diagnostics);
  WordSolids made_of_all(Invocation call, const std::vector<solids::TreePtr>& children, Diagnostics& diagnostics);

  const design::Registry& registry_;
  const design::MaterialTable& materials_;
  design::SourceLoader* loader_;
  std::string script_;
  VcadVocabulary vocabulary_;
};

}  // namespace ombre::lang

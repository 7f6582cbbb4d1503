// Words that OpenSCAD does not have: scripts that say `use <ombre>` may call them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/engine/vocabulary.h"
#include "solids/tree.h"

namespace ombre::lang::openscad {

// Before a word that OpenSCAD has too: ombre_union.
inline constexpr std::string_view word_prefix = "ombre_";

class Words {
 public:
  virtual ~Words() = default;
  virtual bool makes_solid(std::string_view word) const = 0;
  virtual bool gives_value(std::string_view word) const = 0;
  virtual std::vector<std::string> names() const = 0;  // for suggestions
  // What the word makes of the trees that stand in its braces, one for each statement: what solids::Word holds.
  // `call.children` is empty. Null, and diagnostics, where something is wrong.
  virtual std::shared_ptr<const void> make(Invocation call, const std::vector<solids::TreePtr>& children,
                                           Diagnostics& diagnostics) = 0;
  // What the word gives in an expression; nothing, and diagnostics, where it is wrong.
  virtual std::optional<Value> value(Invocation call, Diagnostics& diagnostics, Meter& meter) = 0;
};

}  // namespace ombre::lang::openscad

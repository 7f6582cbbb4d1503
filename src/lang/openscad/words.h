// Ombre's additional modules and functions ("words"), which scripts with `use <ombre>` may call.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/engine/vocabulary.h"
#include "solids/tree.h"

namespace ombre::lang::openscad {

// Prefix of words whose names exist in OpenSCAD, too: ombre_union.
inline constexpr std::string_view word_prefix = "ombre_";

class Words {
 public:
  virtual ~Words() = default;
  virtual bool makes_solid(std::string_view word) const = 0;
  virtual bool gives_value(std::string_view word) const = 0;
  virtual std::vector<std::string> names() const = 0;  // all names, for suggestions
  // Makes the content of a solids::Word from the trees in the call's braces, one for each statement. `call.children` is
  // empty. Returns null and adds diagnostics if something is wrong.
  virtual std::shared_ptr<const void> make(Invocation call, const std::vector<solids::TreePtr>& children,
                                           Diagnostics& diagnostics) = 0;
  // Returns the value of the word in an expression. Returns nothing and adds diagnostics if it is wrong.
  virtual std::optional<Value> value(Invocation call, Diagnostics& diagnostics, Meter& meter) = 0;
};

}  // namespace ombre::lang::openscad

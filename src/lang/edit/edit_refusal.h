// The reason why an edit of a graph cannot be made.
#pragma once

#include "base/text/diagnostic.h"

namespace ombre::lang {

// Thrown within an edit.
struct EditRefusal {
  Diagnostic reason;
};

}  // namespace ombre::lang

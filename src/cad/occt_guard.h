// Calls f, and converts exceptions of Open CASCADE to Error.
#pragma once

#include <Standard_Failure.hxx>

#include <new>
#include <string>

#include "base/text/error.h"

namespace ombre::cad {

template <class F>
auto guarded(const std::string& what, F f) {
  try {
    return f();
  } catch (const Standard_Failure& failure) {
    const std::string reason = failure.GetMessageString();
    throw Error(Code::file_content, what + ": " + (reason.empty() ? failure.DynamicType()->Name() : reason));
  } catch (const std::bad_alloc&) {
    throw Error(Code::memory, what + ": not enough memory");
  }
}

}  // namespace ombre::cad

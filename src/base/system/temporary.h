// A variable that has another value for some time.
#pragma once

#include <type_traits>
#include <utility>

#include "base/system/not_copied.h"

namespace ombre {

// Sets a variable for as long as it lives: const Temporary level(depth_, depth_ + 1);
template <class T>
class Temporary : NotCopied {
 public:
  Temporary(T& place, std::type_identity_t<T> value) : place_(place), before_(std::exchange(place, std::move(value))) {}
  ~Temporary() { place_ = std::move(before_); }

 private:
  T& place_;
  T before_;
};

}  // namespace ombre

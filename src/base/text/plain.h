// The type of a member, be it optional or not.
#pragma once

#include <optional>

namespace ombre {
namespace detail {

template <class Member>
struct Plain {
  using Type = Member;
};
template <class Value>
struct Plain<std::optional<Value>> {
  using Type = Value;
};

}  // namespace detail

template <class Member>
using Plain = typename detail::Plain<Member>::Type;

}  // namespace ombre

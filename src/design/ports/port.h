// Types of the values that parameters of nodes have. `Port<M>` says all that is known of the type M. The file that
// declares a type specialises it; there is no list of types.
#pragma once

#include <string>

#include "base/text/data.h"
#include "design/domain.h"
#include "design/reader.h"

namespace ombre::design {

// The words by which people know a type.
struct PortText {
  std::string kind;    // in help and in the reference: "number or field"
  std::string plural;  // in the kind of a list of them: "numbers or fields"
  std::string python;  // the annotation in Python's stubs: "Number"
  // How a form asks for a value: "number", "boolean", "choice", "text", "file" or "material". "script" is a value as a
  // script writes it, such as a formula or a list.
  std::string_view widget = "script";
};

// A specialisation has these functions:
// - static PortText text(const Domain&).
// - static bool read(const Data&, const Domain&, M&, const Reader&), which returns false after it adds a diagnostic.
// - static Data write(const M&, bool for_hash). For hashes, files are identified by their content.
//
// It may have these, if the defaults do not fit:
// - static bool is_constant(const M&), false if the value varies in space and so distorts the shape of its node.
// - static bool uses_cell(const M&), true if a formula in it uses ci, cj or ck.
// - static void fill(M&, const Reader&), which replaces a value that is not given.
// - static void adapt(Domain&, bool has_composition), for nodes with and without a composition of their own.
// - static bool is_one(const Data&), true if the data is one element in place of a list.
// - static constexpr bool takes_other_names = true, if it gets the arguments whose names match no other parameter.
template <class M>
struct Port;

template <class M>
concept IsPort = requires(const M& value, M& given, const Data& data, const Domain& domain, const Reader& reader) {
  PortText(Port<M>::text(domain));
  bool(Port<M>::read(data, domain, given, reader));
  Data(Port<M>::write(value, true));
};

template <IsPort M>
bool read(const Data& data, const Domain& domain, M& value, const Reader& reader) {
  return Port<M>::read(data, domain, value, reader);
}

template <IsPort M>
Data write(const M& value, bool for_hash) {
  return Port<M>::write(value, for_hash);
}

template <class M>
bool is_constant(const M& value) {
  if constexpr (requires { Port<M>::is_constant(value); })
    return Port<M>::is_constant(value);
  else
    return true;
}

template <class M>
bool uses_cell(const M& value) {
  if constexpr (requires { Port<M>::uses_cell(value); })
    return Port<M>::uses_cell(value);
  else
    return false;
}

}  // namespace ombre::design

// The operators that libraries declare.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/text/data.h"
#include "lang/syntax/declaration.h"

namespace ombre::compile {

struct Operator {
  lang::Declaration declaration;
  std::string library;  // what to write between < and > after `use`: "ombre/cellular.vcad"
};

// Returns the operators of all files in library folders, sorted by category, then in the order of their files. Of
// two files with the same name, only that of the first folder counts, as for `use`. Files that cannot be read are left
// out.
std::vector<Operator> operators_in(const std::vector<std::string>& folders);

// Returns the library of an operator in the usual folders, or "".
std::string library_of(std::string_view name);

// Returns the members of describe_node (node_data.h), and "library" and "source".
DataMembers describe_operator(const Operator& op);

}  // namespace ombre::compile

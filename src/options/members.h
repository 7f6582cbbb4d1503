// Jobs from data, such as the keywords of Python or a request of the studio.
#pragma once

#include <vector>

#include "options/option.h"

namespace ombre::options {

// Sets the options of the job at this address by members named like them without dashes: "layer-height". Values are
// texts, numbers, lists of both, or true for flags; null, "" and false stand for options that are not given, which the
// returned members leave out. Options that take several values may have a list of texts. Throws WrongValue for a member
// that is no option, which names those that there are, and for wrong values.
DataMembers read_members(const std::vector<Option>& options, void* job, const DataMembers& members);

// A list of {"name", "help", "placeholder", "kind", "takes", "is_required", "choices", "needs", "excludes", "least",
// "most"}, for forms and stubs. Names have no dashes.
DataList describe(const std::vector<Option>& options);

// "--layer-height" is layer-height.
std::string member_name(const std::string& option);

}  // namespace ombre::options

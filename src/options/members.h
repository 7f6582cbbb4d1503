// Options of jobs read from data, such as the keyword arguments of Python or a request of the studio.
#pragma once

#include <vector>

#include "base/text/record.h"
#include "options/option.h"

namespace ombre::options {

// Sets the options of the job at address `job` from members that are named like the options without dashes:
// "layer-height". Values are texts, numbers, lists of both, or true for flags. null, "" and false stand for options
// that are not given, and are left out of the returned members. Options that take several values accept a list of
// texts. Throws WrongValue for a member that is not an option, listing the options, and for wrong values.
DataMembers read_members(const std::vector<Option>& options, void* job, const DataMembers& members);

// Removes the dashes of a name: "--layer-height" becomes "layer-height".
std::string member_name(const std::string& option);

// Sets an option of the job at this address by a member, which may not be empty. Throws WrongValue.
void set_member(const Option& option, void* job, const Data& data);

// Returns rows that read the options as members of a JSON object, whose messages have its places.
template <class Job>
std::vector<Field<Job>> fields_of(const Spec<Job>& spec) {
  std::vector<Field<Job>> fields;
  for (const Option& option : spec.options())
    fields.emplace_back(member_name(option.name()), [option](Job& job, const Data& data, const MemberReader& reader) {
      try {
        set_member(option, &job, data);
      } catch (const WrongValue& wrong) {
        reader.fail(data, wrong.message().text());
      }
    });
  return fields;
}

// Returns a list of {"name", "help", "placeholder", "kind", "takes", "is_required", "choices", "needs", "excludes",
// "least", "most"}, for forms and stubs. Names have no dashes.
DataList describe(const std::vector<Option>& options);

}  // namespace ombre::options

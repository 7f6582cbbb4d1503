#include "design/reader.h"

#include "base/system/assert.h"
#include "base/text/text.h"
#include "design/outputs.h"

namespace ombre::design {

void Reader::keep(const NodePtr& value) const {
  ASSERT(values && "parameters of nodes alone hold outputs");
  if (values->empty() || values->back() != value) values->push_back(value);
}

bool Reader::refuse(const std::string& message, const Phrase& hint) const {
  diagnostics.error(where, message, hint);
  return false;
}

bool Reader::fail(const Data& data, const std::string& expected, const Phrase& given_hint, Code code) const {
  Phrase hint = given_hint;
  if (hint.empty() && is_value(data) && data.host_object())
    hint = "this varies in space, so it is known only where the job evaluates it; write a constant";
  std::string message = std::string(name) + " of " + std::string(node) + ": expected " + expected;
  if (!data.is_null()) message += ", found " + describe(data);
  diagnostics.error(code, data.where.source ? data.where : where, message, hint,
                    {{"node", std::string(node)},
                     {"parameter", std::string(name)},
                     {"expected", expected},
                     {"found", data.is_null() ? "" : describe(data)}});
  return false;
}

}  // namespace ombre::design

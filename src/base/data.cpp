#include "base/data.h"

#include "base/text.h"

namespace ombre {

const Data* Data::find(std::string_view name) const {
  const DataMembers* all = members();
  if (!all) return nullptr;
  for (const auto& [key, member] : *all)
    if (key == name) return &member;
  return nullptr;
}

std::string describe(const Data& data) {
  if (data.is_null()) return "nothing";
  if (const bool* b = data.boolean()) return *b ? "true" : "false";
  if (const double* n = data.number()) return "the number " + format_number(*n);
  if (const std::string* s = data.string())
    return "the text \"" + (s->size() > 40 ? s->substr(0, 37) + "..." : *s) + '"';
  if (const DataList* l = data.list()) return "a list of " + std::to_string(l->size());
  return "an object";
}

}  // namespace ombre

#include "base/text/data.h"

#include "base/text/text.h"

namespace ombre {

const Data* Data::find(std::string_view name) const {
  const DataMembers* all = members();
  if (!all) return nullptr;
  for (const auto& [key, member] : *all)
    if (key == name) return &member;
  return nullptr;
}

namespace {

// Cuts a long text at a character boundary.
std::string shortened(const std::string& text) {
  if (text.size() <= 40) return text;
  size_t end = 37;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

}  // namespace

std::string describe(const Data& data) {
  if (data.is_null()) return "nothing";
  if (const bool* b = data.boolean()) return *b ? "true" : "false";
  if (const double* n = data.number()) return "the number " + format_number(*n);
  if (const std::string* s = data.string()) return "the text \"" + shortened(*s) + '"';
  if (const HostObjectPtr object = data.host_object()) return object->describe();
  if (const DataList* l = data.list()) return "a list of " + std::to_string(l->size());
  return "an object";
}

}  // namespace ombre

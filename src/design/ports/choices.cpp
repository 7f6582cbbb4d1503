#include "design/ports/choices.h"

#include <algorithm>

#include "base/text/text.h"

namespace ombre::design {

bool Port<bool>::read(const Data& data, const Domain&, bool& value, const Reader& reader) {
  if (!data.boolean()) return reader.fail(data, "true or false");
  value = *data.boolean();
  return true;
}

bool Port<std::string>::read(const Data& data, const Domain&, std::string& value, const Reader& reader) {
  if (!data.string()) return reader.fail(data, "a text in quotes");
  value = *data.string();
  return true;
}

bool Port<Choice>::read(const Data& data, const Domain& domain, Choice& value, const Reader& reader) {
  if (!data.string()) return reader.fail(data, "a text in quotes");
  const std::string folded = fold_name(*data.string());
  for (const std::string& choice : domain.choices)
    if (fold_name(choice) == folded) {
      value = choice.c_str();
      return true;
    }
  return reader.fail(data, "one of \"" + join(domain.choices, "\", \"") + "\"",
                     did_you_mean(*data.string(), domain.choices), Code::parameter_range);
}

Data Port<bool>::write(const bool& value, bool) { return Data(value); }
Data Port<std::string>::write(const std::string& value, bool) { return Data(value); }
Data Port<Choice>::write(const Choice& value, bool) { return Data(std::string(value.text())); }

namespace {

bool is_pair(const Data& one) {
  return one.list() && one.list()->size() == 2 && (*one.list())[0].string() && (*one.list())[1].string();
}

}  // namespace

bool Port<NamedWord>::is_one(const Data& data) { return !data.list() || is_pair(data); }

bool Port<NamedWord>::read(const Data& data, const Domain& domain, NamedWord& value, const Reader& reader) {
  const std::string words = "one of \"" + join(domain.choices, "\", \"") + "\"";
  if (!is_pair(data)) return reader.fail(data, "pairs of a name and " + words);
  const std::string &name = *(*data.list())[0].string(), &word = *(*data.list())[1].string();
  if (std::ranges::find(domain.choices, word) == domain.choices.end())
    return reader.fail((*data.list())[1], words, did_you_mean(word, domain.choices));
  value = {name, word};
  return true;
}

Data Port<NamedWord>::write(const NamedWord& value, bool) { return Data(DataList{Data(value.name), Data(value.word)}); }

}  // namespace ombre::design

// Functions of values with named members, and of files that hold such values. OpenSCAD 2021.01 does not have them.
#include <filesystem>

#include "base/text/json.h"
#include "base/text/text.h"
#include "lang/openscad/script_functions.h"
#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {
namespace {

Value wrong_entry(const FunctionCall& call, const std::string& what) {
  return call.fail("object() " + what +
                   "; write name = value, an object, or a list of entries [\"name\", value], or [\"name\"] to remove a "
                   "member");
}

// Adds the entries of a list. Returns false, with a warning, if one is wrong.
bool add_entries(const FunctionCall& call, const List& entries, RecordBuilder& members) {
  for (const Value& entry : entries.items) {
    const List* pair = entry.list();
    const size_t size = pair ? pair->items.size() : 0;
    const Text* name = size > 0 ? pair->items[0].text() : nullptr;
    if (!name || size > 2) {
      wrong_entry(call, "entry " + value_text(entry, true, call.meter) + " is no pair of a name and a value");
      return false;
    }
    if (size == 2)
      members.set(name->text, pair->items[1]);
    else
      members.remove(name->text);
  }
  return true;
}

Value object(const FunctionCall& call) {
  RecordBuilder members(call.meter);
  for (size_t n = 0; n < call.size(); ++n) {
    if (const Symbol name = call.written.arguments[n].name.symbol) {
      members.set(*name, call[n]);
    } else if (const Record* other = call[n].record()) {
      members.set_all(*other);
    } else if (const List* entries = call[n].list()) {
      if (!add_entries(call, *entries, members)) return {};
    } else {
      return wrong_entry(call, "cannot take " + value_text(call[n], true, call.meter));
    }
  }
  return members.finish();
}

Value is_object(const FunctionCall& call) { return call[0].record() != nullptr; }

Value has_key(const FunctionCall& call) {
  const Record* record = call[0].record();
  const Text* name = call[1].text();
  if (!record || !name) return call.wrong_type();
  return record->find(name->text) != nullptr;
}

Value import_value(const FunctionCall& call) {
  const Symbol name = call.written.arguments[0].name.symbol;
  const Text* file = call[0].text();
  if (!file || (name && *name != "file")) return call.fail("import() needs the name of a file, such as \"data.json\"");
  if (to_lower(std::filesystem::path(file->text).extension().string()) != ".json")
    return call.stop("import(\"" + file->text +
                     "\") in an expression reads .json files alone; write import() as a statement for geometry");
  const std::string path = path_beside(call.written.span, file->text);
  const auto content = call.files.read(path);
  if (!content) return call.fail("Can't open import file '\"" + file->text + "\"'.");
  Diagnostics found;
  const auto data = parse_json(make_source(path, *content), found);
  if (data) return from_data(*data, call.meter);
  return call.stop(placed_sentence_of(found.list().front()));
}

}  // namespace

std::vector<NamedFunction> object_functions() {
  return {
      {"object", object}, {"is_object", is_object, 1, 1}, {"has_key", has_key, 2, 2}, {"import", import_value, 1, 1}};
}

}  // namespace ombre::lang::openscad

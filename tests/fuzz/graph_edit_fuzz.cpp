// Any bytes are an edit and a script: the edit is refused with a reason, or leaves a script without mistakes, and is
// undone to the byte.
#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/checks.h"
#include "lang/edit/graph_edit.h"

namespace {

using namespace ombre;
using namespace ombre::lang;

constexpr size_t choice_bytes = 4;

// Returns the edit that the bytes choose, of the first 256 items.
GraphEdit edit_of(const uint8_t* chosen) {
  const size_t item = chosen[1], other = chosen[2], detail = chosen[3];
  const SetArgument place{item, detail < 128 ? std::optional<size_t>(detail) : std::nullopt, "size", "[1, 2]"};
  switch (chosen[0] % 11) {
    case 0:
      return place;
    case 1:
      return SetArgument{item, detail, "", ""};
    case 2:
      return InsertCall{static_cast<InsertCall::Where>(detail % 4), item, "translate([1, 0, 0])"};
    case 3:
      return AddVariable{"added", "2 * 3"};
    case 4:
      return RemoveItem{item, detail % 2 == 1};
    case 5:
      return ConnectItems{other, "", place};
    case 6:
      return RenameVariable{item, "renamed"};
    case 7:
      return MoveCall{item, detail < 128 ? std::optional<size_t>(other) : std::nullopt};
    case 8:
      return GroupCalls{{item, other}, "grouped", "A group.", {{item, detail, "given"}}};
    case 9:
      return UseLibrary{"ombre/cellular.vcad"};
    default:
      return MoveToLibrary{"part", "part.vcad", "A part."};
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < choice_bytes) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + choice_bytes, size - choice_bytes);
  const SourcePtr script = make_source("fuzz.vcad", text);
  const Dialect dialect = data[0] < 128 ? Dialect::vcad : Dialect::openscad;
  Diagnostics diagnostics;
  const auto edited = edit(script, dialect, edit_of(data), diagnostics);
  fuzz::check_places(diagnostics);
  fuzz::require(edited.has_value() != diagnostics.has_errors());
  if (!edited) return 0;
  std::vector<std::string> texts{std::string(script->text())};
  for (const Replacements& step : edited->steps) texts.push_back(applied(texts.back(), step));
  fuzz::require(texts.back() == edited->text->text());
  fuzz::require(ScriptGraph::read(edited->text, dialect, diagnostics).has_value());
  std::string undone = texts.back();
  for (size_t n = edited->steps.size(); n-- > 0;) undone = applied(undone, inverse(texts[n], edited->steps[n]));
  fuzz::require(undone == texts.front());
  return 0;
}

// Edits of design files: each does what it says and nothing else, and is undone to the byte.
#include "lang/edit/design_edit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "base/text/json.h"
#include "lang/edit/json_layout.h"

namespace ombre::lang {
namespace {

const std::string design = R"({
  "format": "ombre-design",
  "version": 1,
  "materials": [{"name": "red", "r": 255, "g": 0, "b": 0, "a": 255}],
  "nodes": [
    {"id": "n1", "type": "cube", "parameters": {"side": 5,   "material": "red"}},
    {"id": "v", "type": "noise"},
    {
      "id": "n2",
      "type": "translate",
      "parameters": {"by": [1, 0, 0]},
      "inputs": ["n1"]
    },
    {"id": "n3", "type": "union", "inputs": ["n1", "n2"]}
  ],
  "parts": [
    {"name": "all \"of\" it", "node": "n3"}
  ]
}
)";

// The numbers of the items of `design`: its part, then its nodes.
enum Item : size_t { part, cube, noise, moved, both };

DesignGraph graph_of(const SourcePtr& source) {
  Diagnostics diagnostics;
  auto graph = DesignGraph::read(source, diagnostics);
  EXPECT_TRUE(graph) << to_text(diagnostics);
  return std::move(*graph);
}

// Returns the text after an edit, which is undone to check that nothing is lost.
std::string edited(const std::string& text, const GraphEdit& change) {
  Diagnostics diagnostics;
  const auto made = edit_design(make_source("part.json", text), change, diagnostics);
  if (!made) return "refused: " + diagnostics.list().front().message;
  std::string at = text;
  std::vector<Replacements> undo;
  for (const Replacements& step : made->steps) {
    undo.push_back(inverse(at, step));
    at = applied(at, step);
  }
  EXPECT_EQ(at, made->text->text());
  const std::string result = at;
  for (size_t n = undo.size(); n-- > 0;) at = applied(at, undo[n]);
  EXPECT_EQ(at, text);
  return result;
}

// Returns `design` with a part of its text replaced.
std::string with(const std::string& old, const std::string& by, std::string text = design) {
  const size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), by);
}

TEST(DesignEdit, ReadsItsGraph) {
  const DesignGraph graph = graph_of(make_source("part.json", design));
  ASSERT_EQ(graph.items().size(), 5u);
  EXPECT_EQ(graph.items()[part].name, "all \"of\" it");
  EXPECT_EQ(graph.items()[part].inputs, std::vector<size_t>{both});
  EXPECT_EQ(graph.items()[both].inputs, (std::vector<size_t>{cube, moved}));
  EXPECT_EQ(graph.items()[cube].arguments.size(), 2u);
  EXPECT_TRUE(graph.needs(both, cube));
  EXPECT_FALSE(graph.needs(cube, both));
}

TEST(DesignEdit, ChangesAddsAndRemovesParameters) {
  EXPECT_EQ(edited(design, SetArgument{cube, 0, "", "6.5"}), with("5,  ", "6.5,  "));
  EXPECT_EQ(edited(design, SetArgument{cube, 1, "", R"("blue")"}), with(R"("red"}})", R"("blue"}})"));
  EXPECT_EQ(edited(design, SetArgument{cube, 0, "", ""}), with(R"("side": 5,   )", ""));
  EXPECT_EQ(edited(design, SetArgument{cube, 1, "", ""}), with(R"(,   "material": "red")", ""));
  EXPECT_EQ(edited(design, SetArgument{moved, 0, "", ""}), with(R"("by": [1, 0, 0])", ""));
  EXPECT_EQ(edited(design, SetArgument{cube, std::nullopt, "x", "1"}), with(R"("red"}})", R"("red",   "x": 1}})"));
  EXPECT_EQ(edited(design, SetArgument{noise, std::nullopt, "size", "2"}),
            with(R"("noise")", R"("noise", "parameters": {"size": 2})"));
  EXPECT_EQ(edited(design, SetArgument{cube, 0, "", "red"}), "refused: \"red\" is no value");
  EXPECT_EQ(edited(design, SetArgument{cube, 0, "", "1, 2"}), "refused: \"1, 2\" is no value");
  EXPECT_EQ(edited(design, SetArgument{part, std::nullopt, "x", "1"}),
            "refused: \"all \"of\" it\" is a part, which has one node and no parameters");
}

TEST(DesignEdit, AddsNodes) {
  const std::string line = "\n    {\"id\": \"n3\", \"type\": \"union\", \"inputs\": [\"n1\", \"n2\"]}";
  const std::string sphere = R"({"type": "sphere", "parameters": {"radius": 2}})";
  const std::string entry = R"({"id": "n5", "type": "sphere", "parameters": {"radius": 2}})";
  const std::string added = with(line, line + ",\n    " + entry);
  using Where = InsertCall::Where;
  EXPECT_EQ(edited(design, InsertCall{Where::inside, both, sphere}),
            with(R"(["n1", "n2"])", R"(["n1", "n2", "n5"])", added));
  EXPECT_EQ(edited(design, InsertCall{Where::after, cube, sphere}), with(R"(["n1"])", R"(["n1", "n5"])", added));
  EXPECT_EQ(edited(design, InsertCall{Where::inside, cube, sphere}),
            with(R"("material": "red"})", R"("material": "red"}, "inputs": ["n5"])", added));
  EXPECT_EQ(edited(design, InsertCall{Where::end, 0, sphere}),
            with(R"("node": "n3"})", "\"node\": \"n3\"},\n    {\"name\": \"part\", \"node\": \"n5\"}", added));
  const std::string around = with(line, line + ",\n    {\"id\": \"n5\", \"type\": \"negate\", \"inputs\": [\"n2\"]}");
  EXPECT_EQ(edited(design, InsertCall{Where::around, moved, "negate"}),
            with(R"("inputs": ["n1", "n2"])", R"("inputs": ["n1", "n5"])", around));
  EXPECT_EQ(edited(design, AddVariable{"w", "noise"}),
            with(line, line + ",\n    {\"id\": \"w\", \"type\": \"noise\"}"));
  EXPECT_EQ(edited(design, AddVariable{"v", "noise"}).substr(0, 30), "refused: \"v\" is there already,");
  EXPECT_EQ(edited(design, InsertCall{Where::end, 0, "sphere(5)"}), "refused: \"sphere(5)\" is no type of nodes");
  EXPECT_EQ(edited(design, InsertCall{Where::inside, part, sphere}),
            "refused: \"all \"of\" it\" is a part, which has one node");
}

TEST(DesignEdit, RemovesNodes) {
  const std::string n2 = R"({
      "id": "n2",
      "type": "translate",
      "parameters": {"by": [1, 0, 0]},
      "inputs": ["n1"]
    },
    )";
  // n1 stays, since n3 takes it too.
  EXPECT_EQ(edited(design, RemoveItem{moved, false}), with(R"(["n1", "n2"])", R"(["n1"])", with(n2, "")));
  EXPECT_EQ(edited(design, RemoveItem{moved, true}), with(R"(["n1", "n2"])", R"(["n1", "n1"])", with(n2, "")));
  EXPECT_EQ(edited(design, RemoveItem{part, false}), "refused: the design would have no part");
  EXPECT_EQ(edited(design, RemoveItem{both, false}), "refused: the design would have no part");
  EXPECT_EQ(edited(design, RemoveItem{both, true}), "refused: a part has one node, and this one takes 2");
  const std::string two = with(R"("node": "n3"})", "\"node\": \"n3\"},\n    {\"name\": \"b\", \"node\": \"n2\"}");
  // Without the part and its union, n2 and n1 are used by the other part alone.
  EXPECT_EQ(edited(two, RemoveItem{0, false}),
            with("{\"name\": \"all \\\"of\\\" it\", \"node\": \"n3\"},\n    ", "",
                 with(",\n    {\"id\": \"n3\", \"type\": \"union\", \"inputs\": [\"n1\", \"n2\"]}", "", two)));
}

TEST(DesignEdit, ConnectsRenamesAndMoves) {
  const std::string second = with(R"("version": 1)", R"("version": 2)");
  const std::string wired = with("5,  ", R"({"from": "v", "output": "value"},  )", second);
  EXPECT_EQ(edited(design, ConnectItems{noise, "value", {cube, 0, "", ""}}), wired);
  EXPECT_EQ(edited(design, ConnectItems{both, "", {moved, 0, "", ""}}), "refused: a value cannot depend on itself");
  EXPECT_EQ(edited(wired, RemoveItem{noise, false}), "refused: \"v\" is used in line 6");
  std::string renamed = with(R"("id": "v")", R"("id": "a \"b\"")", wired);
  renamed = with(R"("from": "v")", R"("from": "a \"b\"")", renamed);
  EXPECT_EQ(edited(wired, RenameVariable{noise, "a \"b\""}), renamed);
  std::string other = with(R"("id": "n1")", R"("id": "box")");
  other = with(R"(["n1"])", R"(["box"])", other);
  other = with(R"(["n1", )", R"(["box", )", other);
  EXPECT_EQ(edited(design, RenameVariable{cube, "box"}), other);
  EXPECT_EQ(edited(design, RenameVariable{part, "knob"}), with(R"("all \"of\" it")", R"("knob")"));
  EXPECT_EQ(edited(design, RenameVariable{cube, "n3"}).substr(0, 31), "refused: \"n3\" is there already,");
  // n1 has two uses, which stay.
  const std::string three = with(R"({"id": "v", "type": "noise"})", R"({"id": "v", "type": "negate", "inputs": []})");
  EXPECT_EQ(edited(three, MoveCall{cube, noise}), with(R"("inputs": [])", R"("inputs": ["n1"])", three));
  EXPECT_EQ(edited(three, MoveCall{moved, noise}),
            with(R"(["n1", "n2"])", R"(["n1"])", with(R"("inputs": [])", R"("inputs": ["n2"])", three)));
  EXPECT_EQ(edited(design, MoveCall{both, moved}), "refused: a node cannot be within itself");
  EXPECT_EQ(edited(design, MoveCall{moved, std::nullopt}),
            with(R"(["n1", "n2"])", R"(["n1"])",
                 with(R"("node": "n3"})", "\"node\": \"n3\"},\n    {\"name\": \"part\", \"node\": \"n2\"}")));
  EXPECT_EQ(edited(design, GroupCalls{{cube}, "g", "", {}}), "refused: a design file has no modules");
}

TEST(DesignEdit, RefusesWhatIsNoDesign) {
  for (const char* text : {"", "[]", "{}", "5", R"({"nodes": 5, "parts": []})", R"({"nodes": []})", "{\"nodes\": ["})
    EXPECT_EQ(edited(text, AddVariable{"w", "noise"}).substr(0, 8), "refused:") << text;
  const std::string bare =
      R"({"nodes":[5,{},{"id":3},{"id":"a"},{"id":"a","type":"b","inputs":7,"parameters":[]}],"parts":[{}]})";
  for (size_t item = 0; item < 8; ++item)
    for (const GraphEdit& change : std::vector<GraphEdit>{
             SetArgument{item, std::nullopt, "x", "1"}, SetArgument{item, 0, "", "1"}, RemoveItem{item, true},
             RemoveItem{item, false}, RenameVariable{item, "q"}, MoveCall{item, 4}, MoveCall{4, item},
             ConnectItems{item, "value", {4, std::nullopt, "y", ""}}, InsertCall{InsertCall::Where::around, item, "c"},
             InsertCall{InsertCall::Where::inside, item, "c"}, InsertCall{InsertCall::Where::after, item, "c"}})
      edited(bare, change);
}

class RandomDesigns {
 public:
  size_t below(size_t count) { return std::uniform_int_distribution<size_t>(0, count - 1)(random_); }

  // Returns a design of nodes that take some of those before them.
  std::string design() {
    const size_t count = 2 + below(8);
    std::string nodes;
    for (size_t n = 0; n < count; ++n) {
      nodes += n == 0 ? gap() : "," + gap();
      nodes += R"({"id":)" + gap() + '"' + id(n) + R"(", "type" : ")" + (n % 3 == 2 ? "union" : "sphere") + '"';
      if (below(3) > 0) nodes += ",\"parameters\": {" + gap() + "\"radius\": " + value(n) + gap() + '}';
      if (n > 0 && below(4) > 0) nodes += R"(, "inputs": [)" + list(n) + ']';
      nodes += gap() + '}';
    }
    return R"({"format": "ombre-design", "version": 2, "nodes": [)" + nodes + "],\n\"parts\": [" + gap() +
           R"({"name": "a", "node": ")" + id(count - 1) + R"("}, {"name": "b", "node": ")" + id(0) + "\"}]}\r\n";
  }

  GraphEdit one(const DesignGraph& graph) {
    const size_t item = below(graph.items().size()), other = below(graph.items().size());
    const size_t arguments = graph.items()[item].arguments.size();
    switch (below(7)) {
      case 0:
        return SetArgument{item, arguments == 0 ? std::nullopt : std::optional(below(arguments)), "extra", "7.25"};
      case 1:
        return InsertCall{static_cast<InsertCall::Where>(below(4)), item, "cube"};
      case 2:
        return AddVariable{"new_node", "noise"};
      case 3:
        return RemoveItem{item, below(2) == 0};
      case 4:
        return ConnectItems{item, "value", {other, std::nullopt, "wired", ""}};
      case 5:
        return RenameVariable{item, "new \"name\""};
      default:
        return MoveCall{item, below(4) == 0 ? std::nullopt : std::optional(other)};
    }
  }

 private:
  std::string id(size_t n) const { return n % 2 == 0 ? "n" + std::to_string(n) : R"(\"q\\)" + std::to_string(n); }
  std::string gap() {
    constexpr const char* gaps[] = {"", " ", "\n    ", "\r\n", "\t"};
    return gaps[below(5)];
  }
  std::string list(size_t n) {
    std::string text;
    for (size_t count = below(3); count-- > 0;) text += (text.empty() ? "" : gap() + ',') + '"' + id(below(n)) + '"';
    return text;
  }
  std::string value(size_t n) {
    if (n == 0 || below(3) > 0) return std::to_string(below(100));
    return R"({"from": ")" + id(below(n)) + R"(", "output": "value"})";
  }
  std::mt19937 random_{20261129};
};

// Returns the words of an item, with ids and not numbers, so that graphs can be compared.
std::string line_of(const DesignGraph& graph, const DesignItem& item) {
  std::string line = (item.is_part ? "part " : "") + item.name + ' ' + item.type;
  for (const auto& [name, value] : item.arguments) line += ' ' + name + '=' + print_json_line(*value);
  for (const size_t input : item.inputs) line += " <" + graph.items()[input].name;
  return line;
}

std::multiset<std::string> lines_of(const DesignGraph& graph) {
  std::multiset<std::string> lines;
  for (const DesignItem& item : graph.items()) lines.insert(line_of(graph, item));
  return lines;
}

// The lines that one graph has and the other lacks.
std::vector<std::string> lost(const DesignGraph& from, const DesignGraph& to) {
  const auto before = lines_of(from), after = lines_of(to);
  std::vector<std::string> lines;
  std::ranges::set_difference(before, after, std::back_inserter(lines));
  return lines;
}

struct DesignClaim {
  const DesignGraph &before, &after;

  size_t nodes_lost() const { return before.items().size() - after.items().size(); }

  void check(const SetArgument& edit) const {
    EXPECT_EQ(lost(before, after).size(), 1u);
    const auto& arguments = after.items()[edit.item].arguments;
    EXPECT_EQ(*arguments[edit.index ? *edit.index : arguments.size() - 1].second, Data(7.25));
  }
  void check(const InsertCall& edit) const {
    const bool gives_part = after.part_count() > before.part_count();
    EXPECT_EQ(after.items().size(), before.items().size() + (gives_part ? 2 : 1));
    EXPECT_EQ(after.items().back().type, "cube");
    if (edit.where == InsertCall::Where::around) {
      const size_t made = after.items().size() - 1;
      for (const DesignItem& item : after.items())
        for (const size_t input : item.inputs)
          if (&item != &after.items()[made]) {
            EXPECT_NE(input, after.items()[made].inputs.front());
          }
    } else {
      EXPECT_EQ(lost(before, after).size(), edit.where == InsertCall::Where::end || gives_part ? 0u : 1u);
    }
  }
  void check(const AddVariable&) const {
    EXPECT_TRUE(lost(before, after).empty());
    EXPECT_EQ(lost(after, before), std::vector<std::string>{"new_node noise"});
  }
  void check(const RemoveItem& edit) const {
    const DesignItem& removed = before.items()[edit.item];
    const auto gone = [&](const DesignItem& one) {
      return std::ranges::none_of(after.items(), [&](const DesignItem& other) {
        return other.is_part == one.is_part && other.name == one.name;
      });
    };
    EXPECT_TRUE(gone(removed));
    // Only what the item alone takes goes with it.
    for (const DesignItem& item : before.items())
      if (!item.is_part && gone(item)) {
        EXPECT_TRUE(before.needs(edit.item, *before.node_called(item.name))) << item.name;
      }
    if (edit.keeps_children && !removed.is_part) {
      EXPECT_LE(after.items().size(), before.items().size() - 1);
    }
  }
  void check(const ConnectItems& edit) const {
    EXPECT_EQ(lost(before, after).size(), 1u);
    EXPECT_EQ(after.wires().size(), before.wires().size() + 1);
    EXPECT_TRUE(after.needs(edit.to.item, edit.from));
  }
  void check(const RenameVariable& edit) const {
    EXPECT_EQ(after.items()[edit.item].name, "new \"name\"");
    for (size_t n = 0; n < after.items().size(); ++n) EXPECT_EQ(after.items()[n].inputs, before.items()[n].inputs);
    EXPECT_EQ(after.wires().size(), before.wires().size());
  }
  void check(const MoveCall& edit) const {
    const std::string& id = before.items()[edit.item].name;
    const size_t now = *after.node_called(id);
    const auto uses = [&](const DesignGraph& graph, size_t node) {
      size_t count = 0;
      for (const DesignItem& item : graph.items()) count += static_cast<size_t>(std::ranges::count(item.inputs, node));
      return count;
    };
    const size_t old_uses = uses(before, edit.item);
    EXPECT_EQ(uses(after, now), old_uses == 1 ? 1 : old_uses + 1);
    if (edit.into) {
      EXPECT_EQ(after.items()[*after.node_called(before.items()[*edit.into].name)].inputs.back(), now);
    }
  }
  void check(const GroupCalls&) const {}
  void check(const UseLibrary&) const {}
  void check(const MoveToLibrary&) const {}
};

TEST(RandomDesignEdits, AreWhatTheyClaimAndAreUndoneToTheByte) {
  RandomDesigns random;
  std::map<size_t, size_t> made;
  constexpr size_t wanted = 500;
  size_t count = 0;
  for (size_t tries = 0; count < wanted && tries < 20 * wanted; ++tries) {
    const std::string text = random.design();
    const SourcePtr source = make_source("part.json", text);
    const DesignGraph before = graph_of(source);
    const GraphEdit change = random.one(before);
    Diagnostics diagnostics;
    const auto result = edit_design(source, change, diagnostics);
    SCOPED_TRACE("kind " + std::to_string(change.index()) + ", try " + std::to_string(tries) + '\n' + text);
    if (!result) {
      EXPECT_EQ(diagnostics.list().front().message.find("leave a file with mistakes"), std::string::npos);
      continue;
    }
    if (result->steps.empty()) continue;
    ++count;
    ++made[change.index()];
    const std::string after_text = edited(text, change);
    SCOPED_TRACE(after_text);
    const DesignGraph after = graph_of(result->text);
    std::visit([&](const auto& one) { DesignClaim{before, after}.check(one); }, change);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(count, wanted);
  for (size_t kind = 0; kind < 7; ++kind) EXPECT_GT(made[kind], 10u) << kind;
}

}  // namespace
}  // namespace ombre::lang

// Random edits of the repository's examples: each does what it says and nothing else, and is undone to the byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include "base/system/test_source_files.h"
#include "base/text/text.h"
#include "lang/edit/graph_edit.h"
#include "lang/edit/text_layout.h"

namespace ombre::lang {
namespace {

std::vector<SourcePtr> examples() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(source_file("examples")))
    if (entry.path().extension() == ".vcad") paths.push_back(entry.path());
  std::ranges::sort(paths);
  std::vector<SourcePtr> sources;
  for (const std::filesystem::path& path : paths) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    sources.push_back(make_source(path.filename().string(), text.str()));
  }
  return sources;
}

// Returns a text without the blanks with which its lines begin.
std::string without_indents(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool is_indent = c == ' ' && (result.ends_with('\n') || result.empty());
    if (!is_indent) result += c;
  }
  return result;
}

// Returns what an item says without its place: its name and arguments.
std::string line_of(const ScriptGraph& graph, size_t item) {
  const GraphItem& one = graph.items()[item];
  std::string line = one.variable + " = " + one.callee + '(';
  for (const GraphArgument& argument : one.arguments)
    line += argument.name + ':' + without_indents(graph.text(argument.value->span)) + ',';
  return line;
}

std::multiset<std::string> lines_of(const ScriptGraph& graph) {
  std::multiset<std::string> lines;
  for (size_t n = 0; n < graph.items().size(); ++n)
    if (graph.items()[n].kind != GraphItem::Kind::value) lines.insert(line_of(graph, n));
  return lines;
}

// Returns the comments of a text.
std::multiset<std::string> comments_of(std::string_view text) {
  std::multiset<std::string> comments;
  bool is_in_string = false;
  for (size_t at = 0; at < text.size(); ++at) {
    if (is_in_string) {
      if (text[at] == '\\')
        ++at;
      else if (text[at] == '"')
        is_in_string = false;
    } else if (text.substr(at).starts_with("//")) {
      const size_t end = std::min(text.find_first_of("\r\n", at), text.size());
      comments.emplace(text.substr(at, end - at));
      at = end;
    } else if (text[at] == '"') {
      is_in_string = true;
    }
  }
  return comments;
}

class RandomEdits {
 public:
  size_t below(size_t count) { return std::uniform_int_distribution<size_t>(0, count - 1)(random_); }

  GraphEdit one(const ScriptGraph& graph) {
    const size_t item = below(graph.items().size());
    const GraphItem& of = graph.items()[item];
    switch (below(9)) {
      case 0: {
        const bool is_new = of.arguments.empty();
        return SetArgument{item, is_new ? std::nullopt : std::optional(below(of.arguments.size())), "extra", "7.25"};
      }
      case 1:
        return InsertCall{static_cast<InsertCall::Where>(below(4)), item, "probe(7.25)"};
      case 2:
        return AddVariable{"new_variable", "7.25"};
      case 3:
        return RemoveItem{item, false};
      case 4:
        return RemoveItem{item, true};
      case 5: {
        const size_t to = below(graph.items().size());
        const auto& arguments = graph.items()[to].arguments;
        const auto index = arguments.empty() ? std::nullopt : std::optional(below(arguments.size()));
        return ConnectItems{item, "", {to, index, "extra", ""}};
      }
      case 6:
        return RenameVariable{item, "new_name"};
      case 7:
        return MoveCall{item, below(4) == 0 ? std::nullopt : std::optional(below(graph.items().size()))};
      default:
        return GroupCalls{{item}, "new_group", "A group.", {}};
    }
  }

 private:
  std::mt19937 random_{20261129};
};

struct Claim {
  const ScriptGraph &before, &after;

  std::string difference() const {
    const auto old_lines = lines_of(before), new_lines = lines_of(after);
    std::string text;
    std::vector<std::string> lost, gained;
    std::ranges::set_difference(old_lines, new_lines, std::back_inserter(lost));
    std::ranges::set_difference(new_lines, old_lines, std::back_inserter(gained));
    for (const std::string& line : lost) text += "- " + line + '\n';
    for (const std::string& line : gained) text += "+ " + line + '\n';
    return text;
  }
  long more() const { return static_cast<long>(statements(after)) - static_cast<long>(statements(before)); }
  static size_t statements(const ScriptGraph& graph) {
    return static_cast<size_t>(std::ranges::count_if(
        graph.items(), [](const GraphItem& item) { return item.kind != GraphItem::Kind::value; }));
  }
  static size_t statements_in(const ScriptGraph& graph, size_t item) {
    size_t count = 0;
    for (size_t n = item; n < graph.end_of(item); ++n)
      if (graph.items()[n].kind != GraphItem::Kind::value) ++count;
    return count;
  }

  // Expects that the text has changed in nothing but this argument, and in the order of its lines: a variable moves up
  // to what uses it.
  void check_argument(size_t item, std::optional<size_t> index, const std::string& value) const {
    std::string old_text(before.text());
    if (index) {
      const ast::Span& span = before.items()[item].arguments[*index].value->span;
      old_text.replace(span.begin, span.end - span.begin, value);
    }
    std::vector<std::string> lost, gained;
    std::ranges::set_difference(text_lines(old_text), text_lines(after.text()), std::back_inserter(lost));
    std::ranges::set_difference(text_lines(after.text()), text_lines(old_text), std::back_inserter(gained));
    ASSERT_EQ(lost.size(), index ? 0u : 1u);
    ASSERT_EQ(gained.size(), lost.size());
    if (index) return;
    const auto [kept, from] = std::ranges::mismatch(lost[0], gained[0]);
    EXPECT_TRUE(gained[0].ends_with(std::string(kept, lost[0].end())));
    EXPECT_NE(gained[0].find("extra=" + value), std::string::npos) << gained[0];
  }
  // Returns the lines of a text without their blanks.
  static std::multiset<std::string> text_lines(std::string_view text) {
    std::multiset<std::string> lines;
    for (std::string& line : split(std::string(text), '\n')) {
      std::erase(line, ' ');
      lines.insert(std::move(line));
    }
    return lines;
  }

  void check(const SetArgument& edit) const { check_argument(edit.item, edit.index, "7.25"); }
  void check(const InsertCall&) const {
    EXPECT_EQ(difference(), "+  = probe(:7.25,\n");
    EXPECT_EQ(more(), 1);
  }
  void check(const AddVariable&) const { EXPECT_EQ(difference(), "+ new_variable = (:7.25,\n"); }
  void check(const RemoveItem& edit) const {
    const bool is_value = before.items()[edit.item].kind == GraphItem::Kind::value;
    const bool keeps = edit.keeps_children && before.items()[edit.item].kind == GraphItem::Kind::call;
    EXPECT_EQ(more(), is_value ? 0 : keeps ? -1 : -static_cast<long>(statements_in(before, edit.item)));
    if (keeps) {
      EXPECT_EQ(difference(), "- " + line_of(before, edit.item) + '\n');
    }
  }
  void check(const ConnectItems& edit) const {
    const GraphItem& from = before.items()[edit.from];
    if (from.kind != GraphItem::Kind::value) return check_argument(edit.to.item, edit.to.index, from.variable);
    EXPECT_EQ(more(), 1);
  }
  void check(const RenameVariable& edit) const {
    std::string text(after.text());
    const std::string& name = before.items()[edit.item].variable;
    EXPECT_NE(text.find("new_name"), std::string::npos);
    for (size_t at = text.find("new_name"); at != std::string::npos; at = text.find("new_name", at))
      text.replace(at, std::string("new_name").size(), name);
    EXPECT_EQ(text, before.text());
  }
  void check(const MoveCall& edit) const {
    EXPECT_EQ(difference(), "");
    size_t at_top = 0, was_at_top = 0;
    for (const GraphItem& item : after.items()) at_top += item.parent ? 0 : 1;
    for (const GraphItem& item : before.items()) was_at_top += item.parent ? 0 : 1;
    const bool leaves_top = !before.items()[edit.item].parent;
    EXPECT_EQ(at_top + (leaves_top ? 1 : 0), was_at_top + (edit.into ? 0 : 1));
  }
  void check(const GroupCalls&) const { EXPECT_EQ(difference(), "+  = new_group(\n+ new_group = module(\n"); }
  void check(const UseLibrary&) const {}
  void check(const MoveToLibrary&) const {}  // its text is tested by itself
};

// True if an edit may remove comments, which belong to what it removes.
bool may_lose_comments(const GraphEdit& edit) {
  const auto* removed = std::get_if<RemoveItem>(&edit);
  return removed || std::holds_alternative<SetArgument>(edit) || std::holds_alternative<ConnectItems>(edit);
}

TEST(RandomEdits, AreWhatTheyClaimAndAreUndoneToTheByte) {
  const std::vector<SourcePtr> sources = examples();
  ASSERT_GT(sources.size(), 20u);
  std::vector<ScriptGraph> graphs;
  for (const SourcePtr& source : sources) {
    Diagnostics diagnostics;
    auto graph = ScriptGraph::read(source, Dialect::vcad, diagnostics);
    ASSERT_TRUE(graph) << to_text(diagnostics);
    graphs.push_back(std::move(*graph));
  }
  RandomEdits random;
  std::map<size_t, size_t> made, refused;
  constexpr size_t wanted = 1000, most_tries = 20000;
  size_t count = 0;
  for (size_t tries = 0; count < wanted && tries < most_tries; ++tries) {
    const size_t which = random.below(sources.size());
    const GraphEdit change = random.one(graphs[which]);
    Diagnostics diagnostics;
    const auto edited = edit(sources[which], Dialect::vcad, change, diagnostics);
    ++(edited ? made : refused)[change.index()];
    if (!edited) {
      EXPECT_FALSE(diagnostics.list().front().message.empty());
      EXPECT_EQ(diagnostics.list().front().message.find("leave a script with mistakes"), std::string::npos)
          << sources[which]->name() << ", kind " << change.index() << ", try " << tries;
      continue;
    }
    ++count;
    SCOPED_TRACE(sources[which]->name() + ", kind " + std::to_string(change.index()) + ", try " +
                 std::to_string(tries) + '\n' + std::string(edited->text->text()));
    // The steps are the edit, and their inverses undo it.
    std::string text(sources[which]->text());
    std::vector<Replacements> undo;
    for (const Replacements& step : edited->steps) {
      undo.push_back(inverse(text, step));
      text = applied(text, step);
    }
    EXPECT_EQ(text, edited->text->text());
    for (size_t n = undo.size(); n-- > 0;) text = applied(text, undo[n]);
    EXPECT_EQ(text, sources[which]->text());
    // The new text is a script, which differs as the edit says.
    const auto after = ScriptGraph::read(edited->text, Dialect::vcad, diagnostics);
    ASSERT_TRUE(after) << to_text(diagnostics);
    std::visit([&](const auto& one) { Claim{graphs[which], *after}.check(one); }, change);
    const auto old_comments = comments_of(sources[which]->text());
    auto new_comments = comments_of(edited->text->text());
    if (const auto added = new_comments.find("/// A group."); added != new_comments.end()) new_comments.erase(added);
    EXPECT_TRUE(std::ranges::includes(old_comments, new_comments));
    if (!may_lose_comments(change)) {
      EXPECT_EQ(old_comments, new_comments);
    }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(count, wanted);
  constexpr size_t kinds_of_libraries = 2;  // the last ones, which are tested by themselves
  for (size_t kind = 0; kind + kinds_of_libraries < std::variant_size_v<GraphEdit>; ++kind)
    EXPECT_GT(made[kind], 10u) << kind;
}

}  // namespace
}  // namespace ombre::lang

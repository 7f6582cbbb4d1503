#include "stores/journal.h"

#include "stores/test_piece_job.h"

namespace ombre::stores {
namespace {

bool accept_all(const Entry&) { return true; }

Entries first_entries(int64_t count) {
  Entries entries;
  for (int64_t id = 0; id < count; ++id) entries[id] = entry_of(piece(id));
  return entries;
}

}  // namespace

TEST(Journal, LinesAreTheNumberTheFilesAndTheRecord) {
  const Entry entry{7, {{"a.png", 12, "00ff"}}, {{"voxels", DataList{3.0, 0.0}}}};
  EXPECT_EQ(to_line("layer", entry),
            "{\"layer\":7,\"files\":[{\"file\":\"a.png\",\"bytes\":12,\"hash\":\"00ff\"}],\"voxels\":[3,0]}\n");
  EXPECT_EQ(to_line("design", {1, {}, {}}), "{\"design\":1,\"files\":[]}\n");
}

TEST(Journal, ReadsWhatItWrites) {
  const Entries entries = first_entries(12);
  EXPECT_EQ(parse_journal("piece", to_lines("piece", entries), accept_all), entries);
}

TEST(Journal, TornAtAnyByteItHasTheWholeLinesAlone) {
  const Entries entries = first_entries(4);
  const std::string text = to_lines("piece", entries);
  for (size_t length = 0; length <= text.size(); ++length) {
    const std::string torn = text.substr(0, length);
    const auto lines = static_cast<int64_t>(std::ranges::count(torn, '\n'));
    EXPECT_EQ(parse_journal("piece", torn, accept_all), first_entries(lines)) << length;
  }
}

TEST(Journal, ForeignLinesAreSkipped) {
  const std::string good = to_line("piece", entry_of(piece(3)));
  for (const char* foreign :
       {"", "\n", "hello\n", "[1, 2]\n", "{\"layer\":1,\"files\":[]}\n", "{\"piece\":1}\n",
        "{\"piece\":-1,\"files\":[]}\n", "{\"piece\":1.5,\"files\":[]}\n", "{\"piece\":1e300,\"files\":[]}\n",
        "{\"piece\":1,\"files\":[1]}\n", "{\"piece\":1,\"files\":[{\"file\":\"a\",\"bytes\":-1,\"hash\":\"\"}]}\n",
        "{\"piece\":1,\"files\":[{\"file\":\"a\",\"bytes\":1}]}\n", "\xff\xfe{\"piece\":1,\"files\":[]}\n"}) {
    const Entries entries = parse_journal("piece", foreign + good, accept_all);
    EXPECT_EQ(entries.size(), 1U) << foreign;
    EXPECT_TRUE(entries.contains(3)) << foreign;
  }
}

TEST(Journal, OfTwoLinesForOnePieceTheLaterOneThatIsAcceptedCounts) {
  const auto line = [](double n) { return to_line("piece", {4, {}, {{"n", n}}}); };
  const auto is_small = [](const Entry& entry) { return *entry.record.front().second.number() < 10; };
  EXPECT_EQ(parse_journal("piece", line(1) + line(2), is_small).at(4).record.front().second, Data(2.0));
  EXPECT_EQ(parse_journal("piece", line(1) + line(20), is_small).at(4).record.front().second, Data(1.0));
}

}  // namespace ombre::stores

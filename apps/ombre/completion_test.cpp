#include "ombre/completion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "ombre/command_line.h"

namespace ombre::cli {
namespace {

// Returns the lines that `ombre completion words ...` prints: a word and, after a tab, its description.
std::vector<std::string> lines_for(std::vector<const char*> words) {
  words.insert(words.begin(), {"ombre", "completion", "words"});
  testing::internal::CaptureStdout();
  EXPECT_EQ(run(static_cast<int>(words.size()), words.data()), jobs::done);
  std::vector<std::string> lines;
  std::istringstream text(testing::internal::GetCapturedStdout());
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_for(const std::vector<const char*>& words) {
  std::vector<std::string> found;
  for (const std::string& line : lines_for(words)) found.push_back(line.substr(0, line.find('\t')));
  std::sort(found.begin(), found.end());
  return found;
}

using Words = std::vector<std::string>;

}  // namespace

TEST(Completion, OfCommandsAndOptionsByTheirBeginning) {
  EXPECT_EQ(words_for({"sl"}), Words{"slice"});
  EXPECT_EQ(words_for({"pr"}), (Words{"printers", "probe"}));
  EXPECT_EQ(words_for({"--ver"}), Words{"--version"});
  EXPECT_EQ(words_for({"slice", "part.vcad", "--dry"}), Words{"--dry-run"});
  EXPECT_EQ(words_for({"slice", "--me"}), Words{"--memory"});
  EXPECT_EQ(lines_for({"sheet", "--coun"}), Words{"--count\tNumber of layers, evenly spaced (default 12)"});
}

TEST(Completion, OfValuesThatAreListed) {
  EXPECT_EQ(words_for({"slice", "part.vcad", "--place", ""}), (Words{"center", "design"}));
  EXPECT_EQ(words_for({"mesh", "--flavour", "p"}), Words{"prusa"});
  EXPECT_EQ(words_for({"nodes", "rectpr"}), Words{"rectprism"});
  EXPECT_EQ(words_for({"completion", ""}), (Words{"bash", "fish", "zsh"}));
}

TEST(Completion, LeavesFilesAndFreeValuesToTheShell) {
  EXPECT_EQ(words_for({"slice", ""}), Words{});
  EXPECT_EQ(words_for({"slice", "part.vcad", "--layer-height", ""}), Words{});
  EXPECT_EQ(words_for({"slice", "part.vcad", "-o", "-"}), Words{});
  EXPECT_EQ(words_for({"nothing", ""}), Words{});
  EXPECT_EQ(words_for({}), Words{});
}

TEST(Completion, ScriptsAreForKnownShells) {
  for (const std::string& shell : completion_shells()) EXPECT_NE(completion_script(shell), "") << shell;
  EXPECT_EQ(completion_script("csh"), "");
}

}  // namespace ombre::cli

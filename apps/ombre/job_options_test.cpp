// Tests that the command line, its help and its completion follow the rows of the options of jobs.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "base/text/text.h"
#include "jobs/all_jobs.h"
#include "ombre/command_line.h"

namespace ombre::cli {
namespace {

using Rows = std::vector<options::Option>;

const std::map<std::string, Rows>& rows_of_jobs() {
  static const std::map<std::string, Rows> rows = [] {
    std::map<std::string, Rows> made;
    for (const jobs::JobKind& kind : jobs::all_jobs()) made.emplace(kind.name, kind.options());
    return made;
  }();
  return rows;
}

struct Printed {
  std::string out, err;
};

Printed printed_by(const std::vector<std::string>& words) {
  std::vector<const char*> arguments{"ombre"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  run(static_cast<int>(arguments.size()), arguments.data());
  std::string out = testing::internal::GetCapturedStdout();
  return {std::move(out), testing::internal::GetCapturedStderr()};
}

// Returns the beginning of a help, since helps are wrapped and only that is sure to be in one piece.
std::string beginning(const std::string& help) {
  return help.substr(0, std::min(help.find_first_of(",;:(\n"), size_t{20}));
}

void expect_refusal(const std::string& command, const options::Option& option, const std::string& value,
                    const std::string& problem) {
  const std::string error = printed_by({command, "part.vcad", option.name(), value}).err;
  EXPECT_NE(error.find(option.name() + ": " + problem), std::string::npos) << command << ' ' << error;
}

}  // namespace

TEST(JobOptions, AreInHelp) {
  for (const auto& [command, rows] : rows_of_jobs()) {
    const std::string help = printed_by({command, "--help"}).out;
    for (const options::Option& option : rows) {
      for (const std::string& name : split(option.names, ',')) EXPECT_NE(help.find(name), std::string::npos) << name;
      EXPECT_NE(help.find(beginning(option.help)), std::string::npos) << command << ' ' << option.help;
      EXPECT_NE(help.find(option.placeholder), std::string::npos) << command << ' ' << option.placeholder;
    }
  }
}

TEST(JobOptions, AreCompletedWithTheirWords) {
  for (const auto& [command, rows] : rows_of_jobs())
    for (const options::Option& option : rows) {
      if (!option.name().starts_with("--")) continue;
      const std::string lines = printed_by({"completion", "words", command, option.name()}).out;
      EXPECT_NE(lines.find(option.name() + '\t' + beginning(option.help)), std::string::npos)
          << command << ' ' << lines;
      if (option.choices.empty()) continue;
      const std::string words = printed_by({"completion", "words", command, option.name(), ""}).out;
      EXPECT_EQ(words, join(option.choices, "\n") + '\n') << command << ' ' << option.name();
    }
}

// Options that every command has do not come from jobs.
TEST(JobOptions, AreAllThatTheirCommandsHave) {
  size_t jobs = 0;
  const Data commands = describe_commands();
  for (const Data& command : *commands.list()) {
    const auto found = rows_of_jobs().find(*command.find("name")->string());
    if (found == rows_of_jobs().end()) continue;
    ++jobs;
    for (const Data& option : *command.find("options")->list()) {
      const std::string name = *option.find("name")->string();
      const bool is_of_all = name == "--help" || name == "--quiet" || name == "--json" || name == "--save-job";
      EXPECT_EQ(option.find("kind") == nullptr, is_of_all) << found->first << ' ' << name;
    }
    EXPECT_EQ(command.find("options")->list()->size(), found->second.size() + 4) << found->first;
  }
  EXPECT_EQ(jobs, rows_of_jobs().size());
}

TEST(JobOptions, RefuseValuesBeyondTheirLimits) {
  for (const auto& [command, rows] : rows_of_jobs())
    for (const options::Option& option : rows) {
      if (!option.choices.empty()) expect_refusal(command, option, "?", "there is no \"?\"");
      if (!option.limits) continue;
      const std::string kind = option.limits->is_whole ? "is not a whole number from " : "is not a number from ";
      for (const double beyond : {option.limits->least - 1, option.limits->most * 2})
        expect_refusal(command, option, format_number(beyond),
                       '"' + format_number(beyond) + "\" " + kind + options::range_text(*option.limits));
    }
}

TEST(JobOptions, SlipsGetSuggestions) {
  for (const auto& [command, rows] : rows_of_jobs())
    for (const options::Option& option : rows) {
      if (!option.name().starts_with("--") || option.name().size() < 8) continue;
      std::string slip = option.name();
      std::swap(slip[4], slip[5]);
      if (slip == option.name()) continue;
      const std::string error = printed_by({command, "part.vcad", slip}).err;
      EXPECT_NE(error.find("did you mean \"" + option.name() + "\"?"), std::string::npos) << command << ' ' << error;
    }
}

}  // namespace ombre::cli

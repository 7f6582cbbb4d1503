#include "jobs/sweep_cases.h"

#include <gtest/gtest.h>

#include "jobs/common/session.h"

namespace ombre::jobs {
namespace {

using Texts = std::vector<std::string>;

struct BarChoices {
  std::string cell;
  std::vector<std::string> definitions;

  static const options::Spec<BarChoices>& options() {
    using namespace options;
    static const options::Spec<BarChoices> spec{
        option("--cell", &BarChoices::cell, kind::text, "Size", "MM"),
        list("-D,--define", &BarChoices::definitions, kind::text, "Variables", "NAME=VALUE")};
    return spec;
  }
};

SavedJob bar(DataMembers options) {
  static const JobKind kind = job_kind<BarChoices>("bar", "", "", [](const BarChoices&, Session&) { return done; });
  return {&kind, std::move(options)};
}

const Data* option_of(const SavedJob& job, const std::string& name) {
  for (const auto& [member, value] : job.options)
    if (member == name) return &value;
  return nullptr;
}

}  // namespace

TEST(SweepCases, CommasWithinBracketsBelongToAValue) {
  EXPECT_EQ(parse_varied("at=[1, 2], [3,4]", true).values, (Texts{"[1, 2]", "[3,4]"}));
  EXPECT_EQ(parse_varied("voxel=[0.1,0.1,0.05],0.2", false).values, (Texts{"0.1,0.1,0.05", "0.2"}));
  EXPECT_EQ(parse_varied("name=\"a,b\",max(1, 2)", true).values, (Texts{"\"a,b\"", "max(1, 2)"}));
}

TEST(SweepCases, TheLastValuesChangeFirst) {
  const SweepCases cases(bar({}), {parse_varied("width=1,2", true), parse_varied("cell=3,4,5", false)});
  ASSERT_EQ(cases.count(), 6);
  EXPECT_EQ(cases.values(0), (Texts{"1", "3"}));
  EXPECT_EQ(cases.values(1), (Texts{"1", "4"}));
  EXPECT_EQ(cases.values(5), (Texts{"2", "5"}));
  EXPECT_EQ(cases.name_of(5), "width = 2, cell = 5");
}

TEST(SweepCases, ValuesReplaceThoseOfTheJob) {
  const SweepCases cases(bar({{"cell", "1"}, {"define", DataList{"height=7"}}}),
                         {parse_varied("width=2", true), parse_varied("cell=3", false)});
  const SavedJob job = cases.job_of(0);
  EXPECT_EQ(job.options.size(), 2U);
  EXPECT_EQ(*option_of(job, "cell"), Data("3"));
  EXPECT_EQ(*option_of(job, "define"), Data(DataList{"height=7", "width=2"}));
}

TEST(SweepCases, SlipsAreNamed) {
  for (const char* text : {"width", "width=", "=1", "width=1,,2", "width=,1"})
    EXPECT_THROW(parse_varied(text, true), WrongArgument) << text;
  EXPECT_THROW(SweepCases(bar({}), {parse_varied("weather=1,2", false)}), WrongArgument);
  Varied many{"width", true, Texts(2000, "1")};
  EXPECT_THROW(SweepCases(bar({}), {many, many}), WrongArgument);
}

}  // namespace ombre::jobs

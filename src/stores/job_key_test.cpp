#include "stores/job_key.h"

#include <gtest/gtest.h>

#include "base/text/json.h"

namespace ombre::stores {
namespace {

using KeyParts = std::vector<std::pair<std::string, std::string>>;

JobKey key_of(const KeyParts& parts) {
  JobKey key;
  for (const auto& [name, content] : parts) key.add(name, content);
  return key;
}

using Names = std::vector<std::string>;

}  // namespace

TEST(JobKey, EqualKeysHaveNoDifferences) {
  const KeyParts parts{{"the study", "{}"}, {"a b.scad", "x = 1;"}, {"--rotate", "0,0,0"}};
  EXPECT_EQ(key_of(parts).differences(key_of(parts)), Names{});
  EXPECT_EQ(key_of({}).differences(key_of({})), Names{});
}

TEST(JobKey, NamesPartsThatDifferOrAreInOneKeyAlone) {
  const JobKey key = key_of({{"design", "1"}, {"a.stl", "solid"}, {"-D", ""}});
  EXPECT_EQ(key.differences(key_of({{"design", "2"}, {"a.stl", "solid"}, {"-D", ""}})), Names{"design"});
  EXPECT_EQ(key.differences(key_of({{"design", "1"}, {"-D", "x=1"}})), (Names{"a.stl", "-D"}));
  EXPECT_EQ(key.differences(key_of({{"b.stl", ""}, {"design", "1"}, {"a.stl", "solid"}, {"-D", ""}})), Names{"b.stl"});
  EXPECT_EQ(key.differences({}), (Names{"design", "a.stl", "-D"}));
}

TEST(JobKey, OtherContentHasAnotherKey) {
  // No content of one part may stand for the content of another.
  EXPECT_NE(key_of({{"a", "bc"}}), key_of({{"ab", "c"}}));
  EXPECT_NE(key_of({{"a", "b"}, {"c", "d"}}), key_of({{"c", "d"}, {"a", "b"}}));
}

TEST(JobKey, ReadsItsText) {
  const JobKey key = key_of({{"a name with \"quotes\"\n", "1"}, {"b", ""}});
  Diagnostics ignored;
  const auto data = parse_json(make_source("key", print_json(key.data())), ignored);
  ASSERT_TRUE(data);
  EXPECT_EQ(JobKey::read(&*data), key);
  for (const Data& wrong : {Data(), Data("a"), Data(DataList{"a"}), Data(DataList{DataList{"a"}}),
                            Data(DataList{DataList{"a", 1.0}}), Data(DataList{DataList{"a", "b", "c"}})})
    EXPECT_FALSE(JobKey::read(&wrong));
  EXPECT_FALSE(JobKey::read(nullptr));
}

}  // namespace ombre::stores

// The endings of files that kinds of jobs write, beside the table of formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "jobs/all_jobs.h"
#include "sources/file_formats.h"

namespace ombre::jobs {
namespace {

TEST(JobEndings, BelongToOneKindAndToAWrittenFormat) {
  std::set<std::string> seen;
  for (const JobKind& kind : all_jobs())
    for (const std::string& ending : kind.endings) {
      EXPECT_TRUE(seen.insert(ending).second) << ending;
      EXPECT_TRUE(std::ranges::any_of(sources::file_formats(), [&](const FileFormat& format) {
        return format.is_written && std::ranges::find(format.endings, ending) != format.endings.end();
      })) << ending;
    }
  for (const FileFormat& format : sources::file_formats()) {
    const bool is_of_one_kind = format.content == Content::mesh || format.content == Content::volume;
    const bool is_known = seen.contains(std::string(format.endings.front()));
    EXPECT_TRUE(is_known || !format.is_written || !is_of_one_kind) << format.name;
  }
}

}  // namespace
}  // namespace ombre::jobs

#include "base/text/markdown.h"

#include <gtest/gtest.h>

namespace ombre {
namespace {

TEST(Markdown, RowsHaveTheCellsThatAreGiven) {
  EXPECT_EQ(table_row({"`mode`", "linear | step", "", "two\nlines"}), "| `mode` | linear \\| step |  | two lines |\n");
}

}  // namespace
}  // namespace ombre

#include "export/output_file.h"

#include <gtest/gtest.h>

#include <cerrno>

#include "export/test_folder.h"
#include "formats/containers/file.h"

namespace ombre::exporting {
namespace {

using OutputFile = FolderTest;
using Names = std::vector<std::string>;
using formats::read_file;

}  // namespace

TEST_F(OutputFile, ReplacesAFileAndLeavesNoOther) {
  put("a", "a longer text of before");
  for (const Durability durability : {Durability::closed, Durability::flushed}) {
    const std::string bytes("a\0b\n", 4);
    write_file(path("a"), bytes, durability);
    EXPECT_EQ(read_file(path("a")), bytes);
  }
  write_file(path("empty"), "");
  EXPECT_EQ(names(), (Names{"a", "empty"}));
  EXPECT_EQ(read_file(path("empty")), "");
}

TEST_F(OutputFile, HasItsNameOnlyOnceItIsCommitted) {
  put("a", "before");
  NewFile file(path("a"));
  file.append("new");
  file.close();
  EXPECT_EQ(read_file(path("a")), "before");
  EXPECT_EQ(read_file(file.part()), "new");
  file.commit();
  EXPECT_EQ(read_file(path("a")), "new");
  EXPECT_EQ(names(), Names{"a"});
}

TEST_F(OutputFile, IsGoneUnlessItIsCommitted) {
  put("old", "before");
  {
    NewFile open(path("open")), closed(path("old"));
    open.append("some");
    closed.append("all");
    closed.close();
    EXPECT_EQ(names(), (Names{"old", "old.part", "open.part"}));
  }
  EXPECT_EQ(names(), Names{"old"});
  EXPECT_EQ(read_file(path("old")), "before");
}

TEST_F(OutputFile, HasZerosBeforeWhatIsWrittenFarIn) {
  NewFile file(path("a"));
  file.append("abc");
  file.write_at(6, "xyz");
  file.write_at(1, "B");
  file.append("d");  // after the text that was appended
  file.close();
  file.commit();
  EXPECT_EQ(read_file(path("a")), std::string("aBcd\0\0xyz", 9));
}

TEST_F(OutputFile, OfAFullDiskLeavesWhatWasThere) {
  put("a", "before");
  for (const bool is_far_in : {false, true}) {
    fill_disk_of("a");
    try {
      NewFile file(path("a"));
      is_far_in ? file.write_at(5, "x") : file.append("x");
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::disk_space);
      EXPECT_EQ(error.what(), "cannot write " + path("a") +
                                  ": No space left on device; free some space there and try again, or choose another "
                                  "folder");
    }
    EXPECT_EQ(names(), Names{"a"});
    EXPECT_EQ(read_file(path("a")), "before");
  }
}

TEST_F(OutputFile, SaysWhyItCannotBeBegun) {
  put("file", "");
  const auto message = [&](const std::string& name) { return failure_of([&] { write_file(path(name), "x"); }); };
  EXPECT_EQ(message("none/a"), "cannot write " + path("none/a") + ": No such file or directory; the folder is missing");
  EXPECT_EQ(message("file/a"),
            "cannot write " + path("file/a") + ": Not a directory; part of the path is a file, choose another folder");
  const std::string longest(300, 'x');
  EXPECT_EQ(message(longest), "cannot write " + path(longest) + ": File name too long; choose a shorter name");
  EXPECT_EQ(names(), Names{"file"});
}

TEST_F(OutputFile, DoesNotReplaceAFolder) {
  std::filesystem::create_directories(path("folder"));
  EXPECT_EQ(failure_of([&] { write_file(path("folder"), "x"); }),
            "cannot write " + path("folder") + ": Is a directory; a folder has this name, choose another");
  EXPECT_EQ(names(), Names{"folder"});
  EXPECT_EQ(names("folder"), Names{});
}

TEST_F(OutputFile, OfOtherCodeIsMovedOrRemoved) {
  {
    PendingFile kept(path("kept")), left(path("left")), unwritten(path("unwritten"));
    std::ofstream(kept.part()) << "kept";
    std::ofstream(left.part()) << "left";
    kept.commit();
    EXPECT_EQ(failure_of([&] { unwritten.commit(); }),
              "cannot write " + path("unwritten") + ": No such file or directory; the folder is missing");
    // A file that another job writes under the same name is not this one.
    std::ofstream(kept.part()) << "of another job";
  }
  EXPECT_EQ(names(), (Names{"kept", "kept.part"}));
  EXPECT_EQ(read_file(path("kept")), "kept");
}

TEST_F(OutputFile, GrowsByWholeLinesFromSeveralWriters) {
  put("journal", "begun\n");
  {
    AppendFile one(path("journal")), other(path("journal"));
    one.append("1\n");
    other.append("2\n");
    one.append("3\n");
  }
  EXPECT_EQ(read_file(path("journal")), "begun\n1\n2\n3\n");
  AppendFile(path("new")).append("first\n");
  EXPECT_EQ(read_file(path("new")), "first\n");
  EXPECT_NE(failure_of([&] { AppendFile(path("none/journal")); }).find("the folder is missing"), std::string::npos);
  EXPECT_NE(failure_of([] { AppendFile("/dev/full").append("x"); }).find("No space left on device"), std::string::npos);
}

TEST(WriteErrors, HaveAPlaceAndARemedy) {
  for (const int error : {ENOSPC, EDQUOT, EACCES, EPERM, EROFS, ENOTDIR, ENOENT, ENAMETOOLONG, EISDIR, ENOTEMPTY}) {
    const Error made = write_error("out/a.png", error);
    const std::string text = made.what();
    EXPECT_EQ(text.find("cannot write out/a.png: "), 0U) << text;
    EXPECT_NE(text.find("; "), std::string::npos) << text;
    EXPECT_EQ(made.code(), error == ENOSPC || error == EDQUOT ? Code::disk_space : Code::cannot_write) << text;
    EXPECT_EQ(made.values().size(), 1U);
  }
}

}  // namespace ombre::exporting

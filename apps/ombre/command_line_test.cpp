#include "ombre/command_line.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/system/temporary_folder.h"
#include "base/text/test_cases.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "jobs/slice/slice_report.h"
#include "ombre/arguments.h"
#include "ombre/commands.h"
#include "ombre/progress_line.h"

namespace ombre::cli {
namespace {

struct Outcome {
  int code = 0;
  std::string out, err;
};

Outcome run_with(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "ombre");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Outcome outcome;
  outcome.code = run(static_cast<int>(arguments.size()), arguments.data());
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.err = testing::internal::GetCapturedStderr();
  return outcome;
}

void expect_wrong(const std::vector<const char*>& arguments, const std::string& part) {
  const Outcome outcome = run_with(arguments);
  EXPECT_EQ(outcome.code, jobs::wrong_input);
  EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

// Calls the program with the words before each arrow; what it says contains what follows.
void expect_all_wrong(const char* cases) {
  for_cases(cases, [](const std::string& line, const std::string& part) {
    const std::vector<std::string> words = split(line, ' ');
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());
    expect_wrong(arguments, part);
  });
}

}  // namespace

TEST(CommandLine, HelpAndVersionAreData) {
  EXPECT_EQ(run_with({"--version"}).out.substr(0, 6), "ombre ");
  const Outcome help = run_with({"slice", "--help"});
  EXPECT_EQ(help.code, jobs::done);
  EXPECT_NE(help.out.find("--layer-height"), std::string::npos);
  EXPECT_EQ(help.err, "");
}

TEST(CommandLine, SlipsGetSuggestions) {
  expect_all_wrong(R"(
    slise part.vcad => did you mean "slice"?
    part.vcad => did you mean "ombre slice part.vcad"?
    slice part.vcad --dryrun => did you mean "--dry-run"?
    slice part.vcad other.vcad => one argument too many: "other.vcad"
    slice part.vcad --printer j570 => did you mean "j750"?
    slice part.vcad --voxel thin => write for example --voxel 0.1
    slice part.vcad --force --resume => --force and --resume do not go together
    voxels part.vcad --ouput part.npy => did you mean "--output"?
    nodes spere => did you mean "sphere"?
  )");
}

TEST(CommandLine, ValuesThatDoNotFitAreReportedWithThoseThatDo) {
  for (const char* command : {"slice", "render", "mesh", "voxels", "contours"})
    expect_wrong({command, "part.vcad", "--threads", "0"}, "--threads: \"0\" is not a whole number from 1 to 1024");
  expect_all_wrong(R"(
    slice part.vcad --threads x => --threads: "x" is not a whole number from 1 to 1024
    slice part.vcad --threads 2.5 => --threads: "2.5" is not a whole number
    slice part.vcad --threads 1e3 => --threads: "1e3" is not a whole number
    render part.vcad --perspective 121 => --perspective: "121" is not a number from 0 to 120
    render part.vcad --zoom nan => --zoom: "nan" is not a number from 0.01 to 1000
    mesh part.vcad --flavor cura => there is no "cura"; there are generic, prusa, bambu, orca, snapmaker; see
  )");
  expect_wrong({"slice", "part.vcad", "--dither", "blu-noise"}, "did you mean \"blue-noise\"?\n");
}

TEST(CommandLine, WhatIsMissingIsReported) {
  expect_all_wrong(R"(
    slice => the design is missing; write for example ombre slice part.vcad; see ombre slice --help
    probe part.vcad => --at is missing; write ombre probe ... --at X,Y,Z; see
    bundle => the design is missing; write for example ombre bundle part.vcad; see
    sheet => folder is missing; write ombre sheet ... DIR; see
    render part.vcad --zoom => --zoom needs a value: --zoom X; see
    render part.vcad --view => --view needs a value: --view NAME; see
    slice part.vcad --layers => --layers needs a value: --layers A:B; see
    slice part.vcad --seed 1 --seed 2 => --seed is given more than once; see
  )");
}

TEST(CommandLine, BundlesSayWhatToWrite) {
  expect_all_wrong(R"(
    bundle part.py => ombre slice part.py --emit json > part.json
    bundle part.ombre => part.ombre is a bundle already
    bundle part.vcad -o part.zip => write for example -o part.ombre
    slice part.vcad --rotate 90 => write for example --rotate 90,0,45
  )");
}

TEST(CommandLine, PicturesSayWhatToWrite) {
  expect_all_wrong(R"(
    render part.vcad --size 800 => write for example --size 800x600
    render part.vcad --size 0x600 => write for example --size 800x600
    render part.vcad --size 99999x600 => at most 16384 each way
    render part.vcad --cut w=1 => write for example --cut x=0
    render part.vcad --from 30 => write for example --from 30,20
    render part.vcad --from 30,120 => elevation from -90 to 90
    render part.vcad --opacity clear => write for example --opacity clear=0.2
    render part.vcad --opacity clear=2 => a number from 0 to 1
    render part.vcad --background #12345 => for example #20304a
    render part.vcad --box 0,0,0,1,1,0 => write for example --box
    render part.vcad --view below => below
  )");
}

TEST(CommandLine, MissingFilesAreFailuresOfTheMachine) {
  const Outcome outcome = run_with({"sheet", "/nowhere/at/all"});
  EXPECT_EQ(outcome.code, jobs::failed);
  EXPECT_NE(outcome.err.find("/nowhere/at/all"), std::string::npos);
}

TEST(CommandLine, ListsPrintersForPeopleAndPrograms) {
  EXPECT_NE(run_with({"printers"}).out.find("j750-fine  "), std::string::npos);
  EXPECT_NE(run_with({"printers", "J750"}).out.find("127/3000 mm (600 dpi)"), std::string::npos);
  const std::string events = run_with({"printers", "--json"}).out;
  EXPECT_EQ(events.substr(0, 19), R"({"event":"printer",)");
}

TEST(Arguments, LengthsAreExact) {
  EXPECT_EQ(parse_voxel("0.1")[2], (Pitch{1, 10}));
  EXPECT_EQ(parse_voxel("25.4/600,25.4/300,0.027")[0], (Pitch{127, 3000}));
  EXPECT_EQ(parse_dpi("600,300")[1], (Pitch{127, 1500}));
  EXPECT_FALSE(parse_dpi("600")[2]);
  EXPECT_EQ(parse_layer_height("0.014"), (Pitch{7, 500}));
  for (const char* wrong : {"", "0", "-1", "1,2", "1,2,3,4", "1,,2", "1 mm"})
    EXPECT_THROW(parse_voxel(wrong), options::WrongValue) << wrong;
  EXPECT_THROW(parse_dpi("1,2,3,4"), options::WrongValue);
}

TEST(Arguments, MemoryHasUnits) {
  EXPECT_EQ(parse_memory("2G"), size_t{2} << 30);
  EXPECT_EQ(parse_memory("512 MiB"), size_t{512} << 20);
  EXPECT_EQ(parse_memory("1.5gb"), size_t{3} << 29);
  for (const char* wrong : {"", "G", "2X", "1k", "-1G"})
    EXPECT_THROW(parse_memory(wrong), options::WrongValue) << wrong;
}

TEST(ProgressLine, SaysShareRateAndTimeLeft) {
  EXPECT_EQ(progress_text({0.456, 123.4e6, 34}), " 45%  123 M voxels/s  0:34 left");
  EXPECT_EQ(progress_text({1, 0, -1}), "100%");
  EXPECT_EQ(progress_text({0.25, 0, 61, true}), " 25%  checking what is there  1:01 left");
  EXPECT_EQ(progress_text({0.4, 0, 12, false, "supports"}), " 40%  supports  0:12 left");
  EXPECT_EQ(progress_bar({0.5, 0, -1}), "[===============>              ]  50%");
  EXPECT_EQ(jobs::duration_text(3723.4), "1:02:03");
  EXPECT_EQ(jobs::rate_text(2.5e9), "2.5 G voxels/s");
  EXPECT_EQ(format_bytes(1536), "1.5 KiB");
}

TEST(SavedJobs, RunAsTheyWouldHave) {
  const TemporaryFolder folder;
  const std::string design = folder.file("part.vcad"), direct = folder.file("direct.off"),
                    made = folder.file("made.off"), job = folder.file("part.json");
  exporting::write_file(design, "sphere(5, red);\n");
  const std::vector<const char*> options{"mesh", design.c_str(), "--tolerance", "0.1", "--keep-all", "-o"};
  const auto with = [&](std::vector<const char*> more) {
    more.insert(more.begin(), options.begin(), options.end());
    return more;
  };
  EXPECT_EQ(run_with(with({direct.c_str()})).code, jobs::done);
  EXPECT_EQ(run_with(with({made.c_str(), "--save-job", job.c_str()})).code, jobs::done);
  EXPECT_FALSE(std::filesystem::exists(made));
  EXPECT_EQ(run_with({"job", job.c_str()}).code, jobs::done);
  EXPECT_EQ(formats::read_file(made), formats::read_file(direct));
  EXPECT_NE(run_with(with({made.c_str(), "--save-job", job.c_str()})).err.find("exists already"), std::string::npos);
}

TEST(SavedJobs, SayWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string job = folder.file("job.json");
  const auto wrong = [&](const std::string& text, const std::string& part) {
    exporting::write_file(job, text);
    expect_wrong({"job", job.c_str()}, part);
  };
  const std::string begin = R"({"format": "ombre job, version 1", )";
  wrong("{}", "this is no job");
  wrong("[1", "job.json:1:");
  wrong(begin + R"("kind": "mehs", "options": {}})", "did you mean \"mesh\"?");
  wrong(begin + R"("options": {}})", R"(a job needs "kind"; write for example "kind": "mesh")");
  wrong(begin + R"("kind": "mesh"})", R"(a job needs "options"; write for example "options": {"design": "part.vcad"})");
  wrong(begin + R"("kind": "mesh", "options": ["a.vcad"]})",
        "expected options by their names, in braces, not a list of 1");
  wrong(begin + R"("kind": "mesh", "option": {"design": "a.vcad"}})",
        R"(a job has no "option"; did you mean "options"?)");
  wrong(begin + R"("kind": "mesh", "options": {"design": "a.vcad", "tolerence": "1"}})", "did you mean \"tolerance\"?");
  wrong(begin + R"("kind": "mesh", "options": {"tolerance": 1}})", "\"design\" is required");
}

}  // namespace ombre::cli

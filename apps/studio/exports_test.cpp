// Tests of jobs: their folders, their options, and how they are resumed.
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "base/system/not_copied.h"
#include "base/text/json.h"
#include "formats/containers/zip_archive.h"
#include "formats/images/png.h"
#include "studio/job_choices.h"
#include "studio/test_studio.h"

namespace ombre::studio {
namespace {

// A job that takes some seconds.
constexpr const char* gyroid =
    "gyroid_block(20);\nmodule gyroid_block(s) intersection() { rectprism((s, s, s)); "
    "function(\"sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x)\", red); }";

// Limits the size of files that this process writes, like a full disk.
class FullDisk : NotCopied {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &usual_);
    const rlimit few{bytes, usual_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &few);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &usual_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit usual_{};
  void (*handler_)(int);
};

TEST_F(StudioTest, JobsCoverTheDesignOrTheTray) {
  const std::string job = R"("design": ")" + load(ball) + R"(", "printer": "j750", )";
  const Data middle = ask("plan", job + R"("place": "center")").first;
  // The tray is 490 x 390 mm at 600 and 300 dpi; there are no layers above the ball.
  EXPECT_EQ(*middle.find("count"), Data(DataList{number(11575), number(4606), number(223)}));
  EXPECT_NEAR(*middle.find("origin_mm")->list()->front().number(), -245, 0.05);
  // The ball extends beyond the tray's corner.
  EXPECT_EQ(text(ask("plan", job + R"("tray": true)").first, "error"), "design");
  EXPECT_EQ(*ask("plan", job + R"("place": "design")").first.find("count")->list()->front().number(), 142);
  EXPECT_EQ(text(ask("plan", job + R"("place": "moon")").first, "error"), "request");
}

TEST_F(StudioTest, JobsTakeTheOptionsOfTheCommandLine) {
  const std::string job = R"("design": ")" + load("attribute(\"heat\", \"x\") rectprism((2, 2, 2), red);") + R"(", )";
  const auto plan = [&](const std::string& more) { return ask("plan", job + more).first; };
  const auto job_of = [&](const std::string& more) {
    Diagnostics none;
    const Data planned = plan(more);
    EXPECT_FALSE(planned.find("error")) << print_json(planned);
    return *parse_json(make_source("job.json", text(planned, "job")), none);
  };
  EXPECT_EQ(text(*job_of(R"("seed": 7)").find("sampling"), "seed"), "7");
  EXPECT_EQ(text(*job_of(R"("dither": "threshold", "evaluator": "reference")").find("sampling"), "dither"),
            "threshold");
  EXPECT_EQ(*plan(R"("voxel": [0.5, 0.25, 0.2])").find("count"), Data(DataList{number(4), number(8), number(10)}));
  EXPECT_EQ(*plan(R"("dpi": "254", "layer-height": 0.5)").find("count"),
            Data(DataList{number(20), number(20), number(4)}));
  // A level also makes the chosen voxels longer.
  EXPECT_EQ(*plan(R"("voxel": [0.5, 0.25, 0.2], "level": 1)").find("count"),
            Data(DataList{number(2), number(4), number(10)}));
  const Data channel = job_of(R"("by": "heat", "range": [-1, 1], "bits": "16")").find("channels")->list()->front();
  EXPECT_EQ(text(channel, "type"), "dose16");
  EXPECT_EQ(*channel.find("range"), Data(DataList{-1.0, 1.0}));
  // Null, empty texts and false count as not given.
  EXPECT_EQ(text(plan(R"("printer": "", "place": null, "tray": false)"), "job"),
            text(plan(R"("lane": "plan")"), "job"));

  const auto message = [&](const std::string& more) {
    const Data refused = plan(more);
    EXPECT_EQ(text(refused, "error"), "request") << print_json(refused);
    return text(refused, "message");
  };
  const std::string unknown = message(R"("ditter": "threshold")");
  EXPECT_NE(unknown.find("did you mean \"dither\"?"), std::string::npos) << unknown;
  for (const options::Option& option : JobChoices::options().options())
    EXPECT_NE(unknown.find(option.name().substr(2)), std::string::npos) << unknown;
  EXPECT_NE(message(R"("folder": "x")").find("no option \"folder\""), std::string::npos);  // plans have no such option
  EXPECT_EQ(message(R"("bits": "16")"), "\"bits\" needs \"by\"");
  EXPECT_EQ(message(R"("tray": true, "place": "center")"), "\"tray\" and \"place\" exclude each other: leave one out");
  EXPECT_NE(message(R"("dither": "random")").find("stochastic"), std::string::npos);
  EXPECT_FALSE(message(R"("voxel": "wide")").empty());
  EXPECT_FALSE(message(R"("tray": "yes")").empty());
}

// A tile of a job in shades has the same shades as its file.
TEST_F(StudioTest, TilesOfShadesAreTheJobsPixels) {
  const std::string job = R"("design": ")" + load("attribute(\"heat\", \"x\") rectprism((2, 2, 2), red);") +
                          R"(", "voxel": 0.25, "by": "heat")";
  ASSERT_FALSE(ask("export", job + R"(, "folder": "shades")").first.find("error"));
  const Data done = job_in("done");
  ASSERT_FALSE(done.is_null());
  EXPECT_EQ(text(*done.find("options"), "by"), "heat");
  const auto written = formats::decode_png(folder.read("shades/slice_00004.png"), "layer");
  const auto tile =
      formats::decode_png(ask("tile", job + R"(, "layer": 4, "x": 0, "y": 0, "width": 8, "height": 8)").second, "tile");
  for (uint32_t row = 0; row < 8; ++row)
    for (uint32_t column = 0; column < 8; ++column)
      ASSERT_EQ(tile.colour(column, row), written.colour(column, row)) << column << ' ' << row;
  EXPECT_NE(tile.colour(0, 4), tile.colour(7, 4));
}

TEST_F(StudioTest, EstimatesWhatAJobTakes) {
  const std::string job = R"("printer": "j750", "design": ")" + load(ball) + '"';
  const Data estimate = ask("estimate", job).first;
  ASSERT_FALSE(estimate.find("error")) << print_json(estimate);
  ask("export", job + R"(, "folder": "a_slices")");
  ASSERT_FALSE(job_in("done").is_null());
  double bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path / "a_slices"))
    if (file.path().extension() == ".png") bytes += static_cast<double>(file.file_size());
  EXPECT_EQ(*estimate.find("is_least"), Data(false));
  EXPECT_GT(number_in(estimate, "bytes"), 0.5 * bytes);
  EXPECT_LT(number_in(estimate, "bytes"), 2 * bytes);
  EXPECT_GT(number_in(estimate, "seconds"), 0);
  EXPECT_GT(number_in(estimate, "memory_bytes"), 0);
  EXPECT_GT(number_in(estimate, "free_bytes"), 0);
}

TEST_F(StudioTest, JobsPauseAndGoOn) {
  const std::string job = R"("printer": "j750", "folder": "a_slices", "design": ")" + load(gyroid) + '"';
  const Data started = ask("export", job).first;
  ASSERT_FALSE(started.find("error")) << text(started, "message");
  const std::string id = std::to_string(static_cast<int>(number_in(*started.find("job"), "id")));
  ASSERT_FALSE(job_in("working").is_null());
  EXPECT_EQ(text(ask("export", job).first, "error"), "busy");
  ask("change_export", R"("to": "pause", "job": )" + id);
  ASSERT_FALSE(job_in("paused").is_null());
  ASSERT_TRUE(std::filesystem::exists(folder.path / "a_slices/job.json"));
  ask("change_export", R"("to": "resume", "job": )" + id);
  const Data done = job_in("done");
  ASSERT_FALSE(done.is_null());
  EXPECT_EQ(number_in(done, "layers"), std::ceil(20 / 0.027 - 1e-6));
  EXPECT_EQ(text(ask("change_export", R"("to": "pause", "job": )" + id).first, "error"), "state");
  EXPECT_EQ(text(ask("change_export", R"("to": "pause", "job": 77)").first, "error"), "gone");
  EXPECT_EQ(text(ask("export", R"("printer": "j750", "folder": "../x", "design": ")" + load("sphere(1);") + '"').first,
                 "error"),
            "name");
}

TEST_F(StudioTest, JobsGoOnWhenAFullDiskHasSpaceAgain) {
  const std::string job = R"("printer": "j750", "folder": "a_slices", "design": ")" + load(gyroid) + '"';
  const Data started = ask("export", job).first;
  const std::string id = std::to_string(static_cast<int>(number_in(*started.find("job"), "id")));
  ASSERT_FALSE(job_in("working").is_null());
  ask("change_export", R"("to": "pause", "job": )" + id);
  ASSERT_FALSE(job_in("paused").is_null());
  const std::filesystem::path last = folder.path / "a_slices/slice_00740.png";
  ASSERT_FALSE(std::filesystem::exists(last));
  {
    const FullDisk full(1000);
    ask("change_export", R"("to": "resume", "job": )" + id);
    const Data failed = job_in("failed");
    ASSERT_FALSE(failed.is_null());
    EXPECT_NE(text(failed, "message").find("cannot write"), std::string::npos) << text(failed, "message");
    EXPECT_FALSE(std::filesystem::exists(last));
  }
  ask("change_export", R"("to": "resume", "job": )" + id);
  ASSERT_FALSE(job_in("done").is_null());
  EXPECT_TRUE(std::filesystem::exists(last));
  for (const auto& file : std::filesystem::directory_iterator(folder.path / "a_slices"))
    EXPECT_NE(file.path().extension(), ".part") << file.path();
}

// A studio that ends, and another one that begins the next day with the same state.
class KeptJobs : public testing::Test {
 protected:
  struct Day {
    Day(const std::filesystem::path& folder, const std::filesystem::path& state)
        : studio(folder, {"ombre test", {}, "", 60, nullptr, state}, cache) {
      studio.add(client);
    }
    Data ask(const std::string& what, const std::string& members = "") {
      const double id = ++last;
      studio.take(client, R"({"id": )" + std::to_string(last) + R"(, "do": ")" + what + '"' +
                              (members.empty() ? "" : ", " + members) + "}");
      return client->wait([&](const Data& data) { return data.find("id") && *data.find("id")->number() == id; }).first;
    }
    Data job_in(const std::string& wanted) {
      return client
          ->wait([&](const Data& data) {
            const Data* job = data.find("job");
            return data.find("event") && job && *job->find("state")->string() == wanted;
          })
          .first;
    }
    sources::SourceCache cache;
    Studio studio;
    std::shared_ptr<Listener> client = std::make_shared<Listener>();
    int last = 0;
  };
  static std::string id_of(const Data& job) { return std::to_string(static_cast<int>(*job.find("id")->number())); }
  TestFolder folder;
  std::filesystem::path state = folder.path / ".state";
};

TEST_F(KeptJobs, GoOnTheNextDay) {
  const std::string script = "size = 5;\n" + std::string(gyroid);
  folder.write("a.vcad", script);
  {
    Day first(folder.path, state);
    const Data loaded =
        first.ask("load", R"("file": "a.vcad", "definitions": ["size=20"], "rotate": [0, 0, 90], "text": )" +
                              print_json_line(script));
    const std::string design = *loaded.find("design")->string();
    first.ask("export", R"("printer": "j750", "folder": "a_slices", "file": "a.vcad", "design": ")" + design + '"');
    ASSERT_FALSE(first.job_in("working").is_null());
    first.ask("run", R"("kind": "mesh", "file": "a.vcad", "options": {"output": "a.stl"}, "design": ")" + design + '"');
  }
  Day next(folder.path, state);
  const Data jobs = *next.ask("jobs").find("jobs");
  ASSERT_EQ(jobs.list()->size(), 2U);
  const Data slices = jobs.list()->front();
  EXPECT_EQ(*slices.find("state"), Data("interrupted"));
  EXPECT_EQ(*slices.find("folder"), Data("a_slices"));
  EXPECT_EQ(*slices.find("definitions"), Data(DataList{"size=20"}));
  const Data& spec = *slices.find("spec");  // as --save-job writes it
  EXPECT_EQ(*spec.find("kind"), Data("slice"));
  EXPECT_EQ(*spec.find("options")->find("output"), Data((folder.path / "a_slices").string()));
  EXPECT_EQ(*spec.find("options")->find("printer"), Data("j750"));
  ASSERT_FALSE(next.ask("change_export", R"("to": "resume", "job": )" + id_of(slices)).find("error"));
  const Data done = next.job_in("done");
  ASSERT_FALSE(done.is_null());
  EXPECT_EQ(*done.find("job")->find("layers")->number(), std::ceil(20 / 0.027 - 1e-6));
  // The other one was waiting, and is given up.
  ASSERT_FALSE(next.ask("change_export", R"("to": "cancel", "job": )" + id_of(jobs.list()->back())).find("error"));
}

TEST_F(KeptJobs, AreThoseOfOneStudioAtATime) {
  Day first(folder.path, state);
  folder.write(".state/jobs.json", R"({"jobs": [{"folder": "a_slices", "state": "working"}]})");
  Day second(folder.path, state);
  EXPECT_TRUE(second.ask("jobs").find("jobs")->list()->empty());
}

TEST_F(KeptJobs, BadListsDoNoHarm) {
  for (const char* text :
       {"", "{", R"({"jobs": 3})", R"({"jobs": [3, {}, {"folder": 3}, {"folder": "x", "state": 7}]})"}) {
    folder.write(".state/jobs.json", text);
    Day day(folder.path, state);
    const Data jobs = *day.ask("jobs").find("jobs");
    for (const Data& job : *jobs.list())
      EXPECT_TRUE(day.ask("change_export", R"("to": "resume", "job": )" + id_of(job)).find("error"));
  }
}

TEST_F(KeptJobs, DraftsComeBackToo) {
  folder.write("a.vcad", "cube(1);");
  {
    Day first(folder.path, state);
    first.ask("keep_draft", R"("file": "a.vcad", "text": "cube(2);", "version": "v")");
    first.ask("keep_draft", R"("file": "untitled.vcad", "text": "cube(3);")");
    EXPECT_EQ(*first.ask("keep_draft", R"("file": "../a.vcad", "text": "")").find("error"), Data("name"));
  }
  Day next(folder.path, state);
  EXPECT_EQ(*next.ask("hello").find("drafts"), Data(DataList{"untitled.vcad", "a.vcad"}));
  const Data opened = next.ask("open", R"("file": "a.vcad")");
  EXPECT_EQ(*opened.find("text"), Data("cube(1);"));
  EXPECT_EQ(*opened.find("draft")->find("text"), Data("cube(2);"));
  EXPECT_EQ(*opened.find("draft")->find("version"), Data("v"));
  EXPECT_EQ(*next.ask("open", R"("file": "untitled.vcad")").find("draft")->find("text"), Data("cube(3);"));
  next.ask("save", R"("file": "a.vcad", "text": "cube(2);", "version": )" + print_json_line(*opened.find("version")));
  next.ask("drop_draft", R"("file": "untitled.vcad")");
  EXPECT_TRUE(next.ask("hello").find("drafts")->list()->empty());
}

TEST_F(StudioTest, JobsForDownloadsLeaveNothingInTheFolder) {
  const std::string design = load(ball);
  ask("run", R"("kind": "mesh", "file": "a.vcad", "download": true, "options": {"output": "a.stl"}, "design": ")" +
                 design + '"');
  const Data done = job_in("done");
  ASSERT_FALSE(done.is_null());
  EXPECT_EQ(*done.find("is_download"), Data(true));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "a.stl"));
  const std::string id = std::to_string(static_cast<int>(number_in(done, "id")));
  const Data address = ask("download", R"("job": )" + id).first;
  EXPECT_EQ(text(address, "name"), "a.stl");
  const auto file = studio.take_download(text(address, "address").substr(std::string("/download/").size()));
  ASSERT_TRUE(file);
  EXPECT_GT(std::filesystem::file_size(file->path), 1000U);
}

TEST_F(StudioTest, JobFoldersArePacked) {
  if (!formats::can_write_zip()) GTEST_SKIP();
  ask("export", R"("printer": "j750", "folder": "a_slices", "design": ")" + load("rectprism((2, 2, 2), red);") + '"');
  const Data done = job_in("done");
  ASSERT_FALSE(done.is_null());
  const Data packed = ask("zip", R"("job": )" + std::to_string(static_cast<int>(number_in(done, "id")))).first;
  EXPECT_EQ(text(packed, "name"), "a_slices.zip");
  EXPECT_TRUE(studio.take_download(text(packed, "address").substr(std::string("/download/").size())));
  EXPECT_EQ(text(ask("zip", R"("folder": "../x")").first, "error"), "name");
}

}  // namespace
}  // namespace ombre::studio

// Jobs: where they lie, what they take, and how they go on.
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "base/json.h"
#include "studio/test_studio.h"

namespace ombre::studio {
namespace {

// A job of some seconds.
constexpr const char* gyroid =
    "gyroid_block(20);\nmodule gyroid_block(s) intersection() { rectprism((s, s, s)); "
    "function(\"sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x)\", red); }";

// Files of this process end after so many bytes, as on a disk without space.
class FullDisk {
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
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit usual_{};
  void (*handler_)(int);
};

TEST_F(StudioTest, JobsCoverTheDesignOrTheTray) {
  const std::string job = R"("design": ")" + load(ball) + R"(", "printer": "j750", "place": )";
  const Data middle = ask("plan", job + R"("center")").first;
  // 490 x 390 mm, at 600 and 300 dpi; above the ball are no layers.
  EXPECT_EQ(*middle.find("count"), Data(DataList{number(11575), number(4606), number(223)}));
  EXPECT_NEAR(*middle.find("origin_mm")->list()->front().number(), -245, 0.05);
  // The ball stands around the tray's corner.
  EXPECT_EQ(text(ask("plan", job + R"("tray")").first, "error"), "design");
  EXPECT_EQ(*ask("plan", job + R"("design")").first.find("count")->list()->front().number(), 142);
  EXPECT_EQ(text(ask("plan", job + R"("moon")").first, "error"), "request");
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

}  // namespace
}  // namespace ombre::studio

// Tests what an edit computes again, and what it does not.
#include "load/sub_design_cache.h"

#include "jobs/picture/picture.h"
#include "jobs/test_designs.h"

namespace ombre::compile {
namespace {

// Draws pictures of one design after the other, as they come from edits.
class Edits : public testing::Test {
 protected:
  std::vector<uint8_t> picture(const std::string& text, design::SubDesignMemory* memory, double azimuth = 30) {
    Diagnostics diagnostics;
    const LoadedPtr loaded = load_text(text, diagnostics);
    EXPECT_TRUE(loaded) << to_text(diagnostics);
    PictureRequest request;
    request.width = 60;
    request.height = 45;
    request.samples = 1;
    request.view.azimuth_deg = azimuth;
    request.view.height_mm = 60;  // keeps the pixels as they are
    request.view.target = Vec3{0, 0, 0};
    request.memory = memory;
    std::vector<uint8_t> pixels;
    const auto take = [&](int, const Picture& made) { pixels = made.rgba; };
    EXPECT_TRUE(take_pictures(*loaded, request, StopFlag(), take, diagnostics)) << to_text(diagnostics);
    return pixels;
  }
  // Returns the number of results that a picture computes since they are not kept yet.
  size_t made_by(const std::string& text, double azimuth = 30) {
    const size_t before = memory.counts().made;
    picture(text, &memory, azimuth);
    return memory.counts().made - before;
  }

  sources::SourceCache cache;
  SubDesignCache memory{cache};
};

// Number of results for the ends of rays, which are new if the shape or the camera has changed.
constexpr size_t the_rays = 1;

std::string balls_and_block(int size, const std::string& material) {
  return "union() { translate(-20, 0, 0) union() for (i = [0:63]) translate(0, 0.5 * i - 16, 0) sphere(1 + 0.01 * i, " +
         material + "); translate(12, 0, 0) cylinder(radius=" + std::to_string(size) + ", height=9, \"blue\"); }";
}

// Returns a stage of a ball of a material, beside another ball.
std::string with_stage(const std::string& stage, double radius, const std::string& material, double beside) {
  return "union() { " + stage + " material(\"" + material + "\") sphere(" + std::to_string(radius) +
         "); translate(15, 0, 0) sphere(" + std::to_string(beside) + ", \"red\"); }";
}

}  // namespace

TEST_F(Edits, LeaveTablesOfOtherPartsAsTheyAre) {
  const size_t tables = made_by(balls_and_block(6, "\"red\""));
  EXPECT_GT(tables, the_rays);
  EXPECT_EQ(made_by(balls_and_block(7, "\"red\"")), the_rays);
  EXPECT_EQ(made_by(balls_and_block(7, "\"red\""), 75), the_rays) << "another camera sees the same tables";
  EXPECT_GT(made_by(balls_and_block(7, "\"cyan\"")), the_rays) << "what the tables hold has changed";
}

TEST_F(Edits, ShowWhatIsThereNow) {
  picture(balls_and_block(6, "\"red\""), &memory);
  for (const std::string& text : {balls_and_block(7, "\"red\""), balls_and_block(7, "\"cyan\"")}) {
    const std::vector<uint8_t> kept = picture(text, &memory), fresh = picture(text, nullptr);
    size_t different = 0;
    for (size_t n = 0; n < fresh.size(); ++n) different += std::abs(int{kept[n]} - int{fresh[n]}) > 2;
    EXPECT_LT(different, fresh.size() / 200) << text;  // rounding may decide if a ray grazes an edge
  }
}

TEST_F(Edits, LeaveStagesOfOtherPartsAsTheyAre) {
  for (const std::string stage : {"keep_parts(pitch=(1, 1, 1))", "dilate(2, pitch=(1, 1, 1))"}) {
    EXPECT_GT(made_by(with_stage(stage, 6, "red", 3)), the_rays) << stage;
    EXPECT_EQ(made_by(with_stage(stage, 6, "red", 4)), the_rays) << stage;
    EXPECT_EQ(made_by(with_stage(stage, 6, "blue", 4)), the_rays) << stage << ": a material is no shape";
    EXPECT_GT(made_by(with_stage(stage, 7, "blue", 4)), the_rays) << stage;
  }
}

TEST_F(Edits, GiveThePicturesThatStagesGiveAnew) {
  for (const std::string stage : {"keep_parts(pitch=(1, 1, 1))", "dilate(2, pitch=(1, 1, 1))"}) {
    picture(with_stage(stage, 6, "red", 3), &memory);
    EXPECT_EQ(picture(with_stage(stage, 6, "blue", 4), &memory), picture(with_stage(stage, 6, "blue", 4), nullptr));
    EXPECT_EQ(picture(with_stage(stage, 7, "blue", 4), &memory), picture(with_stage(stage, 7, "blue", 4), nullptr));
  }
}

TEST_F(Edits, ForgetWhatTheCacheHasNoRoomFor) {
  cache.set_most_bytes(0);
  EXPECT_GT(made_by(with_stage("keep_parts(pitch=(1, 1, 1))", 6, "red", 3)), 0u);
  EXPECT_GT(made_by(with_stage("keep_parts(pitch=(1, 1, 1))", 6, "red", 4)), 0u);
}

}  // namespace ombre::compile

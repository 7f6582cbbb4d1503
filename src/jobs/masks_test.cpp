#include "jobs/test_slices.h"

#include "export/output_file.h"
#include "jobs/stacks/job_sheet.h"

namespace ombre::compile {

TEST_F(Slice, MasksShowEachMaterialInAFileOfItsOwn) {
  const SliceRequest request = mask_request();
  EXPECT_EQ(request.files.text(), "slice_{index:05}_{material}.png");
  const SliceReport report = run(request, options());
  EXPECT_EQ(report.layers_written, 40);
  const Contents all = contents(folder());
  EXPECT_EQ(all.size(), 80U + 2);
  for (int64_t k = 0; k < 40; ++k) {
    const std::array<uint64_t, 256> counts = count_materials(ball_layer(request, k, false).materials());
    for (const SliceMaterial& material : request.materials) {
      const std::string name = request.files.of_material(material.name).name(k);
      const formats::PngImage image = formats::decode_png(all.at(name), name);
      EXPECT_EQ(image.bit_depth, 1);
      uint64_t white = 0;
      for (uint32_t row = 0; row < image.height; ++row)
        for (uint32_t column = 0; column < image.width; ++column) white += image.colour(column, row)[0] == 255 ? 1 : 0;
      EXPECT_EQ(white, counts[material.id]) << name;
    }
  }
  const Data job = job_json(folder());
  EXPECT_EQ(*job.find("totals")->find("files"), Data(80.0));
}

TEST_F(Slice, MasksOfEmptyLayersCanBeDropped) {
  SliceRequest request = mask_request();
  request.drop_empty_layers = true;
  EXPECT_EQ(run(request, options()).layers_dropped, 6);
  EXPECT_EQ(contents(folder()).size(), 2 * 34U + 2);
  EXPECT_FALSE(fs::exists(folder() + "/slice_00000_red.png"));
  EXPECT_EQ(run(request, options(FolderUse::resume)).layers_kept, 40);
}

TEST_F(Slice, LayersThatLackAFileAreRedone) {
  const SliceRequest request = mask_request();
  const Contents reference = expected(request, root_);
  run(request, options());
  fs::remove(folder() + "/slice_00011_blue.png");
  write(folder() + "/slice_00020_red.png", "damaged");
  write(folder() + "/slice_00030_red.png.part", "half");
  EXPECT_EQ(run(request, options(FolderUse::resume)).layers_written, 2);
  expect_same(reference, contents(folder()));
  // The run ended between the two files of a layer, so no line of the journal names them.
  const std::string& journal = reference.at("journal.jsonl");
  write(folder() + "/journal.jsonl", journal.substr(0, journal.find("\n", journal.size() / 2) + 1));
  run(request, options(FolderUse::resume));
  expect_same(reference, contents(folder()));
}

TEST_F(Slice, ForceReplacesMasks) {
  run(mask_request(), options());
  write(folder() + "/slice_00003_green.png", "mine, no material has this name");
  run(ball_request(), options(FolderUse::replace));
  Contents reference = expected(ball_request(), root_);
  reference["slice_00003_green.png"] = "mine, no material has this name";
  expect_same(reference, contents(folder()));
  write(folder() + "/slice_00003_red.png", "mine as well");
  expect_error([&] { run(mask_request(), options(FolderUse::replace)); }, "slice_00003_red.png");
}

TEST_F(Slice, ContactSheetsOfMasksHaveTheColoursOfMaterials) {
  run(mask_request(), options());
  const std::string sheet = folder("sheet.png");
  exporting::write_file(sheet, contact_sheet(folder(), 1));
  const formats::PngImage image = formats::decode_png(formats::read_file(sheet), sheet);
  uint64_t red = 0, blue = 0, white = 0;
  for (uint32_t row = 0; row < image.height; ++row)
    for (uint32_t column = 0; column < image.width; ++column) {
      const formats::Rgba colour = image.colour(column, row);
      red += colour == formats::Rgba{255, 0, 0, 255} ? 1 : 0;
      blue += colour == formats::Rgba{0, 0, 255, 255} ? 1 : 0;
      white += colour == formats::Rgba{255, 255, 255, 255} ? 1 : 0;
    }
  EXPECT_GT(red, 10000U);
  EXPECT_GT(blue, 10000U);
  EXPECT_EQ(white, 0U);
}

}  // namespace ombre::compile

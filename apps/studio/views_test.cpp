// Tests pictures, tiles, probes and volumes of a design.
#include <map>

#include "base/text/json.h"
#include "formats/images/png.h"
#include "studio/test_studio.h"

namespace ombre::studio {
namespace {

// Tiles and probes show what the job writes.

TEST_F(StudioTest, PicturesStayWhereTheirCameraIs) {
  const std::string design = load("sphere(1, red);");
  const auto picture = [&](const std::string& target) {
    return ask("render", R"("design": ")" + design + R"(", "width": 40, "height": 40, "azimuth": 0, "elevation": 0, )" +
                             R"("height_mm": 8, "target": )" + target);
  };
  // The ball has ten pixels in the middle; the other place is 10 pixels to its left.
  const auto middle = formats::decode_png(picture("[0, 0, 0]").second, "middle");
  EXPECT_EQ(middle.colour(20, 20)[3], 255);
  EXPECT_EQ(middle.colour(20, 13)[3], 0);
  EXPECT_EQ(middle.colour(13, 20)[3], 0);
  const auto left = formats::decode_png(picture("[2, 0, 0]").second, "left");
  EXPECT_EQ(left.colour(10, 20)[3], 255);
  EXPECT_EQ(left.colour(20, 20)[3], 0);
  EXPECT_EQ(text(ask("render", R"("design": ")" + design + R"(", "width": 40, "height": 40, "cuts": ["q=1"])").first,
                 "error"),
            "request");
}

TEST_F(StudioTest, PicturesAreCutByWedgesAndBoxes) {
  const std::string design = load("sphere(1, red);");
  const auto alpha = [&](const std::string& how, uint32_t column, uint32_t row) {
    const std::string request = R"("design": ")" + design + R"(", "width": 40, "height": 40, "azimuth": 0, )" +
                                R"("elevation": 0, "height_mm": 2.4, "target": [0, 0, 0], )" + how;
    return static_cast<int>(formats::decode_png(ask("render", request).second, "cut").colour(column, row)[3]);
  };
  const std::string quarter = R"("cuts": ["x>0,z>0"])", box = R"("box": [-1, -1, -1, 0, 1, 0])";
  EXPECT_EQ(alpha(quarter, 27, 12), 0);
  EXPECT_EQ(alpha(quarter, 12, 12), 255);
  EXPECT_EQ(alpha(quarter, 27, 27), 255);
  EXPECT_EQ(alpha(box, 12, 27), 255);
  EXPECT_EQ(alpha(box, 27, 27), 0);
  EXPECT_EQ(alpha(box, 12, 12), 0);
  const std::string wrong = R"("design": ")" + design + R"(", "width": 40, "height": 40, "box": [0, 0, 0, 1, 1, -1])";
  EXPECT_EQ(text(ask("render", wrong).first, "error"), "request");
}

// From the front, x is to the right and z downward; the front of the box is at y = -5.
TEST_F(StudioTest, FindsThePointUnderAPixel) {
  const std::string design = load("translate(2, 0, 1) cube(10, red);\n");
  const std::string view = R"("width": 40, "height": 20, "azimuth": 0, "elevation": 0, "target": [2, 0, 1], )"
                           R"("height_mm": 20, "design": ")" +
                           design + '"';
  const Data found = ask("seen_at", view + R"(, "pixel": [22, 7])").first;  // 1 mm for each pixel
  const auto at = [&](size_t n) { return *(*found.find("at")->list())[n].number(); };
  EXPECT_NEAR(at(0), 2 + 2.5, 1e-3);
  EXPECT_NEAR(at(1), -5, 0.02);
  EXPECT_NEAR(at(2), 1 + 2.5, 1e-3);
  EXPECT_TRUE(ask("seen_at", view + R"(, "pixel": [2, 7])").first.find("at")->is_null());
  EXPECT_EQ(text(ask("seen_at", view + R"(, "pixel": [40, 7])").first, "error"), "request");
  EXPECT_EQ(text(ask("seen_at", view).first, "error"), "request");
}

// A face in the middle of a cube of 10 x 10 x 10 voxels, of which each has 4 x 4 pixels.
TEST_F(StudioTest, FacesOfCutsShowTheVoxelsOfTheJob) {
  const std::string design = R"("design": ")" + load("cube(4, mix(red, blue, 0.5));") + '"';
  const std::string job = R"("voxel": [0.4, 0.4, 0.4])";
  const std::string view = design + R"(, "width": 40, "height": 40, "azimuth": 0, "elevation": 0, "target": [0, 0, 0])";
  const auto is_red = [](const auto& colour) { return colour[0] > colour[2]; };
  for (const std::string cut : {R"("cuts": ["y<0"])", R"("cuts": ["y<0,x<9"])", R"("box": [-3, 0, -3, 3, 3, 3])"}) {
    const auto seen = formats::decode_png(
        ask("render", view + R"(, "height_mm": 4, )" + cut + R"(, "voxels": {)" + job + "}").second, "face");
    size_t reds = 0;
    for (uint32_t k = 0; k < 10; ++k) {
      const std::string tile =
          design + ", " + job + R"(, "layer": )" + std::to_string(k) + R"(, "x": 0, "y": 5, "width": 10, "height": 1)";
      const auto row = formats::decode_png(ask("tile", tile).second, "row");
      for (uint32_t i = 0; i < 10; ++i) {
        reds += is_red(row.colour(i, 0)) ? 1 : 0;
        for (const uint32_t pixel : {0U, 3U})
          EXPECT_EQ(is_red(seen.colour(4 * i + pixel, 39 - 4 * k - pixel)), is_red(row.colour(i, 0))) << i << ' ' << k;
      }
    }
    EXPECT_GT(reds, 20);
    EXPECT_LT(reds, 80);
  }
  // With a pixel as long as 5 voxels, voxels are 4 times as long along x.
  const auto far = formats::decode_png(
      ask("render", view + R"(, "height_mm": 80, "cuts": ["y<0"], "voxels": {)" + job + "}").second, "far");
  EXPECT_EQ(far.colour(20, 20)[3], 255);
  for (const std::string wrong :
       {R"("voxels": 1, "height_mm": 4)", R"("voxels": {"voxal": 1}, "height_mm": 4)", R"("voxels": {})"})
    EXPECT_EQ(text(ask("render", view + ", " + wrong).first, "error"), "request") << wrong;
}

TEST_F(StudioTest, SaysWhichCallsMadeAPoint) {
  const std::string script =
      "translate(10, 0, 0) union() {\n"
      "  material(red) rotate(0, 0, 90) rectprism((2, 8, 2));\n"  // |x - 10| < 4, |y| < 1
      "  difference() {\n"
      "    sphere(3, blue);\n"
      "    sphere(1, red);\n"
      "  }\n"
      "  array_linear(3, (0, 5, 0)) sphere(1, green);\n"
      "}\n"
      "offset(1) union() { cube(2, red); translate(1, 0, 0) cube(2, red); }\n";
  const std::string design = load(script);
  const auto calls = [&](const std::string& at) {
    const Data probed = ask("probe", R"("at": )" + at + R"(, "design": ")" + design + '"').first;
    std::string path;
    for (const Data& node : *probed.find("nodes")->list()) {
      path += " " + text(node, "type");
      if (!node.find("from")) continue;
      const auto from = static_cast<size_t>(number_in(node, "from"));
      EXPECT_EQ(script.substr(from, text(node, "type").size()), text(node, "type")) << print_json(node);
      path += std::to_string(static_cast<int>(number_in(node, "line")));
    }
    return path;
  };
  EXPECT_EQ(calls("[13.5, 0.5, 0]"), " union translate1 union1 material2 rotate2 rectprism2");
  EXPECT_EQ(calls("[10, 2.5, 0]"), " union translate1 union1 difference3 sphere4");
  EXPECT_EQ(calls("[10, 10.5, 0]"), " union translate1 union1 array_linear7 sphere7");
  EXPECT_EQ(calls("[-1.5, 0, 0]"), " union offset9");
  EXPECT_EQ(calls("[30, 0, 0]"), "");
}

TEST_F(StudioTest, TilesAndProbesAreTheJobsPixels) {
  const std::string design = load(ball), job = R"("design": ")" + design + R"(", "printer": "j750")";
  const Data plan = ask("plan", job).first;
  const auto count = [&](size_t axis) { return static_cast<int64_t>(*plan.find("count")->list()->at(axis).number()); };
  const auto mm = [&](const char* what, size_t axis) { return *plan.find(what)->list()->at(axis).number(); };
  ASSERT_EQ(count(0), 142);  // 6 mm at 600 dpi
  ASSERT_EQ(count(1), 71);
  const int64_t layer = count(2) / 2;
  ASSERT_FALSE(ask("export", job + R"(, "folder": "a_slices")").first.find("error"));
  ASSERT_FALSE(job_in("done").is_null());
  const std::string number = std::to_string(layer);
  const auto written = formats::decode_png(
      folder.read("a_slices/slice_" + std::string(5 - number.size(), '0') + number + ".png"), "layer");
  const auto tile = formats::decode_png(
      ask("tile", job + R"(, "layer": )" + number + R"(, "x": 32, "y": 8, "width": 64, "height": 48)").second, "tile");
  ASSERT_EQ(tile.width, 64U);
  ASSERT_EQ(tile.height, 48U);
  for (uint32_t row = 0; row < 48; ++row)
    for (uint32_t column = 0; column < 64; ++column) {
      const auto y = static_cast<uint32_t>(count(1)) - (8 + 48) + row;  // counted from the top
      ASSERT_EQ(tile.colour(column, row), written.colour(32 + column, y)) << column << ' ' << row;
    }

  const std::map<std::string, formats::Rgba> colours{
      {"red", {255, 0, 0, 255}}, {"blue", {0, 80, 255, 255}}, {"void", {0, 0, 0, 0}}};
  for (int64_t n = 0; n < 20; ++n) {
    const int64_t i = (37 * n) % count(0), j = (29 * n) % count(1);
    const auto at = [&](size_t axis, int64_t index) {
      return std::to_string(mm("origin_mm", axis) + mm("pitch_mm", axis) * (static_cast<double>(index) + 0.5));
    };
    const Data probed = ask("probe", job + R"(, "at": [)" + at(0, i) + "," + at(1, j) + "," + at(2, layer) + "]").first;
    const Data& voxel = *probed.find("voxel");
    EXPECT_EQ(*voxel.find("index"), Data(DataList{ombre::number(i), ombre::number(j), ombre::number(layer)}));
    EXPECT_EQ(colours.at(text(voxel, "material")),
              written.colour(static_cast<uint32_t>(i), static_cast<uint32_t>(count(1) - 1 - j)));
  }
}

TEST_F(StudioTest, VolumesHoldFractions) {
  const auto [header, bytes] = ask("volume", R"("side": 16, "design": ")" + load("rectprism((4, 4, 4), red);") + '"');
  ASSERT_TRUE(header.find("count")) << print_json(header);
  const DataList& count = *header.find("count")->list();
  const size_t voxels = static_cast<size_t>(*count[0].number() * *count[1].number() * *count[2].number());
  ASSERT_EQ(bytes.size(), 4 * voxels) << print_json(header);
  for (size_t n = 0; n < voxels; ++n) {
    ASSERT_EQ(bytes[4 * n], '\xff');
    ASSERT_EQ(bytes[4 * n + 1], '\0');
  }
}

// An edit does not compute anything that it leaves unchanged.
TEST_F(StudioTest, EditsLeaveStagesOfOthersAsTheyAre) {
  const auto made_by = [&](double radius, double beside, const std::string& material) {
    const size_t before = studio.counts().made;
    const std::string design =
        load("union() { keep_parts(pitch=(0.5, 0.5, 0.5)) material(" + material + ") sphere(" + std::to_string(radius) +
             "); translate(9, 0, 0) sphere(" + std::to_string(beside) + ", red); }");
    const std::string camera = R"("width": 40, "height": 30, "target": [4, 0, 0], "height_mm": 30, "design": ")";
    EXPECT_FALSE(ask("render", camera + design + '"').second.empty());
    EXPECT_TRUE(ask("plan", R"("printer": "j750", "design": ")" + design + '"').first.find("count"));
    return studio.counts().made - before;
  };
  // The picture and the job share one stage; the ends of the picture's rays are kept as well.
  EXPECT_EQ(made_by(3, 2, "red"), 2U);
  EXPECT_EQ(made_by(3, 2.5, "red"), 1U);
  EXPECT_LE(made_by(3, 2.5, "blue"), 1U);
  EXPECT_EQ(made_by(3.25, 2.5, "blue"), 2U);
}

// A change of colours alone uses the known ends of rays, and gives the bytes of a studio with empty caches.
TEST_F(StudioTest, EditsOfColoursFollowNoRays) {
  const std::string camera = R"("width": 90, "height": 60, "samples": 2, "target": [0, 0, 0], "height_mm": 12)";
  const auto script = [](const std::string& from, const std::string& to) {
    return "attribute(\"heat\", \"x\") fgrade([\"0.5 + x / 20\", \"0.5 - x / 20\"], [" + from + ", " + to +
           "]) difference() { sphere(4); translate(2, -3, 1) cube(4); }";
  };
  const std::string red = load(script("red", "blue")), green = load(script("green", "red"));
  const auto render = [&](const std::string& design, const std::string& more) {
    return ask("render", camera + more + R"(, "design": ")" + design + '"').second;
  };
  for (const std::string& more :
       {std::string(), std::string(R"(, "cuts": ["z>1"])"), std::string(R"(, "perspective": 40)")}) {
    const std::string first = render(red, more);
    const auto before = studio.counts();
    const std::string second = render(green, more);
    EXPECT_EQ(studio.counts().made, before.made) << more;
    EXPECT_GT(studio.counts().found, before.found) << more;
    EXPECT_NE(first, second);
    const std::string by_heat = render(green, more + R"(, "by": "heat")");
    EXPECT_EQ(studio.counts().made, before.made) << more;
    FreshStudio fresh;
    const auto same = [&](FreshStudio& by) { return R"(, "design": ")" + by.load(script("green", "red")) + '"'; };
    EXPECT_EQ(fresh.ask("render", camera + more + R"(, "by": "heat")" + same(fresh)).second, by_heat) << more;
    FreshStudio fresher;
    EXPECT_EQ(fresher.ask("render", camera + more + same(fresher)).second, second) << more;
  }
  // Rays that end where they begin, at the face of a block.
  const std::string face = R"(, "azimuth": 0, "elevation": 0)";
  render(load("cube(4, red);"), face);
  const std::string again = render(load("cube(4, green);"), face);
  FreshStudio fresh;
  const std::string block = R"(, "design": ")" + fresh.load("cube(4, green);") + '"';
  EXPECT_EQ(fresh.ask("render", camera + face + block).second, again);
  // Another camera, or translucent materials, need other rays.
  const size_t made = studio.counts().made;
  render(red, R"(, "azimuth": 10)");
  EXPECT_EQ(studio.counts().made, made + 1);
  render(red, R"(, "opacity": {"red": 0.2})");
  EXPECT_EQ(studio.counts().made, made + 1);
}

class ThumbnailTest : public StudioTest {
 protected:
  // Asks for a small picture of what `of` names, such as "node": 1.
  std::pair<Data, std::string> thumbnail(const std::string& design, const std::string& of) {
    return ask("thumbnail", R"("width": 24, "height": 18, "design": ")" + design + R"(", )" + of);
  }

  // Returns the numbers of the values of expressions, by the texts of these in the script.
  static std::map<std::string, std::string> values_in(const Data& loaded, const std::string& script) {
    std::map<std::string, std::string> values;
    for (const Data& one : *loaded.find("made")->list()) {
      if (!one.find("value")) continue;
      const auto from = static_cast<size_t>(number_in(one, "from")), to = static_cast<size_t>(number_in(one, "to"));
      values.emplace(script.substr(from, to - from), print_json_line(*one.find("value")));
    }
    return values;
  }
};

TEST_F(ThumbnailTest, AreMadeOnce) {
  const std::string design = load("union() { sphere(3, red); translate(9, 0, 0) rectprism((4, 4, 4), blue); }");
  const std::string red = thumbnail(design, R"("node": 1)").second;
  ASSERT_FALSE(red.empty());
  const size_t made = studio.counts().made;
  // An edit of the block leaves the ball as it is.
  const std::string edited = load("union() { sphere(3, red); translate(9, 0, 0) rectprism((5, 4, 4), blue); }");
  EXPECT_EQ(thumbnail(edited, R"("node": 1)").second, red);
  EXPECT_EQ(studio.counts().made, made);
  EXPECT_NE(thumbnail(edited, R"("node": 2)").second, thumbnail(design, R"("node": 2)").second);
  EXPECT_GT(studio.counts().made, made);
  EXPECT_EQ(text(thumbnail(design, R"("node": 9)").first, "error"), "request");
}

TEST_F(ThumbnailTest, StatementsThatAreNoNodesShowWhatTheyMake) {
  const std::string script =
      "module pair(r) { sphere(r, red); translate(9, 0, 0) sphere(r, blue); }\n"
      "pair(3);\n"
      "for (i = [0 : 2]) translate(0, 20 * i, 0) pair(2);\n"
      "if (true) cube(1);\n"
      "translate(0, 0, 30) cube(2);\n";
  const Data loaded = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(script)).first;
  ASSERT_TRUE(loaded.find("made")) << print_json(loaded);
  const DataList& nodes = *loaded.find("nodes")->list();
  std::map<size_t, std::string> made, numbers;  // by places in the script
  for (const Data& one : *loaded.find("made")->list()) {
    const auto from = static_cast<size_t>(number_in(one, "from"));
    for (const Data& node : *one.find("nodes")->list())
      made[from] += " " + text(nodes[static_cast<size_t>(*node.number())], "type");
    numbers[from] = print_json_line(*one.find("nodes"));
  }
  EXPECT_EQ(made[script.find("pair(3)")], " sphere translate");
  EXPECT_EQ(made[script.find("for")], " translate translate translate");
  EXPECT_EQ(made[script.find("pair(2)")], " sphere translate");  // in the first turn
  EXPECT_EQ(made[script.find("if")], " cube");
  EXPECT_EQ(made.count(script.find("translate(0, 0, 30)")), 0);
  const Data joined =
      ask("load", R"("file": "b.vcad", "text": )" +
                      print_json_line(std::string("union() { sphere(3, red); translate(9, 0, 0) sphere(3, blue); }")))
          .first;
  const std::string pair = thumbnail(text(loaded, "design"), R"("nodes": )" + numbers[script.find("pair(3)")]).second;
  EXPECT_FALSE(pair.empty());
  EXPECT_EQ(pair, thumbnail(text(joined, "design"), R"("node": 0)").second);
  for (const std::string wrong : {"[]", "1", "[-1]", "[100000]", "[\"x\"]"})
    EXPECT_EQ(text(thumbnail(text(loaded, "design"), R"("nodes": )" + wrong).first, "error"), "request") << wrong;
}

// Pictures of the values of expressions, beside those of nodes that give the same.
TEST_F(ThumbnailTest, ExpressionsShowTheirValues) {
  const std::string script =
      "function wave(k) = sin(k * formula(\"x\"));\n"
      "function both(k) = object(first=wave(k), second=mix(red, blue, wave(k)));\n"
      "a = wave(30);\n"
      "b = wave(30) * 2 + 1;\n"
      "c = both(30);\n"
      "d = 1 + 2;\n"
      "e = [for (k = [10 : 10 : 30]) wave(k)];\n"
      "attribute(\"heat\", wave(60)) rectprism((8, 8, 8), c.second);";
  const Data loaded = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(script)).first;
  ASSERT_TRUE(loaded.find("made")) << print_json(loaded);
  std::map<std::string, std::string> values = values_in(loaded, script);
  for (const char* known : {"wave(30)", "wave(30) * 2 + 1", "both(30)", "wave(60)", "wave(k)"})
    EXPECT_EQ(values.count(known), 1) << known;
  EXPECT_EQ(values.count("1 + 2"), 0);
  const auto of_value = [&](const std::string& number) {
    return thumbnail(text(loaded, "design"), R"("value": )" + number);
  };
  const auto picture = [&](const std::string& expression) {
    const auto [header, bytes] = of_value(values[expression]);
    EXPECT_FALSE(bytes.empty()) << expression << print_json(header);
    return bytes;
  };
  // Colours go from the least to the greatest value, so that a factor above 0 and a sum change nothing.
  EXPECT_EQ(formats::decode_png(picture("wave(30)"), "").pixels,
            formats::decode_png(picture("wave(30) * 2 + 1"), "").pixels);
  EXPECT_NE(picture("wave(30)"), picture("wave(60)"));
  EXPECT_EQ(picture("both(30)"), picture("wave(30)"));  // its first output
  EXPECT_EQ(text(of_value("-1").first, "error"), "request");
  EXPECT_EQ(text(of_value("1000").first, "error"), "request");
}

// A variable, a call and an output may be a solid, which looks as its node does.
TEST_F(ThumbnailTest, ExpressionsShowTheirSolids) {
  const std::string script =
      "function ball(r) = sphere(r, red);\n"
      "one = sphere(3, red);\n"
      "two = ball(3);\n"
      "m = box_cells((4, 4, 4), min=(0, 0, 0), max=(8, 8, 8));\n"
      "region = m.region;\n"
      "copy = sphere(\"1 + 0.2*ci\", red);\n"
      "union() { sphere(3, red); solid_of(one); }";
  const Data loaded = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(script)).first;
  ASSERT_TRUE(loaded.find("made")) << print_json(loaded);
  std::map<std::string, std::string> pictures, errors;  // by the texts of expressions
  for (const auto& [expression, number] : values_in(loaded, script)) {
    const auto [header, bytes] = thumbnail(text(loaded, "design"), R"("value": )" + number);
    pictures[expression] = bytes;
    errors[expression] = bytes.empty() ? text(header, "error") : "";
  }
  for (const char* known : {"sphere(3, red)", "ball(3)", "m.region"}) {
    EXPECT_FALSE(pictures[known].empty()) << known << ' ' << errors[known];
  }
  EXPECT_EQ(pictures["sphere(3, red)"], pictures["ball(3)"]);
  EXPECT_NE(pictures["sphere(3, red)"], pictures["m.region"]);
  EXPECT_EQ(errors["sphere(\"1 + 0.2*ci\", red)"], "unsupported");
}

TEST_F(StudioTest, PortsSayWhichNodesGoInWhere) {
  const Data loaded =
      ask("load", R"("file": "a.vcad", "text": )" +
                      print_json_line("place = cells((5, 5, 5));\nbend = noise(size=3);\n"
                                      "difference() {\n"
                                      "  attribute(\"heat\", place.distance + 2 * bend) sphere(3, red);\n"
                                      "  cube(1, red);\n"
                                      "}"))
          .first;
  ASSERT_TRUE(loaded.find("nodes")) << print_json(loaded);
  const DataList& nodes = *loaded.find("nodes")->list();
  const auto find = [&](const std::string& type) {
    return std::ranges::find_if(nodes, [&](const Data& node) { return text(node, "type") == type; });
  };
  const auto ports = [&](const std::string& type) {
    std::string text_of_graph;
    for (const Data& port : *find(type)->find("ports")->list()) {
      text_of_graph += text(port, "name") + ": " + text(port, "type");
      for (const Data& edge : *port.find("from")->list())
        text_of_graph +=
            " <- " + text(nodes[static_cast<size_t>(number_in(edge, "node"))], "type") + " " + text(edge, "output");
      text_of_graph += '\n';
    }
    return text_of_graph;
  };
  EXPECT_EQ(ports("difference"), "solids: solid <- attribute  <- cube \n");
  EXPECT_EQ(ports("attribute"),
            "solid: solid <- sphere \n"
            "value: number, field, vector, colour or mixture <- cells distance <- noise value\n");
  EXPECT_EQ(ports("sphere"), "");
}

// The thumbnail is a slice through the middle of the design, here a square of 8 mm. Numbers have the colours of the
// palette, mixtures those of their materials.
TEST_F(StudioTest, ThumbnailsOfValuesShowThemOverASlice) {
  const std::string script =
      "warm = 2 * formula(\"x\") + 3;\nhue = mix(red, blue, formula(\"0.5 + x / 8\"));\n"
      "translate(4, 0, 1) attribute(\"heat\", at(warm, [\"x\", \"y\", \"z\"])) rectprism((8, 8, 8), hue);";
  const Data loaded = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(script)).first;
  ASSERT_TRUE(loaded.find("nodes")) << print_json(loaded);
  const DataList& nodes = *loaded.find("nodes")->list();
  const auto picture = [&](const std::string& type) {
    const auto found = std::ranges::find_if(nodes, [&](const Data& node) { return text(node, "type") == type; });
    EXPECT_NE(found, nodes.end()) << type;
    const auto [header, bytes] =
        ask("thumbnail", R"("width": 32, "height": 32, "node": )" + std::to_string(found - nodes.begin()) +
                             R"(, "design": ")" + text(loaded, "design") + '"');
    EXPECT_FALSE(bytes.empty()) << print_json(header);
    return formats::decode_png(bytes, "thumbnail");
  };
  const auto red_to_blue = picture("mix"), least_to_greatest = picture("at");
  const Data hello = ask("hello").first;
  const DataList& palette = *hello.find("palettes")->list()->front().find("colours")->list();
  const auto differs = [](const formats::Rgba& colour, const Data& from) {
    double most = 0;
    for (size_t channel = 0; channel < 3; ++channel)
      most = std::max(most, std::abs(colour[channel] - *from.list()->at(channel).number()));
    return most;
  };
  int first = 0;
  while (least_to_greatest.colour(static_cast<uint32_t>(first), 16)[3] == 0) ++first;
  const auto left = static_cast<uint32_t>(first), right = 31 - left;
  ASSERT_LT(left, 8U);
  EXPECT_LT(differs(least_to_greatest.colour(left, 16), palette.front()), 24);
  EXPECT_LT(differs(least_to_greatest.colour(right, 16), palette.back()), 24);
  // Values that vary along x alone have columns of one colour.
  EXPECT_EQ(least_to_greatest.colour(12, 10), least_to_greatest.colour(12, 22));
  EXPECT_GT(red_to_blue.colour(left, 16)[0], red_to_blue.colour(right, 16)[0]);
  EXPECT_LT(red_to_blue.colour(left, 16)[2], red_to_blue.colour(right, 16)[2]);
}

TEST_F(StudioTest, VolumesHoldValuesOfAttributes) {
  const std::string design = load("attribute(\"heat\", \"x\", unit=\"K\") rectprism((8, 4, 4), red);");
  const auto [header, bytes] = ask("volume", R"("side": 16, "by": "heat", "design": ")" + design + '"');
  ASSERT_TRUE(header.find("count")) << print_json(header);
  const DataList& count = *header.find("count")->list();
  const auto columns = static_cast<size_t>(*count[0].number());
  const size_t texels = columns * static_cast<size_t>(*count[1].number() * *count[2].number());
  ASSERT_EQ(bytes.size(), 2 * texels);
  const double lo = *header.find("range")->list()->front().number(),
               hi = *header.find("range")->list()->back().number();
  EXPECT_NEAR(lo, -4, 0.2);
  EXPECT_NEAR(hi, 4, 0.2);
  const double first_mm = *header.find("origin_mm")->list()->front().number();
  for (size_t i = 0; i < columns; ++i) {  // values of the first row
    const double inside = static_cast<unsigned char>(bytes[2 * i + 1]) / 255.0;
    const double value = static_cast<unsigned char>(bytes[2 * i]) / 255.0;
    const double x = first_mm + (static_cast<double>(i) + 0.5) * number_in(header, "pitch_mm");
    if (inside < 1) continue;
    EXPECT_NEAR(value, std::clamp((x - lo) / (hi - lo), 0.0, 1.0), 0.02) << x;
  }
  const Data refused = ask("volume", R"("side": 16, "by": "cold", "design": ")" + design + '"').first;
  EXPECT_EQ(text(refused, "message"), "the design has no number called \"cold\"; it has heat");
}

}  // namespace
}  // namespace ombre::studio

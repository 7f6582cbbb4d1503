// Tests of endless scripts, too deep designs, and cancelled requests.
#include "base/text/json.h"
#include "studio/test_studio.h"

namespace ombre::studio {
namespace {

// The limits are those of the language: 400 nested nodes, and 200 levels of text.

TEST_F(StudioTest, NewerRequestsOfALaneCancelOlder) {
  const std::string script = "function f(n) = n < 2 ? 1 : f(n - 1) + f(n - 2);\nsphere(f(60));";
  const std::string request = R"(, "do": "load", "lane": "load", "file": "a.vcad", "text": )";
  studio.take(client, R"({"id": 101)" + request + print_json_line(script) + "}");
  studio.take(client, R"({"id": 102)" + request + R"("sphere(1);"})");
  EXPECT_EQ(text(answer(101).first, "error"), "cancelled");
  EXPECT_EQ(*answer(102).first.find("ok"), Data(true));
  studio.take(client, R"({"id": 103)" + request + print_json_line(script) + "}");
  studio.take(client, R"({"id": 103, "do": "cancel"})");
  EXPECT_EQ(text(answer(103).first, "error"), "cancelled");
}

TEST_F(StudioTest, StopsScriptsWithoutEnd) {
  Studio impatient(folder.path, {"ombre test", {}, "", 0.3}, cache);
  impatient.add(client);
  const auto ask_impatient = [&](const std::string& script) {
    const int id = ++last_;
    impatient.take(client, R"({"do": "load", "file": "a.vcad", "id": )" + std::to_string(id) + R"(, "text": )" +
                               print_json_line(script) + "}");
    return answer(id).first;
  };
  const Data endless = ask_impatient("function f(n) = n < 2 ? 1 : f(n - 1) + f(n - 2);\nsphere(f(90));");
  EXPECT_EQ(text(endless, "error"), "time") << print_json(endless);
  EXPECT_NE(text(endless, "message").find("0.3 s"), std::string::npos);
  EXPECT_EQ(*ask_impatient("sphere(1);").find("ok"), Data(true));  // the next request is answered
  impatient.remove(client);
}

TEST_F(StudioTest, SaysWhereScriptsCallThemselvesWithoutEnd) {
  for (const char* script : {"function f(n) = f(n + 1) + 1;\nsphere(f(0));", "module m() { m(); }\nm();"}) {
    const Data loaded = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(std::string(script))).first;
    EXPECT_EQ(*loaded.find("ok"), Data(false));
    ASSERT_FALSE(loaded.find("diagnostics")->list()->empty());
  }
}

TEST_F(StudioTest, ShowsDeepDesignsAndRefusesDeeperOnes) {
  const auto nested = [](int depth) {
    return "module nest(n) { if (n > 0) translate(0, 0, 0.01) nest(n - 1); else sphere(1, red); }\nnest(" +
           std::to_string(depth) + ");";
  };
  const std::string design = load(nested(390));
  const Data probed = ask("probe", R"("at": [0, 0, 3.9], "design": ")" + design + '"').first;
  EXPECT_NEAR(number_in(probed, "distance_mm"), -1, 1e-6) << print_json(probed);
  EXPECT_FALSE(ask("render", R"("width": 20, "height": 20, "design": ")" + design + '"').second.empty());
  EXPECT_NEAR(number_in(ask("measure", R"("design": ")" + design + '"').first, "volume_mm3"), 4.18879, 0.01);
  std::string long_text;
  for (int n = 0; n < 100'000; ++n) long_text += "translate(0, 0, 0.01) ";
  for (const auto& [script, why] : {std::pair{nested(500), "deeper than 400"}, {long_text, "deeper than 200"}}) {
    const Data refused = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(script)).first;
    EXPECT_EQ(*refused.find("ok"), Data(false));
    ASSERT_FALSE(refused.find("diagnostics")->list()->empty());
    const std::string message = text(refused.find("diagnostics")->list()->front(), "message");
    EXPECT_NE(message.find(why), std::string::npos) << message;
  }
  studio.take(client, R"({"id": 900, "do": "load", "x": )" + std::string(100'000, '[') + "}");
  EXPECT_EQ(text(answer(-1).first, "error"), "request");
}

}  // namespace
}  // namespace ombre::studio

// A studio for tests, and a client that sends requests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/text/json.h"
#include "studio/studio.h"
#include "studio/workspace/test_folder.h"

namespace ombre::studio {

inline constexpr const char* ball =
    "radius = 3;  // [1:5]\n"
    "fgrade([\"0.5 + x / 6\", \"0.5 - x / 6\"], [red, blue]) sphere(radius);\n";
inline std::string to_base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t n = 0; n < bytes.size(); n += 3) {
    unsigned group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = group << 8 | (n + k < bytes.size() ? static_cast<unsigned char>(bytes[n + k]) : 0);
    for (size_t k = 0; k < 4; ++k) text += n + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// A client that records the frames sent to it.
class Listener : public Client {
 public:
  void send(Frame frame) override {
    const std::lock_guard lock(mutex_);
    Data data;
    std::string bytes;
    Diagnostics none;
    if (frame.is_binary) {
      size_t length = 0;
      for (size_t n = 0; n < 4; ++n) length |= static_cast<size_t>(static_cast<unsigned char>(frame.data[n])) << 8 * n;
      bytes = frame.data.substr(4 + length);
      data = *parse_json(make_source("frame", frame.data.substr(4, length)), none);
    } else {
      data = *parse_json(make_source("frame", frame.data), none);
    }
    frames_.emplace_back(std::move(data), std::move(bytes));
    news_.notify_all();
  }

  // Waits for the first frame that satisfies the predicate and removes it; returns a null value after 20 minutes.
  template <class Question>
  std::pair<Data, std::string> wait(const Question& is_it) {
    std::unique_lock lock(mutex_);
    const auto found = [&] { return std::ranges::find_if(frames_, [&](const auto& f) { return is_it(f.first); }); };
    news_.wait_for(lock, std::chrono::minutes(20), [&] { return found() != frames_.end(); });
    const auto frame = found();
    if (frame == frames_.end()) return {};
    auto taken = *frame;
    frames_.erase(frame);
    return taken;
  }

 private:
  std::mutex mutex_;
  std::condition_variable news_;
  std::vector<std::pair<Data, std::string>> frames_;
};

class StudioTest : public testing::Test {
 protected:
  StudioTest() { studio.add(client); }

  std::pair<Data, std::string> ask(const std::string& what, const std::string& members = "") {
    const int id = ++last_;
    studio.take(client, R"({"id": )" + std::to_string(id) + R"(, "do": ")" + what + '"' +
                            (members.empty() ? "" : ", " + members) + "}");
    return answer(id);
  }
  std::pair<Data, std::string> answer(int id) {
    return client->wait([&](const Data& data) {
      const Data* found = data.find("id");
      return found && *found->number() == id;
    });
  }
  static std::string text(const Data& data, const char* name) {
    const Data* found = data.find(name);
    return found && found->string() ? *found->string() : "";
  }
  static double number_in(const Data& data, const char* name) {
    const Data* found = data.find(name);
    return found && found->number() ? *found->number() : std::nan("");
  }
  std::string load(const std::string& script, const std::string& more = "") {
    const Data loaded = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(script) + more).first;
    EXPECT_TRUE(loaded.find("design")) << print_json(loaded);
    return text(loaded, "design");
  }
  // Waits for a job in this state and returns it.
  Data job_in(const std::string& state) {
    const auto event = client->wait([&](const Data& data) {
      const Data* job = data.find("job");
      return data.find("event") && job && text(*job, "state") == state;
    });
    return event.first.is_null() ? Data() : *event.first.find("job");
  }

  TestFolder folder;
  std::vector<std::string> opened;  // folders that the studio was to show
  sources::SourceCache cache;
  Studio studio{folder.path,
                {"ombre test", {}, "", 60, [this](const std::string& shown) { return opened.push_back(shown), true; }},
                cache};
  std::shared_ptr<Listener> client = std::make_shared<Listener>();
  int last_ = 0;
};

// A studio with empty caches.
class FreshStudio : public StudioTest {
 public:
  using StudioTest::ask, StudioTest::load;

 private:
  void TestBody() override {}
};

}  // namespace ombre::studio

#include "studio/server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <future>
#include <memory>
#include <thread>
#include <vector>

#include "base/system/stopwatch.h"
#include "studio/workspace/test_folder.h"

namespace ombre::studio {
namespace {

const std::string page_token = "fedcba9876543210fedcba9876543210";
constexpr Asset page[] = {{"/index.html", "text/html", "<p>hello</p>"}, {"/app.js", "text/javascript", "1"}};

// A connection that sends and receives bytes.
class Caller {
 public:
  explicit Caller(uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{20, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    is_open_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Caller() { ::close(socket_); }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;

  bool is_open() const { return is_open_; }
  void say(const std::string& bytes) const {
    for (size_t at = 0; at < bytes.size();) {
      const ssize_t sent = ::send(socket_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (sent <= 0) return;
      at += static_cast<size_t>(sent);
    }
  }
  // Receives until the text arrives or the other side closes.
  std::string hear(const std::string& until = "\r\n\r\n") const {
    std::string heard;
    char block[4096];
    while (heard.find(until) == std::string::npos) {
      const ssize_t count = ::recv(socket_, block, sizeof block, 0);
      if (count <= 0) break;
      heard.append(block, static_cast<size_t>(count));
    }
    return heard;
  }
  // True if the other side has closed without a message.
  bool is_closed() const {
    char byte = 0;
    return ::recv(socket_, &byte, 1, 0) <= 0;
  }

 private:
  int socket_;
  bool is_open_ = false;
};

// Makes a frame as clients send it, with a mask of zeros. `first` is the byte of flags and kind: 0x81 is a text.
std::string client_frame(unsigned char first, const std::string& payload) {
  std::string frame{static_cast<char>(first)};
  if (payload.size() < 126) {
    frame += static_cast<char>(0x80 | payload.size());
  } else {
    frame += static_cast<char>(0x80 | 126);
    frame += static_cast<char>(payload.size() >> 8);
    frame += static_cast<char>(payload.size() & 255);
  }
  return frame + std::string(4, '\0') + payload;
}

class ServerTest : public testing::Test {
 protected:
  void start(const ServerLimits& limits = {}) {
    std::promise<uint16_t> ready;
    thread_ = std::thread([&ready, limits, this] {
      serve(studio, {0, page_token, page, limits}, stop,
            [&](const Address& address) { ready.set_value(address.port); });
    });
    port = ready.get_future().get();
  }
  ~ServerTest() override {
    stop.request();
    if (thread_.joinable()) thread_.join();
  }

  std::string get(const std::string& target, const std::string& more = "",
                  const std::string& host = "localhost") const {
    const Caller caller(port);
    caller.say("GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n" + more + "Connection: close\r\n\r\n");
    return caller.hear("nothing: all of it");
  }
  std::string upgrade(const std::string& target, const std::string& more = "") const {
    return "GET " + target + " HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n" +
           "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" + more + "\r\n";
  }
  static bool has(const std::string& answer, const std::string& part) { return answer.find(part) != std::string::npos; }
  std::string cookie() const { return "Cookie: ombre_studio_" + std::to_string(port) + "=" + page_token + "\r\n"; }

  TestFolder folder;
  sources::SourceCache cache;
  Studio studio{folder.path, {"ombre test", {}, "", 60}, cache};
  StopFlag stop;
  uint16_t port = 0;

 private:
  std::thread thread_;
};

TEST_F(ServerTest, ServesThePageToThoseWithTheToken) {
  start();
  const std::string first = get("/?token=" + page_token);
  EXPECT_TRUE(has(first, " 303 ")) << first;
  EXPECT_TRUE(has(first, "HttpOnly; SameSite=Lax"));
  const std::string second = get("/", cookie());
  EXPECT_TRUE(has(second, " 200 ") && has(second, "<p>hello</p>")) << second;
  EXPECT_TRUE(has(second, "Content-Security-Policy: default-src 'none'"));
  EXPECT_TRUE(has(get("/app.js", cookie()), "text/javascript"));
}

TEST_F(ServerTest, RefusesEverythingElse) {
  start();
  folder.write("secret.vcad", "secret");
  EXPECT_TRUE(has(get("/"), " 403 "));
  EXPECT_TRUE(has(get("/?token=guess"), " 403 "));
  EXPECT_TRUE(has(get("/", cookie(), "evil.example"), " 403 "));
  EXPECT_TRUE(has(get("/", cookie() + "Origin: http://evil.example\r\n"), " 403 "));
  for (const char* path :
       {"/secret.vcad", "/../secret.vcad", "/%2e%2e/secret.vcad", "//etc/passwd", "/index.html/..", "/api"})
    EXPECT_TRUE(has(get(path, cookie()), " 404 ")) << path;
  const Caller caller(port);
  caller.say("DELETE / HTTP/1.1\r\nHost: localhost\r\n" + cookie() + "\r\n");
  EXPECT_TRUE(has(caller.hear(), " 405 "));
}

TEST_F(ServerTest, TakesRequestsByTheSocket) {
  start();
  const Caller caller(port);
  caller.say(upgrade("/api", cookie() + "Origin: http://localhost\r\n"));
  EXPECT_TRUE(has(caller.hear(), " 101 "));
  caller.say(client_frame(0x81, R"({"id": 5, "do": "list"})"));
  EXPECT_TRUE(has(caller.hear("files"), R"("id":5)"));
  caller.say(client_frame(0x81, "nonsense"));
  EXPECT_TRUE(has(caller.hear("message"), R"("error":"request")"));
}

TEST_F(ServerTest, LetsNoOtherPageUseTheSocket) {
  start();
  for (const std::string& more :
       {cookie() + "Origin: http://evil.example\r\n", cookie() + "Origin: null\r\n", std::string()}) {
    const Caller caller(port);
    caller.say(upgrade("/api", more));
    EXPECT_TRUE(has(caller.hear(), " 403 ")) << more;
  }
  const Caller caller(port);
  caller.say(upgrade("/elsewhere", cookie()));
  EXPECT_TRUE(has(caller.hear(), " 404 "));
}

TEST_F(ServerTest, ClosesOnMalformedAndGiantFrames) {
  ServerLimits limits;
  limits.frame_bytes = 1000;
  start(limits);
  const std::string bad[] = {client_frame(0x81, std::string(2000, ' ')),  // too long
                             client_frame(0x8f, "x"),                     // unknown kind
                             client_frame(0xf1, "x"),                     // reserved bits
                             client_frame(0x81, "\xff\xff"),              // invalid UTF-8
                             std::string("\x81\x01x", 3),                 // without a mask
                             client_frame(0x82, "bytes"),                 // binary, not text
                             "\x81" + std::string(9, '\xff') + std::string(4, '\0')};
  for (const std::string& frame : bad) {
    const Caller caller(port);
    caller.say(upgrade("/api", cookie()));
    ASSERT_TRUE(has(caller.hear(), " 101 "));
    caller.say(frame);
    const Stopwatch watch;
    const std::string last = caller.hear("nothing: until it closes");
    EXPECT_LT(last.size(), 200U);
    EXPECT_LT(watch.seconds(), 10);
  }
  EXPECT_TRUE(has(get("/", cookie()), " 200 "));
}

TEST_F(ServerTest, RefusesGiantHeadsAndBodies) {
  start();
  {
    const Caller caller(port);
    caller.say("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(100000, 'x'));
    EXPECT_FALSE(has(caller.hear("nothing"), " 200 "));
  }
  {
    const Caller caller(port);
    caller.say("POST / HTTP/1.1\r\nHost: localhost\r\n" + cookie() + "Content-Length: 100000000000\r\n\r\n");
    EXPECT_TRUE(has(caller.hear(), " 413 "));
  }
  for (const char* garbage : {"\r\n\r\n\r\n", "GET\r\n\r\n", "\x16\x03\x01\x02", "GET / HTTP/9.9\r\n\r\n"}) {
    const Caller caller(port);
    caller.say(garbage);
    caller.say("\r\n\r\n");
    EXPECT_FALSE(has(caller.hear("nothing"), " 200 "));
  }
  EXPECT_TRUE(has(get("/", cookie()), " 200 "));
}

TEST_F(ServerTest, ClosesThoseWhoSayNothing) {
  ServerLimits limits;
  limits.head_seconds = 0.3;
  start(limits);
  const Stopwatch watch;
  const Caller silent(port), slow(port);
  slow.say("GET / HT");
  EXPECT_TRUE(silent.is_closed());
  EXPECT_TRUE(slow.is_closed());
  EXPECT_LT(watch.seconds(), 10);
}

// The oldest connections make room.
TEST_F(ServerTest, AnswersWhile200ConnectionsSayNothing) {
  start();
  std::vector<std::unique_ptr<Caller>> callers;
  for (int n = 0; n < 200; ++n) callers.push_back(std::make_unique<Caller>(port));
  EXPECT_TRUE(has(get("/", cookie()), " 200 "));
  const std::string words = callers.front()->hear("nothing: all of it");
  EXPECT_TRUE(has(words, " 503 ") && has(words, "Too many connections to the studio are open; close some.")) << words;
}

TEST_F(ServerTest, Refuses200WindowsInClearWords) {
  start();
  const auto open_window = [&] {
    auto caller = std::make_unique<Caller>(port);
    caller->say(upgrade("/api", cookie()));
    return caller;
  };
  std::vector<std::unique_ptr<Caller>> windows, refused;
  for (int n = 0; n < 200; ++n) {
    auto caller = open_window();
    const std::string answer = caller->hear(windows.size() < ServerLimits().pages ? "\r\n\r\n" : "close some.");
    if (has(answer, " 101 ")) {
      windows.push_back(std::move(caller));
    } else {
      EXPECT_TRUE(has(answer, " 503 ") && has(answer, "open in too many windows")) << answer;
      refused.push_back(std::move(caller));
    }
  }
  EXPECT_EQ(windows.size(), ServerLimits().pages);
  EXPECT_TRUE(has(open_window()->hear("close some."), " 503 "));  // connection 201
  // Open windows stay open, and are answered.
  for (const auto& window : windows) {
    window->say(client_frame(0x81, R"({"id": 5, "do": "list"})"));
    EXPECT_TRUE(has(window->hear("files"), R"("id":5)"));
  }
  EXPECT_TRUE(has(get("/", cookie()), " 200 "));
  // There is room again once the server has seen that they are closed.
  windows.clear();
  refused.clear();
  const Stopwatch watch;
  std::string answer;
  while (!has(answer, " 101 ") && watch.seconds() < 10) answer = open_window()->hear();
  EXPECT_TRUE(has(answer, " 101 ")) << answer;
}

TEST(Server, EndsWhenNobodyUsesIt) {
  const TestFolder folder;
  sources::SourceCache cache;
  Studio studio(folder.path, {"ombre test", {}, "", 60}, cache);
  const StopFlag none;
  ServerOptions options;
  options.idle_seconds = 0.3;
  const Stopwatch watch;
  serve(studio, options, none, [](const Address&) {});
  EXPECT_GE(watch.seconds(), 0.3);
}

TEST_F(ServerTest, SaysThatAPortIsTaken) {
  start();
  const StopFlag none;
  EXPECT_THROW(serve(studio, {port, page_token, page, {}}, none, [](const Address&) {}), std::runtime_error);
}

}  // namespace
}  // namespace ombre::studio

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

#include "base/system/not_copied.h"
#include "base/system/stopwatch.h"
#include "studio/workspace/test_folder.h"

namespace ombre::studio {
namespace {

const std::string page_token = "fedcba9876543210fedcba9876543210";
constexpr Asset page[] = {{"/index.html", "text/html", "<p>hello</p>"}, {"/app.js", "text/javascript", "1"}};

// A connection that sends and receives bytes.
class Caller : NotCopied {
 public:
  explicit Caller(uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{1200, 0};  // s, after which a test hangs
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    is_open_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Caller() { ::close(socket_); }

  bool is_open() const { return is_open_; }
  void say(const std::string& bytes) const {
    for (size_t at = 0; at < bytes.size();) {
      const ssize_t sent = ::send(socket_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (sent <= 0) return;
      at += static_cast<size_t>(sent);
    }
  }
  // Receives until the text occurs or the other side closes the connection.
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
  // Returns true if the other side has closed the connection and sends nothing more.
  bool is_closed() const {
    char byte = 0;
    const ssize_t count = ::recv(socket_, &byte, 1, 0);
    return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK);
  }

 private:
  int socket_;
  bool is_open_ = false;
};

// Returns a frame as clients send it, with a mask of zeros. `first` is the byte of flags and opcode: 0x81 for text.
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
      serve(studio, {0, 0, page_token, page, limits}, stop,
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
  static std::string key() { return "Authorization: Bearer " + page_token + "\r\n"; }

  TestFolder folder;
  sources::SourceCache cache;
  Studio studio{folder.path, {"ombre test", {}, "", 60}, cache};
  StopFlag stop;
  uint16_t port = 0;

 private:
  std::thread thread_;
};

// No answer has a cookie, which a browser would send to the other ports of this machine as well.
TEST_F(ServerTest, ServesThePageWithoutCookies) {
  start();
  for (const std::string& target : {"/?token=" + page_token, std::string("/")}) {
    const std::string answer = get(target);
    EXPECT_TRUE(has(answer, " 200 ") && has(answer, "<p>hello</p>")) << answer;
    EXPECT_TRUE(has(answer, "Content-Security-Policy: default-src 'none'"));
    EXPECT_FALSE(has(answer, "Set-Cookie"));
  }
  EXPECT_TRUE(has(get("/app.js"), "text/javascript"));
}

TEST_F(ServerTest, TellsWhetherATokenIsRight) {
  start();
  EXPECT_TRUE(has(get("/api", key()), " 200 "));
  EXPECT_TRUE(has(get("/api?token=" + page_token), " 200 "));
  EXPECT_TRUE(has(get("/api"), " 403 "));
  EXPECT_TRUE(has(get("/api?token=guess"), " 403 "));
  EXPECT_TRUE(has(get("/api", "Cookie: ombre_studio_" + std::to_string(port) + "=" + page_token + "\r\n"), " 403 "));
}

TEST_F(ServerTest, RefusesEverythingElse) {
  start();
  folder.write("secret.vcad", "secret");
  EXPECT_TRUE(has(get("/", key(), "evil.example"), " 403 "));
  EXPECT_TRUE(has(get("/", key() + "Origin: http://evil.example\r\n"), " 403 "));
  for (const char* path : {"/secret.vcad", "/../secret.vcad", "/%2e%2e/secret.vcad", "//etc/passwd", "/index.html/..",
                           "/download/", "/download/00000000000000000000000000000000", "/download/../secret.vcad"})
    EXPECT_TRUE(has(get(path, key()), " 404 ")) << path;
  const Caller caller(port);
  caller.say("DELETE / HTTP/1.1\r\nHost: localhost\r\n" + key() + "\r\n");
  EXPECT_TRUE(has(caller.hear(), " 405 "));
}

// A prepared file is sent once, to the page that knows its random address.
TEST_F(ServerTest, SendsAFileOnce) {
  start();
  folder.write("part.stl", std::string(300000, 's'));
  const Caller caller(port);
  caller.say(upgrade("/api", key()));
  EXPECT_TRUE(has(caller.hear(), " 101 "));
  caller.say(client_frame(0x81, R"({"id": 5, "do": "download", "file": "part.stl"})"));
  const std::string answer = caller.hear("}");
  const size_t at = answer.find("/download/");
  ASSERT_NE(at, std::string::npos) << answer;
  const std::string path = answer.substr(at, answer.find('"', at) - at);
  const Caller first(port);
  first.say("GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const std::string sent = first.hear("nothing: until it closes");
  EXPECT_TRUE(has(sent, " 200 ") && has(sent, "Content-Length: 300000") && has(sent, "attachment"));
  EXPECT_TRUE(has(sent, "\r\n\r\n" + std::string(300000, 's')));
  EXPECT_TRUE(has(get(path), " 404 "));
}

TEST_F(ServerTest, TakesRequestsByTheSocket) {
  start();
  const Caller caller(port);
  caller.say(upgrade("/api", key() + "Origin: http://localhost\r\n"));
  EXPECT_TRUE(has(caller.hear(), " 101 "));
  caller.say(client_frame(0x81, R"({"id": 5, "do": "list"})"));
  EXPECT_TRUE(has(caller.hear("files"), R"("id":5)"));
  caller.say(client_frame(0x81, "nonsense"));
  EXPECT_TRUE(has(caller.hear("message"), R"("error":"request")"));
}

TEST_F(ServerTest, LetsNoOtherPageUseTheSocket) {
  start();
  for (const std::string& more :
       {key() + "Origin: http://evil.example\r\n", key() + "Origin: null\r\n", std::string()}) {
    const Caller caller(port);
    caller.say(upgrade("/api", more));
    EXPECT_TRUE(has(caller.hear(), " 403 ")) << more;
  }
  const Caller caller(port);
  caller.say(upgrade("/elsewhere", key()));
  EXPECT_TRUE(has(caller.hear(), " 404 "));
}

TEST_F(ServerTest, ClosesOnMalformedAndGiantFrames) {
  ServerLimits limits;
  limits.frame_bytes = 1000;
  start(limits);
  const std::string bad[] = {client_frame(0x81, std::string(2000, ' ')),  // too long
                             client_frame(0x8f, "x"),                     // unknown opcode
                             client_frame(0xf1, "x"),                     // reserved bits are set
                             client_frame(0x81, "\xff\xff"),              // not UTF-8
                             std::string("\x81\x01x", 3),                 // not masked
                             client_frame(0x82, "bytes"),                 // not text
                             "\x81" + std::string(9, '\xff') + std::string(4, '\0')};
  for (const std::string& frame : bad) {
    const Caller caller(port);
    caller.say(upgrade("/api", key()));
    ASSERT_TRUE(has(caller.hear(), " 101 "));
    caller.say(frame);
    const std::string last = caller.hear("nothing: until it closes");
    EXPECT_LT(last.size(), 200U);
    EXPECT_TRUE(caller.is_closed());
  }
  EXPECT_TRUE(has(get("/", key()), " 200 "));
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
    caller.say("POST / HTTP/1.1\r\nHost: localhost\r\n" + key() + "Content-Length: 100000000000\r\n\r\n");
    EXPECT_TRUE(has(caller.hear(), " 413 "));
  }
  for (const char* garbage : {"\r\n\r\n\r\n", "GET\r\n\r\n", "\x16\x03\x01\x02", "GET / HTTP/9.9\r\n\r\n"}) {
    const Caller caller(port);
    caller.say(garbage);
    caller.say("\r\n\r\n");
    EXPECT_FALSE(has(caller.hear("nothing"), " 200 "));
  }
  EXPECT_TRUE(has(get("/", key()), " 200 "));
}

TEST_F(ServerTest, ClosesThoseWhoSayNothing) {
  ServerLimits limits;
  limits.head_seconds = 0.3;
  start(limits);
  const Caller silent(port), slow(port);
  slow.say("GET / HT");
  EXPECT_TRUE(silent.is_closed());
  EXPECT_TRUE(slow.is_closed());
}

// The oldest connections are closed to make room.
TEST_F(ServerTest, AnswersWhile200ConnectionsSayNothing) {
  start();
  std::vector<std::unique_ptr<Caller>> callers;
  for (int n = 0; n < 200; ++n) callers.push_back(std::make_unique<Caller>(port));
  EXPECT_TRUE(has(get("/", key()), " 200 "));
  const std::string words = callers.front()->hear("nothing: all of it");
  EXPECT_TRUE(has(words, " 503 ") && has(words, "Too many connections to the studio are open; close some.")) << words;
}

TEST_F(ServerTest, Refuses200WindowsInClearWords) {
  start();
  const auto open_window = [&] {
    auto caller = std::make_unique<Caller>(port);
    caller->say(upgrade("/api", key()));
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
  EXPECT_TRUE(has(open_window()->hear("close some."), " 503 "));  // the 201st connection
  // Open windows stay connected and get answers.
  for (const auto& window : windows) {
    window->say(client_frame(0x81, R"({"id": 5, "do": "list"})"));
    EXPECT_TRUE(has(window->hear("files"), R"("id":5)"));
  }
  EXPECT_TRUE(has(get("/", key()), " 200 "));
  // After they are closed, there is room again as soon as the server has noticed.
  windows.clear();
  refused.clear();
  const Stopwatch watch;
  std::string answer;
  while (!has(answer, " 101 ") && watch.seconds() < 1200) answer = open_window()->hear();
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

// Another server has the usual port, so this one takes a port after it.
TEST_F(ServerTest, TakesTheNextPortIfTheUsualOneIsTaken) {
  start();
  ServerOptions options{0, port, page_token, page, {}};
  options.idle_seconds = 0.1;
  const StopFlag none;
  Address found;
  serve(studio, options, none, [&](const Address& address) { found = address; });
  EXPECT_NE(found.port, port);
  EXPECT_EQ(found.wanted_port, port);
}

TEST_F(ServerTest, SaysThatAPortIsTaken) {
  start();
  const StopFlag none;
  EXPECT_THROW(serve(studio, {port, 0, page_token, page, {}}, none, [](const Address&) {}), std::runtime_error);
}

}  // namespace
}  // namespace ombre::studio

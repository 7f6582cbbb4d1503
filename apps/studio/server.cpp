#include "studio/server.h"

#include <algorithm>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <list>
#include <memory>
#include <optional>

#include "base/text/error.h"
#include "studio/workspace/guard.h"

namespace ombre::studio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
using HttpRequest = http::request<http::string_body>;
using HttpResponse = http::response<http::string_body>;

constexpr std::string_view api_path = "/api", downloads_path = "/download/";

std::string text_of(beast::string_view view) { return {view.data(), view.size()}; }

std::chrono::milliseconds duration(double seconds) {
  return std::chrono::milliseconds(static_cast<int64_t>(seconds * 1000));
}

RequestHead head_of(const HttpRequest& request) {
  return {text_of(request.method_string()), text_of(request.target()), text_of(request[http::field::host]),
          text_of(request[http::field::origin]), text_of(request[http::field::authorization])};
}

// The page loads nothing from other servers, cannot be embedded in other pages, and is not cached.
template <class Response>
void add_page_headers(Response& response) {
  response.set("Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; "
               "connect-src 'self' ws://127.0.0.1:* ws://localhost:*; font-src 'self'; base-uri 'none'; "
               "form-action 'none'; frame-ancestors 'none'");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("X-Frame-Options", "DENY");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set(http::field::cache_control, "no-store");
}

HttpResponse response_of(const HttpRequest& request, unsigned status, std::string_view type, std::string_view body) {
  HttpResponse response{static_cast<http::status>(status), request.version()};
  add_page_headers(response);
  response.set(http::field::content_type, beast::string_view(type.data(), type.size()));
  response.body() = body;
  response.keep_alive(request.keep_alive());
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();
  return response;
}

HttpResponse plain(const HttpRequest& request, unsigned status, const std::string& text) {
  return response_of(request, status, "text/plain; charset=utf-8", text + "\n");
}

// An open connection.
class Connection {
 public:
  virtual ~Connection() = default;
  virtual void close() = 0;
  // Closes the connection in favour of a newer one, with a message if possible.
  virtual void give_way() = 0;
  // Importance of a connection. The least important are closed first: silent ones, then those that load files, then
  // pages.
  enum class Matters { least, more, most };
  virtual Matters matters() const = 0;
};

// State shared by all connections. It is used only by the thread that calls serve().
struct Shared {
  Studio& studio;
  const ServerOptions& options;
  Guard guard;
  std::shared_ptr<asio::io_context> context;              // needed by pages as long as answers refer to them
  std::list<std::weak_ptr<Connection>> connections = {};  // oldest first
  size_t pages = 0;

  HttpResponse answer(const HttpRequest& request) const;
  size_t count() {
    connections.remove_if([](const auto& connection) { return connection.expired(); });
    return connections.size();
  }
  void make_room() {
    while (count() >= options.limits.connections) {
      const auto chosen = std::ranges::min_element(connections, {}, [](const auto& weak) {
        const auto connection = weak.lock();
        return connection ? connection->matters() : Connection::Matters::least;
      });
      if (const auto connection = chosen->lock()) connection->give_way();
      connections.erase(chosen);
    }
  }
};

// Answers with the page's files, which hold nothing of the user. "/api" is there for clients that try a token.
HttpResponse Shared::answer(const HttpRequest& request) const {
  const std::string path(path_of(text_of(request.target())));
  const bool needs_token = path == api_path;
  const auto refusal = needs_token ? guard.refuse(head_of(request)) : Guard::refuse_foreign(head_of(request));
  if (refusal) return plain(request, refusal->status, refusal->text);
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return plain(request, 405, "The studio's files are read, with GET.");
  if (needs_token) return plain(request, 200, "The studio's socket is here.");
  const Asset* asset = find_asset(options.assets, path == "/" ? "/index.html" : path);
  return asset ? response_of(request, 200, asset->type, asset->bytes) : plain(request, 404, "There is no such file.");
}

class Page : public Client, public Connection, public std::enable_shared_from_this<Page> {
 public:
  Page(beast::tcp_stream stream, std::shared_ptr<Shared> shared)
      : socket_(std::move(stream)), shared_(std::move(shared)) {
    ++shared_->pages;
  }
  ~Page() override { --shared_->pages; }

  void start(const HttpRequest& request) {
    beast::get_lowest_layer(socket_).expires_never();
    websocket::stream_base::timeout timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.read_message_max(shared_->options.limits.frame_bytes);
    socket_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) return;
      self->is_open_ = true;
      self->shared_->studio.add(self);
      self->read();
    });
  }

  void send(Frame frame) override {
    if (!is_open_) return;
    auto held = std::make_shared<Frame>(std::move(frame));
    asio::post(socket_.get_executor(), [self = shared_from_this(), held] { self->enqueue(held); });
  }

  void close() override {
    if (is_open_) shared_->studio.remove(shared_from_this());
    is_open_ = false;
    error_code ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }
  void give_way() override { close(); }
  Matters matters() const override { return Matters::most; }

 private:
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](error_code error, size_t) {
      if (error || !self->is_open_) return self->close();
      if (!self->socket_.got_text()) return self->close();
      const std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      self->shared_->studio.take(self->shared_from_this(), text);
      self->read();
    });
  }

  void enqueue(const std::shared_ptr<Frame>& frame) {
    if (!is_open_) return;
    waiting_bytes_ += frame->data.size();
    waiting_.push_back(frame);
    if (waiting_bytes_ > shared_->options.limits.waiting_bytes) return close();
    if (waiting_.size() == 1) write();
  }

  void write() {
    const Frame& frame = *waiting_.front();
    socket_.binary(frame.is_binary);
    socket_.async_write(asio::buffer(frame.data), [self = shared_from_this()](error_code error, size_t) {
      if (error || !self->is_open_) return self->close();
      self->waiting_bytes_ -= self->waiting_.front()->data.size();
      self->waiting_.pop_front();
      if (!self->waiting_.empty()) self->write();
    });
  }

  websocket::stream<beast::tcp_stream> socket_;
  std::shared_ptr<Shared> shared_;
  beast::flat_buffer buffer_;
  std::deque<std::shared_ptr<Frame>> waiting_;
  size_t waiting_bytes_ = 0;
  std::atomic<bool> is_open_ = false;
};

class Visit : public Connection, public std::enable_shared_from_this<Visit> {
 public:
  Visit(tcp::socket socket, std::shared_ptr<Shared> shared) : stream_(std::move(socket)), shared_(std::move(shared)) {}

  void read() {
    const ServerLimits& limits = shared_->options.limits;
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(limits.head_bytes));
    parser_->body_limit(limits.body_bytes);
    stream_.expires_after(duration(limits.head_seconds));
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, size_t) {
      if (error == http::error::end_of_stream) return self->close();
      if (error == http::error::body_limit || error == http::error::header_limit) return self->refuse_size();
      if (error) return self->close();
      self->take(self->parser_->release());
    });
  }

  void close() override {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.socket().close(ignored);
  }
  Matters matters() const override { return was_let_in_ ? Matters::more : Matters::least; }

  // The message is so short that the socket accepts it at once or never.
  void give_way() override {
    if (!is_answering_) {
      HttpResponse words = plain(last_request(), 503, "Too many connections to the studio are open; close some.");
      error_code ignored;
      http::write(stream_, words, ignored);
    }
    close();
  }

 private:
  // Returns a request after whose answer the connection is closed.
  static HttpRequest last_request() {
    HttpRequest request;
    request.version(11);
    request.keep_alive(false);
    return request;
  }
  void refuse_size() { answer(plain(last_request(), 413, "The request is too large.")); }

  void take(const HttpRequest& request) {
    if (websocket::is_upgrade(request)) return upgrade(request);
    if (path_of(text_of(request.target())).starts_with(downloads_path)) return download(request);
    HttpResponse response = shared_->answer(request);
    was_let_in_ = was_let_in_ || response.result_int() < 400;
    answer(std::move(response));
  }

  // Sends a file that the page has asked for by its socket. Its address is random and works once, so the browser can
  // save the file piece by piece without a token.
  void download(const HttpRequest& request) {
    if (const auto refusal = Guard::refuse_foreign(head_of(request)))
      return answer(plain(request, refusal->status, refusal->text));
    if (request.method() != http::verb::get)
      return answer(plain(request, 405, "The studio's files are read, with GET."));
    const std::string target(path_of(text_of(request.target())));
    download_ = shared_->studio.take_download(target.substr(downloads_path.size()));
    if (!download_) return answer(plain(request, 404, "There is no such download any more; start it again."));
    error_code error;
    file_.emplace(http::status::ok, request.version());
    file_->body().open(download_->path.c_str(), beast::file_mode::scan, error);
    if (error) return answer(plain(request, 404, "The file is gone; start the download again."));
    add_page_headers(*file_);
    file_->set(http::field::content_type, "application/octet-stream");
    file_->set(http::field::content_disposition, "attachment");
    file_->keep_alive(false);
    file_->prepare_payload();
    stream_.expires_after(duration(shared_->options.limits.download_seconds));
    was_let_in_ = is_answering_ = true;
    http::async_write(stream_, *file_, [self = shared_from_this()](error_code, size_t) { self->close(); });
  }

  void upgrade(const HttpRequest& request) {
    if (const auto refusal = shared_->guard.refuse(head_of(request)))
      return answer(plain(request, refusal->status, refusal->text));
    if (path_of(text_of(request.target())) != api_path)
      return answer(plain(request, 404, "The studio's socket is /api."));
    if (shared_->pages >= shared_->options.limits.pages)
      return answer(plain(request, 503, "The studio is open in too many windows; close some."));
    const auto page = std::make_shared<Page>(std::move(stream_), shared_);
    shared_->connections.emplace_back(page);
    page->start(request);
  }

  void answer(HttpResponse response) {
    response_ = std::move(response);
    is_answering_ = true;
    stream_.expires_after(duration(shared_->options.limits.head_seconds));
    http::async_write(stream_, response_, [self = shared_from_this()](error_code error, size_t) {
      self->is_answering_ = false;
      if (error || !self->response_.keep_alive()) return self->close();
      self->read();
    });
  }

  beast::tcp_stream stream_;
  std::shared_ptr<Shared> shared_;
  beast::flat_buffer buffer_{64 << 10};
  std::optional<http::request_parser<http::string_body>> parser_;
  HttpResponse response_;
  std::shared_ptr<const Download> download_;  // keeps the file that is being sent
  std::optional<http::response<http::file_body>> file_;
  bool was_let_in_ = false, is_answering_ = false;
};

class Listener {
 public:
  // Listens on the port of the options; without one, on the usual port or the next free one after it.
  Listener(asio::io_context& context, const ServerOptions& options) : acceptor_(context), pause_(context) {
    constexpr uint16_t most_tries = 100;
    if (options.port != 0 || options.usual_port == 0) {
      if (const error_code error = listen(options.port)) refuse(options.port, error);
      return;
    }
    for (uint16_t n = 0; n < most_tries; ++n)
      if (!listen(static_cast<uint16_t>(options.usual_port + n))) return;
    if (const error_code error = listen(0)) refuse(options.usual_port, error);
  }

  void close() {
    error_code ignored;
    acceptor_.close(ignored);
  }
  uint16_t port() const { return acceptor_.local_endpoint().port(); }

  void accept(const std::shared_ptr<Shared>& shared) {
    acceptor_.async_accept([this, shared](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later(shared);  // for example too many open files
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);  // answers are small, and clients wait for them
      shared->make_room();
      const auto visit = std::make_shared<Visit>(std::move(socket), shared);
      shared->connections.emplace_back(visit);
      visit->read();
      accept(shared);
    });
  }

 private:
  error_code listen(uint16_t port) {
    const tcp::endpoint here(asio::ip::make_address("127.0.0.1"), port);
    error_code error, ignored;
    acceptor_.open(here.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(here, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) acceptor_.close(ignored);
    return error;
  }

  [[noreturn]] static void refuse(uint16_t port, const error_code& error) {
    throw Error(Code::other_program, "cannot listen on port " + std::to_string(port) + ": " + error.message() +
                                         "; choose another with --port, or leave it out");
  }

  void accept_later(const std::shared_ptr<Shared>& shared) {
    pause_.expires_after(duration(0.1));
    pause_.async_wait([this, shared](error_code error) {
      if (!error) accept(shared);
    });
  }

  tcp::acceptor acceptor_;
  asio::steady_timer pause_;
};

// Checks the folder regularly, and stops the server when requested.
class Clock {
 public:
  Clock(asio::io_context& context, Studio& studio, double idle_seconds, const StopFlag& stop)
      : context_(context), timer_(context), studio_(studio), idle_seconds_(idle_seconds), stop_(stop) {}

  void tick() {
    if (stop_.requested()) return context_.stop();
    if (idle_seconds_ > 0 && studio_.idle_seconds() > idle_seconds_) return context_.stop();
    if (++ticks_ % ticks_between_checks == 0) studio_.check_disk();
    timer_.expires_after(duration(0.1));
    timer_.async_wait([this](error_code error) {
      if (!error) tick();
    });
  }

 private:
  static constexpr int ticks_between_checks = 5;

  asio::io_context& context_;
  asio::steady_timer timer_;
  Studio& studio_;
  double idle_seconds_;
  const StopFlag& stop_;
  int ticks_ = 0;
};

}  // namespace

std::string Address::url() const { return "http://127.0.0.1:" + std::to_string(port) + "/?token=" + token; }

void serve(Studio& studio, const ServerOptions& options, const StopFlag& stop,
           const std::function<void(const Address&)>& ready) {
  const auto context = std::make_shared<asio::io_context>(1);
  Listener listener(*context, options);
  const uint16_t wanted = options.port != 0 ? options.port : options.usual_port;
  const Address address{listener.port(), options.token.empty() ? random_token() : options.token, wanted};
  const auto shared = std::make_shared<Shared>(Shared{studio, options, Guard(address.token), context});
  Clock clock(*context, studio, options.idle_seconds, stop);
  listener.accept(shared);
  clock.tick();
  ready(address);
  context->run();
  listener.close();
  for (const auto& weak : shared->connections)
    if (const auto connection = weak.lock()) connection->close();
  context->restart();
  context->poll();
}

}  // namespace ombre::studio

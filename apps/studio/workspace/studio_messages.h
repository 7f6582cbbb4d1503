// Messages between page and server: JSON objects, some of them followed by bytes (docs/reference/studio-api.md).
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre::studio {

// An error in a request that a person can correct.
class RequestError : public std::runtime_error {
 public:
  RequestError(std::string code, const std::string& message) : std::runtime_error(message), code_(std::move(code)) {}
  const std::string& code() const { return code_; }  // for programs: "name", "gone", "busy", ...

 private:
  std::string code_;
};

// A request of a client: {"id": 7, "do": "render", ...}.
struct Request {
  double id = 0;
  std::string what;
  std::string lane;  // a newer request of the same lane and connection cancels this one; empty: none does
  Data body;         // the whole JSON object

  // The functions below return members of the body. Those without `otherwise` throw RequestError when the member is
  // missing or of another type, the others only when it is of another type.
  const std::string& text(std::string_view name) const;
  double number(std::string_view name) const;
  std::string text(std::string_view name, const std::string& otherwise) const;
  double number(std::string_view name, double otherwise) const;
  // Throws RequestError unless the number is whole and within these bounds.
  int64_t whole(std::string_view name, int64_t least, int64_t most) const;
  bool flag(std::string_view name) const;
  std::vector<std::string> texts(std::string_view name) const;
  std::vector<double> numbers(std::string_view name, size_t count) const;
};

// Reads the text of a frame; throws RequestError if it is no request.
Request parse_request(const std::string& text);

// An answer has members; some answers also have bytes (a picture, a grid).
struct Answer {
  DataMembers members;
  std::string bytes;
};

// A frame holds text; or, with bytes, 4 bytes with the length of the JSON (lowest first), the JSON, then the bytes.
struct Frame {
  std::string data;
  bool is_binary = false;
};
Frame frame_of(double id, const Answer& answer);
Frame frame_of_error(double id, const std::string& code, const std::string& message);
Frame frame_of_event(const std::string& event, DataMembers members);

// Converts places in a text from bytes to units of UTF-16, which the page counts.
class PageOffsets {
 public:
  explicit PageOffsets(std::string_view text);
  double at(size_t byte) const;

 private:
  static constexpr size_t block = 256;
  std::string_view text_;
  std::vector<size_t> units_before_;  // number of units before each block of bytes
};

// Returns a list of {"severity", "message", "hint", "file", "line", "column", "from", "to"}; the last two are present
// if the diagnostic is about the text of `source`.
DataList describe(const Diagnostics& diagnostics, const SourcePtr& source);

}  // namespace ombre::studio

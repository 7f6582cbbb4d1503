#include "studio/workspace/studio_messages.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/text/json.h"
#include "base/text/text.h"

namespace ombre::studio {
namespace {

[[noreturn]] void expected(std::string_view name, const std::string& what) {
  throw RequestError("request", "the request needs \"" + std::string(name) + "\", " + what);
}

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

// Returns how many UTF-16 units a character takes, by its first byte: characters of four bytes take two.
size_t units_of(char first) { return static_cast<unsigned char>(first) >= 0xF0 ? 2 : 1; }

}  // namespace

const std::string& Request::text(std::string_view name) const {
  const Data* found = body.find(name);
  if (!found || !found->string()) expected(name, "a text");
  return *found->string();
}

double Request::number(std::string_view name) const {
  const Data* found = body.find(name);
  if (!found || !found->number() || !std::isfinite(*found->number())) expected(name, "a number");
  return *found->number();
}

std::string Request::text(std::string_view name, const std::string& otherwise) const {
  const Data* found = body.find(name);
  return !found || found->is_null() ? otherwise : text(name);
}

double Request::number(std::string_view name, double otherwise) const {
  const Data* found = body.find(name);
  return !found || found->is_null() ? otherwise : number(name);
}

int64_t Request::whole(std::string_view name, int64_t least, int64_t most) const {
  const double value = number(name);
  if (value != std::floor(value) || value < static_cast<double>(least) || value > static_cast<double>(most))
    expected(name, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int64_t>(value);
}

bool Request::flag(std::string_view name) const {
  const Data* found = body.find(name);
  if (!found || found->is_null()) return false;
  if (!found->boolean()) expected(name, "true or false");
  return *found->boolean();
}

std::vector<std::string> Request::texts(std::string_view name) const {
  std::vector<std::string> list;
  const Data* found = body.find(name);
  if (!found || found->is_null()) return list;
  if (!found->list()) expected(name, "a list of texts");
  for (const Data& item : *found->list()) {
    if (!item.string()) expected(name, "a list of texts");
    list.push_back(*item.string());
  }
  return list;
}

std::vector<double> Request::numbers(std::string_view name, size_t count) const {
  std::vector<double> list;
  const Data* found = body.find(name);
  const std::string wanted = "a list of " + std::to_string(count) + " numbers";
  if (!found || !found->list() || found->list()->size() != count) expected(name, wanted);
  for (const Data& item : *found->list()) {
    if (!item.number() || !std::isfinite(*item.number())) expected(name, wanted);
    list.push_back(*item.number());
  }
  return list;
}

Request parse_request(const std::string& text) {
  Diagnostics diagnostics;
  auto data = parse_json(make_source("request", text), diagnostics);
  if (!data) throw RequestError("request", "a request is a JSON object: " + diagnostics.list().front().message);
  if (!data->members()) throw RequestError("request", "a request is a JSON object, {\"id\": 1, \"do\": \"hello\"}");
  Request request;
  request.body = std::move(*data);
  request.id = request.number("id");
  request.what = request.text("do");
  request.lane = request.text("lane", "");
  return request;
}

Frame frame_of(double id, const Answer& answer) {
  DataMembers members{{"id", id}};
  members.insert(members.end(), answer.members.begin(), answer.members.end());
  std::string json = print_json_line(members);
  if (answer.bytes.empty()) return {std::move(json), false};
  std::string data;
  data.reserve(4 + json.size() + answer.bytes.size());
  for (int shift = 0; shift < 32; shift += 8) data += static_cast<char>((json.size() >> shift) & 255);
  return {data + json + answer.bytes, true};
}

Frame frame_of_error(double id, const std::string& code, const std::string& message) {
  return {print_json_line(DataMembers{{"id", id}, {"error", code}, {"message", message}}), false};
}

Frame frame_of_event(const std::string& event, DataMembers members) {
  members.emplace(members.begin(), "event", event);
  return {print_json_line(std::move(members)), false};
}

PageOffsets::PageOffsets(std::string_view text) : text_(text) {
  size_t units = 0;
  for (size_t n = 0; n < text.size(); ++n) {
    if (n % block == 0) units_before_.push_back(units);
    if (begins_character(text[n])) units += units_of(text[n]);
  }
  if (units_before_.empty()) units_before_.push_back(0);
}

double PageOffsets::at(size_t byte) const {
  byte = std::min(byte, text_.size());
  const size_t start = std::min(byte / block, units_before_.size() - 1);
  size_t units = units_before_[start];
  for (size_t n = start * block; n < byte; ++n)
    if (begins_character(text_[n])) units += units_of(text_[n]);
  return static_cast<double>(units);
}

DataList describe(const Diagnostics& diagnostics, const SourcePtr& source) {
  const PageOffsets offsets(source ? source->text() : std::string_view());
  DataList list;
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    DataMembers members{{"severity", std::string(name_of(diagnostic.severity))}, {"message", diagnostic.message}};
    if (!diagnostic.hint.empty()) members.emplace_back("hint", hint_of(diagnostic, FrontEnd::studio));
    members.emplace_back("code", std::string(name_of(diagnostic.code)));
    const SourceRange& where = diagnostic.where;
    if (where.source) {
      members.emplace_back("file", where.source->name());
      const Place place = where.source->place(where.begin);
      if (where.begin > 0 || where.end > 0) {
        members.emplace_back("line", number(place.line));
        members.emplace_back("column", number(place.column));
      }
      if (source && (where.source == source || where.source->text() == source->text())) {
        members.emplace_back("from", offsets.at(where.begin));
        members.emplace_back("to", offsets.at(std::max(where.end, where.begin)));
      }
    }
    list.emplace_back(std::move(members));
  }
  return list;
}

}  // namespace ombre::studio

#include "formats/drawings/dxf_entities.h"

#include <charconv>
#include <cmath>

#include "base/text/text.h"

namespace ombre::formats {
namespace {

class DocumentReader {
 public:
  DocumentReader(const std::string& name, std::string_view bytes, const TextScanner& scanner, Diagnostics& diagnostics)
      : name_(name), scanner_(scanner), bytes_(bytes), diagnostics_(diagnostics) {}

  DxfDocument read() {
    check_kind();
    read_sections();
    return std::move(document_);
  }

 private:
  std::string_view line() {
    const size_t end = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
    std::string_view text = bytes_.substr(at_, end - at_);
    at_ = end;
    if (bytes_.substr(at_).starts_with("\r\n")) ++at_;
    if (at_ < bytes_.size()) ++at_;
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
  }

  // Skips a byte order mark, and says which other files have the name of a drawing.
  void check_kind() {
    at_ = bytes_.size() - without_byte_order_mark(bytes_).size();
    constexpr const char* remedy = "save the drawing as DXF in text form (ASCII)";
    if (bytes_.starts_with("AutoCAD Binary DXF"))
      fail(diagnostics_, name_, "this is a DXF file in binary form, which is not read", remedy);
    if (bytes_.starts_with("AC10")) fail(diagnostics_, name_, "this is a DWG file, not a DXF file", remedy);
    if (bytes_.starts_with("\xFF\xFE") || bytes_.starts_with("\xFE\xFF"))
      fail(diagnostics_, name_, "this text is in UTF-16, which is not read", "save the drawing as DXF in UTF-8");
  }

  bool next(DxfPair& pair) {
    if (at_ >= bytes_.size()) return false;
    const size_t begin = at_;
    const std::string_view code = line();
    if (code.empty() && at_ >= bytes_.size()) return false;
    const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), pair.code);
    if (error != std::errc() || end != code.data() + code.size())
      scanner_.fail_at(begin, begin + std::max<size_t>(1, code.size()),
                       "a group code is expected, a whole number, not " + quoted(code),
                       "save the drawing as DXF in text form");
    pair.begin = at_;
    pair.value = line();
    pair.end = pair.begin + pair.value.size();
    return true;
  }

  void read_sections();
  // Reads the entities up to the end of a section or block.
  void read_entities(std::vector<DxfEntity>& entities, DxfPair& pair);
  void read_blocks(DxfPair& pair);
  void add_vertex(std::vector<DxfEntity>& entities, const DxfEntity& vertex) const;

  const std::string& name_;
  const TextScanner& scanner_;
  std::string_view bytes_;
  Diagnostics& diagnostics_;
  size_t at_ = 0;
  DxfDocument document_;
};

void DocumentReader::read_sections() {
  DxfPair pair;
  bool has_entities = false;
  while (next(pair)) {
    if (pair.code != 0 || pair.value != "SECTION" || !next(pair)) continue;
    if (pair.value == "BLOCKS") read_blocks(pair);
    if (pair.value != "ENTITIES") continue;
    has_entities = true;
    read_entities(document_.entities, pair);
  }
  if (!has_entities) fail(diagnostics_, name_, "there is no section ENTITIES", "save the drawing as DXF in text form");
}

void DocumentReader::read_entities(std::vector<DxfEntity>& entities, DxfPair& pair) {
  DxfEntity entity;
  const auto finish = [&] {
    if (entity.kind == "VERTEX")
      add_vertex(entities, entity);
    else if (!entity.kind.empty() && entity.kind != "SEQEND")
      entities.push_back(entity);
    entity = {};
  };
  while (next(pair)) {
    if (pair.code != 0) {
      if (!entity.kind.empty()) entity.pairs.push_back(pair);
      continue;
    }
    finish();
    if (pair.value == "ENDSEC" || pair.value == "ENDBLK") return;
    entity.kind = pair.value;
  }
  finish();
}

void DocumentReader::read_blocks(DxfPair& pair) {
  while (next(pair)) {
    if (pair.code == 0 && pair.value == "ENDSEC") return;
    if (pair.code != 0 || pair.value != "BLOCK") continue;
    std::vector<DxfEntity> entities{{"BLOCK", {}}};
    // The block's own values precede its first entity.
    const size_t begin = at_;
    while (next(pair) && pair.code != 0) entities[0].pairs.push_back(pair);
    const DxfValues values(scanner_, entities[0]);
    DxfBlock block{values.point(10), {}};
    const std::string name(values.text(2));
    at_ = begin;
    read_entities(block.entities, pair);
    document_.blocks[name] = std::move(block);
  }
}

void DocumentReader::add_vertex(std::vector<DxfEntity>& entities, const DxfEntity& vertex) const {
  if (entities.empty() || entities.back().kind != "POLYLINE") return;
  const DxfValues values(scanner_, vertex);
  constexpr int control_point = 16;  // of a spline, whose curve other vertices follow
  if (values.flags(70) & control_point) return;
  entities.back().vertices.push_back(values.point(10));
  entities.back().bulges.push_back(values.number(42));
}

}  // namespace

double DxfValues::number(int code, double otherwise) const {
  for (const DxfPair& pair : entity_.pairs)
    if (pair.code == code) return parsed(pair);
  return otherwise;
}

std::vector<double> DxfValues::numbers(int code) const {
  std::vector<double> list;
  for (const DxfPair& pair : entity_.pairs)
    if (pair.code == code) list.push_back(parsed(pair));
  return list;
}

std::vector<Vec2> DxfValues::points(int code) const {
  std::vector<Vec2> list;
  for (const DxfPair& pair : entity_.pairs) {
    if (pair.code == code) list.push_back({parsed(pair), 0});
    if (pair.code == code + 10 && !list.empty()) list.back().y = parsed(pair);
  }
  return list;
}

std::string_view DxfValues::text(int code) const {
  for (const DxfPair& pair : entity_.pairs)
    if (pair.code == code) return pair.value;
  return {};
}

double DxfValues::parsed(const DxfPair& pair) const {
  const auto number = parse_number(pair.value);
  if (!number || std::abs(*number) > 1e15)
    scanner_.fail_at(pair.begin, pair.end,
                     "a number is expected for code " + std::to_string(pair.code) + ", not " + quoted(pair.value));
  return *number;
}

DxfDocument read_dxf_document(const std::string& name, std::string_view bytes, const TextScanner& scanner,
                              Diagnostics& diagnostics) {
  return DocumentReader(name, bytes, scanner, diagnostics).read();
}

}  // namespace ombre::formats

// The contents of DXF files before conversion to lines: entities with their values, and blocks of entities.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec.h"
#include "base/text/diagnostic.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {

// A value with its group code, which determines its meaning.
struct DxfPair {
  int code = 0;
  std::string_view value;
  size_t begin = 0, end = 0;  // position of the value
};

struct DxfEntity {
  std::string_view kind;
  std::vector<DxfPair> pairs;
  std::vector<Vec2> vertices = {};  // vertices of a polyline
  std::vector<double> bulges = {};  // one per vertex
};

// The numbers of one entity by their codes.
class DxfValues {
 public:
  DxfValues(const TextScanner& scanner, const DxfEntity& entity) : scanner_(scanner), entity_(entity) {}

  double number(int code, double otherwise = 0) const;
  Vec2 point(int code) const { return {number(code), number(code + 10)}; }
  int64_t flags(int code) const { return static_cast<int64_t>(number(code)); }
  // Returns all numbers of a code in their order.
  std::vector<double> numbers(int code) const;
  // Returns all points whose x has the code.
  std::vector<Vec2> points(int code) const;
  std::string_view text(int code) const;

  double parsed(const DxfPair& pair) const;

 private:
  const TextScanner& scanner_;
  const DxfEntity& entity_;
};

struct DxfBlock {
  Vec2 base;
  std::vector<DxfEntity> entities;
};

struct DxfDocument {
  std::vector<DxfEntity> entities;
  std::map<std::string, DxfBlock, std::less<>> blocks;
};

// Reads a document, whose values refer to `bytes`. Throws DesignError after reporting if it is not DXF in text form.
DxfDocument read_dxf_document(const std::string& name, std::string_view bytes, const TextScanner& scanner,
                              Diagnostics& diagnostics);

}  // namespace ombre::formats

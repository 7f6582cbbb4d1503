#include "import/fields/spans.h"

#include <algorithm>

namespace ombre::importing {

using program::Span;

void unite(Spans& spans) {
  if (spans.size() < 2) return;
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
  size_t last = 0;
  for (size_t n = 1; n < spans.size(); ++n) {
    if (spans[n].begin <= spans[last].end)
      spans[last].end = std::max(spans[last].end, spans[n].end);
    else
      spans[++last] = spans[n];
  }
  spans.resize(last + 1);
}

Spans intersection(const Spans& a, const Spans& b) {
  Spans both;
  for (size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const Span common{std::max(a[i].begin, b[j].begin), std::min(a[i].end, b[j].end)};
    if (common.begin < common.end) both.push_back(common);
    if (a[i].end < b[j].end)
      ++i;
    else
      ++j;
  }
  return both;
}

Spans difference(const Spans& a, const Spans& b) {
  Spans rest;
  size_t j = 0;
  for (Span left : a) {
    while (j < b.size() && b[j].end <= left.begin) ++j;
    for (size_t n = j; n < b.size() && b[n].begin < left.end; ++n) {
      if (left.begin < b[n].begin) rest.push_back({left.begin, b[n].begin});
      left.begin = std::max(left.begin, b[n].end);
    }
    if (left.begin < left.end) rest.push_back(left);
  }
  return rest;
}

}  // namespace ombre::importing

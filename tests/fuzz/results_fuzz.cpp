// Any bytes as results of a simulation: values that can be asked for, or a message. What follows an empty line is the
// table of a mesh, or a file that the first one names.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "import/fields/result_source.h"

namespace {

using namespace ombre;

void ask(const program::FieldSource& source, const Box& box) {
  for (const int channel : {0, 1}) {
    if (channel == 1 && source.channel(importing::result_channel_name(0, 0)) < 0) continue;
    for (const Vec3 p : {box.center(), box.lo, box.hi, box.hi + Vec3{1, 1, 1}}) {
      const double value = source.sample(channel, p);
      if (std::isfinite(value) && !source.range(channel, {p, p}).contains(value)) std::abort();
    }
  }
}

void exercise(const std::string& bytes, const std::string* table) {
  Diagnostics diagnostics;
  formats::ResultsBeside beside;
  if (table) beside.values = {"fuzz.csv", *table};
  if (table)
    for (const char* name : {"fuzz.inp", "fuzz.vtu"}) beside.named.push_back({name, *table, name});
  auto results = formats::read_results("fuzz", bytes, beside, diagnostics);
  if (!results) {
    if (!diagnostics.has_errors()) std::abort();
    return;
  }
  const importing::OutsideRule nearest{importing::OutsideRule::Kind::nearest};
  if (results->kinds.empty()) {
    const auto shared = std::make_shared<formats::Results>(std::move(*results));
    const auto source = importing::make_scattered_source("fuzz", shared, false, nearest, {});
    return ask(*source, {shared->points.front(), shared->points.front()});
  }
  const auto mesh = std::make_shared<importing::ResultMesh>(std::move(*results));
  ask(*importing::make_result_source("fuzz", mesh, nearest, {}), mesh->bounds());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with("\x89HDF")) return 0;  // bytes for the library of HDF5, which is not ours
  exercise(bytes, nullptr);
  const size_t gap = bytes.find("\n\n");
  if (gap == std::string::npos) return 0;
  const std::string table = bytes.substr(gap + 2);
  exercise(bytes.substr(0, gap + 1), &table);
  return 0;
}

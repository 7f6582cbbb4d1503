// Loads the module that makes tetrahedra on first use.
#include "solids/tetrahedra.h"

#include <new>

#include "base/system/byte_pack.h"
#include "base/system/helper_process.h"
#include "base/system/module_loader.h"
#include "base/text/error.h"

namespace ombre::solids {

namespace {

constexpr Module tetrahedra_by_cgal{"ombre_tetrahedra", "CGAL",         "tetrahedra",
                                    "libcgal-dev",      "OMBRE_SOLIDS", "use bricks"};

using Make = decltype(ombre_make_tetrahedra);

std::string make_and_pack(Make* make, const TetrahedraRequest& request) {
  Tetrahedra made;
  try {
    make(request, made);
  } catch (const std::bad_alloc&) {
    throw Error(Code::memory, "the tetrahedra take more memory than is allowed; choose a larger size, or more memory");
  }
  BytePacker packer;
  packer.add_list(made.points);
  packer.add_list(made.nodes);
  packer.add_list(made.regions);
  packer.add(uint64_t{made.edges_left_out.size()});
  for (const Polyline& line : made.edges_left_out) packer.add_list(line);
  return packer.take();
}

Error explain(HelperFailure) {
  return {Code::not_meshed,
          "the mesher of tetrahedra crashed, most likely since sharp edges cross or touch each other"};
}

}  // namespace

Tetrahedra make_tetrahedra(const TetrahedraRequest& request) {
  static Make* const make = load_function<Make>(tetrahedra_by_cgal, "ombre_make_tetrahedra");
  constexpr double a_week = 7 * 24 * 3600.0;
  const HelperLimits limits{a_week, request.memory_bytes};
  const std::string bytes = run_in_helper([&] { return make_and_pack(make, request); }, limits, explain, request.stop);
  ByteUnpacker unpacker(bytes);
  Tetrahedra made;
  made.points = unpacker.get_list<Vec3>();
  made.nodes = unpacker.get_list<std::array<uint32_t, 4>>();
  made.regions = unpacker.get_list<uint32_t>();
  made.edges_left_out.resize(unpacker.get<uint64_t>());
  for (Polyline& line : made.edges_left_out) line = unpacker.get_list<Vec3>();
  return made;
}

bool has_tetrahedra() { return has_module(tetrahedra_by_cgal); }

}  // namespace ombre::solids

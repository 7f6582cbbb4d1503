// The module that reads CAD files by Open CASCADE.
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>

#include <filesystem>
#include <mutex>

#include "base/system/helper_process.h"
#include "cad/occt_calls.h"
#include "cad/occt_guard.h"
#include "cad/occt_shapes.h"

namespace ombre::cad {
namespace {

// Limits of the helper process. Most valid files take one or two seconds of processor time per megabyte, surfaces with
// many knots ten times as long, and memory of some tens of times their size.
constexpr double least_seconds = 20, seconds_for_a_byte = 30e-6;
constexpr size_t least_memory = size_t{2} << 30, memory_for_a_byte = 200;

HelperLimits limits_for(const std::string& path) {
  std::error_code failed;
  const uintmax_t size = std::filesystem::file_size(path, failed);
  if (failed) return {least_seconds, least_memory};
  return {least_seconds + seconds_for_a_byte * static_cast<double>(size),
          least_memory + memory_for_a_byte * static_cast<size_t>(size)};
}

std::string read_and_pack(const std::string& path, const std::string& what) {
  return guarded(what, [&] {
    std::vector<MeasuredShape> shapes;
    for (NamedShape& shape : read_shapes(path)) shapes.push_back(measured(std::move(shape)));
    return pack_shapes(shapes);
  });
}

}  // namespace
}  // namespace ombre::cad

// Reads files in a helper process, because broken files may crash the library or make it run forever.
void ombre_read_cad(const std::string* path, const ombre::StopFlag* stop, std::vector<ombre::cad::SolidPtr>* solids) {
  using namespace ombre;
  using namespace ombre::cad;
  // The library's readers share global settings.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  // Without this, the library prints its progress on the console.
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  const std::string what = "cannot read " + *path;
  const HelperLimits limits = limits_for(*path);
  const auto explain = [&](HelperFailure failure) {
    const std::string seconds = std::to_string(static_cast<int>(limits.seconds));
    const std::string reason = failure == HelperFailure::crashed ? ": it is broken"
                                                                 : ": it takes longer than " + seconds +
                                                                       " s of processor time, so it is probably broken";
    return Error(Code::file_content, what + reason + "; export it again, as STEP AP214 or AP242", {{"file", *path}});
  };
  const std::string bytes = run_in_helper([&] { return read_and_pack(*path, what); }, limits, explain, stop);
  guarded(what, [&] {
    for (const MeasuredShape& shape : unpack_shapes(bytes)) solids->push_back(make_solid(shape));
  });
}

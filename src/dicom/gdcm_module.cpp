// The module that reads DICOM files by GDCM.
#include <gdcmTrace.h>

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

#include "base/system/helper_process.h"
#include "dicom/gdcm_calls.h"
#include "dicom/gdcm_slices.h"
#include "dicom/segmentation.h"
#include "dicom/volume_pack.h"

namespace ombre::dicom {
namespace {

// Limits of the helper process. Compressed files expand by a factor of some tens.
constexpr double least_seconds = 20, seconds_for_a_byte = 1e-6;
constexpr size_t least_memory = size_t{2} << 30, memory_for_a_byte = 60;

HelperLimits limits_for(const std::vector<std::string>& files) {
  uintmax_t size = 0;
  for (const std::string& file : files) {
    std::error_code failed;
    const uintmax_t bytes = std::filesystem::file_size(file, failed);
    if (!failed) size += bytes;
  }
  return {least_seconds + seconds_for_a_byte * static_cast<double>(size),
          least_memory + memory_for_a_byte * static_cast<size_t>(size)};
}

// The library and its decoders print assertions and remarks, which would tell a person nothing. They go nowhere in the
// helper process, whose only result is its answer.
void silence() {
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  gdcm::Trace::DebugOff();
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDERR_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::close(nowhere);
}

std::string answer_of_helper(const std::string& name, const std::vector<std::string>& files, const StopFlag* stop,
                             const std::function<std::string()>& work) {
  const HelperLimits limits = limits_for(files);
  const auto explain = [&](HelperFailure failure) {
    return Error(Code::file_content,
                 "cannot read the scan \"" + name + "\": " +
                     (failure == HelperFailure::crashed
                          ? "a file is broken"
                          : "it takes longer than " + std::to_string(static_cast<int>(limits.seconds)) +
                                " s of processor time, so a file is probably broken") +
                     "; export it again",
                 {{"file", name}});
  };
  const auto quietly = [&] {
    silence();
    return work();
  };
  return run_in_helper(quietly, limits, explain, stop);
}

}  // namespace
}  // namespace ombre::dicom

// Reads files in a helper process, because broken files may crash the library.
void ombre_read_dicom(const std::string* name, const std::vector<std::string>* files,
                      const ombre::dicom::SeriesChoice* choice, const ombre::StopFlag* stop,
                      ombre::dicom::Series* series) {
  using namespace ombre::dicom;
  *series = unpack(answer_of_helper(*name, *files, stop, [&] { return pack(read_slices(*name, *files, *choice)); }));
}

void ombre_read_dicom_segments(const std::string* name, const std::string* file,
                               std::vector<ombre::dicom::Segment>* segments) {
  using namespace ombre::dicom;
  *segments = unpack_segments(
      answer_of_helper(*name, {*file}, nullptr, [&] { return pack_segments(segments_of_file(*name, *file)); }));
}

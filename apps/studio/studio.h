// The studio without its connections: takes requests, sends answers and events.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "base/system/stopwatch.h"
#include "sources/source_cache.h"
#include "studio/exports.h"
#include "studio/scans.h"
#include "studio/work_queue.h"
#include "studio/workspace/presets.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// A connection to a page.
class Client {
 public:
  virtual ~Client() = default;
  // Sends a frame; does nothing once the connection is gone. Thread-safe.
  virtual void send(Frame frame) = 0;
};
using ClientPtr = std::shared_ptr<Client>;

struct StudioOptions {
  std::string program;               // "ombre 0.1.0"
  std::vector<std::string> command;  // words that start Ombre's command line; empty: no designs in Python
  std::string first_file;            // file that a page opens at first; empty: none
  double most_seconds = 60;          // time limit of an answer
  // Shows the folder to a person; empty without a display.
  std::function<bool(const std::string& folder)> open_folder = nullptr;
};

// The studio. Thread-safe.
class Studio {
 public:
  Studio(const std::filesystem::path& folder, StudioOptions options, sources::SourceCache& cache);
  ~Studio();

  void add(const ClientPtr& client);
  void remove(const ClientPtr& client);
  // Takes a request of the client; the answer is sent when it is done.
  void take(const ClientPtr& client, const std::string& text);
  // Tells clients which files have been changed by others; to be called a few times a second.
  void check_disk();
  // Returns the time since it had a client or a working job.
  double idle_seconds();
  // Counts of results of sub-designs that were computed, and that were found in memory.
  compile::SubDesignCache::Counts counts() const { return memory_.counts(); }

 private:
  struct Kind;
  static const std::vector<Kind>& kinds();

  void answer(const ClientPtr& client, const Request& request, const Kind& kind, const StopFlag& cancelled);
  void broadcast(const std::string& event, const DataMembers& members);
  OpenDesignPtr design_of(const Request& request) { return designs_.find(request.text("design")); }

  Answer hello(const Request& request, const StopFlag& stop);
  Answer list(const Request& request, const StopFlag& stop);
  Answer open(const Request& request, const StopFlag& stop);
  Answer save(const Request& request, const StopFlag& stop);
  Answer files_ending_in(const Request& request, const StopFlag& stop);
  Answer presets(const Request& request, const StopFlag& stop);
  Answer save_preset(const Request& request, const StopFlag& stop);
  Answer delete_preset(const Request& request, const StopFlag& stop);
  Answer presets_answer(const std::string& file, DataList presets);
  compile::LoadedPtr read(const Request& request, const SourcePtr& text, const compile::LoadOptions& options,
                          Diagnostics& diagnostics);
  Answer load(const Request& request, const StopFlag& stop);
  Answer scan(const Request& request, const StopFlag& stop) { return scans_.describe(request, stop); }
  Answer plane(const Request& request, const StopFlag& stop) { return scans_.plane(request, stop); }
  Answer voxel(const Request& request, const StopFlag& stop) { return scans_.voxel(request, stop); }
  template <Answer (*answer)(const Workspace&, const Request&, const StopFlag&)>
  Answer of_folder(const Request& request, const StopFlag& stop) {
    return answer(workspace_, request, stop);
  }
  void give_memory_back();
  DataMembers listed() const;
  DataList scans_of(const design::Design& design) const;
  Answer compare(const Request& request, const StopFlag& stop);
  Answer estimate(const Request& request, const StopFlag& stop);
  Answer start_export(const Request& request, const StopFlag& stop);
  Answer start_kind(const Request& request, const StopFlag& stop);
  Answer change_export(const Request& request, const StopFlag& stop);
  Answer open_folder(const Request& request, const StopFlag& stop);
  Answer jobs(const Request& request, const StopFlag& stop);
  template <Answer (*view)(OpenDesign&, const Request&, const StopFlag&)>
  Answer show(const Request& request, const StopFlag& stop) {
    return view(*design_of(request), request, stop);
  }

  StudioOptions options_;
  sources::SourceCache& cache_;
  Workspace workspace_;
  Scans scans_;
  Presets presets_;
  sources::SourceCache made_{size_t{256} << 20};  // results of sub-designs, apart from files
  compile::SubDesignCache memory_{made_};
  Designs designs_{memory_};
  std::mutex mutex_;
  std::set<ClientPtr> clients_;
  Stopwatch idle_, given_back_;
  std::atomic<bool> has_answered_ = false;
  Exports exports_;
  WorkQueue queue_;  // declared last, so that it ends first
};

}  // namespace ombre::studio

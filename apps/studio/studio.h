// The studio without its connections: handles requests, and sends answers and events.
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
#include "studio/workspace/downloads.h"
#include "studio/workspace/drafts.h"
#include "studio/workspace/presets.h"
#include "studio/workspace/state_folder.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/uploads.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// A connection to a page.
class Client {
 public:
  virtual ~Client() = default;
  // Sends a frame; does nothing if the connection is closed. Thread-safe.
  virtual void send(Frame frame) = 0;
};
using ClientPtr = std::shared_ptr<Client>;

struct StudioOptions {
  std::string program;               // such as "ombre 0.1.0"
  std::vector<std::string> command;  // the command line that starts Ombre; empty if designs in Python are not supported
  std::string first_file;            // the file that a page opens first; empty for none
  double most_seconds = 60;          // time limit of an answer
  // shows a folder to the user; empty without a display
  std::function<bool(const std::string& folder)> open_folder = nullptr;
  std::filesystem::path state = {};  // folder for drafts and jobs; empty: they end with the studio
};

// Handles the requests of all clients. Thread-safe.
class Studio {
 public:
  Studio(const std::filesystem::path& folder, StudioOptions options, sources::SourceCache& cache);
  ~Studio();

  void add(const ClientPtr& client);
  void remove(const ClientPtr& client);
  // Handles a request of the client, which is answered when it is done.
  void take(const ClientPtr& client, const std::string& text);
  // Tells clients which files other programs have changed; has to be called a few times per second.
  void check_disk();
  // Returns a file that a client has asked for, once; null if there is no such key. Thread-safe.
  std::shared_ptr<const Download> take_download(const std::string& key) { return downloads_.take(key); }
  // Returns the time since there was a client or a running job.
  double idle_seconds();
  // Returns how often something was made of a sub-design, and how often it was cached.
  compile::SubDesignCache::Counts counts() const { return memory_.counts(); }

 private:
  struct Kind;
  static const std::vector<Kind>& kinds();

  void answer(const ClientPtr& client, const Request& request, const Kind& kind, const StopFlag& cancelled);
  void broadcast(const std::string& event, const DataMembers& members);
  OpenDesignPtr design_of(const Request& request) { return designs_.find(request.text("design")); }

  using Handler = Answer(const Request& request, const StopFlag& stop);
  Handler hello, list, open, save, files_ending_in, presets, save_preset, delete_preset, load, node_picture;
  Handler compare, estimate, start_export, start_kind, change_export, open_folder, jobs;
  Handler keep_draft, drop_draft, rename, duplicate, remove_file, make_folder, upload, import, download, zip, is_there;
  Answer presets_answer(const std::string& file, DataList presets);
  compile::LoadedPtr read(const DesignOrigin& origin, bool may_run, const SourcePtr& text,
                          const compile::LoadOptions& options, ScriptResults& results, Diagnostics& diagnostics);
  // Loads a design and keeps it by a handle. Returns null, with diagnostics, if it is wrong.
  OpenDesignPtr load_design(const DesignOrigin& origin, bool may_run, const SourcePtr& text,
                            compile::LoadOptions options, Diagnostics& diagnostics);
  OpenDesignPtr load_again(const DesignOrigin& origin, const StopFlag& stop);
  void resume(int64_t job, const StopFlag& stop);
  void keep_jobs(const DataList& jobs) const;
  DataList draft_names() const;
  void tell_list();
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
  template <Answer (*view)(OpenDesign&, const Request&, const StopFlag&)>
  Answer show(const Request& request, const StopFlag& stop) {
    return view(*design_of(request), request, stop);
  }

  StudioOptions options_;
  sources::SourceCache& cache_;
  Workspace workspace_;
  Scans scans_;
  Presets presets_;
  StateLock state_lock_;
  Drafts drafts_;
  Uploads uploads_{workspace_};
  Downloads downloads_;
  sources::SourceCache made_{size_t{256} << 20};  // what was made of sub-designs, separate from files
  compile::SubDesignCache memory_{made_};
  Designs designs_{memory_};
  std::mutex mutex_;
  std::set<ClientPtr> clients_;
  Stopwatch idle_, given_back_;
  std::atomic<bool> has_answered_ = false;
  Exports exports_;
  WorkQueue queue_;  // last, so that it is destroyed first
};

}  // namespace ombre::studio

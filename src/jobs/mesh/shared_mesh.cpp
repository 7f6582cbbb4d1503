#include "jobs/mesh/shared_mesh.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "formats/containers/file.h"
#include "jobs/common/events.h"
#include "jobs/common/overwrite.h"
#include "jobs/mesh/slab_bytes.h"
#include "stores/folder_store.h"
#include "stores/numbered_files.h"
#include "stores/open_store.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;
using stores::PieceRange;
using surface::CellLayers;
using surface::GridBorders;

const stores::JobWords& slab_words() {
  static const stores::JobWords words{"mesh", "ombre cells", "slabs", "slabs.json", "slab", ".bin"};
  return words;
}

constexpr int64_t slab_layers = surface::strip_layers;

class SharedMesh final : public SharedJob {
 public:
  explicit SharedMesh(MeshToShare mesh)
      : mesh_(std::move(mesh)),
        layers_(surface::all_layers(contour().corners)),
        stored_(slab_words(), pieces().end, mesh_.key) {}

  std::string folder() const override { return mesh_.folder; }
  const stores::StoredJob& stored() const override { return stored_; }
  PieceRange pieces() const override { return {0, (layers_.end + slab_layers - 1) / slab_layers}; }
  DataMembers description() const override { return {{"slabs", number(pieces().end)}, {"key", mesh_.key.data()}}; }
  std::string difference(const DataMembers& earlier) const override {
    return mesh_.key.difference(Data(earlier).find("key"));
  }
  // How long a slab takes is not known before one is made.
  PieceCosts costs(Session&) const override { return {std::vector<double>(static_cast<size_t>(pieces().end)), 0}; }

  int make(PieceRange range, const stores::Shard& shard, Session& session) const override {
    if (!fs::exists(folder())) refuse_joined(mesh_.written);
    JobProgress progress(session.events);
    const auto store = stores::open_shard(folder(), stored_, shard, {threads(), &progress, &session.stop});
    add_slabs(*store, range, progress, session);
    session.events.say("slabs " + std::to_string(range.begin) + ":" + std::to_string(range.end) + " are in " +
                       folder());
    return done;
  }

  int join(Session& session) const override {
    refuse_joined(mesh_.written);
    JobProgress progress(session.events);
    stores::FolderStore store(folder(), stored_, stores::FolderUse::resume, {threads(), &progress, &session.stop});
    add_slabs(store, pieces(), progress, session);
    GridBorders all;
    for (int64_t slab = 0; slab < pieces().end; ++slab) {
      if (session.stop.requested()) throw Cancelled();
      all.append(read_slab(formats::read_file((fs::path(folder()) / stored_.file_name(slab)).string())));
    }
    const int code = mesh_.write(mesh_.planned, all, session);
    if (code == done) store.remove();
    return code;
  }

 private:
  const surface::ContourOptions& contour() const { return mesh_.planned.surface.contour; }
  int threads() const { return contour().workers.threads; }

  CellLayers layers_of(int64_t slab) const {
    return {slab * slab_layers, std::min((slab + 1) * slab_layers, layers_.end)};
  }

  // Makes the slabs of the range that the store lacks, several at once.
  void add_slabs(stores::Store& store, PieceRange range, JobProgress& progress, Session& session) const {
    std::vector<int64_t> missing;
    for (int64_t slab = range.begin; slab < range.end; ++slab)
      if (!store.finished().contains(slab)) missing.push_back(slab);
    const size_t at_once = 2 * static_cast<size_t>(threads() > 0 ? threads() : core_count());
    run_ordered<GridBorders>(
        missing.size(), threads(), at_once,
        [&](size_t n) {
          return find_grid_borders(layers_of(missing[n]), mesh_.planned.surface.program.partition, contour().corners,
                                   contour().tolerance_mm > 0, {1, &session.stop});
        },
        [&](size_t n, const GridBorders& borders) {
          if (session.stop.requested()) throw Cancelled();
          store.put({missing[n], {{stored_.file_name(missing[n]), slab_bytes(borders)}}, {}});
          progress.update({n + 1, missing.size()});
        });
    progress.finish();
  }

  MeshToShare mesh_;
  CellLayers layers_;
  stores::NumberedFiles stored_;
};

}  // namespace

SharedJobPtr share_mesh(MeshToShare mesh) { return std::make_unique<SharedMesh>(std::move(mesh)); }

}  // namespace ombre::jobs

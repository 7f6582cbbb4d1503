#include "jobs/picture/frame_job.h"

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/images/png.h"
#include "jobs/common/settings_key.h"
#include "stores/numbered_files.h"
#include "stores/open_store.h"

namespace ombre::jobs {
namespace {

using compile::PictureChoices;

stores::FolderUse folder_use(const PictureChoices& a) {
  if (a.force) return stores::FolderUse::replace;
  return a.resume ? stores::FolderUse::resume : stores::FolderUse::fresh;
}

const stores::JobWords& frame_words() {
  static const stores::JobWords words{"set of frames", "ombre frames", "frames", "frames.json", "frame", ".png"};
  return words;
}

stores::JobKey key_of(const PictureChoices& a, const compile::Loaded& loaded, const Session& session) {
  return settings_key(a.design.design, loaded.design, a.settings, session.program);
}

// Adds the frames of a range that the store lacks; returns an exit code.
int add_frames(const compile::Loaded& loaded, compile::PictureRequest request, const stores::NumberedFiles& job,
               stores::Store& store, stores::PieceRange range, JobProgress& progress, Session& session) {
  request.wants = [&](int frame) {
    return range.begin <= frame && frame < range.end && !store.finished().contains(frame);
  };
  return take_pictures(loaded, request, session, progress, [&](int frame, const compile::Picture& picture) {
    store.put({frame, {{job.file_name(frame), png_of(request, picture)}}, {{"pixel_mm", picture.pixel_mm}}});
  });
}

void say_stored(const PictureChoices& a, size_t written, size_t kept, Session& session) {
  session.events.say(format_count(written) + " frames written to " + a.output +
                     (kept > 0 ? ", " + format_count(kept) + " finished before" : ""));
  session.events.event("frames",
                       {{"folder", a.output}, {"frames_written", number(written)}, {"frames_kept", number(kept)}});
}

// Frames that several processes make.
class SharedFrames final : public SharedJob {
 public:
  SharedFrames(const PictureChoices& choices, compile::LoadedPtr loaded, stores::JobKey key)
      : choices_(choices),
        loaded_(std::move(loaded)),
        key_(std::move(key)),
        stored_(frame_words(), choices.frames, key_) {}

  std::string folder() const override { return stores::pieces_folder(choices_.output); }
  const stores::StoredJob& stored() const override { return stored_; }
  stores::PieceRange pieces() const override { return {0, choices_.frames}; }
  DataMembers description() const override { return {{"frames", number(choices_.frames)}, {"key", key_.data()}}; }
  std::string difference(const DataMembers& earlier) const override {
    return key_.difference(Data(earlier).find("key"));
  }
  // How long a frame takes is not known before one is made.
  PieceCosts costs(Session&) const override { return {std::vector<double>(static_cast<size_t>(choices_.frames)), 0}; }

  int make(stores::PieceRange range, const stores::Shard& shard, Session& session) const override {
    JobProgress progress(session.events, Counted::steps);
    const auto store =
        stores::open_shard(choices_.output, stored_, shard, {choices_.work.threads, &progress, &session.stop});
    const size_t kept = store->finished().size();
    const int code = add_frames(*loaded_, choices_.request(), stored_, *store, range, progress, session);
    if (code == done) say_stored(choices_, store->finished().size() - kept, kept, session);
    return code;
  }

  int join(Session& session) const override {
    PictureChoices resumed = choices_;
    resumed.resume = true;
    return store_frames(resumed, *loaded_, choices_.request(), session);
  }

 private:
  PictureChoices choices_;
  compile::LoadedPtr loaded_;
  stores::JobKey key_;
  stores::NumberedFiles stored_;
};

}  // namespace

std::string png_of(const compile::PictureRequest& request, const compile::Picture& picture) {
  return formats::encode_png(static_cast<uint32_t>(request.width), static_cast<uint32_t>(request.height), picture.rgba);
}

int take_pictures(const compile::Loaded& loaded, const compile::PictureRequest& request, Session& session,
                  JobProgress& progress, const TakePicture& take) {
  Diagnostics diagnostics;
  const bool is_done = compile::take_pictures(loaded, request, session.stop, take, diagnostics, &progress);
  progress.finish();
  session.events.diagnose(diagnostics);
  return is_done && !diagnostics.has_errors() ? done : wrong_input;
}

void refuse_used_folder(const PictureChoices& a) { stores::refuse_used(a.output, folder_use(a), frame_words()); }

int store_frames(const PictureChoices& a, const compile::Loaded& loaded, const compile::PictureRequest& request,
                 Session& session) {
  JobProgress progress(session.events, Counted::steps);
  const stores::NumberedFiles job(frame_words(), a.frames, key_of(a, loaded, session));
  const auto store = stores::open_store(a.output, job, folder_use(a), {a.work.threads, &progress, &session.stop});
  const size_t kept = store->finished().size();
  try {
    if (const int code = add_frames(loaded, request, job, *store, {0, a.frames}, progress, session); code != done)
      return code;
  } catch (const Cancelled&) {
    progress.finish();
    session.events.say("interrupted; " + format_count(store->finished().size()) + " frames are in " +
                       stores::pieces_folder(a.output) + ", the same command with --resume goes on");
    throw;
  }
  store->close();
  say_stored(a, store->finished().size() - kept, kept, session);
  return done;
}

SharedJobPtr share_frames(const PictureChoices& a, const compile::LoadedPtr& loaded, const Session& session) {
  return std::make_unique<SharedFrames>(a, loaded, key_of(a, *loaded, session));
}

}  // namespace ombre::jobs

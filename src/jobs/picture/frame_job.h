// Frames of a design that turns, which go into a folder or an archive, by one process or by several.
#pragma once

#include <functional>
#include <string>

#include "jobs/common/events.h"
#include "jobs/common/session.h"
#include "jobs/common/shared_job.h"
#include "jobs/picture/picture.h"
#include "jobs/picture/picture_choices.h"

namespace ombre::jobs {

using TakePicture = std::function<void(int frame, const compile::Picture& picture)>;

// Takes all pictures that the request wants; returns an exit code.
int take_pictures(const compile::Loaded& loaded, const compile::PictureRequest& request, Session& session,
                  JobProgress& progress, const TakePicture& take);
std::string png_of(const compile::PictureRequest& request, const compile::Picture& picture);

// Throws Error if the folder holds something that the options do not allow to replace or to go on with.
void refuse_used_folder(const compile::PictureChoices& a);
// Stores all frames that are not there yet; returns an exit code.
int store_frames(const compile::PictureChoices& a, const compile::Loaded& loaded,
                 const compile::PictureRequest& request, Session& session);
SharedJobPtr share_frames(const compile::PictureChoices& a, const compile::LoadedPtr& loaded, const Session& session);

}  // namespace ombre::jobs

// Events of a job for its caller: text for people, or data for programs.
#pragma once

#include <memory>
#include <string>

#include "base/system/progress.h"
#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre::jobs {

// The unit of a job's progress. Steps may take unequal times, so they have no rate.
enum class Counted { voxels, steps };

// Progress that is shown until it is finished or updated again.
class ShownProgress : public Progress {
 public:
  // Removes the shown line, so that other text can follow.
  virtual void finish() = 0;
};

// The receiver of a job's events. Methods may be called from several threads.
class Events {
 public:
  virtual ~Events() = default;

  // True if data are wanted instead of text.
  virtual bool wants_data() const = 0;
  // Takes a result that is text, such as a listing or the bytes of an image.
  virtual void print(const std::string& text) const = 0;
  // True if texts and events go to the same place, so that the bytes of an image cannot be told from events.
  virtual bool prints_among_events() const = 0;
  // Takes data under a name, as {"event": name, ...members}.
  virtual void event(const std::string& name, DataMembers members) const = 0;
  // Takes a remark for people.
  virtual void say(const Phrase& text) const = 0;
  virtual void warn(const Phrase& message, Code code = Code::design) const = 0;
  virtual void error(Code code, const Phrase& message, const CodeValues& values = {}) const = 0;
  virtual void diagnose(const Diagnostics& diagnostics) const = 0;
  // Returns an object that shows progress until it is destroyed.
  virtual std::unique_ptr<ShownProgress> progress(Counted counted) const = 0;
};

// The progress of one piece of work.
class JobProgress final : public Progress {
 public:
  explicit JobProgress(const Events& events, Counted counted = Counted::voxels) : shown_(events.progress(counted)) {}

  void update(const HowFar& how_far) override { shown_->update(how_far); }
  void checking(const HowFar& how_far) override { shown_->checking(how_far); }
  void preparing(const std::string& what, const HowFar& how_far) override { shown_->preparing(what, how_far); }
  void finish() { shown_->finish(); }

 private:
  std::unique_ptr<ShownProgress> shown_;
};

}  // namespace ombre::jobs

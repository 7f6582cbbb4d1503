#include "jobs/common/data_events.h"

#include <cmath>

#include "jobs/common/pace.h"

namespace ombre::jobs {
namespace {

constexpr double interval_s = 1;

DataMembers message_members(std::string_view severity, const std::string& message, Code code,
                            const CodeValues& values) {
  DataMembers named;
  for (const auto& [name, value] : values) named.emplace_back(name, value);
  return {{"severity", std::string(severity)},
          {"message", message},
          {"code", std::string(name_of(code))},
          {"values", Data(std::move(named))}};
}

DataMembers members_of(const Diagnostic& diagnostic, FrontEnd front_end) {
  DataMembers members =
      message_members(name_of(diagnostic.severity), diagnostic.message, diagnostic.code, diagnostic.values);
  members.emplace_back("hint", hint_of(diagnostic, front_end));
  if (!diagnostic.where.source) return members;
  const Place place = diagnostic.where.source->place(diagnostic.where.begin);
  members.emplace_back("file", diagnostic.where.source->name());
  members.emplace_back("line", static_cast<double>(place.line));
  members.emplace_back("column", static_cast<double>(place.column));
  return members;
}

class DataProgress final : public ShownProgress {
 public:
  DataProgress(const Events& events, Counted counted)
      : events_(events), counted_(counted), meter_(counted, interval_s) {}

  void update(const HowFar& how_far) override {
    const auto pace = meter_.update(how_far);
    if (!pace) return;
    const auto done = static_cast<double>(how_far.done), total = static_cast<double>(how_far.total);
    const double seconds_left = std::round(pace->seconds_left);
    if (counted_ == Counted::steps)
      return events_.event("progress", {{"steps_done", done}, {"steps_total", total}, {"seconds_left", seconds_left}});
    events_.event("progress", {{"voxels_done", done},
                               {"voxels_total", total},
                               {"voxels_per_second", std::round(pace->voxels_per_second)},
                               {"seconds_left", seconds_left}});
  }

  void checking(const HowFar& how_far) override {
    if (const auto pace = meter_.checking(how_far))
      events_.event("checking", {{"bytes_done", static_cast<double>(how_far.done)},
                                 {"bytes_total", static_cast<double>(how_far.total)},
                                 {"seconds_left", std::round(pace->seconds_left)}});
  }

  void preparing(const std::string& what, const HowFar& how_far) override {
    if (const auto pace = meter_.preparing(what, how_far))
      events_.event("preparing",
                    {{"what", what}, {"share", pace->share}, {"seconds_left", std::round(pace->seconds_left)}});
  }

  void finish() override {}

 private:
  const Events& events_;
  Counted counted_;
  PaceMeter meter_;
};

}  // namespace

void DataEvents::event(const std::string& name, DataMembers members) const {
  members.emplace(members.begin(), "event", name);
  on_event_(members);
}

void DataEvents::warn(const Phrase& message, Code code) const {
  event("message", message_members("warning", message.in({{}, front_end_}), code, {}));
}

void DataEvents::error(Code code, const Phrase& message, const CodeValues& values) const {
  event("message", message_members("error", message.in({{}, front_end_}), code, values));
}

void DataEvents::diagnose(const Diagnostics& diagnostics) const {
  for (const Diagnostic& diagnostic : diagnostics.list()) event("message", members_of(diagnostic, front_end_));
}

std::unique_ptr<ShownProgress> DataEvents::progress(Counted counted) const {
  return std::make_unique<DataProgress>(*this, counted);
}

}  // namespace ombre::jobs

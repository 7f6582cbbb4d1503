// Loads the module for ICC profiles when the first is read.
#include "ink/profile.h"

#include <algorithm>

#include "base/math/math.h"
#include "base/system/module_loader.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "ink/lcms_calls.h"

namespace ombre::ink {
namespace {

constexpr Module lcms{"ombre_lcms",   "Little CMS", "ICC profiles",
                      "liblcms2-dev", "OMBRE_LCMS", "mix materials by the mean of their light with colour_mixture"};

// Opening a profile takes as long as some thousand colours.
constexpr size_t colours_at_once = size_t{1} << 14;

// Calls body(begin, end) for ranges of `count` colours.
template <class Body>
void in_ranges(size_t count, int threads, const Body& body) {
  run_parallel((count + colours_at_once - 1) / colours_at_once, threads,
               [&](size_t n) { body(n * colours_at_once, std::min(count, (n + 1) * colours_at_once)); });
}

}  // namespace

const std::vector<std::string>& intent_names() {
  static const std::vector<std::string> names{"perceptual", "relative", "saturation", "absolute"};
  return names;
}

ProfileFacts facts_of(const Profile& profile) {
  static const auto facts_of_profile = load_function<decltype(ombre_profile_facts)>(lcms, "ombre_profile_facts");
  ProfileFacts facts;
  facts_of_profile(&profile, &facts);
  return facts;
}

std::vector<double> shares_of(const Profile& profile, const Rendering& rendering, std::span<const Vec3> srgb,
                              int threads) {
  static const auto shares_by_profile = load_function<decltype(ombre_profile_shares)>(lcms, "ombre_profile_shares");
  const size_t channels = facts_of(profile).channels;
  std::vector<double> shares(srgb.size() * channels);
  in_ranges(srgb.size(), threads, [&](size_t begin, size_t end) {
    shares_by_profile(&profile, &rendering, srgb.data() + begin, end - begin, shares.data() + begin * channels);
  });
  constexpr double steps = 65535;
  for (double& share : shares) share = math::round(math::min(math::max(share, 0), 1) * steps) / steps;
  return shares;
}

std::vector<Lab> colours_of(const Profile& profile, Intent intent, std::span<const double> shares, int threads) {
  static const auto colours_by_profile = load_function<decltype(ombre_profile_colours)>(lcms, "ombre_profile_colours");
  const size_t channels = facts_of(profile).channels;
  std::vector<Lab> colours(shares.size() / channels);
  in_ranges(colours.size(), threads, [&](size_t begin, size_t end) {
    colours_by_profile(&profile, intent, shares.data() + begin * channels, end - begin, colours.data() + begin);
  });
  return colours;
}

std::string make_profile(const ProfileTables& tables) {
  static const auto made_profile = load_function<decltype(ombre_make_profile)>(lcms, "ombre_make_profile");
  constexpr size_t most_inks = 8;  // more need tables of gigabytes
  if (tables.inks == 0 || tables.inks > most_inks)
    throw Error(Code::limit, "a profile is made of 1 to 8 inks, not " + std::to_string(tables.inks));
  std::string bytes;
  made_profile(&tables, &bytes);
  return bytes;
}

}  // namespace ombre::ink

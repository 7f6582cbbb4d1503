// ICC output profiles of a machine's inks, by Little CMS.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ink/colour_difference.h"

namespace ombre::ink {

// The rendering intents of ICC.1:2022, in its order.
enum class Intent : uint8_t { perceptual, relative, saturation, absolute };
const std::vector<std::string>& intent_names();

struct Rendering {
  Intent intent = Intent::relative;
  bool black_point = true;  // compensates the black point; ignored by the intent absolute
};

// The bytes of a profile, and the name of their file for messages.
struct Profile {
  std::string name;
  std::shared_ptr<const std::string> bytes;
};

struct ProfileFacts {
  size_t channels = 0;      // inks
  std::string space;        // "CMYK", "6CLR"
  std::string description;  // as the profile gives it; may be empty
};

// Each throws Error, naming the profile, if it is broken or no output profile of inks, and in builds without the
// library. All are thread-safe; colours do not affect each other.
ProfileFacts facts_of(const Profile& profile);

// Returns shares for colours in sRGB, 0 to 1: for each colour the channels of the profile, each from 0 to 1 in steps of
// 1/65535. The sum of a colour's shares may exceed 1.
std::vector<double> shares_of(const Profile& profile, const Rendering& rendering, std::span<const Vec3> srgb,
                              int threads = 0);

// Returns the colours that inks show in these shares, relative to the white of the profile's medium; to the white of a
// perfect diffuser for the intent absolute.
std::vector<Lab> colours_of(const Profile& profile, Intent intent, std::span<const double> shares, int threads = 0);

// The tables of which a profile is made.
struct ProfileTables {
  std::string description, copyright;
  size_t inks = 0;
  Vec3 white{1, 1, 1};       // X, Y and Z of the medium relative to D50
  size_t ink_steps = 0;      // shares along each ink, from 0 to 1
  std::vector<Lab> colours;  // for all combinations of shares, of which the last ink's varies fastest; relative to
                             // the white of the medium
  // Numbers along each of L* (0 to 100), a* and b* (-128 to 0, and in as many steps from there to 127); odd.
  size_t lab_steps = 0;
  std::vector<double> shares;  // of all inks for all colours, of which b* varies fastest
};
// Returns a profile of version 4 whose tables hold 16-bit numbers. The same tables give the same bytes, whatever the
// time. Throws Error if there are no inks or more than 8, and in builds without the library.
std::string make_profile(const ProfileTables& tables);

}  // namespace ombre::ink

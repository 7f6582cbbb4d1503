// The interface between profile.cpp and the module with Little CMS.
#pragma once

#include "ink/profile.h"

// Functions that the module exports.
extern "C" void ombre_profile_facts(const ombre::ink::Profile* profile, ombre::ink::ProfileFacts* facts);
// Writes `count` times as many shares as the profile has channels.
extern "C" void ombre_profile_shares(const ombre::ink::Profile* profile, const ombre::ink::Rendering* rendering,
                                     const ombre::Vec3* srgb, size_t count, double* shares);
extern "C" void ombre_profile_colours(const ombre::ink::Profile* profile, ombre::ink::Intent intent,
                                      const double* shares, size_t count, ombre::Vec3* lab);
extern "C" void ombre_make_profile(const ombre::ink::ProfileTables* tables, std::string* bytes);

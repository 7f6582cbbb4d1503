#include "draw/font_search.h"

#ifdef OMBRE_TEXT

#include <fontconfig/fontconfig.h>
// The next header needs the one above.
#include <fontconfig/fcfreetype.h>

#include <memory>
#include <utility>

#include "base/text/text.h"

namespace ombre::draw {
namespace {

struct DestroyPattern {
  void operator()(FcPattern* pattern) const { FcPatternDestroy(pattern); }
};
using Pattern = std::unique_ptr<FcPattern, DestroyPattern>;

const FcChar8* letters(const std::string& text) { return reinterpret_cast<const FcChar8*>(text.c_str()); }

// The language is set explicitly; otherwise it would come from the locale.
Pattern wanted_font(const std::string& family, bool bold, bool italic) {
  Pattern wanted(FcPatternCreate());
  if (!wanted) return nullptr;
  FcPatternAddString(wanted.get(), FC_FAMILY, letters(family));
  FcPatternAddInteger(wanted.get(), FC_WEIGHT, bold ? FC_WEIGHT_BOLD : FC_WEIGHT_REGULAR);
  FcPatternAddInteger(wanted.get(), FC_SLANT, italic ? FC_SLANT_ITALIC : FC_SLANT_ROMAN);
  FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
  FcPatternAddBool(wanted.get(), FC_VARIABLE, FcFalse);
  FcPatternAddString(wanted.get(), FC_LANG, letters("en"));
  FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  return wanted;
}

std::string family_of(FcPattern* pattern, const std::string& requested, bool& has_name) {
  std::string first;
  FcChar8* name = nullptr;
  for (int n = 0; FcPatternGetString(pattern, FC_FAMILY, n, &name) == FcResultMatch; ++n) {
    const std::string family = reinterpret_cast<const char*>(name);
    if (n == 0) first = family;
    has_name = has_name || to_lower(family) == to_lower(requested);
  }
  return first;
}

int number_of(FcPattern* pattern, const char* what) {
  int number = 0;
  return FcPatternGetInteger(pattern, what, 0, &number) == FcResultMatch ? number : 0;
}

FoundFont described(FcPattern* pattern, std::string file, const std::string& family) {
  FoundFont font;
  font.file = std::move(file);
  font.index = number_of(pattern, FC_INDEX);
  font.family = family_of(pattern, family, font.has_name);
  font.is_bold = number_of(pattern, FC_WEIGHT) > FC_WEIGHT_MEDIUM;
  font.is_italic = number_of(pattern, FC_SLANT) != FC_SLANT_ROMAN;
  return font;
}

}  // namespace

std::optional<FoundFont> search_font_files(const std::vector<std::string>& files, const std::string& family, bool bold,
                                           bool italic) {
  std::optional<FoundFont> best;
  for (const std::string& file : files) {
    int count = 0;
    const Pattern pattern(FcFreeTypeQuery(letters(file), 0, nullptr, &count));
    if (!pattern) continue;
    FoundFont font = described(pattern.get(), file, family);
    if (!font.has_name) continue;
    if (font.is_bold == bold && font.is_italic == italic) return font;
    if (!best) best = std::move(font);
  }
  return best;
}

std::optional<FoundFont> search_font(const std::string& family, bool bold, bool italic) {
  const Pattern wanted = wanted_font(family, bold, italic);
  if (!wanted) return std::nullopt;
  FcResult result = FcResultMatch;
  const Pattern found(FcFontMatch(nullptr, wanted.get(), &result));
  FcChar8* file = nullptr;
  if (!found || FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch) return std::nullopt;
  return described(found.get(), reinterpret_cast<const char*>(file), family);
}

}  // namespace ombre::draw

#else

namespace ombre::draw {

std::optional<FoundFont> search_font(const std::string&, bool, bool) { return std::nullopt; }
std::optional<FoundFont> search_font_files(const std::vector<std::string>&, const std::string&, bool, bool) {
  return std::nullopt;
}

}  // namespace ombre::draw

#endif

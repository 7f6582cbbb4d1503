// The module that reads ICC profiles by Little CMS.
#include <lcms2.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text/error.h"
#include "ink/lcms_calls.h"

namespace ombre::ink {
namespace {

constexpr size_t most_channels = 15;

struct Close {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
struct Delete {
  void operator()(void* transform) const { cmsDeleteTransform(transform); }
};
struct DeleteContext {
  void operator()(cmsContext context) const { cmsDeleteContext(context); }
};
using Opened = std::unique_ptr<void, Close>;
using Transform = std::unique_ptr<void, Delete>;

// The library reports what is wrong with a file to its context, whose data is a text.
void keep_first_error(cmsContext context, cmsUInt32Number, const char* text) {
  auto* first = static_cast<std::string*>(cmsGetContextUserData(context));
  if (first && first->empty()) *first = text;
}

bool is_of_inks(cmsColorSpaceSignature space) {
  switch (space) {
    case cmsSigCmyData:
    case cmsSigCmykData:
    case cmsSig1colorData:
    case cmsSig2colorData:
    case cmsSig3colorData:
    case cmsSig4colorData:
    case cmsSig5colorData:
    case cmsSig6colorData:
    case cmsSig7colorData:
    case cmsSig8colorData:
    case cmsSig9colorData:
    case cmsSig10colorData:
    case cmsSig11colorData:
    case cmsSig12colorData:
    case cmsSig13colorData:
    case cmsSig14colorData:
    case cmsSig15colorData:
      return true;
    default:
      return false;
  }
}

// Returns the four letters of a signature without spaces at their end.
std::string letters_of(cmsUInt32Number signature) {
  std::string text;
  for (const int shift : {24, 16, 8, 0}) text += static_cast<char>((signature >> shift) & 0xFFU);
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

class Reading {
 public:
  explicit Reading(const Profile& file) : file_(file), context_(cmsCreateContext(nullptr, &first_error_)) {
    cmsSetLogErrorHandlerTHR(context_.get(), keep_first_error);
    profile_.reset(
        cmsOpenProfileFromMemTHR(context_.get(), file.bytes->data(), static_cast<cmsUInt32Number>(file.bytes->size())));
    if (!profile_) fail(first_error_.empty() ? "it is no ICC profile" : first_error_);
    space_ = cmsGetColorSpace(profile_.get());
    if (cmsGetDeviceClass(profile_.get()) != cmsSigOutputClass || !is_of_inks(space_))
      fail("its class is " + letters_of(cmsGetDeviceClass(profile_.get())) + " and its colours are " +
           letters_of(space_) + "; an output profile (prtr) of inks, such as CMYK, is needed");
    channels_ = cmsChannelsOf(space_);
    if (channels_ > most_channels) fail("it has more than 15 inks");
  }

  ProfileFacts facts() const {
    ProfileFacts facts{channels_, letters_of(space_), ""};
    std::array<char, 256> text{};
    if (cmsGetProfileInfoASCII(profile_.get(), cmsInfoDescription, "en", "US", text.data(), text.size()) > 0)
      facts.description = text.data();
    return facts;
  }

  void shares(const Rendering& rendering, const Vec3* srgb, size_t count, double* shares) {
    const Opened screen(cmsCreate_sRGBProfileTHR(context_.get()));
    const cmsUInt32Number compensation = rendering.black_point ? cmsFLAGS_BLACKPOINTCOMPENSATION : 0;
    const Transform transform =
        made(screen.get(), TYPE_RGB_DBL, profile_.get(), ink_format(), rendering.intent, compensation);
    cmsDoTransform(transform.get(), srgb, shares, static_cast<cmsUInt32Number>(count));
    for (size_t n = 0; n < count * channels_; ++n) shares[n] /= percent;
  }

  void colours(Intent intent, const double* shares, size_t count, Vec3* lab) {
    const Opened space(cmsCreateLab4ProfileTHR(context_.get(), nullptr));
    const Transform transform = made(profile_.get(), ink_format(), space.get(), TYPE_Lab_DBL, forward(intent), 0);
    std::vector<double> percents(shares, shares + count * channels_);
    for (double& share : percents) share *= percent;
    cmsDoTransform(transform.get(), percents.data(), lab, static_cast<cmsUInt32Number>(count));
  }

 private:
  static constexpr double percent = 100;  // the library's numbers of inks go from 0 to 100

  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(Code::file_content, "the ICC profile \"" + file_.name + "\" cannot be used: " + reason,
                {{"file", file_.name}});
  }

  // The way from inks to colours is the measured one for all intents but the absolute one.
  static Intent forward(Intent intent) { return intent == Intent::absolute ? intent : Intent::relative; }

  cmsUInt32Number ink_format() const {
    return FLOAT_SH(1) | COLORSPACE_SH(static_cast<cmsUInt32Number>(_cmsLCMScolorSpace(space_))) |
           CHANNELS_SH(channels_) | BYTES_SH(0);
  }

  Transform made(void* from, cmsUInt32Number format, void* to, cmsUInt32Number to_format, Intent intent,
                 cmsUInt32Number flags) {
    constexpr cmsUInt32Number plain = cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE;
    Transform transform(cmsCreateTransformTHR(context_.get(), from, format, to, to_format,
                                              static_cast<cmsUInt32Number>(intent), plain | flags));
    if (!transform) fail(first_error_.empty() ? "it lacks a table for this direction" : first_error_);
    return transform;
  }

  const Profile& file_;
  std::string first_error_;
  std::unique_ptr<std::remove_pointer_t<cmsContext>, DeleteContext> context_;
  Opened profile_;
  cmsColorSpaceSignature space_ = cmsSigCmykData;
  cmsUInt32Number channels_ = 0;
};

struct FreePipeline {
  void operator()(cmsPipeline* pipeline) const { cmsPipelineFree(pipeline); }
};

struct FreeCurve {
  void operator()(cmsToneCurve* curve) const { cmsFreeToneCurve(curve); }
};
using Curve = std::unique_ptr<cmsToneCurve, FreeCurve>;

constexpr double greatest = 65535;

cmsUInt16Number number_of(double share) {
  return static_cast<cmsUInt16Number>(std::lround(std::clamp(share, 0.0, 1.0) * greatest));
}

// Makes a profile from tables.
class Writing {
 public:
  explicit Writing(const ProfileTables& tables)
      : tables_(tables),
        context_(cmsCreateContext(nullptr, nullptr)),
        profile_(cmsCreateProfilePlaceholder(context_.get())) {}

  std::string bytes() {
    constexpr double version = 4.3;
    cmsSetProfileVersion(profile_.get(), version);
    cmsSetDeviceClass(profile_.get(), cmsSigOutputClass);
    cmsSetColorSpace(profile_.get(), space_of(tables_.inks));
    cmsSetPCS(profile_.get(), cmsSigLabData);
    const cmsCIEXYZ d50 = *cmsD50_XYZ();
    const cmsCIEXYZ white{tables_.white.x * d50.X, tables_.white.y * d50.Y, tables_.white.z * d50.Z};
    write(cmsSigMediaWhitePointTag, &white);
    write_text(cmsSigProfileDescriptionTag, tables_.description);
    write_text(cmsSigCopyrightTag, tables_.copyright);
    const auto inks = static_cast<cmsUInt32Number>(tables_.inks);
    write_table(cmsSigAToB0Tag, {cmsSigAToB1Tag, cmsSigAToB2Tag}, tables_.ink_steps, inks, 3, colours());
    write_table(cmsSigBToA0Tag, {cmsSigBToA1Tag, cmsSigBToA2Tag}, tables_.lab_steps, 3, inks, shares(),
                curves_to_gray());
    return saved();
  }

 private:
  static cmsColorSpaceSignature space_of(size_t inks) {
    constexpr std::array<cmsColorSpaceSignature, 9> spaces{cmsSigLabData,    cmsSig1colorData, cmsSig2colorData,
                                                           cmsSigCmyData,    cmsSigCmykData,   cmsSig5colorData,
                                                           cmsSig6colorData, cmsSig7colorData, cmsSig8colorData};
    return spaces[inks];
  }

  [[noreturn]] static void fail() { throw Error(Code::memory, "Little CMS cannot make the ICC profile"); }
  void write(cmsTagSignature tag, const void* value) {
    if (cmsWriteTag(profile_.get(), tag, value) == 0) fail();
  }

  void write_text(cmsTagSignature tag, const std::string& text) {
    const std::unique_ptr<cmsMLU, decltype(&cmsMLUfree)> texts(cmsMLUalloc(context_.get(), 1), cmsMLUfree);
    if (cmsMLUsetASCII(texts.get(), "en", "US", text.c_str()) == 0) fail();
    write(tag, texts.get());
  }

  std::vector<cmsUInt16Number> colours() const {
    std::vector<cmsUInt16Number> numbers;
    for (const Lab& lab : tables_.colours)
      for (const double share : {lab.x / 100, (lab.y + 128) / 255, (lab.z + 128) / 255})
        numbers.push_back(number_of(share));
    return numbers;
  }
  std::vector<cmsUInt16Number> shares() const {
    std::vector<cmsUInt16Number> numbers;
    for (const double share : tables_.shares) numbers.push_back(number_of(share));
    return numbers;
  }

  // Returns curves for L*, a* and b*, which bring a* = 0 and b* = 0 to the middle of the table: gray has places of its
  // own.
  std::vector<Curve> curves_to_gray() const {
    constexpr size_t numbers = 256, gray = 128;
    std::array<cmsUInt16Number, numbers> straight{}, bent{};
    for (size_t n = 0; n < numbers; ++n) {
      const auto at = static_cast<double>(n);
      straight[n] = number_of(at / (numbers - 1));
      bent[n] = number_of(n <= gray ? 0.5 * at / gray : 0.5 + 0.5 * (at - gray) / (numbers - 1 - gray));
    }
    std::vector<Curve> curves;
    for (const auto* numbers_of_curve : {&straight, &bent, &bent})
      curves.emplace_back(cmsBuildTabulatedToneCurve16(context_.get(), numbers, numbers_of_curve->data()));
    return curves;
  }

  void write_table(cmsTagSignature tag, std::initializer_list<cmsTagSignature> equal, size_t steps,
                   cmsUInt32Number inputs, cmsUInt32Number outputs, const std::vector<cmsUInt16Number>& numbers,
                   const std::vector<Curve>& before = {}) {
    cmsContext context = context_.get();
    const std::unique_ptr<cmsPipeline, FreePipeline> table(cmsPipelineAlloc(context, inputs, outputs));
    std::vector<cmsToneCurve*> curves;
    for (const Curve& curve : before) curves.push_back(curve.get());
    for (cmsStage* stage :
         {cmsStageAllocToneCurves(context, inputs, curves.empty() ? nullptr : curves.data()),
          cmsStageAllocCLut16bit(context, static_cast<cmsUInt32Number>(steps), inputs, outputs, numbers.data()),
          cmsStageAllocToneCurves(context, outputs, nullptr)})
      if (!stage || cmsPipelineInsertStage(table.get(), cmsAT_END, stage) == 0) fail();
    write(tag, table.get());
    for (const cmsTagSignature other : equal)
      if (cmsLinkTag(profile_.get(), other, tag) == 0) fail();
  }

  std::string saved() {
    cmsUInt32Number size = 0;
    if (cmsSaveProfileToMem(profile_.get(), nullptr, &size) == 0) fail();
    std::string bytes(size, '\0');
    if (cmsSaveProfileToMem(profile_.get(), bytes.data(), &size) == 0) fail();
    // The header's date is that of this moment; the first of January 2000 stands in for it.
    constexpr size_t date = 24;
    constexpr std::array<char, 12> new_year{'\x07', '\xD0', 0, 1, 0, 1, 0, 0, 0, 0, 0, 0};
    std::ranges::copy(new_year, bytes.begin() + date);
    return bytes;
  }

  const ProfileTables& tables_;
  std::unique_ptr<std::remove_pointer_t<cmsContext>, DeleteContext> context_;
  Opened profile_;
};

}  // namespace
}  // namespace ombre::ink

static_assert(sizeof(ombre::Vec3) == 3 * sizeof(double), "colours are arrays of doubles to the library");
static_assert(INTENT_PERCEPTUAL == 0 && INTENT_RELATIVE_COLORIMETRIC == 1 && INTENT_SATURATION == 2 &&
              INTENT_ABSOLUTE_COLORIMETRIC == 3);

void ombre_profile_facts(const ombre::ink::Profile* profile, ombre::ink::ProfileFacts* facts) {
  *facts = ombre::ink::Reading(*profile).facts();
}

void ombre_profile_shares(const ombre::ink::Profile* profile, const ombre::ink::Rendering* rendering,
                          const ombre::Vec3* srgb, size_t count, double* shares) {
  ombre::ink::Reading(*profile).shares(*rendering, srgb, count, shares);
}

void ombre_profile_colours(const ombre::ink::Profile* profile, ombre::ink::Intent intent, const double* shares,
                           size_t count, ombre::Vec3* lab) {
  ombre::ink::Reading(*profile).colours(intent, shares, count, lab);
}

void ombre_make_profile(const ombre::ink::ProfileTables* tables, std::string* bytes) {
  *bytes = ombre::ink::Writing(*tables).bytes();
}

// Values that are colours or mixtures: conversions of colour spaces, images as textures, mixtures of many materials.
#include <cmath>
#include <map>

#include "base/math/srgb.h"
#include "base/system/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "ink/profile.h"
#include "nodes/common/field_math.h"
#include "nodes/common/mixtures.h"
#include "nodes/common/solid_values.h"
#include "nodes/values/colour_table.h"
#include "nodes/values/texture_source.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Op;
using Colour = std::array<Field, 3>;

template <class Change>
Colour each(const Colour& colour, const Change& change) {
  return {change(colour[0]), change(colour[1]), change(colour[2])};
}

// The transfer function of IEC 61966-2-1.
Field light_of_srgb(Field v) { return select(v <= 0.04045, v / 12.92, power_of((max(v, 0.0) + 0.055) / 1.055, 2.4)); }
Field srgb_of_linear(Field v) {
  return select(v <= 0.0031308, v * 12.92, power_of(max(v, 0.0), 1 / 2.4) * 1.055 - 0.055);
}

// Converts from hue in degrees, and saturation and value from 0 to 1. A. R. Smith, "Color gamut transform pairs",
// SIGGRAPH 1978.
Colour rgb_of_hsv(const Colour& hsv) {
  const Field zero = hsv[0].builder->constant(0), one = hsv[0].builder->constant(1);
  const auto channel = [&](double n) {
    const Field k = wrapped(hsv[0] / 60.0 + n, 6);
    return hsv[2] - hsv[2] * hsv[1] * max(min(min(k, 4.0 - k), one), zero);
  };
  return {channel(5), channel(3), channel(1)};
}
Colour hsv_of_rgb(const Colour& rgb) {
  const auto& [r, g, b] = rgb;
  const Field zero = r.builder->constant(0);
  const Field greatest = max(r, max(g, b)), spread = greatest - min(r, min(g, b));
  const Field safe = select(spread <= 0, r.builder->constant(1), spread);
  const Field of_red = wrapped((g - b) / safe, 6), of_green = (b - r) / safe + 2, of_blue = (r - g) / safe + 4;
  const Field hue = select(less_equal(greatest, r), of_red, select(less_equal(greatest, g), of_green, of_blue));
  const Field saturation =
      select(greatest <= 0, zero, spread / select(greatest <= 0, r.builder->constant(1), greatest));
  return {select(spread <= 0, zero, hue * 60.0), saturation, greatest};
}

// L*a*b* of CIE 15 under D65, whose white is (0.95047, 1, 1.08883).
constexpr double white[] = {0.95047, 1, 1.08883};
constexpr double xyz_of_rgb[3][3] = {
    {0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}};
constexpr double rgb_of_xyz[3][3] = {
    {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};

Colour times(const double (&matrix)[3][3], const Colour& v) {
  const auto row = [&](size_t n) { return v[0] * matrix[n][0] + v[1] * matrix[n][1] + v[2] * matrix[n][2]; };
  return {row(0), row(1), row(2)};
}

Colour lab_of_linear(const Colour& linear) {
  constexpr double edge = 6.0 / 29;
  const Colour xyz = times(xyz_of_rgb, linear);
  const auto f = [&](size_t n) {
    const Field t = xyz[n] / white[n];
    return select(t <= edge * edge * edge, t / (3 * edge * edge) + 4.0 / 29, power_of(max(t, 0.0), 1.0 / 3));
  };
  const Field x = f(0), y = f(1), z = f(2);
  return {y * 116.0 - 16, (x - y) * 500.0, (y - z) * 200.0};
}
Colour linear_of_lab(const Colour& lab) {
  constexpr double edge = 6.0 / 29;
  const Field y = (lab[0] + 16) / 116.0, x = y + lab[1] / 500.0, z = y - lab[2] / 200.0;
  const auto back = [&](Field t, size_t n) {
    return select(t <= edge, (t - 4.0 / 29) * (3 * edge * edge), t * t * t) * white[n];
  };
  return times(rgb_of_xyz, {back(x, 0), back(y, 1), back(z, 2)});
}

Domain colour_spaces() { return one_of({"srgb", "linear", "hsv", "lab"}); }

Colour to_linear(const Colour& colour, const Choice& space) {
  if (space == "lab") return linear_of_lab(colour);
  if (space == "linear") return colour;
  return each(space == "hsv" ? rgb_of_hsv(colour) : colour, light_of_srgb);
}
Colour from_linear(const Colour& colour, const Choice& space) {
  if (space == "lab") return lab_of_linear(colour);
  if (space == "linear") return colour;
  const Colour srgb = each(colour, srgb_of_linear);
  return space == "hsv" ? hsv_of_rgb(srgb) : srgb;
}

Colour colour_at(const Numbers3& numbers, const Point& p) { return {numbers.x(p), numbers.y(p), numbers.z(p)}; }

struct ColourValue {
  Numbers3 numbers;
  Choice from = "srgb", to = "srgb";

  static Spec<ColourValue> spec() {
    return {"colour",
            "A colour converted between spaces: sRGB, linear light, HSV or CIE L*a*b*.",
            {{"numbers", &ColourValue::numbers,
              "Red, green and blue from 0 to 1; for hsv hue in degrees, saturation and value; for lab L from 0 to 100, "
              "a, b",
              required()},
             {"space", &ColourValue::from, "Colour space of the numbers", colour_spaces()},
             {"to", &ColourValue::to, "Colour space of the result", colour_spaces()}},
            no_inputs,
            "attribute(\"color_rgb\", colour([\"10*theta\", 1, 1], space=\"hsv\").colour) sphere(5);",
            {{"colour", &ColourValue::colour, "The three numbers of the colour"}}};
  }

  VectorField colour(const Ask& ask) const {
    const Colour given = colour_at(numbers, ask.p);
    const bool is_same = from.text() == to.text();
    const bool is_near = (from == "hsv" && to == "srgb") || (from == "srgb" && to == "hsv");
    const Colour made = is_same   ? given
                        : is_near ? (from == "hsv" ? rgb_of_hsv(given) : hsv_of_rgb(given))
                                  : from_linear(to_linear(given, from), to);
    return {made[0], made[1], made[2]};
  }
};

struct ColourDifference {
  Numbers3 a, b;
  Choice space = "srgb";

  static Spec<ColourDifference> spec() {
    return {
        "colour_difference",
        "The visible difference of two colours: the distance in CIE L*a*b* (Delta E of 1976). About 2 is just visible.",
        {{"a", &ColourDifference::a, "A colour", required()},
         {"b", &ColourDifference::b, "Another colour", required()},
         {"space", &ColourDifference::space, "Colour space of both", colour_spaces()}},
        no_inputs,
        "sphere(8, mix(\"red\", \"blue\", colour_difference([\"x/8\", 0, 0], [1, 0, 0]) / 50));",
        {{"value", &ColourDifference::value, "Difference, 0 or more", Interval(0, 1e6)}}};
  }

  Field value(const Ask& ask) const {
    const Colour p = lab(a, ask.p), q = lab(b, ask.p);
    return length(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }

 private:
  Colour lab(const Numbers3& numbers, const Point& p) const {
    return lab_of_linear(to_linear(colour_at(numbers, p), space));
  }
};

struct Texture {
  FilePath path;
  double width = 40;
  Choice projection = "planar", wrap = "repeat", encoding = "srgb";
  SolidName on;
  double sharpness = 4;
  program::SourceField source;  // read when the node is made
  double columns = 1, rows = 1;

  static Spec<Texture> spec() {
    return {
        "texture",
        "An image over space, centred on the origin.",
        {{"path", &Texture::path, "A PNG or JPEG file; relative to the script, then to the working directory",
          required()},
         {"width", &Texture::width, "Width of the image; around a cylinder, along its circumference",
          unit::positive_mm},
         {"projection", &Texture::projection,
          "planar (along z), cylindrical (around z, upright), or triplanar (along the axis that the surface of `on` "
          "faces most)",
          one_of({"planar", "cylindrical", "triplanar"})},
         {"wrap", &Texture::wrap, "Outside the image: repeat it, or continue the pixels of its border (clamp)",
          one_of({"repeat", "clamp"})},
         {"encoding", &Texture::encoding, "Encoding of the numbers: srgb (as in the file) or linear (light)",
          one_of({"srgb", "linear"})},
         {"on", &Texture::on, "Solid on which a triplanar image lies"},
         {"sharpness", &Texture::sharpness, "Sharpness of the change of triplanar images from one axis to the next",
          from_to(1, 64)}},
        no_inputs,
        "cube(20, mix(\"red\", \"blue\", texture(\"models/leaf.png\", 20)));",
        {{"value", &Texture::value, "Brightness, from 0 to 1", Interval(0, 1)},
         {"colour", &Texture::colour, "Red, green and blue, from 0 to 1"},
         {"alpha", &Texture::alpha, "Opacity, from 0 to 1", Interval(0, 1)}}};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("images cannot be read here");
    if (projection == "triplanar" && !on.node)
      return reader.refuse(
          "a triplanar texture lies on a solid",
          "name it, for example " + spelled::either("on=sphere(10)", R"("on": {"from": "n2"})", "on=ombre.sphere(10)"));
    PixelsRequest request{path};
    const auto pixels = reader.loader->source(request, reader);
    path = request.file;
    if (!pixels) return false;
    columns = static_cast<double>(pixels->columns);
    rows = static_cast<double>(pixels->rows);
    source = make_texture(pixels->columns, pixels->rows, pixels->rgba, path.content,
                          {wrap == "repeat", encoding == "linear"});
    return true;
  }

  Field value(const Ask& ask) const { return limited(channel(ask, "value"), 0, 1); }
  VectorField colour(const Ask& ask) const {
    return {channel(ask, "red"), channel(ask, "green"), channel(ask, "blue")};
  }
  Field alpha(const Ask& ask) const { return limited(channel(ask, "alpha"), 0, 1); }

 private:
  // Reads a channel at a position in pixels from the lower left corner.
  Field at(Field across, Field up, const char* name) const {
    const int number = source->channel(name);
    ASSERT(number >= 0);
    const double pixel = width / columns;
    return across.builder->source(source, number, across / pixel + columns / 2, up / pixel + rows / 2,
                                  across.builder->constant(0));
  }

  Field channel(const Ask& ask, const char* name) const {
    const Point& p = ask.p;
    if (projection == "planar") return at(p.x, p.y, name);
    if (projection == "cylindrical") {
      const Field turn = p.builder().apply(Op::atan2, p.y, p.x) / (2 * 3.14159265358979323846);
      return at(turn * width, p.z, name);
    }
    const VectorField normal = normal_of(ask, on, 0.01);
    std::array<Field, 3> weights;
    for (int axis = 0; axis < 3; ++axis) weights[static_cast<size_t>(axis)] = power_of(abs(normal[axis]), sharpness);
    const Field total = max(weights[0] + weights[1] + weights[2], 1e-12);
    return (weights[0] * at(p.y, p.z, name) + weights[1] * at(p.x, p.z, name) + weights[2] * at(p.x, p.y, name)) /
           total;
  }
};

struct SurfaceColour {
  FilePath path;
  std::string image;
  program::SourceField source;  // read when the node is made

  static Spec<SurfaceColour> spec() {
    return {
        "surface_colour",
        "The colour of the nearest point of a mesh file's surface.",
        {{"path", &SurfaceColour::path,
          "A mesh file with colours or textures: .ply, .obj, .off, .glb, .gltf, .3mf or .amf; relative to the script, "
          "then to the working directory",
          required()},
         {"texture", &SurfaceColour::image,
          "A PNG or JPEG file for the texture coordinates; none: the file's own textures, or its colours"}},
        no_inputs,
        "cube(20, colour_mixture(surface_colour(\"models/painted_ball.ply\").colour, [\"red\", \"green\", "
        "\"blue\", \"white\", \"black\"]));",
        {{"colour", &SurfaceColour::colour, "Red, green and blue, from 0 to 1 (sRGB)"},
         {"alpha", &SurfaceColour::alpha, "Opacity, from 0 to 1", Interval(0, 1)}}};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("meshes cannot be read here");
    SurfaceColoursRequest request{path, {image, {}}};
    source = reader.loader->source(request, reader);
    path = request.file;
    if (source) path.content = source->content();  // that of both files
    return source != nullptr;
  }

  VectorField colour(const Ask& ask) const {
    return {channel(ask, "red"), channel(ask, "green"), channel(ask, "blue")};
  }
  Field alpha(const Ask& ask) const { return channel(ask, "alpha"); }

 private:
  Field channel(const Ask& ask, const char* name) const {
    return ask.p.builder().source(source, source->channel(name), ask.p.x, ask.p.y, ask.p.z);
  }
};

// Returns a mixture by shares. Shares that are negative or NaN count as 0. If all do, the result is the first material
// alone, and the check `none` is set.
Composition by_shares(const Ask& ask, const SharedList<MaterialName>& materials, const std::vector<Field>& shares,
                      const std::string& none) {
  const Field zero = ask.p.constant(0);
  std::vector<Composition> parts;
  std::vector<Field> weights, known;
  for (const MaterialName& name : materials) parts.push_back(ask.in.composition_of(name, ask.p));
  for (const Field raw : shares) {
    weights.push_back(select(is_finite(raw), max(raw, 0.0), zero));
    known.push_back(truth(weights.back()));
  }
  const Field any = program::fold(known, program::logical_or);
  weights[0] = select(any, weights[0], ask.p.constant(1));
  Composition made = weighted(parts, weights);
  if (ask.p.builder().constant_value(any) != 1.0) made.checks.push_back(ask.in.check(logical_not(any), none));
  return made;
}

struct MixMany {
  SharedList<MaterialName> materials;
  SharedList<Number> shares;

  static Spec<MixMany> spec() {
    return {"mix_many",
            "A mixture of several materials or mixtures by their shares. Negative shares count as 0.",
            {{"materials", &MixMany::materials, "Materials or mixtures", required(mixable())},
             {"shares", &MixMany::shares, "A number for each material; they need not add up to 1", required()}},
            no_inputs,
            "sphere(8, mix_many([\"red\", \"blue\", \"clear\"], [\"x^2\", \"y^2\", \"z^2\"]));",
            {{"mixture", &MixMany::mixture,
              "The mixture; where all shares are 0 or not numbers, the first material alone, with a warning"}}};
  }

  bool complete(const Reader& reader) const {
    if (materials.empty()) return reader.refuse("mix_many needs a material", "write for example [\"red\", \"blue\"]");
    if (materials.size() == shares.size()) return true;
    return reader.refuse("mix_many has " + std::to_string(shares.size()) + " shares for " +
                             std::to_string(materials.size()) + " materials",
                         "give one for each");
  }

  Composition mixture(const Ask& ask) const {
    std::vector<Field> raw;
    for (const Number& share : shares) raw.push_back(share(ask.p));
    Composition made =
        by_shares(ask, materials, raw, "mix_many has no share above 0, only its first material is taken there");
    tell_of_lost(ask, raw, made);
    return made;
  }

 private:
  // Sets a check where one share is above 0 and another is NaN.
  static void tell_of_lost(const Ask& ask, const std::vector<Field>& raw, Composition& made) {
    std::vector<Field> usable, counts;
    for (const Field share : raw) {
      usable.push_back(is_finite(share));
      counts.push_back(logical_and(usable.back(), less(ask.p.constant(0), share)));
    }
    const Field all = program::fold(usable, program::logical_and), any = program::fold(counts, program::logical_or);
    if (ask.p.builder().constant_value(all) == 1.0) return;
    made.checks.push_back(ask.in.check(logical_and(any, logical_not(all)),
                                       "a share of mix_many is not a finite number and counts as 0 there"));
  }
};

struct ColourMixture {
  Numbers3 wanted;
  SharedList<MaterialName> materials;
  std::vector<Vec3> colours;  // the materials' colours in linear light; set when the node is made, like the table
  program::SourceField table;

  static Spec<ColourMixture> spec() {
    return {"colour_mixture",
            "The mixture of materials that shows a colour by the mean of their light, with the least graininess.",
            {{"colour", &ColourMixture::wanted, "Red, green and blue from 0 to 1 (sRGB)", required()},
             {"materials", &ColourMixture::materials,
              "Materials that may be mixed, at most 12; their colours in the materials file count, without opacity",
              required()}},
            no_inputs,
            "cube(20, colour_mixture(texture(\"models/leaf.png\", 20).colour, [\"red\", \"green\", \"white\", "
            "\"black\"]));",
            {{"mixture", &ColourMixture::mixture,
              "The mixture, or the one with the nearest colour if none shows the colour"},
             {"difference", &ColourMixture::difference,
              "Visible difference: the distance in CIE L*a*b* (Delta E of 1976)", Interval(0, 1e6)}}};
  }

  bool complete(const Reader& reader) {
    constexpr size_t most = ink::ColourMixer::most_materials;
    if (materials.empty())
      return reader.refuse("colour_mixture needs a material", "write for example [\"red\", \"white\"]");
    if (materials.size() > most)
      return reader.refuse("colour_mixture has " + std::to_string(materials.size()) + " materials",
                           "give " + std::to_string(most) + " at most");
    for (const MaterialName& name : materials) {
      const auto& [red, green, blue, alpha] = name.material->colour;
      colours.push_back({linear_of_srgb(red / 255.0), linear_of_srgb(green / 255.0), linear_of_srgb(blue / 255.0)});
    }
    table = make_colour_table(ink::ColourMixer(colours), colours.size());
    return true;
  }

  Composition mixture(const Ask& ask) const {
    return by_shares(ask, materials, shares(ask),
                     "the colour of colour_mixture is no finite number, only its first material is taken there");
  }

  Field difference(const Ask& ask) const {
    const std::vector<Field> each_share = shares(ask);
    Colour shown = each(colour_at(wanted, ask.p), [&](Field) { return ask.p.constant(0); });
    for (size_t n = 0; n < colours.size(); ++n)
      for (int axis = 0; axis < 3; ++axis) {
        Field& light = shown[static_cast<size_t>(axis)];
        light = light + each_share[n] * colours[n][axis];
      }
    const Colour p = lab_of_linear(shown), q = lab_of_linear(each(colour_at(wanted, ask.p), light_of_srgb));
    return length(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }

 private:
  std::vector<Field> shares(const Ask& ask) const {
    const Colour at = colour_at(wanted, ask.p);
    std::vector<Field> fields;
    for (size_t n = 0; n < colours.size(); ++n)
      fields.push_back(ask.p.builder().source(table, static_cast<int>(n), at[0], at[1], at[2]));
    return fields;
  }
};

struct InkMixture {
  Numbers3 wanted;
  FilePath profile;
  SharedList<MaterialName> materials;
  Choice intent = "relative";
  bool black_point = true;
  size_t inks = 0;  // set when the node is made, like the table
  program::SourceField table;

  static Spec<InkMixture> spec() {
    return {
        "ink_mixture",
        "The mixture of inks that shows a colour by an ICC output profile of the machine.",
        {{"colour", &InkMixture::wanted, "Red, green and blue from 0 to 1 (sRGB)", required()},
         {"profile", &InkMixture::profile,
          "An ICC output profile; relative to the script, then to the working directory", required()},
         {"materials", &InkMixture::materials,
          "The material of each of the profile's inks, in its order (CMYK: cyan, magenta, yellow, black); then the one "
          "that takes what they leave, white",
          required()},
         {"intent", &InkMixture::intent, "Rule for colours that the inks do not show", one_of(ink::intent_names())},
         {"black_point", &InkMixture::black_point, "Map black to the darkest that the inks show"}},
        no_inputs,
        "cube(20, ink_mixture(texture(\"models/leaf.png\", 20).colour, \"models/made_up_inks.icc\", [\"cyan\", "
        "\"magenta\", \"yellow\", \"white\"]));",
        {{"mixture", &InkMixture::mixture,
          "The mixture. Shares of inks that add up to more than 1 are divided by their sum"},
         {"difference", &InkMixture::difference, "Visible difference from the colour (CIEDE2000)", Interval(0, 1e6)}}};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("ICC profiles cannot be read here");
    InkRequest request{profile, intent, black_point};
    const auto made = reader.loader->source(request, reader);
    profile = request.profile;
    if (!made) return false;
    inks = made->inks;
    if (materials.size() != inks + 1)
      return reader.refuse("the profile has " + std::to_string(inks) + " inks (" + made->space + "), and " +
                               std::to_string(materials.size()) + " materials are given",
                           "give one for each ink, and last the one that takes what they leave");
    table = make_colour_source(made->values);
    return true;
  }

  Composition mixture(const Ask& ask) const {
    std::vector<Field> shares;
    Field rest = ask.p.constant(1);
    for (size_t n = 0; n < inks; ++n) {
      shares.push_back(channel(ask, n));
      rest = rest - shares.back();
    }
    shares.push_back(max(rest, 0.0));
    return by_shares(ask, materials, shares,
                     "the colour of ink_mixture is no finite number, only its first material is taken there");
  }

  Field difference(const Ask& ask) const { return channel(ask, inks); }

 private:
  Field channel(const Ask& ask, size_t n) const {
    const Colour at = colour_at(wanted, ask.p);
    return ask.p.builder().source(table, static_cast<int>(n), at[0], at[1], at[2]);
  }
};

}  // namespace

void add_value_colours(Registry& registry) {
  registry.add<ColourValue, ColourDifference, Texture, MixMany, ColourMixture, InkMixture, SurfaceColour>("values");
}

}  // namespace ombre::nodes

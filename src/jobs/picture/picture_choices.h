// The options of pictures.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/text.h"
#include "jobs/common/job_options.h"
#include "jobs/picture/picture.h"
#include "questions/colour_map.h"

namespace ombre::compile {

// These functions parse texts of options, as in options/option_values.h.
std::array<int64_t, 2> parse_size(const std::string& text, const std::string& name);  // "800x600"
std::array<double, 2> parse_angles(const std::string& text, const std::string& name);
render::Background parse_background(const std::string& text, const std::string& name);
CutRequest parse_cut_option(const std::string& text, const std::string& name);
SliceView parse_slice_option(const std::string& text, const std::string& name);
std::pair<std::string, double> parse_opacity(const std::string& text, const std::string& name);  // "clear=0.2"

inline constexpr options::Kind<std::array<int64_t, 2>> size_kind{"size in pixels", parse_size};
inline constexpr options::Kind<std::array<double, 2>> angles_kind{"2 numbers", parse_angles};
inline constexpr options::Kind<render::Background> colour_kind{"colour", parse_background};
inline constexpr options::Kind<CutRequest> cut_kind{"planes", parse_cut_option};
inline constexpr options::Kind<SliceView> plane_kind{"plane", parse_slice_option};
inline constexpr options::Kind<std::pair<std::string, double>> opacity_kind{"material with number", parse_opacity};

struct PictureChoices {
  DesignOptions design;
  std::string output;
  std::array<int64_t, 2> size{800, 600};
  std::string view = "iso";
  std::optional<std::array<double, 2>> angles_deg;  // azimuth, elevation
  double perspective_deg = 0, zoom = 1, deform = 0;
  int step = 0;  // number, from 1, of a step of results; 0: the last
  std::vector<CutRequest> cuts;
  std::optional<Box> box;
  std::vector<std::pair<std::string, double>> opacity;  // by the name of the material
  std::string by;
  std::optional<Interval> range;
  std::string palette;
  render::Background background;
  int samples = 2, frames = 1;
  WorkOptions work{0, 2 * usual_memory};
  std::optional<SliceView> slice;
  bool axes = false, scale_bar = false, legend = false, annotate = false;
  std::optional<Divided> outlines, names;
  std::string font;
  bool force = false, resume = false;
  std::vector<std::string> settings;  // all options that were set: "--size=800x600"

  static const options::Spec<PictureChoices>& options() {
    using namespace options;
    using P = PictureChoices;
    static const options::Spec<P> rows{
        group(&P::design),
        option("-o,--output", &P::output, kind::file,
               "The picture to write, - for stdout (default: the design's name with .png); with --frames also a "
               "folder, or a\n"
               ".zip archive",
               "FILE"),
        option("--size", &P::size, size_kind, "Size of the picture in pixels (default 800x600)", "WxH"),
        choice("--view", &P::view, render::view_names(),
               "Direction of view: iso (default), front, back, left, right, top or bottom", "NAME"),
        option("--from", &P::angles_deg, angles_kind,
               "Direction of view by angles: azimuth (0 in front, 90 from the right), elevation", "AZ,EL")
            .excludes({"--view"}),
        option("--perspective", &P::perspective_deg, kind::number,
               "Vertical field of view; degrees (default 0: parallel rays)", "DEG")
            .between(0, 120),
        option("--zoom", &P::zoom, kind::number, "Enlarge the middle of the picture", "X").between(0.01, 1000),
        options::list("--cut", &P::cuts, cut_kind,
                      "Cut along a plane: x=0 takes away the side of the eye, x>0 or x<0 that side; x>0,y<0 takes a "
                      "wedge out; may be repeated",
                      "PLANE"),
        option("--box", &P::box, kind::box, "Show only the inside of this box; mm", "X0,Y0,Z0,X1,Y1,Z1"),
        options::list("--opacity", &P::opacity, opacity_kind,
                      "Opacity of a material, 0 (clear) to 1, instead of its own; may be repeated", "MATERIAL=N"),
        option(
            "--by,--colour-by,--color-by", &P::by, kind::text,
            "Colour by a material's fraction or an attribute, from dark blue (least) to yellow, or\nby parts, each in "
            "a colour of its own",
            "NAME|parts"),
        option("--range", &P::range, kind::range,
               "Values of the first and the last colour (default: the range of the design)", "LO,HI")
            .needs("--by"),
        choice("--palette", &P::palette, palette_names(),
               "Colours from the least value to the greatest: " + join(palette_names(), ", "), "NAME")
            .needs("--by"),
        option("--deform", &P::deform, kind::number,
               "Factor of the displacement that moves the mesh of results (.vtu, .xdmf, .frd; default 0)", "X"),
        option("--step", &P::step, kind::whole,
               "Number of one of several steps of results, counted from 1; without it the last", "N")
            .between(1, 1000000000),
        option("--background", &P::background, colour_kind,
               "Colour of the background: white (default), black, gray, transparent or #rrggbb", "COLOUR"),
        option("--aa", &P::samples, kind::whole, "Rays along the edge of a pixel, which smooth edges (default 2)", "N")
            .between(1, 8),
        option("--frames", &P::frames, kind::whole, "Pictures all around the part, numbered (default 1)", "N")
            .between(1, 3600),
        group(&P::work, WorkOptions::options("Most memory for rays, pixels and stages (default 4G)")),
        option("--slice", &P::slice, plane_kind,
               "Show the plane x, y or z = mm instead of a view: flat, in the materials' colours", "PLANE")
            .excludes({"--view", "--from", "--perspective", "--opacity", "--frames"}),
        flag("--axes", &P::axes, "Draw the directions x, y and z in the corner"),
        flag("--scale-bar", &P::scale_bar, "Draw a length in mm; in perspective it holds at the part's middle"),
        flag("--legend", &P::legend, "List the materials and their colours"),
        flag("--annotate", &P::annotate, "Draw axes, scale bar and legend"),
        choice("--outlines", &P::outlines, {"parts", "materials"},
               "Draw the borders between parts or materials, as they are seen", "parts|materials"),
        choice("--names", &P::names, {"parts", "materials"}, "Write the names of parts or materials on them",
               "parts|materials"),
        option("--font", &P::font, kind::file,
               "Font of the labels (default: DejaVu Sans, or another font of the system)", "FILE"),
        flag("--force", &P::force, "Replace existing pictures"),
        flag("--resume", &P::resume, "Go on with the frames in the folder of -o")
            .needs("--frames")
            .excludes({"--force"})};
    static const options::Spec<P> spec = recorded(rows, &P::settings);
    return spec;
  }
  PictureRequest request() const;
};

}  // namespace ombre::compile

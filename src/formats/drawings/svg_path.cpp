#include "formats/drawings/svg_path.h"

#include <cctype>
#include <charconv>

#include "formats/drawings/arcs.h"

namespace ombre::formats {
namespace {

constexpr int chords_per_curve = 20;
constexpr size_t most_path_points = 10'000'000;

void skip_blanks(std::string_view& text) {
  while (!text.empty() && (std::isspace(static_cast<unsigned char>(text[0])) || text[0] == ',')) text.remove_prefix(1);
}

bool read_number(std::string_view& text, double& number) {
  skip_blanks(text);
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return false;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return true;
}

double angle_of_vector(Vec2 v) { return math::atan2(v.y, v.x); }

class PathReader {
 public:
  PathReader(std::string_view data, int chords) : text_(data), chords_(chords) {}

  SvgPath read() {
    while (path_.error.empty()) {
      skip_blanks(text_);
      if (text_.empty()) break;
      if (std::isalpha(static_cast<unsigned char>(text_[0]))) {
        command_ = text_[0];
        text_.remove_prefix(1);
      } else if (command_ == 0) {
        path_.error = "the path does not begin with a command";
        break;
      }
      step();
    }
    return std::move(path_);
  }

 private:
  bool is_relative() const { return std::islower(static_cast<unsigned char>(command_)) != 0; }
  Ring& ring() {
    if (path_.rings.empty() || is_closed_) begin_ring(start_);
    is_closed_ = false;
    return path_.rings.back();
  }

  void begin_ring(Vec2 at) {
    path_.rings.push_back({at});
    path_.is_closed.push_back(false);
  }

  double number() {
    double value = 0;
    if (path_.error.empty() && !read_number(text_, value))
      path_.error = std::string("a number is missing after '") + command_ + '\'';
    return value;
  }
  // Reads a flag of an arc, which may directly precede the next number.
  double flag() {
    skip_blanks(text_);
    if (text_.starts_with('0') || text_.starts_with('1')) {
      const double value = text_[0] - '0';
      text_.remove_prefix(1);
      return value;
    }
    path_.error = "a flag of an arc is neither 0 nor 1";
    return 0;
  }
  Vec2 point() {
    const double x = number(), y = number();
    return is_relative() ? at_ + Vec2{x, y} : Vec2{x, y};
  }

  void line_to(Vec2 to) {
    ring().push_back(to);
    at_ = to;
    if (++points_ > most_path_points) path_.error = "the path has more than ten million points";
  }

  void step();
  void cubic(Vec2 first, Vec2 second, Vec2 to);
  void quadratic(Vec2 by, Vec2 to) {
    const Vec2 from = at_;
    cubic(from + (2.0 / 3) * (by - from), to + (2.0 / 3) * (by - to), to);
    pull_ = by;
  }
  void arc();

  std::string_view text_;
  int chords_;
  char command_ = 0, before_ = 0;
  Vec2 at_, start_, pull_;  // the last control point of a curve
  bool is_closed_ = false;
  size_t points_ = 0;
  SvgPath path_;
};

void PathReader::cubic(Vec2 first, Vec2 second, Vec2 to) {
  const Vec2 from = at_;
  for (int n = 1; n <= chords_per_curve; ++n) {
    const double t = static_cast<double>(n) / chords_per_curve, s = 1 - t;
    line_to(n == chords_per_curve
                ? to
                : (s * s * s) * from + (3 * s * s * t) * first + (3 * s * t * t) * second + (t * t * t) * to);
  }
  pull_ = second;
}

// Converts an arc from its ends to its center, by the SVG specification, implementation notes, section B.2.4.
void PathReader::arc() {
  double rx = std::abs(number()), ry = std::abs(number());
  const double tilt = number() * math::degree;
  const bool is_large = flag() != 0, is_clockwise = flag() != 0;
  const Vec2 from = at_, to = point();
  if (!path_.error.empty()) return;
  if (rx == 0 || ry == 0 || from == to) return line_to(to);
  const double c = math::cos(tilt), s = math::sin(tilt);
  const Vec2 half = 0.5 * (from - to);
  const Vec2 p{c * half.x + s * half.y, -s * half.x + c * half.y};
  const double excess = p.x * p.x / (rx * rx) + p.y * p.y / (ry * ry);
  if (excess > 1) {
    rx *= std::sqrt(excess);
    ry *= std::sqrt(excess);
  }
  const double under = rx * rx * p.y * p.y + ry * ry * p.x * p.x;
  const double factor = std::sqrt(std::max(0.0, rx * rx * ry * ry / under - 1)) * (is_large == is_clockwise ? -1 : 1);
  const Vec2 q{factor * rx * p.y / ry, -factor * ry * p.x / rx};
  const Vec2 center = Vec2{c * q.x - s * q.y, s * q.x + c * q.y} + 0.5 * (from + to);
  const double begin = angle_of_vector({(p.x - q.x) / rx, (p.y - q.y) / ry});
  double turn = angle_of_vector({(-p.x - q.x) / rx, (-p.y - q.y) / ry}) - begin;
  if (is_clockwise && turn < 0) turn += 2 * std::numbers::pi;
  if (!is_clockwise && turn > 0) turn -= 2 * std::numbers::pi;
  Ring points;
  append_arc({center, {rx * c, rx * s}, {-ry * s, ry * c}, begin, turn}, chords_, points);
  for (size_t n = 1; n + 1 < points.size(); ++n) line_to(points[n]);
  line_to(to);
}

void PathReader::step() {
  const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command_)));
  const auto mirrored = [&](const char* kinds) {
    const bool follows = before_ != 0 && std::string_view(kinds).find(before_) != std::string_view::npos;
    return follows ? 2 * at_ - pull_ : at_;
  };
  switch (kind) {
    case 'M':
      at_ = start_ = point();
      begin_ring(at_);
      is_closed_ = false;
      command_ = is_relative() ? 'l' : 'L';  // further points are lines
      break;
    case 'L':
      line_to(point());
      break;
    case 'H': {
      const double x = number();
      line_to({is_relative() ? at_.x + x : x, at_.y});
      break;
    }
    case 'V': {
      const double y = number();
      line_to({at_.x, is_relative() ? at_.y + y : y});
      break;
    }
    case 'C': {
      const Vec2 first = point(), second = point();
      cubic(first, second, point());
      break;
    }
    case 'S': {
      const Vec2 first = mirrored("CS"), second = point();
      cubic(first, second, point());
      break;
    }
    case 'Q': {
      const Vec2 by = point();
      quadratic(by, point());
      break;
    }
    case 'T':
      quadratic(mirrored("QT"), point());
      break;
    case 'A':
      arc();
      break;
    case 'Z':
      at_ = start_;
      is_closed_ = true;
      if (!path_.is_closed.empty()) path_.is_closed.back() = true;
      command_ = 0;
      break;
    default:
      path_.error = std::string("'") + command_ + "' is no command of a path";
  }
  before_ = kind;
}

}  // namespace

std::vector<double> read_svg_numbers(std::string_view& text, size_t most) {
  std::vector<double> numbers;
  double number = 0;
  while (numbers.size() < most && read_number(text, number)) numbers.push_back(number);
  return numbers;
}

SvgPath read_svg_path(std::string_view data, int chords_per_turn) { return PathReader(data, chords_per_turn).read(); }

}  // namespace ombre::formats

#include "jobs/fea/tetra_job.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/math/point_text.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "import/fields/triangle_distance.h"
#include "jobs/fea/sharp_edges.h"
#include "jobs/mesh/mesh_job.h"
#include "questions/build.h"
#include "questions/design_stages.h"
#include "questions/question.h"
#include "questions/sampler.h"
#include "questions/unusable_mixtures.h"
#include "solids/tetrahedra.h"
#include "voxel/quantise.h"

namespace ombre::compile {
namespace {

// Cells and tolerance of the surface whose sharp edges count, as shares of the least element size, or of an eighth of
// the part if that is less; and the greatest number of cells along an axis.
constexpr double cell_share = 0.5, tolerance_share = 0.01, most_cells_along = 500, least_sizes_along = 8;
// Measured: the mean volume of a tetrahedron as a share of the cube of the size, and the number of questions for its
// region.
constexpr double volume_of_cube = 0.115, questions_of_element = 60;
constexpr double most_questions = 400;  // questions for each expected element after which refinement counts as endless
constexpr double bytes_of_element = 700;
// Elements beside edges are small and grow with the distance by this share; the mesher may then ask this many times
// more often.
constexpr double growth_from_edges = 0.3;
constexpr uint64_t more_questions = 8;
// Elements are at most as large as the gaps between edges. Edges that are far closer together than the element size are
// left out instead.
constexpr double most_of_gap = 1, least_share_of_size = 0.2;
// Distance, as a share of the size, between faces and a surface whose edges are cut off.
constexpr double rough_share = 0.2;
constexpr double least_share = 0.9;  // share of the surface's volume that tetrahedra must fill
constexpr double draws = 16777216;   // 2^24

// Returns the box around the design, with room for the mesher.
Box with_room(const Box& box) {
  const Vec3 size = box.size();
  return box.expanded(0.05 * std::max({size.x, size.y, size.z}));
}

double distance_to(const std::vector<solids::Polyline>& lines, Vec3 p) {
  double squared = std::numeric_limits<double>::infinity();
  for (const solids::Polyline& line : lines)
    for (size_t n = 0; n + 1 < line.size(); ++n)
      squared = std::min(squared, importing::squared_distance_to_segment(p, line[n], line[n + 1]));
  return std::sqrt(squared);
}

// Returns the least distance of lines from others that do not end where they do.
double least_gap(const std::vector<solids::Polyline>& lines, const std::vector<solids::Polyline>& all) {
  double least = std::numeric_limits<double>::infinity();
  for (const solids::Polyline& line : lines) {
    const auto meets = [&](const solids::Polyline& other) {
      return other.front() == line.front() || other.front() == line.back() || other.back() == line.front() ||
             other.back() == line.back();
    };
    std::vector<solids::Polyline> others;
    std::ranges::remove_copy_if(all, std::back_inserter(others), meets);
    for (const Vec3 p : line) least = std::min(least, distance_to(others, p));
  }
  return least;
}

class TetraMaker {
 public:
  TetraMaker(const LoadedPtr& loaded, const fea::Study& study, const TetraRequest& request, Diagnostics& diagnostics,
             Progress* progress, const StopFlag* stop)
      : loaded_(loaded),
        study_(study),
        request_(request),
        diagnostics_(diagnostics),
        progress_(progress),
        stop_(stop) {}

  std::optional<TetraModel> make() {
    const auto box = request_.period ? request_.period : design_box(loaded_->design, diagnostics_);
    if (!box) return std::nullopt;
    const Vec3 extent = box->size();
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double size_mm = std::min(request_.size.least_mm, longest / least_sizes_along);
    tolerance_mm_ = tolerance_share * size_mm;
    cell_mm_ = std::max(cell_share * size_mm, longest / most_cells_along);
    design_ = with_stages(for_tolerance(loaded_->design, tolerance_mm_), loan());
    auto size = ElementSize::build(design_, *box, request_.size, diagnostics_);
    if (!size || !find_regions(*box) || !check_count(*size, *box)) return std::nullopt;
    if (!request_.period && !find_surface()) return std::nullopt;
    TetraModel made;
    for (const RegionBody& body : surface_) made.surface_mm3 += body.volume_mm3;
    take(request_.period ? repeating_mesh(*size, *box) : mesh(*size, *box, made.surface_mm3), made);
    if (made.model.mesh.nodes.empty())
      return fail("no tetrahedron lies inside the design", "choose a smaller " + spelled::option("--size"));
    if (!add_fields(made.model)) return std::nullopt;
    const ElementMaterials found = materials(made.model);
    if (!has_numbers(made.model, found)) return std::nullopt;
    auto sections = make_sections(*loaded_, study_, request_.sections, found, diagnostics_);
    if (!sections) return std::nullopt;
    made.model.sections = std::move(sections->sections);
    made.model.section_of = std::move(sections->section_of);
    made.quality = fea::quality_of(made.model.mesh);
    if (request_.quadratic) made.model.mesh = fea::with_middle_nodes(made.model.mesh);
    return made;
  }

 private:
  std::nullopt_t fail(const std::string& message, const Phrase& hint) {
    diagnostics_.error(Code::not_meshed, {loaded_->source, 0, 0}, message, hint);
    return std::nullopt;
  }

  StageLoan loan() const {
    StageLoan loan;
    loan.threads = request_.sections.threads;
    loan.progress = progress_;
    loan.stop = stop_;
    return loan;
  }

  bool find_regions(const Box& box) {
    RegionRequest regions;
    regions.by_material = request_.by_material;
    auto program = build_regions(design_, box, regions, diagnostics_);
    if (!program) return false;
    stages_of(design_)->prepare(loan());
    labels_ = PointValues(std::move(program->partition.label), with_room(box), request_.size.least_mm);
    regions_ = std::move(program->regions);
    return true;
  }

  uint32_t region_at(Vec3 p) {
    const auto label = static_cast<uint32_t>(labels_.at(p));
    return label > 0 && is_void(regions_[label - 1]) ? 0 : label;
  }

  // Estimates the count by samples in the middles of a coarse grid's cells.
  TetraPlan plan(ElementSize& size, const Box& box) {
    constexpr int cells_along = 32;
    const Vec3 extent = box.size(), cell = (1.0 / cells_along) * extent;
    const double volume = cell.x * cell.y * cell.z;
    TetraPlan plan;
    for (int k = 0; k < cells_along; ++k)
      for (int j = 0; j < cells_along; ++j)
        for (int i = 0; i < cells_along; ++i) {
          const Vec3 p = box.lo + Vec3{(i + 0.5) * cell.x, (j + 0.5) * cell.y, (k + 0.5) * cell.z};
          if (region_at(p) != 0) plan.elements += volume / (volume_of_cube * std::pow(size.at(p), 3));
        }
    plan.memory_bytes = plan.elements * bytes_of_element * (request_.quadratic ? 1.3 : 1);
    return plan;
  }

  bool check_count(ElementSize& size, const Box& box) {
    plan_ = plan(size, box);
    if (request_.announce) request_.announce(plan_);
    const auto allowed = static_cast<double>(request_.memory_bytes);
    if (allowed > 0 && plan_.memory_bytes > allowed)
      throw Error(Code::memory, "about " + format_rounded(plan_.elements, 3) + " tetrahedra take about " +
                                    format_bytes(plan_.memory_bytes) + " of memory, more than the " +
                                    format_bytes(allowed) + " allowed; choose a larger " + spelled::option("--size") +
                                    ", or more " + spelled::option("--memory"));
    return true;
  }

  bool find_surface() {
    MeshRequest mesh;
    mesh.by_material = request_.by_material;
    mesh.tolerance_mm = tolerance_mm_;
    mesh.cell_mm = cell_mm_;
    mesh.threads = request_.sections.threads;
    mesh.memory_bytes = request_.memory_bytes;
    auto meshed = mesh_design(*loaded_, mesh, diagnostics_, progress_, stop_);
    if (!meshed) return false;
    surface_ = std::move(meshed->bodies);
    if (!surface_.empty()) return true;
    fail("the design has no solid that cells of " + format_rounded(cell_mm_, 3) + " mm could see",
         "choose a smaller " + spelled::option("--size"));
    return false;
  }

  solids::TetrahedraRequest request_in(const Box& box, ElementSize& size) {
    solids::TetrahedraRequest wanted;
    wanted.box = box;
    wanted.region = [this](Vec3 p) {
      count_question();
      return region_at(p);
    };
    wanted.size_mm = [&size](Vec3 p) { return size.at(p); };
    wanted.least_size_mm = size.least_mm();
    wanted.most_questions = static_cast<uint64_t>(most_questions * (plan_.elements + 5000));
    if (request_.memory_bytes > 0) wanted.memory_bytes = request_.memory_bytes;
    wanted.stop = stop_;
    // The mesher asks in a process of its own, on one thread.
    StageLoan alone = loan();
    alone.threads = 1;
    stages_of(design_)->lend(alone);
    if (progress_) progress_->preparing("tetrahedra", {0, 1});
    return wanted;
  }

  solids::Tetrahedra repeating_mesh(ElementSize& size, const Box& box) {
    solids::TetrahedraRequest wanted = request_in(box, size);
    wanted.is_periodic = true;
    return solids::make_tetrahedra(wanted);
  }

  // Makes the mesh, and repeats it if that fails: with points on all faces if much of the volume was not found; without
  // sharp edges if these lie so close together or are so rough that it does not end.
  solids::Tetrahedra mesh(ElementSize& size, const Box& box, double volume_mm3) {
    std::vector<surface::Body> bodies;
    for (const RegionBody& body : surface_) bodies.push_back(body.body);
    SharpEdges edges = find_sharp_edges(bodies, 2 * tolerance_mm_, size.least_mm());
    solids::TetrahedraRequest wanted = request_in(with_room(box), size);
    wanted.sharp_edges = std::move(edges.lines);
    wanted.fixed_points = std::move(edges.smooth_points);
    const auto make = [&] {
      questions_ = 0;
      return solids::make_tetrahedra(wanted);
    };
    const auto add_face_points = [&] {
      wanted.fixed_points.insert(wanted.fixed_points.end(), edges.face_points.begin(), edges.face_points.end());
    };
    solids::Tetrahedra made;
    try {
      made = make();
    } catch (const Error& failure) {
      if (wanted.sharp_edges.empty()) throw;
      wanted.sharp_edges.clear();
      wanted.distance_share = rough_share;
      add_face_points();
      made = make();
      diagnostics_.warning({loaded_->source, 0, 0},
                           "sharp edges are cut off by up to " + format_rounded(rough_share * size.least_mm(), 2) +
                               " mm, since with them " + failure.what(),
                           "choose a smaller " + spelled::option("--size") + ", or bricks");
      return made;
    }
    if (!(volume_of(made) > least_share * volume_mm3)) {
      add_face_points();
      made = make();
    }
    if (!made.edges_left_out.empty()) keep_edges(wanted, size, made);
    warn_of_left_out(made.edges_left_out);
    return made;
  }

  // Thin plates keep their edges, although these lie closer together than elements are large; elements beside them are
  // smaller.
  void keep_edges(solids::TetrahedraRequest wanted, ElementSize& size, solids::Tetrahedra& made) {
    const std::vector<solids::Polyline> edges = made.edges_left_out;
    const double share = most_of_gap * least_gap(edges, wanted.sharp_edges) / size.least_mm();
    if (share < least_share_of_size || share >= 1) return;
    wanted.size_mm = [&](Vec3 p) {
      const double usual = size.at(p);
      return std::min(usual, share * usual + growth_from_edges * distance_to(edges, p));
    };
    wanted.least_size_mm = share * size.least_mm();
    wanted.most_questions *= more_questions;
    questions_ = 0;
    solids::Tetrahedra finer = solids::make_tetrahedra(wanted);
    if (!finer.edges_left_out.empty()) return;
    diagnostics_.warning({loaded_->source, 0, 0},
                         "elements are down to " + format_rounded(wanted.least_size_mm, 3) +
                             " mm small beside sharp edges that lie closer together than their size",
                         "choose a smaller " + spelled::option("--size") + ", or bricks");
    made = std::move(finer);
  }

  void warn_of_left_out(const std::vector<solids::Polyline>& edges) {
    if (edges.empty()) return;
    const bool is_one = edges.size() == 1;
    diagnostics_.warning({loaded_->source, 0, 0},
                         (is_one ? "a sharp edge is" : std::to_string(edges.size()) + " sharp edges are") +
                             " cut off, since others lie too close for elements of this size; " +
                             (is_one ? "it" : "the first") + " goes through " +
                             format_point(edges[0][edges[0].size() / 2]),
                         "choose a smaller " + spelled::option("--size") + ", or bricks");
  }

  static double volume_of(const solids::Tetrahedra& made) {
    double six_volumes = 0;
    for (const auto& n : made.nodes) {
      const Vec3 a = made.points[n[0]];
      six_volumes += dot(cross(made.points[n[1]] - a, made.points[n[2]] - a), made.points[n[3]] - a);
    }
    return six_volumes / 6;
  }

  void count_question() {
    constexpr uint64_t check_interval = 1024;
    if (++questions_ % check_interval != 0) return;
    if (stop_ && stop_->requested()) throw Cancelled();
    if (!progress_) return;
    const auto total = static_cast<uint64_t>(plan_.elements * questions_of_element) + check_interval;
    progress_->preparing("tetrahedra", {std::min(questions_, total - 1), total});
  }

  // Takes the tetrahedra whose region is not void, with their regions.
  void take(const solids::Tetrahedra& tetrahedra, TetraModel& made) {
    made.model.mesh.kind = fea::ElementKind::c3d4;
    made.model.mesh.points = tetrahedra.points;
    for (size_t n = 0; n < tetrahedra.nodes.size(); ++n) {
      made.model.mesh.nodes.insert(made.model.mesh.nodes.end(), tetrahedra.nodes[n].begin(), tetrahedra.nodes[n].end());
      region_of_.push_back(tetrahedra.regions[n]);
    }
  }

  static std::vector<Vec3> middles_of(const fea::MeshModel& model) {
    const fea::MeshView view(model.mesh);
    std::vector<Vec3> middles;
    for (size_t n = 0; n < view.count(); ++n) middles.push_back(view.centroid(n));
    return middles;
  }

  bool has_numbers(const fea::MeshModel& model, const ElementMaterials& found) {
    const std::vector<Vec3> middles = middles_of(model);
    return check_mixtures(design_, {middles, found.drawn}, request_.sections.threads, stop_, diagnostics_);
  }

  // Adds fractions without void, whose sum is one, and attributes, at the middles of elements.
  bool add_fields(fea::MeshModel& model) {
    SampleQuery query;
    query.fractions = true;
    query.attributes = all_attribute_parts(design_);
    const auto sampler = Sampler::build(design_, query, diagnostics_);
    if (!sampler) return false;
    const std::vector<Vec3> middles = middles_of(model);
    std::vector<std::vector<double>> values(sampler->columns().size(), std::vector<double>(middles.size()));
    std::vector<double*> columns;
    for (auto& column : values) columns.push_back(column.data());
    sampler->sample(middles, columns, request_.sections.threads, stop_);
    normalise(*sampler, values);
    for (size_t c = 0; c < values.size(); ++c) {
      const Sampler::Column& column = sampler->columns()[c];
      const bool is_fraction = column.kind == Sampler::Column::Kind::fraction;
      if (is_fraction && column.material == 0) continue;
      if (is_fraction) fractions_.push_back(column.material);
      std::string unit = is_fraction ? "" : value_unit(design_, column.name);
      if (unit == "1") unit = "";
      fea::ValueField field{is_fraction ? std::string(fraction_prefix) + column.name : column.name, unit, 1, {}};
      for (const double value : values[c]) field.values.push_back(static_cast<float>(value));
      model.fields.push_back(std::move(field));
    }
    return true;
  }

  static void normalise(const Sampler& sampler, std::vector<std::vector<double>>& values) {
    for (size_t n = 0; n < values[0].size(); ++n) {
      double sum = 0;
      const auto each = [&](const auto& body) {
        for (size_t c = 0; c < values.size(); ++c)
          if (sampler.columns()[c].kind == Sampler::Column::Kind::fraction && sampler.columns()[c].material != 0)
            body(values[c][n]);
      };
      each([&](double& share) {
        if (!(share > 0)) share = 0;
        sum += share;
      });
      each([&](double& share) { share = sum > 0 ? share / sum : 0; });
    }
  }

  // Draws a material at the middle of each element, as the paper does; with regions by material, takes that of the
  // region.
  ElementMaterials materials(const fea::MeshModel& model) {
    ElementMaterials found{fea::MeshView(model.mesh).count(), {}, fractions_, &model.fields};
    const uint32_t row = voxel::row_hash(request_.seed, 0, 0);
    for (size_t n = 0; n < found.count; ++n) {
      if (request_.by_material) {
        found.drawn.push_back(*regions_[region_of_[n] - 1].material);
        continue;
      }
      const double draw = voxel::hashed_draw(row, static_cast<int64_t>(n)) / draws;
      double sum = 0;
      size_t chosen = 0;
      for (size_t f = 0; f < fractions_.size(); ++f) {
        if (model.fields[f].values[n] > 0) chosen = f;
        sum += static_cast<double>(model.fields[f].values[n]);
        if (draw < sum) break;
      }
      found.drawn.push_back(fractions_[chosen]);
    }
    return found;
  }

  const LoadedPtr& loaded_;
  const fea::Study& study_;
  const TetraRequest& request_;
  Diagnostics& diagnostics_;
  Progress* progress_;
  const StopFlag* stop_;
  double tolerance_mm_ = 0, cell_mm_ = 0;
  design::Design design_;
  PointValues labels_;
  std::vector<Region> regions_;
  std::vector<RegionBody> surface_;
  TetraPlan plan_;
  uint64_t questions_ = 0;
  std::vector<uint32_t> region_of_;    // region of each element
  std::vector<MaterialId> fractions_;  // materials whose fractions are the first fields
};

}  // namespace

std::optional<TetraModel> tetra_model(const LoadedPtr& loaded, const fea::Study& study, const TetraRequest& request,
                                      Diagnostics& diagnostics, Progress* progress, const StopFlag* stop) {
  return TetraMaker(loaded, study, request, diagnostics, progress, stop).make();
}

}  // namespace ombre::compile

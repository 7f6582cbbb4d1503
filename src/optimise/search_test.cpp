// Tests searches on functions whose best points are known.
#include "optimise/search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/text/error.h"
#include "optimise/chart.h"
#include "optimise/ranking.h"

namespace ombre::optimise {
namespace {

struct Record {
  std::vector<Point> points;
  std::vector<Outcome> outcomes;

  const Point& best() const { return points[front_of(outcomes).front()]; }
};

Record search_with(const std::string& method, size_t evaluations, size_t objectives, size_t constraints, Point start,
                   const std::function<Outcome(const Point&)>& function) {
  Record record;
  Problem problem{std::move(start), objectives, constraints, [&](const std::vector<Point>& points) {
                    std::vector<Outcome> outcomes;
                    for (const Point& point : points) {
                      record.points.push_back(point);
                      outcomes.push_back(function(point));
                    }
                    record.outcomes.insert(record.outcomes.end(), outcomes.begin(), outcomes.end());
                    return outcomes;
                  }};
  SearchOptions options;
  options.method = method;
  options.evaluations = evaluations;
  search(problem, options);
  return record;
}

// The square of the distance to (0.9, 0.4); under the constraint x + y <= 1 the nearest point is (0.75, 0.25).
Outcome nearest(const Point& p) {
  return {false, {std::pow(p[0] - 0.9, 2) + std::pow(p[1] - 0.4, 2)}, {p[0] + p[1] - 1}};
}

bool has(const char* method) { return is_built(*find_method(method)); }

void expect_nearest(const char* method, size_t evaluations, double tolerance) {
  if (!has(method)) GTEST_SKIP();
  const Record record = search_with(method, evaluations, 1, 1, {0.2, 0.2}, nearest);
  EXPECT_NEAR(record.best()[0], 0.75, tolerance);
  EXPECT_NEAR(record.best()[1], 0.25, tolerance);
}

TEST(Search, CobylaFindsTheBestPointOnAConstraint) { expect_nearest("cobyla", 200, 1e-3); }
TEST(Search, CmaesFindsTheBestPointOnAConstraint) { expect_nearest("cmaes", 2000, 1e-2); }

TEST(Search, BobyqaFindsTheLowestPointOfRosenbrocksValley) {
  if (!has("bobyqa")) GTEST_SKIP();
  const auto valley = [](const Point& p) {
    const double x = 4 * p[0] - 2, y = 4 * p[1] - 2;
    return Outcome{false, {std::pow(1 - x, 2) + 100 * std::pow(y - x * x, 2)}, {}};
  };
  const Record record = search_with("bobyqa", 400, 1, 0, {0.2, 0.75}, valley);
  EXPECT_NEAR(record.best()[0], 0.75, 2e-3);
  EXPECT_NEAR(record.best()[1], 0.75, 4e-3);
}

TEST(Search, DirectLeavesLocalMinima) {
  if (!has("direct")) GTEST_SKIP();
  const auto waves = [](const Point& p) {
    return Outcome{false, {std::pow(p[0] - 0.7, 2) - 0.2 * std::cos(40 * (p[0] - 0.7))}, {}};
  };
  EXPECT_NEAR(search_with("direct", 200, 1, 0, {0.05}, waves).best()[0], 0.7, 1e-2);
}

// Schaffer's problem is x^2 against (x - 2)^2; its front is x from 0 to 2, where sqrt(f1) + sqrt(f2) = 2.
TEST(Search, Nsga2FindsAFront) {
  if (!has("nsga2")) GTEST_SKIP();
  const auto schaffer = [](const Point& p) {
    const double x = 20 * p[0] - 10;
    return Outcome{false, {x * x, (x - 2) * (x - 2)}, {}};
  };
  const Record record = search_with("nsga2", 1200, 2, 0, {0.5}, schaffer);
  const std::vector<size_t> front = front_of(record.outcomes);
  ASSERT_GT(front.size(), 20u);
  for (const size_t n : front) {
    const auto& f = record.outcomes[n].objectives;
    EXPECT_NEAR(std::sqrt(f[0]) + std::sqrt(f[1]), 2, 1e-6);
  }
  // The front reaches both ends.
  EXPECT_LT(record.outcomes[front.front()].objectives[0], 0.05);
  EXPECT_LT(record.outcomes[front.back()].objectives[1], 0.05);
}

// Searches for the nearest point, with the constraint in the form that the method takes.
Record nearest_by(const Method& method, size_t evaluations, const std::function<Outcome(const Point&)>& function) {
  const size_t objectives = method.many_objectives ? 2 : 1, constraints = method.takes_constraints ? 1 : 0;
  return search_with(method.name, evaluations, objectives, constraints, {0.2, 0.2}, [&](const Point& p) {
    Outcome outcome = function(p);
    if (!outcome.failed) outcome.objectives.resize(objectives, p[0]);
    if (!outcome.failed) outcome.excesses.resize(constraints);
    return outcome;
  });
}

TEST(Search, RepeatsItself) {
  for (const Method& method : methods())
    if (is_built(method)) {
      EXPECT_EQ(nearest_by(method, 100, nearest).points, nearest_by(method, 100, nearest).points) << method.name;
    }
}

TEST(Search, EndsWithWhatAnEvaluationThrows) {
  for (const Method& method : methods()) {
    if (!is_built(method)) continue;
    size_t evaluated = 0;
    const auto throws = [&](const Point& p) {
      if (++evaluated > 10) throw Cancelled();
      return nearest(p);
    };
    EXPECT_THROW(nearest_by(method, 100, throws), Cancelled) << method.name;
    EXPECT_EQ(evaluated, 11u) << method.name;
  }
}

TEST(Search, GoesAroundPointsThatFail) {
  for (const Method& method : methods()) {
    if (!is_built(method) || !method.takes_constraints || method.many_objectives) continue;
    const auto partly = [](const Point& p) { return p[1] < 0.1 ? Outcome{true, {}, {}} : nearest(p); };
    EXPECT_NEAR(nearest_by(method, 1000, partly).best()[0], 0.75, 0.05) << method.name;
  }
}

TEST(Ranking, LeavesOutWhatIsBeatenOrNotAllowed) {
  const std::vector<Outcome> outcomes{{false, {2, 2}, {}}, {false, {1, 3}, {}},  {false, {2, 3}, {}},
                                      {true, {}, {}},      {false, {0, 0}, {1}}, {false, {1, 3}, {}}};
  EXPECT_EQ(front_of(outcomes), (std::vector<size_t>{1, 0}));
}

TEST(Chart, HasAPointForEachAndRoundNumbers) {
  const std::string svg =
      chart_svg({"a < b", "x", "y", {{0.13, 7, ChartPoint::Kind::best}, {0.92, 31, ChartPoint::Kind::feasible}}, true});
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_NE(svg.find(">0.2</text>"), std::string::npos);
  size_t circles = 0;
  for (size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) ++circles;
  EXPECT_EQ(circles, 2u);
}

}  // namespace
}  // namespace ombre::optimise

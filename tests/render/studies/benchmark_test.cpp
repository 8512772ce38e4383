#include "render/studies/benchmark.hpp"

#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/studies/benchmark.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/report/report.hpp"
#include "render/studies/registry.hpp"
#include "tests/render/report/score_files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const char* const study_config = R"(name: study
simulators: [mujoco]
estimators: [robust]
fit: {scenarios: [scenarios/stairs.yaml]}
test: {scenarios: [scenarios/stairs.yaml]}
benchmark: {}
)";

/// Four estimators in two scenes. Two of them do not differ significantly.
class BenchmarkPage : public ::testing::Test {
 protected:
  BenchmarkPage() {
    folder_.write("config.yaml", study_config);
    folder_.write("manifest.json", "{}");
    write_score_files(folder_);
    folder_.write(
        "tables/benchmark.csv",
        "simulator,robot,sensors,scene,split,estimator,balanced_accuracy,balanced_accuracy_low,"
        "balanced_accuracy_high,no_contact_precision,no_contact_recall,torque_noise_nm,"
        "accelerometer_noise_mps2,fitted_on\n"
        "mujoco,upkie,harsh,stairs,test,robust,0.99,0.98,0.995,1,1,0,0,own\n"
        "mujoco,upkie,harsh,stairs,test,free_fall,0.5,0.4,0.6,nan,0,0,0,own\n"
        "mujoco,upkie,harsh,stairs,test,robust,0.1,0,0.2,1,1,0,0,bullet\n"  // a transfer
        "mujoco,upkie,harsh,<i>hop,unseen,robust,0.7,0.6,0.8,0.9,0.45,0,0,own\n"
        "mujoco,upkie,harsh,<i>hop,unseen,free_fall,0.2,0.1,0.3,nan,nan,0,0,own\n"
        "mujoco,upkie,harsh,<i>hop\n");  // torn
    folder_.write("tables/benchmark_standings.csv",
                  "robot,sensors,torque_noise_nm,accelerometer_noise_mps2,estimator,"
                  "event_f1,event_f1_low,event_f1_high,"
                  "mean_balanced_accuracy,mean_balanced_accuracy_low,mean_balanced_accuracy_high,"
                  "worst_balanced_accuracy,worst_scene,worst_simulator,is_not_significantly_worse,"
                  "log_loss_bits\n"
                  "upkie,harsh,0,0,robust,0.9,0.8,1,0.845,0.83,0.85,0.7,<i>hop,mujoco,1,0.125\n"
                  "upkie,harsh,0,0,load_filter,0.8,0.7,0.9,0.84,0.83,0.85,0.7,<i>hop,mujoco,1\n"
                  "upkie,harsh,0,0,paper,0.7,0.6,0.8,0.83,0.82,0.84,0.7,<i>hop,mujoco,0\n"
                  "upkie,harsh,0,0,free_fall,0.2,0.1,0.3,0.5,0.4,0.6,0.5,stairs,mujoco,0\n");
  }
  std::string page() const { return read_file(write_benchmark_page(read_subject(folder_.path()))); }

  const ScratchFolder folder_;
};

TEST_F(BenchmarkPage, IsLinkedFromTheReportOfABenchmarkAlone) {
  const auto report = [&] {
    return read_file(make_report(read_subject(folder_.path()), {}, study_pictures()));
  };
  EXPECT_THAT(report(), HasSubstr("href=\"benchmark.html\""));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "benchmark.html"));
  const std::string text = study_config;
  folder_.write("config.yaml", text.substr(0, text.find("benchmark")));
  EXPECT_THAT(report(), Not(HasSubstr("benchmark.html")));
}

TEST_F(BenchmarkPage, ShowsEveryScenesBestAndWorst) {
  const std::string html = page();
  EXPECT_THAT(html, AllOf(HasSubstr("upkie, harsh sensors"),
                          HasSubstr("level-5 best\" data-value=\"0.99\""),
                          HasSubstr("level-0\" data-value=\"0.5\""), HasSubstr("F1 of events –; "),
                          HasSubstr("&lt;i&gt;hop *"),  // unlike the training scenes
                          HasSubstr("0.845</td>"),      // the mean of both scenes
                          Not(HasSubstr("<i>hop")), Not(HasSubstr("data-value=\"0.1\"")),
                          Not(HasSubstr("id=\"standings\""))));  // without figures
}

TEST_F(BenchmarkPage, ListsTheScenesAndErrorsOfEachFailure) {
  EXPECT_THAT(page(), AllOf(HasSubstr("<b>&lt;i&gt;hop</b> 0.700: misses 55 % of the time in the "
                                      "air; 10 % of the flight it reports is contact (MuJoCo"),
                            HasSubstr("<b>stairs</b> 0.500: misses 100 % of the time in the air "
                                      "and never reports flight"),
                            HasSubstr("Not significantly worse than the best in 1 of 1 settings")));
}

TEST_F(BenchmarkPage, ShowsTheFilmOfTheWorstSegmentIfThereIsOne) {
  EXPECT_THAT(page(), Not(HasSubstr("<video")));
  folder_.write("videos/worst_robust.mp4", "film");
  EXPECT_THAT(page(), HasSubstr("The worst two seconds of Bayes filter (robust)"));
}

/// The drawn dots of one kind at different positions.
std::set<std::string> places_of(const std::string& dot, const Figure& figure) {
  const std::string svg = read_file(figure.svg);
  std::set<std::string> places;
  for (std::size_t at = svg.find(dot); at != std::string::npos; at = svg.find(dot, at + 1)) {
    const std::size_t begin = svg.find("translate(", at);
    places.insert(svg.substr(begin, svg.find(')', begin) - begin));
  }
  return places;
}

/// Without intervals too: those of a single run per scene.
TEST_F(BenchmarkPage, RingsBalancedAccuraciesThatAreNotSignificantlyWorse) {
  const ReportSubject subject = read_subject(folder_.path());
  Table standings = benchmark_tables(folder_.path()).standings;
  std::filesystem::create_directory(folder_ / "figures");
  for (const bool has_intervals : {true, false}) {
    const auto specs = experiments::standings_figures(standings, subject.experiment);
    ASSERT_EQ(specs.size(), 1U);
    const Figure figure =
        draw_facets(specs[0], standings, folder_ / "figures" / specs[0].name).value();
    EXPECT_EQ(places_of("'#gpPt6' transform", figure).size(), 3U * 4U);  // three measures of four
    EXPECT_EQ(places_of("'#gpPt5' transform", figure).size(), 2U) << has_intervals;
    for (std::vector<Cell>& cells : standings.rows) {
      cells[6] = cells[7] = cells[9] = cells[10] = NAN;
    }
  }
  EXPECT_THAT(page(), HasSubstr("src=\"data:image/svg+xml;base64,"));
}

void expect_segment(const std::vector<std::vector<int>>& wrong, std::size_t length, std::size_t run,
                    std::size_t begin, std::int64_t count) {
  const WorstSegment segment = worst_segment(wrong, length);
  EXPECT_EQ(segment.run, run);
  EXPECT_EQ(segment.begin, begin);
  EXPECT_EQ(segment.wrong, count);
}

TEST(WorstSegment, HasTheMostWrongDecisions) {
  expect_segment({{0, 1, 0, 0, 2, 1, 0}, {1, 0, 0, 0, 0, 0, 1}}, 2, 0, 4, 3);
  expect_segment({{0, 1, 0, 0}, {0, 0, 2, 2}}, 2, 1, 2, 4);
}

TEST(WorstSegment, IsTheFirstOfEqualOnesAndTheBeginningWithoutErrors) {
  expect_segment({{0, 1, 1, 0, 1, 1}, {1, 1, 0, 0, 0, 0}}, 2, 0, 1, 2);
  expect_segment({{0, 0, 0}, {0, 0, 0}}, 2, 0, 0, 0);
}

TEST(WorstSegment, IsTheWholeOfAShorterRun) { expect_segment({{1, 0}, {2, 1, 1}}, 5, 1, 0, 4); }

}  // namespace
}  // namespace touchdown::render

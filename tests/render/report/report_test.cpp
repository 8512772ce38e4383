#include "render/report/report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/report/html.hpp"
#include "tests/render/report/score_files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

const char* const config = R"(name: study  # <b>bold</b> & "quoted"
simulators: [mujoco]
estimators: [robust]
fit: {scenarios: [scenarios/stairs.yaml]}
test: {scenarios: [scenarios/stairs.yaml]}
noise: {torque: [0.0, 1.0], accelerometer: [0.0, 5.0]}
highlights: [{torque: 1.0, accelerometer: 5.0}]
)";

/// Point-wise metrics of two estimators in MuJoCo.
const char* const some_cells =
    "mujoco,robust,0,0,0.99,0.98,0.995\nmujoco,robust,0,5,0.97,0.96,0.98\n"
    "mujoco,robust,1,0,0.98,0.97,0.99\nmujoco,robust,1,5,0.86,0.85,0.875\n"
    "mujoco,<script>alert(1)</script>,1,5,0.5,0.4,0.6\n";
/// Their F1 at 1 N·m and 5 m/s².
const char* const some_scores =
    "mujoco,robust,1,5,0.86,0.85,0.875\nmujoco,<script>alert(1)</script>,1,5,0.5,0.4,0.6\n";

class Report : public ::testing::Test {
 protected:
  Report() {
    folder_.write("config.yaml", config);
    folder_.write("manifest.json", R"({"command": "touchdown run <x> && y", "id": "abc",
      "versions": {"touchdown": "0.1.0", "commit": "v0.1.0-3-gabc<"}, "seeds": {"experiment": 1}})");
    write_score_files(folder_);
  }
  std::string page(const std::vector<StudyPictures>& studies = {}) const {
    return read_file(make_report(read_subject(folder_.path()), {}, studies));
  }

  const ScratchFolder folder_;
};

TEST_F(Report, LeavesOutWhatTheDirectoryLacks) {
  const std::string html = page();
  EXPECT_THAT(html, AllOf(HasSubstr("id=\"reproduce\""), Not(HasSubstr("id=\"noise\"")),
                          Not(HasSubstr("id=\"figures\"")), Not(HasSubstr("<video"))));
}

TEST_F(Report, EscapesMarkupInFiles) {
  write_score_files(folder_, some_cells, some_scores);
  folder_.write("tables/other.csv", "a,\"b <i>\"\n<img src=x>,\"1,5\"\n");
  folder_.write("figures/f.png", "not a picture");
  folder_.write("figures/f.gp", "# Caption: <img onerror=1>\n");
  const std::string html = page();
  EXPECT_THAT(html,
              AllOf(HasSubstr("&lt;b&gt;bold&lt;/b&gt; &amp; &quot;quoted&quot;"),
                    HasSubstr("&lt;script&gt;alert(1)"), HasSubstr("run &lt;x&gt; &amp;&amp; y"),
                    HasSubstr("alt=\"f: &lt;img onerror=1&gt;\"")));
  for (const char* markup : {"<b>bold", "<script>alert", "<img src=x", "<img onerror", "<i>"}) {
    EXPECT_THAT(html, Not(HasSubstr(markup)));
  }
}

TEST_F(Report, ShowsFiguresWithTheTextsOfTheirScripts) {
  folder_.write("figures/a.svg", "<svg viewBox=\"0 0 300 100\"></svg>");
  folder_.write("figures/a.gp",
                "# Draws a.png\n# Title: Latency\n# Caption: 4 runs & 2 seeds.\n"
                "# Alt: A histogram\nplot x\n");
  folder_.write("figures/a.dat", "1\n");
  EXPECT_THAT(page(), AllOf(HasSubstr("alt=\"A histogram\""), HasSubstr("<b>Latency.</b>"),
                            HasSubstr("4 runs &amp; 2 seeds."), HasSubstr("class=\"wide\""),
                            HasSubstr("href=\"figures/a.dat\""),
                            HasSubstr("src=\"data:image/svg+xml;base64,")));
  // What is in the picture is not repeated below it.
  folder_.write("figures/b.svg", "<svg viewBox=\"0 0 300 100\"></svg>");
  folder_.write(
      "figures/b.gp",
      "# Title: Maps\n# Caption: 5 runs.\n# Alt: A map\nset label 1002 '5 runs.' at 0, 0\n");
  folder_.write("figures/c.svg", "<svg viewBox=\"0 0 300 100\"></svg>");
  folder_.write("figures/c.gp",
                "# Title: Print\n# Caption: 6 runs.\n# Alt: Maps\nset label 1002 '' at 0, 0\n");
  EXPECT_THAT(page(), AllOf(Not(HasSubstr("5 runs.")), HasSubstr("6 runs.")));
}

/// What the page lays over a drawn map.
nlohmann::json overlay_in(const std::string& html) {
  const std::string opening = "<script type=\"application/json\">";
  const std::size_t at = html.find(opening) + opening.size();
  return nlohmann::json::parse(html.substr(at, html.find("</script>", at) - at));
}

TEST_F(Report, LaysEveryCellsNumbersOverItsPlaceInTheDrawnMap) {
  write_score_files(folder_, some_cells, some_scores);
  const ReportSubject subject = read_subject(folder_.path());
  const NoiseMaps maps = noise_maps(subject.experiment).front();
  const Table cells = mapped_cells(subject.tables.cells, maps, "mujoco");
  std::filesystem::create_directory(folder_ / "figures");
  const Figure figure = draw_facets(map_figure(cells, maps, subject.experiment, "mujoco"), cells,
                                    folder_ / "figures/error_mujoco")
                            .value();
  const std::string html = page();
  const nlohmann::json overlay = overlay_in(html);
  EXPECT_EQ(overlay["columns"], 2);
  ASSERT_EQ(overlay["panels"].size(), 1U);
  const nlohmann::json& panel = overlay["panels"][0];
  EXPECT_EQ(panel["cells"][3],
            "MuJoCo, Bayes filter (robust): torque noise 1 N·m, accelerometer noise 5 m/s²: "
            "success rate 0.860 [0.850, 0.875]; always contact 0.870");
  // The upper right cell is the dark one: its edges inside the place are dark, others are not.
  const cv::Mat image = cv::imread(figure.png.string());
  const double left = panel["place"][0], top = panel["place"][1], width = panel["place"][2],
               height = panel["place"][3];
  const auto is_dark = [&](double x, double y) {
    const auto& pixel = image.at<cv::Vec3b>(static_cast<int>((top + y * height) * image.rows),
                                            static_cast<int>((left + x * width) * image.cols));
    return pixel[1] < 60;
  };
  EXPECT_TRUE(is_dark(0.52, 0.25));
  EXPECT_TRUE(is_dark(0.98, 0.25));
  EXPECT_TRUE(is_dark(0.75, 0.02));
  EXPECT_TRUE(is_dark(0.75, 0.48));
  EXPECT_FALSE(is_dark(0.48, 0.25));
  EXPECT_FALSE(is_dark(1.02, 0.25));
  EXPECT_FALSE(is_dark(0.75, -0.02));
  EXPECT_FALSE(is_dark(0.75, 0.52));
}

TEST_F(Report, ShowsAMapWithOtherPanelsAmongTheFigures) {
  write_score_files(folder_, some_cells, some_scores);
  folder_.write("figures/error_mujoco.svg", "<svg viewBox=\"0 0 300 100\"></svg>");
  EXPECT_THAT(page(), AllOf(Not(HasSubstr("id=\"noise\"")), HasSubstr("id=\"figures\""),
                            HasSubstr("href=\"figures/error_mujoco.svg\"")));
}

TEST_F(Report, RanksNoEstimatorAheadOfAnEqualOne) {
  const auto text = [&](double first, double second, double third, double low) {
    std::string cells, scores;
    for (const auto& [estimator, f1] : {std::pair("robust", first), std::pair("reference", second),
                                        std::pair("free_fall", third)}) {
      cells += fmt::format("mujoco,{},1,5,nan,nan,nan\n", estimator);
      scores += fmt::format("mujoco,{},1,5,{},{},{}\n", estimator, f1, low, f1);
    }
    write_score_files(folder_, cells, scores);
    const std::string html = page();
    const std::size_t begin = html.find("<b>MuJoCo.</b>");
    return html.substr(begin, html.find("</p>", begin) - begin);
  };
  EXPECT_THAT(text(1.0, 1.0, 0.9, 0.8),
              AllOf(HasSubstr(" find takeoffs and landings best: F1 1.000, ahead of "),
                    HasSubstr(" (0.900).")));
  EXPECT_THAT(text(0.99, 0.99, 0.99, 0.8), Not(HasSubstr("ahead of")));
  EXPECT_THAT(text(0.99, 0.98, 0.97, NAN),
              AllOf(HasSubstr(" finds takeoffs and landings best: F1 0.990, ahead of "),
                    Not(HasSubstr("–"))));
}

TEST_F(Report, ListsEstimatorsResultsAndCommit) {
  write_score_files(folder_, some_cells, some_scores);
  const std::string html = page();
  EXPECT_THAT(
      html,
      HasSubstr(
          "<dt>Bayes filter (robust)</dt><dd>Runs the paper&apos;s Bayes filter with changes for "
          "noisy sensors. It uses knee torques, wheel torques and the "
          "accelerometer.</dd>"));
  EXPECT_THAT(
      html,
      HasSubstr(
          "<p><b>MuJoCo.</b> With torque noise 1 N·m, accelerometer noise 5 m/s², "
          "Bayes filter (robust), fitted to these scenes, finds takeoffs and landings best: F1 "
          "0.860 [0.850, 0.875], ahead of &lt;script&gt;alert(1)&lt;/script&gt; (0.500).</p>"));
  EXPECT_THAT(html, HasSubstr("built from commit v0.1.0-3-gabc&lt;."));
}

TEST_F(Report, ShowsFiguresInTheExperimentsOrderOfEngines) {
  std::string both = config;
  both.replace(both.find("[mujoco]"), 8, "[mujoco, bullet]");
  folder_.write("config.yaml", both);
  for (const char* name : {"latency_bullet", "latency_mujoco", "drop", "error_bullet"}) {
    folder_.write(std::string("figures/") + name + ".svg", "<svg></svg>");
    folder_.write(std::string("figures/") + name + ".gp", std::string("# Title: ") + name + "\n");
  }
  const std::string html = page();
  std::size_t before = 0;
  for (const char* title :
       {"<b>drop.", "<b>error_bullet.", "<b>latency_mujoco.", "<b>latency_bullet."}) {
    const std::size_t at = html.find(title);
    ASSERT_NE(at, std::string::npos) << title;
    EXPECT_GT(at, before) << title;
    before = at;
  }
}

TEST_F(Report, PutsThePapersNumbersBesideOurs) {
  write_score_files(folder_, "mujoco,reference,1,5,nan,nan,nan\n",
                    "mujoco,reference,1,5,nan,nan,nan,9.5,2.7,14.9,12.4\n");
  EXPECT_THAT(page(), AllOf(HasSubstr("9.5 ± 12.4"), HasSubstr("[2.7, 14.9]"),
                            HasSubstr("77.1 ± 31.8 / 17.9 ± 9.1"),
                            HasSubstr("The last column repeats the paper"),
                            HasSubstr(", under sensor noise.")));
}

TEST_F(Report, NamesNeitherTheColumnNorTheNoiseThatAnExperimentLacks) {
  std::string without_noise = config;
  without_noise.replace(without_noise.find("highlights"), std::string::npos,
                        "highlights: [{torque: 0.0, accelerometer: 0.0}]\n");
  folder_.write("config.yaml", without_noise);
  write_score_files(folder_, "mujoco,robust,0,0,0.9,0.8,1\n", "mujoco,robust,0,0,0.9,0.8,1\n");
  EXPECT_THAT(page(), AllOf(HasSubstr("Transitions. "), Not(HasSubstr("The last column")),
                            Not(HasSubstr("under sensor noise"))));
}

TEST_F(Report, JoinsIntervalsAndMarksMissingNumbers) {
  folder_.write("tables/t.csv",
                "name,x,x_low,x_high,wait_ms,wait_low_ms,wait_high_ms\n"
                "a,0.5,0.25,0.75,12.34,1,20\nb,word,0,1,nan\n");
  const std::string html = page();
  EXPECT_THAT(html, AllOf(HasSubstr(">wait (ms)</th>"), Not(HasSubstr("x low")),
                          HasSubstr("0.500 <span class=\"interval\">[0.250, 0.750]</span>"),
                          HasSubstr("12.3 <span class=\"interval\">[1.0, 20.0]</span>"),
                          HasSubstr(">b</th><td>–</td><td>–</td>")));
}

TEST_F(Report, HasTheSectionsOfStudiesThatAreNotEmpty) {
  const auto study = [](const ReportSection& section) {
    return StudyPictures{.is_requested = [](const experiments::Experiment&) { return true; },
                         .section = [section](const ReportSubject&) { return section; }};
  };
  const std::string html =
      page({study({"mine", "My study", "<p>found</p>"}), study({"none", "Empty study", ""})});
  EXPECT_THAT(html, AllOf(HasSubstr("href=\"#mine\""), HasSubstr("<p>found</p>"),
                          Not(HasSubstr("Empty study"))));
}

TEST_F(Report, RefusesOtherDirectories) {
  const ScratchFolder empty;
  EXPECT_THAT([&] { read_subject(empty.path()); },
              ThrowsMessage<InputError>(HasSubstr("no run directory")));
  std::filesystem::remove(folder_ / "manifest.json");
  EXPECT_THAT([&] { read_subject(folder_.path()); },
              ThrowsMessage<InputError>(HasSubstr("is not finished: `touchdown run ")));
  folder_.write("manifest.json", "{\"command\":");
  EXPECT_THAT([&] { read_subject(folder_.path()); },
              ThrowsMessage<InputError>(HasSubstr("manifest.json")));
}

TEST_F(Report, RefusesRunsOfOlderProgramsAndTablesThatDoNotMatch) {
  write_score_files(folder_, some_cells, some_scores);
  folder_.write("tables/views.csv", "simulator,view\nmujoco,wheels\n");
  EXPECT_THAT([&] { read_subject(folder_.path()); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("tables/views.csv: has 1 rows"), HasSubstr("expected 2"))));
  for (const char* table : {"ranking.csv", "runs.csv", "success.csv"}) {
    write_score_files(folder_, some_cells, some_scores);
    std::filesystem::remove(folder_ / "tables" / table);
    EXPECT_THAT(
        [&] { read_subject(folder_.path()); },
        ThrowsMessage<InputError>(AllOf(HasSubstr(table), HasSubstr("`touchdown run` again"))));
  }
}

TEST(Html, EncodesBytesAsRfc4648Does) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Html, NamesDigestsAsPoliciesDo) {
  // Of the empty text.
  EXPECT_EQ(policy_source("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"),
            "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='");
}

}  // namespace
}  // namespace touchdown::render

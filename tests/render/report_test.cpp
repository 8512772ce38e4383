#include "render/report.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/csv_file.hpp"
#include "render/html.hpp"
#include "render/map_colour.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
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

const char* const success =
    "simulator,estimator,torque_noise_nm,accelerometer_noise_mps2,success,success_low,success_high,"
    "always_contact_success\n"
    "mujoco,robust,0,0,0.990000,0.980000,0.995000,0.870000\n"
    "mujoco,robust,0,5,0.970000,0.960000,0.980000,0.870000\n"
    "mujoco,robust,1,0,0.980000,0.970000,0.990000,0.870000\n"
    "mujoco,robust,1,5,0.860000,0.850000,0.875000,0.870000\n"
    "mujoco,<script>alert(1)</script>,1,5,0.5,0.4,0.6,0.87\n";

class Report : public ::testing::Test {
 protected:
  Report() {
    folder_.write("config.yaml", config);
    folder_.write("manifest.json", R"({"command": "touchdown run <x> && y", "id": "abc",
      "versions": {"touchdown": "0.1.0"}, "seeds": {"experiment": 1}})");
  }
  std::string page() const { return read_file(write_report(folder_.path(), {})); }

  const ScratchFolder folder_;
};

TEST_F(Report, LeavesOutWhatTheDirectoryLacks) {
  const std::string html = page();
  EXPECT_THAT(html, AllOf(HasSubstr("id=\"reproduce\""), Not(HasSubstr("id=\"noise\"")),
                          Not(HasSubstr("id=\"figures\"")), Not(HasSubstr("<video"))));
}

TEST_F(Report, TakesNothingFromFilesForMarkup) {
  folder_.write("tables/success.csv", success);
  folder_.write("tables/other.csv", "a,\"b <i>\"\n<img src=x>,\"1,5\"\n");
  folder_.write("figures/f.png", "not a picture");
  folder_.write("figures/f.gp", "set title '<img onerror=1>'\n");
  const std::string html = page();
  EXPECT_THAT(html,
              AllOf(HasSubstr("&lt;b&gt;bold&lt;/b&gt; &amp; &quot;quoted&quot;"),
                    HasSubstr("&lt;script&gt;alert(1)"), HasSubstr("run &lt;x&gt; &amp;&amp; y"),
                    HasSubstr("alt=\"f: &lt;img onerror=1&gt;.\"")));
  for (const char* markup : {"<b>bold", "<script>alert", "<img src=x", "<img onerror", "<i>"}) {
    EXPECT_THAT(html, Not(HasSubstr(markup)));
  }
}

TEST_F(Report, ShowsFiguresWithWhatTheirScriptsSay) {
  folder_.write("figures/a.svg", "<svg viewBox=\"0 0 300 100\"></svg>");
  folder_.write("figures/a.gp",
                "# Draws a.png\n# Title: Latency\n# Caption: 4 runs & 2 seeds.\n"
                "# Alt: A histogram\nplot x\n");
  folder_.write("figures/a.dat", "1\n");
  EXPECT_THAT(page(), AllOf(HasSubstr("alt=\"A histogram\""), HasSubstr("<b>Latency.</b>"),
                            HasSubstr("4 runs &amp; 2 seeds."), HasSubstr("class=\"wide\""),
                            HasSubstr("href=\"figures/a.dat\""),
                            HasSubstr("src=\"data:image/svg+xml;base64,")));
}

TEST_F(Report, SaysEveryCellsNumbersAndStrikesOutWhatAConstantAnswerBeats) {
  folder_.write("tables/success.csv", success);
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("torque noise 1 N·m, accelerometer noise 5 m/s²: success rate "
                              "0.860 [0.850, 0.875]; always contact 0.870"));
  std::size_t beaten = 0;
  for (std::size_t at = html.find("class=\"beaten\""); at != std::string::npos;
       at = html.find("class=\"beaten\"", at + 1)) {
    ++beaten;
  }
  EXPECT_EQ(beaten, 2U);  // the last row of each of the two estimators
}

TEST_F(Report, PutsThePapersNumbersBesideOurs) {
  folder_.write("tables/latency.csv",
                "simulator,estimator,torque_noise_nm,accelerometer_noise_mps2,view,"
                "takeoff_latency_ms,takeoff_latency_low_ms,takeoff_latency_high_ms,"
                "takeoff_latency_deviation_ms\nmujoco,robust,1,5,wheels,9.5,2.7,14.9,12.4\n");
  EXPECT_THAT(page(), AllOf(HasSubstr("9.5 ± 12.4"), HasSubstr("[2.7, 14.9]"),
                            HasSubstr("77.1 ± 31.8 / 17.9 ± 9.1")));
}

TEST_F(Report, RefusesWhatIsNoRunDirectory) {
  const ScratchFolder empty;
  EXPECT_THAT([&] { write_report(empty.path(), {}); },
              ThrowsMessage<InputError>(HasSubstr("no run directory")));
  folder_.write("manifest.json", "{\"command\":");
  EXPECT_THAT([&] { write_report(folder_.path(), {}); },
              ThrowsMessage<InputError>(HasSubstr("manifest.json")));
}

TEST(CsvFile, ReadsWhatToCsvWrites) {
  const ScratchFolder folder;
  const Table table{{"a", "b,\"c\""}, {{"1", "two\nlines"}, {"", "x"}}};
  const auto read = read_csv(folder.write("t.csv", to_csv(table)));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->header, table.header);
  EXPECT_EQ(read->rows, table.rows);
  EXPECT_FALSE(read_csv(folder / "missing.csv").has_value());
  EXPECT_FALSE(read_csv(folder.write("empty.csv", "")).has_value());
}

TEST(CsvFile, ShortRowsAndOtherTextsAreNoNumbers) {
  const ScratchFolder folder;
  const auto table = read_csv(folder.write("t.csv", "x,y\n1.5\nword,nan\n"));
  const auto rows = rows_of(*table);
  EXPECT_EQ(rows[0].number("x"), 1.5);
  EXPECT_TRUE(std::isnan(rows[0].number("y")));
  EXPECT_TRUE(std::isnan(rows[1].number("x")));
  EXPECT_TRUE(std::isnan(rows[1].number("no such column")));
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

TEST(MapColours, RunFromDarkToLightAndStayInside) {
  EXPECT_EQ(map_colour(0.0).hex, "#00224e");
  EXPECT_EQ(map_colour(1.0).hex, "#fee838");
  EXPECT_EQ(map_colour(-3.0).hex, map_colour(0.0).hex);
  EXPECT_EQ(map_colour(7.0).hex, map_colour(1.0).hex);
  EXPECT_FALSE(map_colour(0.0).light);
  EXPECT_TRUE(map_colour(1.0).light);
}

}  // namespace
}  // namespace touchdown

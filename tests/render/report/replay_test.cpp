#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/mjcf/types.hpp"
#include "render/film/scene_view.hpp"
#include "render/report/sections.hpp"
#include "tests/render/staged_run.hpp"

namespace touchdown::render {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

std::vector<std::uint8_t> bytes_of(const Json& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text.get<std::string>()) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<unsigned>(letters.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count & 0xffU));
  }
  return bytes;
}

std::vector<float> floats_of(const Json& text) {
  const auto bytes = bytes_of(text);
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), sizeof(float) * numbers.size());
  return numbers;
}

/// The position of body `body` (without the terrain) in frame `frame` of a replayed run.
Eigen::Vector3d position_in(const Json& run, std::size_t bodies, std::size_t frame,
                            std::size_t body) {
  const std::vector<float> numbers = floats_of(run["positions"]);
  Eigen::Vector3d position;
  for (std::size_t k = 0; k < 3; ++k) {
    position[static_cast<Eigen::Index>(k)] = numbers.at(3 * (frame * bodies + body) + k);
  }
  return position;
}

class ReplayData : public ::testing::Test {
 protected:
  const models::RobotModel robot_ = models::compile_robot_model(upkie_mjcf, staged_terrain());
  const logs::Recording run_ = staged_run(3.0);
  const std::vector<BeliefTrack> beliefs_ = {staged_beliefs(run_, "robust"),
                                             staged_beliefs(run_, "paper", 2, 0.01f)};
};

TEST_F(ReplayData, PosesAreThoseOfTheRecording) {
  const Json data = replay_data({{robot_, run_, beliefs_}}, {});
  const Json& run = data["runs"][0];
  const std::size_t bodies = data["scenes"][0]["bodies"].size() - 1;
  EXPECT_EQ(bodies, 7U);  // torso, legs of two parts, wheels
  const Poses poses(robot_, run_);
  const models::MjDataPtr state(mj_makeData(robot_.mj.get()));
  for (const std::size_t frame : {0U, 1U, 77U, 150U}) {
    poses.apply(20 * frame, *state);
    const auto base = run["base"].get<std::size_t>() - 1;
    EXPECT_LT((position_in(run, bodies, frame, base) - run_.truth[20 * frame].base_position).norm(),
              1e-4);
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const auto place = run["wheels"][wheel].get<std::size_t>() - 1;
      const int body = robot_.mj->geom_bodyid[robot_.tyre_geom[wheel]];
      EXPECT_LT(
          (position_in(run, bodies, frame, place) - models::vector_at(state->xpos, body)).norm(),
          1e-4);
      const std::vector<float> numbers = floats_of(run["orientations"]);
      const Eigen::Quaterniond expected = models::quaternion_at(state->xquat, body);
      const std::array<double, 4> q = {expected.w(), expected.x(), expected.y(), expected.z()};
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(numbers.at(4 * (frame * bodies + place) + k), q[k], 1e-4);
      }
    }
  }
}

TEST_F(ReplayData, BeliefsAndContactAreThoseOfTheirSteps) {
  const Json data = replay_data({{robot_, run_, beliefs_}}, {});
  const Json& run = data["runs"][0];
  const auto truth = bytes_of(run["truth"]);
  ASSERT_EQ(truth.size(), 301U);
  for (std::size_t e = 0; e < beliefs_.size(); ++e) {
    EXPECT_EQ(run["estimators"][e]["name"], beliefs_[e].name);
    const auto codes = bytes_of(run["estimators"][e]["beliefs"]);
    ASSERT_EQ(codes.size(), 2 * truth.size());
    for (std::size_t step = 0; step < truth.size(); ++step) {
      for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
        const float p = beliefs_[e].p_contact[wheel][10 * step];
        EXPECT_NEAR((codes[2 * step + wheel] >> 1) / 127.0, p, 0.5 / 127.0 + 1e-6);
        EXPECT_EQ(codes[2 * step + wheel] & 1, p > 0.5F ? 1 : 0);
      }
    }
  }
  for (std::size_t step = 0; step < truth.size(); ++step) {
    const bool contact = run_.truth[10 * step].wheel_normal_force[0] > 1.0;
    EXPECT_EQ(truth[step], contact ? 3 : 0) << step;
  }
  ASSERT_FALSE(run["flights"].empty());
  const auto takeoff = run["flights"][0][0].get<double>();
  EXPECT_LE(run_.truth[static_cast<std::size_t>(std::lround(1e3 * takeoff))].wheel_normal_force[0],
            1.0);
}

TEST_F(ReplayData, LongRunsAreCutAndScenesAreSharedByEngines) {
  logs::Recording longer = run_;
  while (longer.steps() < 70'000) {
    longer.observation.insert(longer.observation.end(), run_.observation.begin(),
                              run_.observation.end());
    longer.truth.insert(longer.truth.end(), run_.truth.begin(), run_.truth.end());
    longer.action.insert(longer.action.end(), run_.action.begin(), run_.action.end());
  }
  const Json data = replay_data({{robot_, run_, beliefs_}, {robot_, longer, {}}}, {});
  EXPECT_EQ(data["scenes"].size(), 1U);
  EXPECT_EQ(bytes_of(data["runs"][1]["truth"]).size(), 6001U);
  EXPECT_EQ(floats_of(data["runs"][1]["orientations"]).size(), 4U * 7 * 3001);
  EXPECT_TRUE(data["runs"][1]["estimators"].empty());
  EXPECT_THAT(replay_html({{robot_, longer, {}}}, {}), HasSubstr("first 60 of 72 seconds"));
  EXPECT_THAT(replay_html({{robot_, run_, {}}}, {}), Not(HasSubstr("Only the first")));
}

TEST_F(ReplayData, DivergedAndTinyRunsAreReplayed) {
  logs::Recording diverged = run_;
  for (std::size_t k = 2000; k < diverged.steps(); ++k) {
    diverged.truth[k].base_position.x() = std::nan("");
    diverged.truth[k].base_orientation.coeffs().setConstant(std::nan(""));
    for (models::ServoReading& servo : diverged.observation[k].servo) servo.position = std::nan("");
  }
  logs::Recording tiny = staged_run(0.0);
  ASSERT_EQ(tiny.steps(), 1U);
  std::vector<BeliefTrack> unknown = {staged_beliefs(diverged, "unknown")};
  unknown[0].p_contact[0].assign(diverged.steps(), std::nanf(""));
  const Json data = replay_data({{robot_, diverged, unknown}, {robot_, tiny, {}}}, {});
  EXPECT_LT(position_in(data["runs"][0], 7, 149, 0).norm(), 100.0);
  EXPECT_EQ(bytes_of(data["runs"][1]["truth"]).size(), 1U);
  EXPECT_EQ(data.dump().find("null"), std::string::npos);
}

TEST_F(ReplayData, NamesCannotCloseTheScriptThatContainsThem) {
  std::vector<BeliefTrack> beliefs = beliefs_;
  beliefs[0].name = "</script><script>alert(1)//<!--";
  const std::string html =
      replay_html({{robot_, run_, beliefs, "<b>"}, {robot_, run_, beliefs}}, {});
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<!--")));
  EXPECT_THAT(html, Not(HasSubstr("<b>")));
  const std::string opening = "<script type=\"application/json\">";
  const std::size_t at = html.find(opening) + opening.size();
  const Json data = Json::parse(html.substr(at, html.find("</script>") - at));
  EXPECT_EQ(data["runs"][0]["estimators"][0]["name"], beliefs[0].name);
}

/// A sphere of many triangles keeps its shape with few.
TEST(ReplayMeshes, AreReducedAndKeepTheirShape) {
  constexpr int rows = 100, columns = 200;
  TriangleMesh sphere;
  for (int i = 0; i <= rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      const double up = M_PI * i / rows, around = 2.0 * M_PI * k / columns;
      sphere.vertices.emplace_back(std::sin(up) * std::cos(around), std::sin(up) * std::sin(around),
                                   std::cos(up));
    }
  }
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      const int a = i * columns + k, b = i * columns + (k + 1) % columns;
      for (const int index : {a, b, a + columns, b, b + columns, a + columns}) {
        sphere.indices.push_back(index);
      }
    }
  }
  for (const std::size_t most : {40'001U, 5'000U, 300U}) {
    const TriangleMesh few = reduced(sphere, most);
    EXPECT_LE(few.indices.size(), 3 * most);
    EXPECT_GT(few.indices.size(), most / 10);
    for (const int index : few.indices) {
      EXPECT_NEAR(few.vertices.at(static_cast<std::size_t>(index)).norm(), 1.0, 0.3);
    }
  }
  EXPECT_EQ(reduced(sphere, 40'001).vertices.size(), sphere.vertices.size());
  EXPECT_TRUE(reduced({}, 10).indices.empty());
}

}  // namespace
}  // namespace touchdown::render

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "tests/bag_writer.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

using models::Observation;

const std::vector<std::string> joint_names = {"lh", "lk", "lw", "rh", "rk", "rw"};

/// Logs that can be read, and of which a number is wrong for a reason that their rows show. Each is
/// made from a simulated robot that roams.
class MisleadingLog : public InFolder {
 protected:
  static void SetUpTestSuite() {
    const ProgramFolder folder;
    folder.output_of("simulate scenarios/roam.yaml -o run.mpack");
    whole_run = logs::read_recording(folder / "run.mpack").observation;
    constexpr std::size_t most = 6000;
    whole_run.resize(std::min(whole_run.size(), most));
  }
  static void TearDownTestSuite() { whole_run.clear(); }

  using Change = std::function<void(Observation& record, std::size_t k)>;

  /// Every `every`-th record, changed.
  static std::vector<Observation> records(std::size_t every, const Change& change = {}) {
    std::vector<Observation> records;
    for (std::size_t k = 0; k < whole_run.size(); k += every) {
      records.push_back(whole_run[k]);
      if (change) change(records.back(), records.size() - 1);
    }
    return records;
  }

  /// What `check` prints about these records as a CSV file. `stamp` writes the time of record k.
  std::string check_csv(const std::vector<Observation>& records,
                        const std::function<std::string(double t, std::size_t k)>& stamp,
                        const std::string& options = "") const {
    std::vector<std::string> names = {"t"};
    for (const char* const what : {"q", "v", "tau"}) {
      for (const std::string& joint : joint_names) names.push_back(joint + "_" + what);
    }
    for (const char* const name : {"qw", "qx", "qy", "qz", "gx", "gy", "gz", "px", "py", "pz"}) {
      names.emplace_back(name);
    }
    std::string csv = fmt::format("{}\n", fmt::join(names, ","));
    for (std::size_t k = 0; k < records.size(); ++k) {
      const Observation& o = records[k];
      csv += stamp(o.time, k);
      for (const auto& s : o.servo) csv += fmt::format(",{:.9g}", s.position);
      for (const auto& s : o.servo) csv += fmt::format(",{:.9g}", s.velocity);
      for (const auto& s : o.servo) csv += fmt::format(",{:.9g}", s.torque);
      const auto& q = o.imu.orientation;
      for (const double x : {q.w(), q.x(), q.y(), q.z()}) csv += fmt::format(",{:.9g}", x);
      for (const Eigen::Vector3d& v : {o.imu.angular_velocity, o.imu.raw_linear_acceleration}) {
        csv += fmt::format(",{:.9g},{:.9g},{:.9g}", v.x(), v.y(), v.z());
      }
      csv += "\n";
    }
    folder_.write("log.csv", csv);
    const auto six = [](const char* what) {
      return fmt::format("[{0}_{1}]", fmt::join(joint_names, fmt::format("_{}, ", what)), what);
    };
    folder_.write("csv.yaml", fmt::format(R"(time: {{from: t}}
joints: {{position: {{from: {}}}, velocity: {{from: {}}}, torque: {{from: {}}}}}
imu: {{orientation: {{from: [qw, qx, qy, qz]}}, angular_velocity: {{from: [gx, gy, gz]}}, proper_acceleration: {{from: [px, py, pz]}}}}
)",
                                          six("q"), six("v"), six("tau")));
    const Ended ended = folder_.run("check log.csv --mapping csv.yaml" + options);
    return ended.errors + ended.output;
  }

  static std::string plain(double t, std::size_t /*k*/) { return fmt::format("{:.6f}", t); }

  static std::vector<Observation> whole_run;
};

std::vector<Observation> MisleadingLog::whole_run;

/// Seconds, a dot, and a count of parts of a second, without the zeros before it.
std::string joined_by_a_dot(double t, double parts) {
  const auto whole = static_cast<long>(std::floor(t + 1e-9));
  return fmt::format("{}.{}", whole, std::lround((t - static_cast<double>(whole)) * parts));
}

TEST_F(MisleadingLog, StampsThatLostZerosOrDigitsAreNamedByTheirPattern) {
  using Stamp = std::function<std::string(double, std::size_t)>;
  const struct {
    const char* name;
    std::size_t every;  ///< ms
    Stamp stamp;
    std::vector<std::string> texts;
  } cases[] = {
      {"ms behind a dot",
       5,
       [](double t, std::size_t) { return joined_by_a_dot(t, 1e3); },
       {"unpadded fractions", "scramble"}},
      {"µs behind a dot",
       1,
       [](double t, std::size_t) { return joined_by_a_dot(t, 1e6); },
       {"unpadded fractions"}},
      {"ns behind a dot",
       2,
       [](double t, std::size_t) { return joined_by_a_dot(t, 1e9); },
       {"unpadded fractions"}},
      {"ms since 1970",
       4,
       [](double t, std::size_t) { return joined_by_a_dot(1.7e9 + t, 1e3); },
       {"unpadded fractions"}},
      {"ms behind a dot, from .2 s on",
       1,
       [](double t, std::size_t) { return joined_by_a_dot(t + 0.2, 1e3); },
       {"unpadded fractions"}},
      {"digits of 10 ms",
       1,
       [](double t, std::size_t) {
         return fmt::format("{:.2f}", std::floor(100 * t + 1e-6) / 100);
       },
       {"steps of 0.01 s", "10 records share each", "truncated"}},
      {"seconds alone",
       5,
       [](double t, std::size_t) { return fmt::format("{}", std::floor(t + 1e-9)); },
       {"seconds"}},
      {"a float32 of a day",
       1,
       [](double t, std::size_t) { return fmt::format("{:.9f}", static_cast<float>(86'400 + t)); },
       {"did a float lose its digits"}},
  };
  for (const auto& [name, every, stamp, texts] : cases) {
    const std::string printed = check_csv(records(every), stamp);
    for (const std::string& text : texts) EXPECT_THAT(printed, HasSubstr(text)) << name;
    EXPECT_THAT(printed, Not(HasSubstr("sort the log"))) << name;
  }
}

TEST_F(MisleadingLog, BurstsAndSeveralClocksAreNamedAtTheirMeanRate) {
  std::mt19937 generator(1);
  std::normal_distribution<double> jitter(0.0, 1e-4);
  std::bernoulli_distribution is_lost(0.05);
  const auto bursts = [](std::size_t size, double period, double within, double shift) {
    return [=](double, std::size_t k) {
      const std::size_t number = k / size;
      const auto burst = static_cast<double>(number);
      return fmt::format("{:.9f}", period * burst + within * static_cast<double>(k % size) + shift);
    };
  };
  const struct {
    const char* name;
    std::size_t every;
    std::function<std::string(double, std::size_t)> stamp;
    std::string text;
    std::string rate;
  } cases[] = {
      {"fours, 1 ms apart", 2, bursts(4, 0.010, 1e-3, 0.0), "bursts of 4 every 10 ms", "at 400 Hz"},
      {"fours, 50 µs apart", 2, bursts(4, 0.008, 5e-5, 5.0), "bursts of 4 every 8 ms", "at 500 Hz"},
      {"tens", 1, bursts(10, 0.010, 1e-4, 0.0), "bursts of 10 every 10 ms", "at 1000 Hz"},
      {"pairs, or two publishers", 5, bursts(2, 0.010, 1e-3, 0.0), "bursts of 2 every 10 ms",
       "at 200 Hz"},
      {"fours with jitter", 2,
       [&](double, std::size_t k) {
         const std::size_t burst = k / 4;
         return fmt::format("{:.9f}", 0.008 * static_cast<double>(burst) +
                                          2e-4 * static_cast<double>(k % 4) +
                                          0.3 * std::abs(jitter(generator)));
       },
       "bursts of 4 every 8 ms", "at 500 Hz"},
      {"even", 1, plain, "plausible", "at 1000 Hz"},
      {"rounded to ms at 400 Hz", 1,
       [](double, std::size_t k) {
         return fmt::format("{:.3f}", 0.0025 * static_cast<double>(k) + 1e-6);
       },
       "", "at 400 Hz"},
      {"jitter", 2,
       [&](double t, std::size_t) { return fmt::format("{:.9f}", t + jitter(generator)); },
       "plausible", "at 500 Hz"},
  };
  for (const auto& [name, every, stamp, text, rate] : cases) {
    const std::string printed = check_csv(records(every), stamp);
    EXPECT_THAT(printed, AllOf(HasSubstr(text), HasSubstr(rate))) << name;
    EXPECT_EQ(printed.find("time: records come") != std::string::npos, text.starts_with("bursts"))
        << name;
  }
  std::vector<Observation> some = records(1);
  std::erase_if(some, [&](const Observation&) { return is_lost(generator); });
  EXPECT_THAT(check_csv(some, plain), AllOf(HasSubstr("at 1000 Hz"), HasSubstr("plausible")));
}

TEST_F(MisleadingLog, SignalsHeldAtALowerRateAreNamedWithIt) {
  const auto held = [](std::size_t by,
                       const std::function<void(Observation&, const Observation&)>& take) {
    return records(1, [=](Observation& o, std::size_t k) { take(o, whole_run[k - k % by]); });
  };
  const auto whole = [](Observation& o, const Observation& last) {
    const double time = o.time;
    o = last;
    o.time = time;
  };
  const auto torques = [](Observation& o, const Observation& last) {
    for (std::size_t i = 0; i < 6; ++i) o.servo[i].torque = last.servo[i].torque;
  };
  const auto knee = [](Observation& o, const Observation& last) { o.servo[1] = last.servo[1]; };
  const auto imu = [](Observation& o, const Observation& last) { o.imu = last.imu; };
  const struct {
    const char* name;
    std::vector<Observation> records;
    std::string text;
  } cases[] = {
      {"all by 10", held(10, whole),
       "all signals: change 100 times a second, rows come at 1000 Hz"},
      {"all by 2", held(2, whole), "all signals: change 500 times a second, rows come at 1000 Hz"},
      {"torques by 10", held(10, torques), "right_wheel torque: changes 100 times a second"},
      {"a knee by 4", held(4, knee), "left_knee torque: changes 250 times a second"},
      {"IMU by 20", held(20, imu), "linear_acceleration: changes 50 times a second"},
      {"IMU by 2, as Upkie's", held(2, imu), "plausible"},
      {"none", records(1), "plausible"},
  };
  for (const auto& [name, changed, text] : cases) {
    EXPECT_THAT(check_csv(changed, plain), HasSubstr(text)) << name;
  }
}

TEST_F(MisleadingLog, TorquesWithoutSignOrInAnotherScaleAreNamedWithTheFactor) {
  const auto scaled = [](double factor) {
    return [=](Observation& o, std::size_t) {
      for (auto& servo : o.servo) servo.torque *= factor;
    };
  };
  const auto sizes = [](double factor) {
    return [=](Observation& o, std::size_t) {
      for (auto& servo : o.servo) servo.torque = factor * std::abs(servo.torque);
    };
  };
  const std::string upkie = " --robot models/upkie.xml";
  const struct {
    const char* name;
    Change change;
    std::string options;
    std::vector<std::string> texts;
  } cases[] = {
      {"sizes", sizes(1.0), "", {"torques: never change their sign"}},
      {"sizes in percent", sizes(6.0), upkie, {"torques: never change their sign"}},
      {"cN·m", scaled(100.0), upkie, {"are they in cN·m"}},
      {"mN·m", scaled(1e3), upkie, {"are they in mN·m"}},
      {"percent",
       scaled(30.0),
       upkie,
       {"30 times those that carry its weight", "percent", "scale: 0.03"}},
      {"kgf·cm", scaled(10.2), upkie, {"kgf·cm", "those of --robot"}},
      {"no gear", scaled(1.0 / 6.0), upkie, {"before their gears", "`scale: "}},
      {"other legs",
       [](Observation& o, std::size_t) {
         for (const std::size_t i : {0U, 1U, 3U, 4U}) o.servo[i].position *= 0.4;
       },
       upkie,
       {"legs"}},
      {"as they are", {}, upkie, {"plausible"}},
  };
  for (const auto& [name, change, options, texts] : cases) {
    const std::string printed = check_csv(records(1, change), plain, options);
    for (const std::string& text : texts) EXPECT_THAT(printed, HasSubstr(text)) << name;
  }
}

/// A publisher of joint states.
struct Publisher {
  std::size_t every;                ///< ms
  std::int64_t after;               ///< µs
  std::vector<std::size_t> joints;  ///< in its order
  double offset = 0.0;              ///< of positions (rad)
  double effort = 1.0;              ///< factor
};

TEST_F(MisleadingLog, PublishersThatShareATopicAreNamed) {
  const std::vector<std::size_t> all = {0, 1, 2, 3, 4, 5};
  const struct {
    const char* name;
    std::vector<Publisher> publishers;
    std::string text;
  } cases[] = {
      {"3 and 6 names",
       {{5, 0, all}, {10, 1000, {0, 1, 2}}},
       "2 kinds of messages alternate on /joint_states: "},
      {"1, 4 and 6 names",
       {{10, 0, all}, {10, 2000, {2, 0, 3, 1}}, {10, 5000, {0}}},
       "3 kinds of messages alternate on /joint_states: "},
      {"stamps that alternate", {{5, 0, all}, {5, 1000, all}}, "do 2 publishers share a topic"},
      {"two rates", {{4, 0, all}, {10, 1300, all}}, "do 2 publishers share a topic"},
      {"three", {{10, 0, all}, {10, 1000, all}, {10, 2500, all}}, "do 3 publishers share a topic"},
      {"a doubled rate", {{4, 0, all}, {4, 2000, all, 0.05}}, "positions: repeat a pattern of 2"},
      {"one without effort",
       {{4, 0, all}, {4, 2000, {5, 4, 3, 2, 1, 0}, 0.0, 0.0}},
       "torques: are 0 in every other record"},
      {"a copy", {{4, 0, all}, {4, 2000, all, -1.0}}, ""},
      {"one", {{2, 0, {3, 1, 5, 0, 2, 4}}}, "plausible"},
      {"one for each leg", {{4, 0, {0, 1, 2}}, {4, 500, {3, 4, 5}}}, "plausible"},
  };
  for (const auto& [name, publishers, text] : cases) {
    test::TestBag bag{
        {{"/joint_states", "sensor_msgs/msg/JointState"}, {"/imu", "sensor_msgs/msg/Imu"}}, {}};
    constexpr std::int64_t epoch = 1'732'540'000'000'000'000;
    for (std::size_t k = 0; k < whole_run.size(); ++k) {
      const std::int64_t now = epoch + static_cast<std::int64_t>(k) * 1'000'000;
      for (const Publisher& one : publishers) {
        if (k % one.every != 0) continue;
        test::TestJoints joints;
        for (const std::size_t i : one.joints) {
          joints.name.push_back(joint_names[i]);
          joints.position.push_back(whole_run[k].servo[i].position + one.offset);
          joints.velocity.push_back(whole_run[k].servo[i].velocity);
          joints.effort.push_back(one.effort * whole_run[k].servo[i].torque);
        }
        const std::int64_t stamp = now + 1000 * one.after;
        bag.messages.push_back({0, stamp, test::joint_state_cdr(stamp, joints)});
      }
      const models::ImuReading& imu = whole_run[k].imu;
      const auto& q = imu.orientation;
      const Eigen::Quaterniond up = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0) * q *
                                    Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0).conjugate();
      const Eigen::Vector3d& g = imu.angular_velocity;
      const Eigen::Vector3d& a = imu.raw_linear_acceleration;
      bag.messages.push_back({1, now,
                              test::imu_cdr(now, {{up.x(), up.y(), up.z(), up.w()},
                                                  {-g.x(), g.y(), -g.z()},
                                                  {-a.x(), a.y(), -a.z()}})});
    }
    std::stable_sort(bag.messages.begin(), bag.messages.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
    std::ofstream(folder_ / "bag.mcap", std::ios::binary) << test::mcap_bytes(bag, {"zstd", 1000});
    folder_.write("bag.yaml",
                  fmt::format("sources: {{joints: /joint_states}}\njoints: {{names: [{}]}}\n",
                              fmt::join(joint_names, ", ")));
    const std::string printed = folder_.run("check bag.mcap --mapping bag.yaml").output;
    EXPECT_THAT(printed, HasSubstr(text)) << name;
    EXPECT_EQ(printed.ends_with("plausible\n"), text == "plausible") << name << ": " << printed;
  }
}

/// What to type next.
TEST_F(InFolder, LogsWithoutAMappingAndPackedFilesAreAnsweredWithTheNextCommand) {
  for (const char* const name :
       {"a.csv", "a.tsv", "a.NPZ", "a.mcap", "a.db3", "a.mcap.zstd", "a.csv.gz", "a.mcap.gz"}) {
    folder_.write(name, "t\n1\n");
  }
  std::filesystem::create_directories(folder_ / "bag");
  // From any folder the example is where the message says.
  const std::string copy =
      "--mapping FILE.yaml: start from a copy of " TOUCHDOWN_SOURCE_DIR "/examples/mapping/";
  const std::string table = copy + "robot.yaml";
  const std::string bag = copy + "ros2_bag.yaml";
  folder_.write("csv.yaml", "time: {from: t}\n");
  folder_.write("robot.urdf.xacro",
                "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>"
                "<xacro:include filename='legs.xacro'/></robot>");
  folder_.expect_refusals({{"check a.csv", {"is a CSV file", table}},
                           {"estimate a.tsv -o b.csv", {"is a CSV file", table}},
                           {"check a.NPZ", {"NumPy", table}},
                           {"check a.mcap", {"is a ROS 2 bag", bag}},
                           {"estimate a.db3 -o b.csv", {"is a ROS 2 bag", bag}},
                           {"check a.mcap.zstd", {"is a ROS 2 bag", bag}},
                           {"check bag", {"is a folder", bag}},
                           {"check a.csv.gz", {"`gunzip -k a.csv.gz`"}},
                           {"check a.csv.gz --mapping csv.yaml", {"`gunzip -k a.csv.gz`"}},
                           {"check a.mcap.gz --mapping csv.yaml", {"`gunzip -k a.mcap.gz`"}},
                           {"simulate " TOUCHDOWN_SOURCE_DIR
                            "/scenarios/flat.yaml --set robot=robot.urdf.xacro -o x.mpack",
                            {"`xacro robot.urdf.xacro > robot_flat.urdf`"}}});
}

}  // namespace
}  // namespace touchdown::cli

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/table.hpp"
#include "program.hpp"
#include "recordings/log/recording_file.hpp"
#include "tests/python_with_numpy.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Six columns, of joints in Upkie's order.
std::string six(const char* what) {
  return fmt::format("lh_{0}, lk_{0}, lw_{0}, rh_{0}, rk_{0}, rw_{0}", what);
}

/// The run as CSV in Upkie's units. Each number reads back to the same bits.
std::string si_csv(const recordings::Recording& run) {
  std::string csv =
      fmt::format("t, {}, {}, {}, qw, qx, qy, qz, gx, gy, gz, ax, ay, az, px, py, pz\n", six("q"),
                  six("v"), six("tau"));
  for (const models::Observation& o : run.observation) {
    csv += fmt::format("{:.17g}", o.time);
    for (const auto& s : o.servo) csv += fmt::format(",{:.17g}", s.position);
    for (const auto& s : o.servo) csv += fmt::format(",{:.17g}", s.velocity);
    for (const auto& s : o.servo) csv += fmt::format(",{:.17g}", s.torque);
    const auto& q = o.imu.orientation;
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) csv += fmt::format(",{:.17g}", x);
    for (const Eigen::Vector3d& v :
         {o.imu.angular_velocity, o.imu.linear_acceleration, o.imu.raw_linear_acceleration}) {
      csv += fmt::format(",{:.17g},{:.17g},{:.17g}", v.x(), v.y(), v.z());
    }
    csv += "\n";
  }
  return csv;
}

std::string si_mapping() {
  return fmt::format(R"(time: {{from: t}}
joints:
  position: {{from: [{}]}}
  velocity: {{from: [{}]}}
  torque: {{from: [{}]}}
imu:
  orientation: {{from: [qw, qx, qy, qz]}}
  angular_velocity: {{from: [gx, gy, gz]}}
  linear_acceleration: {{from: [ax, ay, az]}}
  proper_acceleration: {{from: [px, py, pz]}}
)",
                     six("q"), six("v"), six("tau"));
}

/// The same run in the log format of a robot that differs from Upkie in everything. The clock is in
/// milliseconds and does not begin at 0. Joints run from right to left, wheels first, in degrees
/// and turns per minute. Both legs have the same signs, and knees are zero when bent. Torques are
/// in mN·m and act on the joint from outside. The IMU has x forward, y left and z up, an
/// east-north-up reference, and measures in g.
std::string odd_csv(const recordings::Recording& run) {
  constexpr double degree = std::numbers::pi / 180.0;
  constexpr std::array<std::size_t, 6> order = {5, 4, 3, 2, 1, 0};
  const Eigen::Matrix3d upkie_from_flu = Eigen::Vector3d(-1.0, 1.0, -1.0).asDiagonal();
  const Eigen::Matrix3d up_from_down = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  std::string csv = "\xef\xbb\xbfstate,\"stamp, ms\"";
  for (const char* what : {"pos", "vel", "load"}) {
    for (int i = 0; i < 6; ++i) csv += fmt::format(",\"{}[{}]\"", what, i);
  }
  csv += ",x,y,z,w,rate_x,rate_y,rate_z,acc_x,acc_y,acc_z,foot_l,foot_r,comment\r\n";
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const models::Observation& o = run.observation[k];
    csv += fmt::format("walk,{:.17g}", 1e3 * o.time + 5e6);
    const auto sign = [](std::size_t i) { return i >= 3 ? -1.0 : 1.0; };
    for (const std::size_t i : order) {
      const double zero = i % 3 == 1 ? 0.25 : 0.0;
      csv += fmt::format(",{:.17g}", (sign(i) * o.servo[i].position + zero) / degree);
    }
    for (const std::size_t i : order) {
      csv +=
          fmt::format(",{:.17g}", sign(i) * o.servo[i].velocity / (2.0 * std::numbers::pi) * 60.0);
    }
    for (const std::size_t i : order)
      csv += fmt::format(",{:.17g}", -1e3 * sign(i) * o.servo[i].torque);
    const Eigen::Quaterniond q(
        Eigen::Matrix3d(up_from_down * o.imu.orientation.toRotationMatrix() * upkie_from_flu));
    csv += fmt::format(",{:.17g},{:.17g},{:.17g},{:.17g}", q.x(), q.y(), q.z(), q.w());
    const Eigen::Vector3d rate = upkie_from_flu.transpose() * o.imu.angular_velocity / degree;
    const Eigen::Vector3d proper =
        upkie_from_flu.transpose() *
        (o.imu.linear_acceleration - o.imu.orientation.conjugate() * Eigen::Vector3d(0, 0, 9.81)) /
        9.80665;
    for (const Eigen::Vector3d& v : {rate, proper}) {
      csv += fmt::format(",{:.17g},{:.17g},{:.17g}", v.x(), v.y(), v.z());
    }
    const auto& force = run.truth[k].wheel_normal_force;
    csv += fmt::format(",{:.17g},{:.17g},\"well, well\"\r\n", force[0], force[1]);
  }
  return csv;
}

/// `six_of` gives the mapping of a quantity's six joint columns, such as "pos".
std::string odd_mapping(const std::string& stamp,
                        const std::function<std::string(const char*)>& six_of,
                        const std::string& orientation, const std::string& rate,
                        const std::string& acceleration, const std::string& feet) {
  return fmt::format(R"(time: {{from: "{}", unit: ms}}
joints:
  position: {{{}, unit: deg, sign: [1, 1, 1, -1, -1, -1], zero: [0, 0.25, 0, 0, 0.25, 0]}}
  velocity: {{{}, unit: rpm, sign: [1, 1, 1, -1, -1, -1]}}
  torque: {{{}, unit: mNm, sign: [-1, -1, -1, 1, 1, 1]}}
imu:
  axes: [-x, y, -z]
  orientation: {{from: {}, order: xyzw, reference: z_up}}
  angular_velocity: {{from: {}, unit: deg/s}}
  proper_acceleration: {{from: {}, unit: g}}
contact: {{from: {}}}
)",
                     stamp, six_of("pos"), six_of("vel"), six_of("load"), orientation, rate,
                     acceleration, feet);
}

std::string odd_csv_mapping() {
  const auto six_of = [](const char* what) {
    return fmt::format(
        "from: [\"{0}[5]\", \"{0}[4]\", \"{0}[3]\", \"{0}[2]\", \"{0}[1]\", \"{0}[0]\"]", what);
  };
  return odd_mapping("stamp, ms", six_of, "[x, y, z, w]", "[rate_x, rate_y, rate_z]",
                     "[acc_x, acc_y, acc_z]", "[foot_l, foot_r], above: 1.0");
}

std::string odd_npz_mapping() {
  const auto six_of = [](const char* what) {
    return fmt::format("from: {}, index: [5, 4, 3, 2, 1, 0]", what);
  };
  return odd_mapping("stamp", six_of, "quaternion", "rate", "acc", "[left, right]");
}

/// Writes the CSV file above as .npz with NumPy alone.
constexpr const char* to_npz = R"(
import csv, sys, numpy as np
rows = list(csv.DictReader(open('odd.csv', newline='', encoding='utf-8-sig')))
def of(*names): return np.array([[float(row[name]) for name in names] for row in rows])
joints = {what: of(*[f'{what}[{i}]' for i in range(6)]) for what in ('pos', 'vel', 'load')}
feet = of('foot_l', 'foot_r')
np.savez('odd.npz', stamp=of('stamp, ms')[:, 0], quaternion=np.asfortranarray(of(*'xyzw')),
         rate=of('rate_x', 'rate_y', 'rate_z'), acc=of('acc_x', 'acc_y', 'acc_z'),
         left=feet[:, 0] > 1.0, right=(feet[:, 1] > 1.0).astype('i8') * 2,
         names=np.array(['an', 'unused', 'array']), **joints)
)";

using Numbers = std::vector<std::vector<double>>;

Numbers numbers_in(const std::filesystem::path& csv) {
  Numbers rows;
  for (const auto& cells : from_csv(read_file(csv)).rows) {
    std::vector<double>& row = rows.emplace_back();
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) row.push_back(std::stod(cells[i]));
  }
  return rows;
}

/// Largest absolute difference between the numbers of two tables; infinite for different sizes.
double difference(const Numbers& a, const Numbers& b) {
  if (a.size() != b.size()) return INFINITY;
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t i = 0; i < a[k].size(); ++i) {
      const bool both_nan = std::isnan(a[k][i]) && std::isnan(b[k][i]);
      if (!both_nan) most = std::fmax(most, std::abs(a[k][i] - b[k][i]));
    }
  }
  return most;
}

class Mapping : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new ScratchFolder;
    write_tiny_experiment(*folder);
    ran("simulate step.yaml --run 2 -o run.mpack");
    ran("fit run.mpack -o model.npz");
    ran("estimate run.mpack --model model.npz -o run.csv");
    run = new recordings::Recording(recordings::read_recording(*folder / "run.mpack"));
  }
  static void TearDownTestSuite() {
    delete folder;
    delete run;
  }

  static std::string ran(const std::string& arguments) {
    const Ended ended = touchdown_program(arguments, folder->path());
    EXPECT_EQ(ended.exit_code, 0) << arguments << "\n" << ended.errors;
    return ended.output + ended.errors;
  }
  static std::string refused(const std::string& arguments) {
    const Ended ended = touchdown_program(arguments, folder->path());
    EXPECT_EQ(ended.exit_code, 2) << arguments << "\n" << ended.errors;
    EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
    return ended.errors;
  }

  static ScratchFolder* folder;
  static recordings::Recording* run;
};
ScratchFolder* Mapping::folder = nullptr;
recordings::Recording* Mapping::run = nullptr;

TEST_F(Mapping, LogInUpkiesUnitsGivesTheSameBeliefsAsTheRun) {
  folder->write("si.csv", si_csv(*run));
  folder->write("si.yaml", si_mapping());
  EXPECT_THAT(ran("export si.csv --mapping si.yaml -o si.mpack"),
              AllOf(HasSubstr(fmt::format("si.mpack, {} records", run->steps())),
                    HasSubstr("touchdown estimate si.mpack"), Not(HasSubstr("lack"))));
  ran("estimate si.mpack --model model.npz -o si_beliefs.csv");
  EXPECT_EQ(read_file(*folder / "si_beliefs.csv"), read_file(*folder / "run.csv"));
}

TEST_F(Mapping, LogWithOtherUnitsAxesAndOrderGivesTheSameBeliefs) {
  folder->write("odd.csv", odd_csv(*run));
  folder->write("odd_csv.yaml", odd_csv_mapping());
  ran("export odd.csv --mapping odd_csv.yaml -o odd.mpack --labels odd_labels.csv");
  const std::string output =
      ran("estimate odd.mpack --model model.npz --labels odd_labels.csv -o odd_beliefs.csv");
  EXPECT_THAT(output,
              AllOf(HasSubstr("5000.000"), HasSubstr("accuracy"), Not(HasSubstr("upside"))));
  const Numbers beliefs = numbers_in(*folder / "odd_beliefs.csv");
  ASSERT_GT(beliefs.size(), 1000U);
  EXPECT_LT(difference(beliefs, numbers_in(*folder / "run.csv")), 1e-6);

  const std::string python = python_with_numpy();
  if (python.empty()) GTEST_SKIP() << "python3 with NumPy is not installed";
  folder->write("to_npz.py", to_npz);
  folder->write("odd_npz.yaml", odd_npz_mapping());
  const std::string command =
      fmt::format("cd '{}' && {} to_npz.py", folder->path().string(), python);
  ASSERT_EQ(std::system(command.c_str()), 0);
  ran("export odd.npz --mapping odd_npz.yaml -o npz.mpack --labels npz_labels.csv");
  EXPECT_EQ(read_file(*folder / "npz.mpack"), read_file(*folder / "odd.mpack"));
  EXPECT_EQ(read_file(*folder / "npz_labels.csv"), read_file(*folder / "odd_labels.csv"));
}

TEST_F(Mapping, ExampleIsTheOneInTheDocuments) {
  const std::string example = TOUCHDOWN_SOURCE_DIR "/examples/mapping/robot";
  EXPECT_THAT(read_file(TOUCHDOWN_SOURCE_DIR "/docs/guides/map_a_log.md"),
              HasSubstr("```yaml\n" + read_file(example + ".yaml") + "```\n"));
  EXPECT_THAT(
      ran(fmt::format("export {0}.csv --mapping {0}.yaml -o example.mpack --labels example.csv",
                      example)),
      AllOf(HasSubstr("10 records, from 81.000 to 81.009 s"), HasSubstr("3 intervals"),
            Not(HasSubstr("lack"))));
  const auto recorded = recordings::read_recording(*folder / "example.mpack");
  ASSERT_EQ(recorded.steps(), 10U);
  // The robot stands: knees bent backwards, torques that carry it, no gravity except for rounding.
  const models::Observation& o = recorded.observation.front();
  EXPECT_NEAR(o.servo[1].position, -45.3 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_NEAR(o.servo[4].position, 45.2 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_NEAR(o.servo[1].torque, 1.31, 1e-12);
  EXPECT_NEAR(o.servo[5].velocity, -10.0, 0.01);
  EXPECT_LT(o.imu.linear_acceleration.norm(), 0.1);
  EXPECT_NEAR(o.pitch, 0.0174, 1e-4);
}

TEST_F(Mapping, InconsistentRequestsAreRefusedAndNothingIsWritten) {
  folder->write("si.yaml", si_mapping());
  folder->write("bad.csv", "t,lh_q\n0,1\n");
  EXPECT_THAT(refused("export bad.csv --mapping si.yaml -o bad.mpack"),
              HasSubstr("si.yaml:3:20: joints.position.from: bad.csv has no column 'lk_q' (did you "
                        "mean 'lh_q'?)"));
  EXPECT_THAT(refused("export bad.csv --mapping si.yaml -o bad.csv"),
              HasSubstr("bad.csv: expected a log with the extension .mpack"));
  EXPECT_THAT(refused("export bad.csv --mapping si.yaml --benchmark d"),
              HasSubstr("--mapping: expected -o"));
  EXPECT_THAT(refused("export bad.csv --labels l.csv -o bad.mpack"),
              HasSubstr("--labels: expected --mapping"));
  EXPECT_THAT(refused("export bad.csv -o bad.mpack"), HasSubstr("bad.mpack: expected --mapping"));
  EXPECT_THAT(refused("estimate bad.csv --model model.npz"),
              HasSubstr("bad.csv: byte 0: expected a MessagePack map, one per control step: "
                        "`touchdown export --mapping`"));
  EXPECT_THAT(refused("export bad.csv --mapping none.yaml -o bad.mpack"), HasSubstr("none.yaml"));
  folder->write("good.csv", si_csv(*run));
  EXPECT_THAT(refused("export good.csv --mapping si.yaml -o bad.mpack --labels bad_labels.csv"),
              HasSubstr("--labels: good.csv has no contact labels"));
  EXPECT_THAT(refused("export good.csv --mapping si.yaml -o bad.mpack --labels good.csv"),
              HasSubstr("good.csv"));
  EXPECT_FALSE(std::filesystem::exists(*folder / "bad.mpack"));
  EXPECT_FALSE(std::filesystem::exists(*folder / "bad_labels.csv"));
}

}  // namespace
}  // namespace touchdown::cli

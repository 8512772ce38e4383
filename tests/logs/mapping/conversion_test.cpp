#include "logs/mapping/conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/log/reader.hpp"
#include "logs/model_file.hpp"
#include "tests/logs/log/upkie_log.hpp"
#include "tests/logs/mapping/mapped_logs.hpp"

namespace touchdown::logs {
namespace {

using ::testing::HasSubstr;

/// The required signals. Optional ones can be appended behind `imu`.
const std::string mapping_head = R"(time: {from: t}
joints:
  position: {from: [q0, q1, q2, q3, q4, q5]}
  velocity: {from: [v0, v1, v2, v3, v4, v5]}
  torque: {from: [m0, m1, m2, m3, m4, m5]}
imu:
  orientation: {from: [qw, qx, qy, qz]}
  angular_velocity: {from: [gx, gy, gz]}
  linear_acceleration: {from: [ax, ay, az]}
)";
const std::string names =
    "t,q0,q1,q2,q3,q4,q5,v0,v1,v2,v3,v4,v5,m0,m1,m2,m3,m4,m5,qw,qx,qy,qz,gx,gy,gz,ax,ay,az";

std::string row(const std::string& time) {
  std::string text = time;
  for (int i = 1; i <= 18; ++i) text += fmt::format(",{}.5", i);
  return text + ",0,0,1,0,.1,.2,.3,1,2,3";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// The log with rows 10 ms apart, each `row` of the index.
std::string log_of(std::size_t rows) {
  std::string text = names + "\n";
  for (std::size_t k = 0; k < rows; ++k)
    text += row(fmt::format("{}", 0.01 * static_cast<double>(k))) + "\n";
  return text;
}

std::string with_separator(const std::string& text, const std::string& separator) {
  std::string result;
  for (const char c : text) result += c == ',' ? separator : std::string(1, c);
  return result;
}

class Conversion : public test::MappedLogs {
 protected:
  std::vector<LogRow> convert(const std::string& csv, const std::string& mapping = mapping_head) {
    return MappedLogs::convert(write("log.csv", csv), mapping);
  }
  std::string complaint(const std::string& csv, const std::string& mapping = mapping_head) {
    return MappedLogs::complaint(write("log.csv", csv), mapping);
  }
};

TEST_F(Conversion, KeepsStampsToTheNanosecond) {
  struct Clock {
    const char* mapping;
    const char* first;
    const char* second;
    const char* separator = ",";
  };
  for (const Clock& clock : std::initializer_list<Clock>{
           {"{from: t}", "1732540000.002345679", "1732540000.012345601"},
           {"{from: t, unit: ms}", "1732540000002.345679", "1732540000012.345601"},
           {"{from: t, unit: us}", "1732540000002345.679", "1732540000012345.601"},
           {"{from: t, unit: ns}", "1732540000002345679", "1732540000012345601"},
           {"{from: t}", "2024-11-25 13:06:40.002345679", "2024-11-25T13:06:40.012345601Z"},
           {"{from: t}", "1732540000,002345679", "1732540000,012345601", ";"}}) {
    std::string csv = with_separator(names, clock.separator) + "\n";
    for (const char* time : {clock.first, clock.second}) {
      csv += time + with_separator(row(""), clock.separator) + "\n";
    }
    LogReader reader(
        mapped_records(write("log.csv", csv),
                       write("map.yaml", replaced(mapping_head, "{from: t}", clock.mapping))),
        "log");
    for (const std::int64_t stamp : {1732540000002345679, 1732540000012345601}) {
      ASSERT_TRUE(reader.next()) << clock.first;
      EXPECT_EQ(reader.stamp(), stamp) << clock.first;
    }
  }
}

TEST_F(Conversion, KeepsStampsOfSecondsAndNanoseconds) {
  const std::string csv = "sec," + replaced(names, "t,", "nsec,") + "\n1732540000," +
                          row("2345679") + "\n1732540000," + row("999999999") + "\n";
  const std::string mapping = replaced(mapping_head, "{from: t}", "{sec: sec, nanosec: nsec}");
  LogReader reader(mapped_records(write("log.csv", csv), write("map.yaml", mapping)), "log");
  for (const std::int64_t stamp : {1732540000002345679, 1732540000999999999}) {
    ASSERT_TRUE(reader.next());
    EXPECT_EQ(reader.stamp(), stamp);
  }
}

TEST_F(Conversion, NumbersOfARowAreThoseOfTheRecord) {
  const auto rows = convert(names + "\n" + row("7.25") + "\n" + row("7.5") + "\n");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].observation.time, 0.25);  // a robot's log counts from its first record
  const models::Observation& o = rows[0].observation;
  EXPECT_EQ(o.servo[4].position, 5.5);
  EXPECT_EQ(o.servo[4].velocity, 11.5);
  EXPECT_EQ(o.servo[4].torque, 17.5);
  EXPECT_EQ(o.imu.orientation.coeffs(), Eigen::Vector4d(0.0, 1.0, 0.0, 0.0));  // x y z w
  EXPECT_EQ(o.imu.angular_velocity, Eigen::Vector3d(.1, .2, .3));
  EXPECT_EQ(o.imu.linear_acceleration, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_FALSE(rows[0].truth);
  EXPECT_EQ(rows[0].action.servo[2].velocity, 0.0);
  EXPECT_EQ(converted_.rows, 2U);
  EXPECT_EQ(converted_.start, 7.25);
  EXPECT_EQ(converted_.end, 7.5);
  EXPECT_EQ(converted_.incomplete_rows + converted_.time_reversals, 0U);
}

TEST_F(Conversion, TheResultIsARobotsLogWithoutOrigin) {
  std::stringstream stream;
  const auto log = write("log.csv", names + "\n" + row("0") + "\n" + row("0.002") + "\n");
  (void)convert_log(log, write("map.yaml", mapping_head), stream, {.with_labels = true});
  LogReader reader(test::stream_source(stream), "log");
  EXPECT_EQ(reader.info().simulator, "");
  EXPECT_EQ(reader.info().control_period_us, 2000);
  EXPECT_EQ(stream.str().find("config"), std::string::npos);
  EXPECT_EQ(stream.str().find("sim"), std::string::npos);
}

TEST_F(Conversion, WindowsLineEndsQuotesByteOrderMarkAndOtherColumnsAreNoMatter) {
  std::string quoted = "\xef\xbb\xbf \"t\" ,\"a, \"\"b\"\"\",";
  quoted += replaced(names.substr(2), "q3", "\"q3\"") + ",note\r\n";
  const std::string text = quoted + "\"1.5\",\"x, y\"," + row("").substr(1) +
                           ",\"see, there\"\r\n\r\n" + "2,," + row("").substr(1) + ",no number\r\n";
  const auto rows = convert(text);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(converted_.start, 1.5);
  EXPECT_EQ(rows[1].observation.time, 0.5);
  EXPECT_EQ(rows[1].observation.servo[3].position, 4.5);
  EXPECT_EQ(converted_.incomplete_rows, 0U);
  EXPECT_THAT(complaint(quoted, replaced(mapping_head, "from: t", "from: 'a, \"b\"'")),
              HasSubstr("holds no rows"));  // there is such a column
}

TEST_F(Conversion, WhatIsMissingIsNaNAndCounted) {
  std::string text = names + "\n";
  for (const char* time : {"", "1", "2", "3", "nan", "2.5"}) text += row(time) + "\n";
  text = replaced(text, "\n1,1.5,", "\n1,,");
  text = replaced(text, "\n2,1.5,", "\n2,NaN,");
  text = replaced(text, "\n3,1.5,", "\n3,inf,");
  const auto rows = convert(text);
  ASSERT_EQ(rows.size(), 5U);  // what comes before the first time is left out, as in any log
  EXPECT_TRUE(std::isnan(rows[0].observation.servo[0].position));
  EXPECT_TRUE(std::isnan(rows[1].observation.servo[0].position));
  EXPECT_TRUE(std::isinf(rows[2].observation.servo[0].position));
  EXPECT_EQ(rows[2].observation.servo[1].position, 2.5);
  EXPECT_TRUE(std::isnan(rows[3].observation.time));
  EXPECT_EQ(rows[4].observation.time, 1.5);
  EXPECT_EQ(converted_.rows, 6U);
  EXPECT_EQ(converted_.incomplete_rows, 5U);
  EXPECT_EQ(converted_.time_reversals, 1U);
  EXPECT_EQ(converted_.start, 1.0);
}

TEST_F(Conversion, PeriodStandsForTimes) {
  const auto rows = convert(names + "\n" + row("a") + "\n" + row("b") + "\n" + row("c") + "\n",
                            replaced(mapping_head, "time: {from: t}", "period: 0.005"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[2].observation.time, 0.01);
}

TEST_F(Conversion, ClockThatSeemsToCountAnotherUnitIsRefusedAndAPauseIsNot) {
  const auto log = [](std::initializer_list<const char*> times) {
    std::string text = names + "\n";
    for (const char* time : times) text += row(time) + "\n";
    return text;
  };
  EXPECT_THAT(complaint(log({"0", "1", "2", "3"})),
              HasSubstr("log.csv: most rows come more than 0.5 s after the one before: is time in "
                        "ms, us or ns?"));
  EXPECT_EQ(convert(log({"0", "0.01", "0.02", "7", "7.01", "7.02"})).size(), 6U);
}

TEST_F(Conversion, UnitsSignsAndZerosAreThoseOfTheMapping) {
  std::string mapping = replaced(mapping_head, "from: t", "from: t, unit: us");
  mapping = replaced(mapping, "q5]", "q5], unit: deg, sign: -1, zero: [0, 0, 0.5, 0, 0, 0]");
  mapping = replaced(mapping, "v5]", "v5], unit: rev/s, sign: [1, 1, 1, -1, -1, -1]");
  mapping = replaced(mapping, "m5]", "m5], unit: mNm");
  mapping = replaced(mapping, "az]", "az], unit: g");
  const auto rows = convert(names + "\n" + row("0") + "\n" + row("1e6") + "\n", mapping);
  const models::Observation& o = rows.at(1).observation;
  EXPECT_DOUBLE_EQ(o.time, 1.0);
  EXPECT_DOUBLE_EQ(o.servo[1].position, -2.5 * M_PI / 180.0);
  EXPECT_DOUBLE_EQ(o.servo[2].position, 0.5 - 3.5 * M_PI / 180.0);
  EXPECT_DOUBLE_EQ(o.servo[2].velocity, 9.5 * 2.0 * M_PI);
  EXPECT_DOUBLE_EQ(o.servo[3].velocity, -10.5 * 2.0 * M_PI);
  EXPECT_DOUBLE_EQ(o.servo[0].torque, 0.0135);
  EXPECT_DOUBLE_EQ(o.imu.linear_acceleration.y(), 2.0 * 9.80665);
}

TEST_F(Conversion, ChipAtRestAccelerates) {
  // z up, level, at rest: it measures 1 g upwards, and nothing is left of that without gravity.
  std::string mapping = replaced(mapping_head, "linear_", "proper_");
  mapping = replaced(mapping, "qw, qx, qy, qz]", "qx, qy, qz, qw], order: xyzw, reference: z_up");
  mapping += "  axes: [-x, y, -z]\n";
  const std::string at_rest =
      replaced(row("0"), ",0,0,1,0,.1,.2,.3,1,2,3", ",1,0,0,0,.1,.2,.3,0,0,9.81");
  const auto rows = convert(names + "\n" + at_rest + "\n", mapping);
  const models::Observation& o = rows.at(0).observation;
  EXPECT_NEAR(o.imu.linear_acceleration.norm(), 0.0, 1e-12);
  EXPECT_EQ(o.imu.raw_linear_acceleration, Eigen::Vector3d(0.0, 0.0, -9.81));
  EXPECT_EQ(o.imu.angular_velocity, Eigen::Vector3d(-.1, .2, -.3));
  EXPECT_NEAR(o.pitch, 0.0, 1e-12);
  EXPECT_NEAR(o.yaw, 0.0, 1e-12);
  // The same, turned to the left by a quarter and leaning forward by .1 rad.
  const Eigen::Quaterniond q = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY());
  const std::string leaning =
      replaced(at_rest, ",1,0,0,0,", fmt::format(",{},{},{},{},", q.w(), q.x(), q.y(), q.z()));
  const auto turned = convert(names + "\n" + leaning + "\n", mapping);
  EXPECT_NEAR(turned.at(0).observation.pitch, 0.1, 1e-12);
  EXPECT_NEAR(turned.at(0).observation.yaw, M_PI / 2, 1e-12);
}

TEST_F(Conversion, CommandOfTheWheelsIsMapped) {
  const std::string mapping =
      replaced(mapping_head, "imu:", "  wheel_velocity_target: {from: [cl, cr]}\nimu:");
  const auto rows = convert(names + ",cl,cr\n" + row("0") + ",4,-6\n", mapping);
  EXPECT_EQ(rows.at(0).action.servo[2].velocity, 4.0);
  EXPECT_EQ(rows.at(0).action.servo[5].velocity, -6.0);
}

TEST_F(Conversion, TargetsOfLegsAreMapped) {
  const std::string header = names + ",ph,pk,qh,qk,vh,vk,wh,wk\n" + row("0");
  const std::string values = ",90,-45,-90,30,1,2,3,4\n";
  const auto mapped = [](const std::string& keys) {
    return replaced(mapping_head, "imu:", "  leg_targets: {" + keys + "}\nimu:");
  };
  const std::string position =
      "position: {from: [ph, pk, qh, qk], unit: deg, zero: [0.1, 0, 0, 0]}";
  const auto rows =
      convert(header + values, mapped(position + ", velocity: {from: [vh, vk, wh, wk], sign: -1}, "
                                                 "kp: [40, 30, 20, 10], kd: 2"));
  const auto& servo = rows.at(0).action.servo;
  EXPECT_NEAR(servo[0].position, M_PI / 2 - 0.1, 1e-12);
  EXPECT_NEAR(servo[1].position, -M_PI / 4, 1e-12);
  EXPECT_NEAR(servo[3].position, -M_PI / 2, 1e-12);
  EXPECT_NEAR(servo[4].position, M_PI / 6, 1e-12);
  EXPECT_EQ(servo[4].velocity, -4.0);
  EXPECT_EQ(servo[1].feedforward_torque, 0.0);
  // Scales of Upkie's gains, 20 N·m/rad and 1 N·m·s/rad.
  EXPECT_EQ(servo[0].kp_scale, 2.0);
  EXPECT_EQ(servo[4].kp_scale, 0.5);
  EXPECT_EQ(servo[3].kd_scale, 2.0);
  // Without kd there is no damping, and without this section there are no targets.
  EXPECT_EQ(convert(header + values, mapped(position + ", kp: 40")).at(0).action.servo[0].kd_scale,
            0.0);
  EXPECT_TRUE(std::isnan(convert(names + "\n" + row("0") + "\n").at(0).action.servo[0].position));
}

TEST_F(Conversion, LabelsAreIntervalsOfEqualRows) {
  std::string text = names + ",left,right\n";
  const char* labels[] = {"1,1", "1,1", "0,1", "0,1", ",1", "1,0.2"};
  for (int k = 0; k < 6; ++k)
    text += row(fmt::format("{}", 3.0 + 0.5 * k)) + "," + labels[k] + "\n";
  const std::string mapping = mapping_head + "contact: {from: [left, right]}\n";
  (void)convert(text, mapping);
  EXPECT_EQ(to_csv(converted_.contact), "start,end,left,right\n0,1,1,1\n1,2,0,1\n2.5,3,1,0\n");
  EXPECT_EQ(converted_.incomplete_rows, 0U);
  (void)convert(text, mapping_head + "contact: {from: right, above: 0.1}\n");
  EXPECT_EQ(to_csv(converted_.contact), "start,end,left,right\n0,3,1,1\n");
  EXPECT_THAT(complaint(replaced(text, "\n5,", "\n4,"), mapping),
              HasSubstr("log.csv:6: contact labels need increasing times: 1 s comes after 1.5"));
}

TEST_F(Conversion, ALogBackwardsNamesItsFirstRowThatGoesBack) {
  const auto log_at = [](const std::vector<double>& times) {
    std::string text = names + "\n";
    for (const double time : times) text += row(fmt::format("{}", time)) + "\n";
    return text;
  };
  std::vector<double> times;
  for (int k = 0; k < 300; ++k) times.push_back(1.7e9 + 0.01 * (300 - k));
  const auto refused = [&] { return complaint(log_at(times), mapping_head); };
  EXPECT_THAT(refused(),
              HasSubstr("log.csv:3: times decrease from here on, at 199 of 200 rows: sort"));
  std::swap(times[0], times[1]);  // the newest rows are nearly so
  EXPECT_THAT(refused(), HasSubstr("log.csv:4: times decrease"));
  times = {2.0, 2.0, 1.0, 0.5, 0.25};
  EXPECT_THAT(refused(), HasSubstr("log.csv:4: times decrease from here on, at 3 of 5 rows"));
  times.clear();
  for (int k = 0; k < 300; ++k) times.push_back(0.01 * (k ^ 1));  // pairs are exchanged
  EXPECT_EQ(convert(log_at(times)).size(), 300U);
}

TEST_F(Conversion, LabelsEndWithTheLogWhateverItsClockSkipped) {
  std::string text = names + ",c\n";
  for (const char* time : {"0", "0.01", "0.02", "86400", "86400.01"}) text += row(time) + ",1\n";
  (void)convert(text, mapping_head + "contact: {from: c}\n");
  EXPECT_EQ(to_csv(converted_.contact), "start,end,left,right\n0,86400.02,1,1\n");
}

/// A log of four rows as arrays, or of more.
ModelArrays sample_arrays(std::size_t rows = 4) {
  const auto array = [rows](std::size_t columns) {
    ModelArray made{{rows, columns}, {}};
    for (std::size_t i = 0; i < rows * columns; ++i) made.data.push_back(static_cast<double>(i));
    return made;
  };
  ModelArrays arrays = {{"q", array(7)}, {"v", array(6)}, {"m", array(6)}, {"o", array(4)}};
  arrays["g"] = arrays["a"] = array(3);
  arrays["t"] = {{rows}, {}};
  for (std::size_t i = 0; i < rows; ++i) arrays["t"].data.push_back(0.1 * static_cast<double>(i));
  arrays["left"] = arrays["right"] = array(1);
  return arrays;
}

const std::string array_mapping = R"(time: {from: t}
joints:
  position: {from: q, index: [6, 5, 4, 3, 2, 1]}
  velocity: {from: v}
  torque: {from: m}
imu:
  orientation: {from: o}
  angular_velocity: {from: g}
  linear_acceleration: {from: a}
contact: {from: [left, right], above: 1.5}
)";

TEST_F(Conversion, ArraysAreReadByTheirColumns) {
  write_npz(sample_arrays(), folder_ / "log.npz");
  const auto rows = MappedLogs::convert(folder_ / "log.npz", array_mapping);
  ASSERT_EQ(rows.size(), 4U);
  const models::Observation& o = rows[2].observation;
  EXPECT_EQ(o.time, 0.2);
  EXPECT_EQ(o.servo[0].position, 2 * 7 + 6);
  EXPECT_EQ(o.servo[5].position, 2 * 7 + 1);
  EXPECT_EQ(o.servo[5].torque, 2 * 6 + 5);
  EXPECT_EQ(o.imu.linear_acceleration, Eigen::Vector3d(6.0, 7.0, 8.0));
  EXPECT_EQ(converted_.contact.intervals.size(), 2U);
}

TEST_F(Conversion, ATransposedArrayIsNamed) {
  const auto refused = [&](const std::string& name, const std::string& mapping) {
    ModelArrays arrays = sample_arrays(9);
    std::vector<std::size_t>& shape = arrays.at(name).shape;
    shape.resize(2, 1);
    std::swap(shape[0], shape[1]);
    write_npz(arrays, folder_ / "log.npz");
    return MappedLogs::complaint(folder_ / "log.npz", mapping);
  };
  for (const auto& [name, width] :
       {std::pair{"v", 6}, std::pair{"m", 6}, std::pair{"o", 4}, std::pair{"g", 3}}) {
    EXPECT_THAT(refused(name, array_mapping),
                HasSubstr(fmt::format("'{0}' is {1} × 9: expected N × {1}, a row for each time: "
                                      "array.T transposes it",
                                      name, width)));
  }
  EXPECT_THAT(refused("q", array_mapping),
              HasSubstr("q has 7 rows, and t has 9: q is 7 × 9: expected a row for each time: "
                        "array.T transposes it"));
  EXPECT_THAT(refused("q", replaced(array_mapping, "time: {from: t}", "period: 0.001")),
              HasSubstr("v has 9 rows, and q has 7: q is 7 × 9"));
  EXPECT_THAT(refused("t", array_mapping),
              HasSubstr("t: is 1 × 9: expected one axis: array.ravel() makes it"));
}

// Habits of other programs ----------------------------------------------------------------------

TEST_F(Conversion, SeparatorIsThatOfTheNames) {
  for (const char* separator : {",", ";", "\t", " ; "}) {
    const auto rows = convert(with_separator(log_of(3), separator));
    ASSERT_EQ(rows.size(), 3U) << separator;
    EXPECT_EQ(rows[1].observation.servo[4].torque, 17.5) << separator;
  }
  // Names that contain another separator are quoted; decimal commas go with semicolons.
  std::string german = with_separator(log_of(2), ";");
  std::replace(german.begin(), german.end(), '.', ',');
  EXPECT_EQ(convert(german).at(1).observation.servo[0].position, 1.5);
  const std::string quoted = replaced(with_separator(log_of(2), ";"), "q0", "\"hip, left\"");
  EXPECT_EQ(convert(quoted, replaced(mapping_head, "q0", "'hip, left'")).size(), 2U);
}

TEST_F(Conversion, CommentsAreSkippedAndMayHoldTheNames) {
  const std::string plain = log_of(2);
  const auto after = [](const char* comment, const std::string& text) {
    return fmt::format("{}{}", comment, text);
  };
  for (const std::string& text :
       {after("# recorded by us, in a hall\n", plain), after("% a\n# b\n", plain),
        replaced(plain, "\n0.01,", "\n# a stop\n0.01,"), after("# ", plain), after("#", plain),
        after("# recorded by us\n# ", plain), after("#", with_separator(plain, "\t"))}) {
    EXPECT_EQ(convert(text).size(), 2U) << text.substr(0, 40);
  }
}

TEST_F(Conversion, NumbersMayHaveAPlus) {
  for (const char* number : {"+1.5e0", "+1.5", "+15e-1", "+001.50"}) {
    const auto rows = convert(replaced(log_of(2), ",1.5,", fmt::format(",{},", number)));
    EXPECT_EQ(rows.at(0).observation.servo[0].position, 1.5) << number;
  }
  EXPECT_TRUE(std::isinf(
      convert(replaced(log_of(2), ",1.5,", ",+inf,")).at(0).observation.servo[0].position));
}

TEST_F(Conversion, ExtensionMayBeInAnyCase) {
  for (const char* name : {"LOG.CSV", "log.Csv", "log.TSV"}) {
    EXPECT_EQ(MappedLogs::convert(write(name, log_of(2)), mapping_head).size(), 2U) << name;
  }
  write_npz(sample_arrays(), folder_ / "LOG.NPZ");
  EXPECT_EQ(MappedLogs::convert(folder_ / "LOG.NPZ", array_mapping).size(), 4U);
}

TEST_F(Conversion, LastRowThatIsCutOffIsLeftOutAndNamed) {
  const std::string whole = log_of(4);
  const std::string last = row("0.03");
  const std::string before = whole.substr(0, whole.size() - last.size() - 1);
  for (const std::string& cut :
       {last.substr(0, 3), last.substr(0, 40), last.substr(0, last.size() - 1),
        last.substr(0, last.size() - 1) + "-", last.substr(0, last.size() - 1) + "1e",
        std::string("\"0.03")}) {
    const auto rows = convert(before + cut);
    const bool is_whole = cut == last.substr(0, last.size() - 1);  // an empty last cell
    EXPECT_EQ(rows.size(), is_whole ? 4U : 3U) << cut;
    if (is_whole) continue;
    EXPECT_THAT(converted_.warnings,
                ::testing::ElementsAre(HasSubstr("log.csv:5: the last row is cut off")));
  }
  EXPECT_EQ(convert(before + last).size(), 4U) << "a whole row needs no line end";
  EXPECT_THAT(converted_.warnings, ::testing::IsEmpty());
  EXPECT_THAT(complaint(before + last.substr(0, 40) + "\n" + last),
              HasSubstr("expected 29 values"));
}

TEST_F(Conversion, TimesMayBeDates) {
  const auto rows_of = [&](const char* first, const char* second) {
    std::string text = replaced(log_of(2), "\n0,", fmt::format("\n{},", first));
    return convert(replaced(text, "\n0.01,", fmt::format("\n{},", second)));
  };
  for (const auto& [first, second] : std::vector<std::pair<const char*, const char*>>{
           {"2024-02-28 23:59:59.995", "2024-02-29 00:00:00.005"},
           {"2024-02-28T23:59:59.995000", "2024-02-29T00:00:00.005000Z"},
           {"2024-02-28T23:59:59.995+00:00", "2024-02-29T05:30:00.005+05:30"},
           {"2024-02-28T18:59:59.995-05:00", "2024-02-29 01:00:00.005+01:00"},
           {"\"2024-12-31 23:59:59.99\"", "\"2025-01-01 00:00:00\""}}) {
    EXPECT_NEAR(rows_of(first, second).at(1).observation.time, 0.01, 1e-6) << first;
  }
  (void)rows_of("1970-01-02 00:00:01", "1970-01-02 00:00:01.01");
  EXPECT_EQ(converted_.start, 86401.0);
}

TEST_F(Conversion, LabelsAreLookedAtOnlyIfAsked) {
  std::string text = names + ",c\n";
  for (const char* time : {"0", "0.01", "0.005"}) text += row(time) + ",1\n";
  const std::string mapping = mapping_head + "contact: {from: c}\n";
  EXPECT_THAT(complaint(text, mapping), HasSubstr("contact labels need increasing times"));
  std::stringstream stream;
  const ConvertedLog converted =
      convert_log(write("log.csv", text), write("map.yaml", mapping), stream);
  EXPECT_EQ(converted.rows, 3U);
  EXPECT_EQ(converted.time_reversals, 1U);
}

TEST_F(Conversion, CellsThatAreEmptyNowAndThenAreHeld) {
  // Rows 2 ms apart; every third lacks the torque of a knee.
  std::string text = names + "\n";
  for (int k = 0; k < 30; ++k) {
    std::string one = row(fmt::format("{}", 0.002 * k));
    one = replaced(one, ",14.5,", k % 3 == 1 ? ",," : fmt::format(",{},", k));
    text += one + "\n";
  }
  const auto rows = convert(text);
  ASSERT_EQ(rows.size(), 30U);
  EXPECT_EQ(rows[4].observation.servo[1].torque, 3.0);
  EXPECT_EQ(rows[5].observation.servo[1].torque, 5.0);
  EXPECT_EQ(converted_.completed_rows, 10U);
  EXPECT_NEAR(converted_.oldest, 0.002, 1e-9);
  EXPECT_EQ(converted_.incomplete_rows, 0U);
}

TEST_F(Conversion, RowsOfTwoTopicsAreJoinedAtTheJoints) {
  // Joints at 500 Hz, the IMU at 200 Hz, each in rows of its own.
  std::string text = names + "\n";
  for (int ms = 0; ms < 100; ++ms) {
    const bool joints = ms % 2 == 0;
    const bool imu = ms % 5 == 0;
    if (!joints && !imu) continue;
    text += fmt::format("{}", 1e-3 * ms);
    for (int i = 0; i < 18; ++i) text += joints ? fmt::format(",{}", ms) : ",";
    text += imu ? fmt::format(",0,0,1,0,{0},.2,.3,1,2,3", ms) : ",,,,,,,,,,";
    text += "\n";
  }
  const auto rows = convert(text);
  ASSERT_EQ(rows.size(), 50U);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int ms = 2 * static_cast<int>(k);
    EXPECT_EQ(rows[k].observation.servo[0].position, ms);
    EXPECT_EQ(rows[k].observation.imu.angular_velocity.x(), ms / 5 * 5);
  }
  EXPECT_EQ(converted_.rows_without_joints, 10U);
  EXPECT_NEAR(converted_.oldest, 0.004, 1e-9);
}

TEST_F(Conversion, TimesThatCountAnotherUnitAreNamed) {
  const auto text = [](double step) {
    std::string log = names + "\n";
    for (int k = 0; k < 40; ++k) log += row(fmt::format("{}", step * k)) + "\n";
    return log;
  };
  EXPECT_THAT(complaint(text(2.0)), HasSubstr("times look like milliseconds"));
  EXPECT_THAT(complaint(text(1000.0)), HasSubstr("times look like microseconds"));
  EXPECT_THAT(complaint(text(5e6)), HasSubstr("times look like nanoseconds"));
  const std::string in_ns = replaced(mapping_head, "from: t", "from: t, unit: ns");
  EXPECT_EQ(complaint(text(5e6), in_ns), "no complaint");
  EXPECT_THAT(complaint(text(0.005), in_ns), HasSubstr("is the `unit` of `time` smaller"));
}

TEST_F(Conversion, ScaleIsAFactorOfEachNumber) {
  std::string mapping = replaced(mapping_head, "m5]", "m5], scale: 0.1");
  mapping =
      replaced(mapping, "q5]", "q5], scale: [1, 2, 1, 1, 1, 0.5], zero: 0.25, sign: -1, unit: deg");
  const auto rows = convert(log_of(2), mapping);
  const models::Observation& o = rows.at(0).observation;
  EXPECT_DOUBLE_EQ(o.servo[0].torque, 1.35);
  EXPECT_DOUBLE_EQ(o.servo[1].position, 0.25 - 2.0 * 2.5 * M_PI / 180.0);
  EXPECT_DOUBLE_EQ(o.servo[5].position, 0.25 - 0.5 * 6.5 * M_PI / 180.0);
}

TEST_F(Conversion, ImuMayBeMountedAtAnyRotation) {
  const auto mounted = [&](const std::string& how) {
    const auto rows = convert(log_of(2), mapping_head + "  " + how + "\n");
    return rows.at(0).observation.imu;
  };
  const models::ImuReading with_axes = mounted("axes: [-x, y, -z]");
  for (const char* same : {"rotation: {rpy: [0, 0, 0]}", "rotation: {quaternion: [1, 0, 0, 0]}",
                           "rotation: {rpy: [0, 0, 360], unit: deg}"}) {
    const models::ImuReading imu = mounted(same);
    EXPECT_NEAR((imu.angular_velocity - with_axes.angular_velocity).norm(), 0.0, 1e-12) << same;
    EXPECT_NEAR(imu.orientation.angularDistance(with_axes.orientation), 0.0, 1e-7) << same;
  }
  // Turned to the left by a quarter: its x axis is the robot's left.
  for (const char* turned :
       {"rotation: {rpy: [0, 0, 90], unit: deg}", "rotation: {rpy: [0, 0, 1.5707963267948966]}",
        "rotation: {quaternion: [0.7071067811865476, 0, 0, 0.7071067811865476]}"}) {
    const models::ImuReading imu = mounted(turned);
    EXPECT_NEAR((imu.angular_velocity - Eigen::Vector3d(.2, .1, -.3)).norm(), 0.0, 1e-12) << turned;
    EXPECT_NEAR((imu.linear_acceleration - Eigen::Vector3d(2, 1, -3)).norm(), 0.0, 1e-12) << turned;
    // What the world sees of a vector does not depend on the mounting.
    EXPECT_NEAR((imu.orientation * imu.linear_acceleration -
                 with_axes.orientation * with_axes.linear_acceleration)
                    .norm(),
                0.0, 1e-12);
  }
  const models::ImuReading tilted = mounted("rotation: {rpy: [0.1, -0.2, 0.3]}");
  EXPECT_NEAR(tilted.angular_velocity.norm(), with_axes.angular_velocity.norm(), 1e-12);
  EXPECT_GT((tilted.angular_velocity - with_axes.angular_velocity).norm(), 0.01);
}

TEST_F(Conversion, RobotMayLackHips) {
  std::string mapping = mapping_head;
  for (const char* one : {"q", "v", "m"}) {
    mapping = replaced(mapping, fmt::format("[{0}0, {0}1, {0}2, {0}3, {0}4, {0}5]", one),
                       fmt::format("[{0}1, {0}2, {0}4, {0}5], sign: [1, 1, -1, -1]", one));
  }
  mapping = replaced(mapping, "imu:", "  hip: none\nimu:");
  const models::Observation o = convert(log_of(2), mapping).at(0).observation;
  EXPECT_EQ(o.servo[0].position, 0.0);
  EXPECT_EQ(o.servo[3].torque, 0.0);
  EXPECT_EQ(o.servo[1].position, 2.5);
  EXPECT_EQ(o.servo[2].velocity, 9.5);
  EXPECT_EQ(o.servo[4].torque, -17.5);
  EXPECT_EQ(o.servo[5].torque, -18.5);
}

TEST_F(Conversion, RobotOfTheMappingIsThatOfTheLog) {
  std::stringstream stream;
  (void)convert_log(write("log.csv", log_of(5)), write("map.yaml", "robot: mine\n" + mapping_head),
                    stream);
  LogReader reader(test::stream_source(stream), "log");
  EXPECT_EQ(reader.info().robot, "mine");
  EXPECT_EQ(reader.info().simulator, "");
  EXPECT_EQ(reader.info().control_period_us, 10000);
  std::size_t rows = 0;
  while (reader.next()) ++rows;
  EXPECT_EQ(rows, 5U);
}

TEST_F(Conversion, ArrayWithAColumnForEachWheelHoldsBothLabels) {
  ModelArrays arrays = sample_arrays();
  arrays["contact"] = {{4, 2}, {1, 1, 0, 1, 0, 1, 1, 1}};
  write_npz(arrays, folder_ / "log.npz");
  for (const char* contact :
       {"contact: {from: contact}", "contact: {from: contact, index: [0, 1]}"}) {
    (void)MappedLogs::convert(
        folder_ / "log.npz",
        replaced(array_mapping, "contact: {from: [left, right], above: 1.5}", contact));
    ASSERT_EQ(converted_.contact.intervals.size(), 3U) << contact;
    EXPECT_EQ(converted_.contact.intervals[1].contact, (std::array<bool, 2>{false, true}))
        << contact;
  }
  (void)MappedLogs::convert(folder_ / "log.npz",
                            replaced(array_mapping, "contact: {from: [left, right], above: 1.5}",
                                     "contact: {from: contact, index: 1}"));
  EXPECT_EQ(converted_.contact.intervals.size(), 1U);
}

}  // namespace
}  // namespace touchdown::logs

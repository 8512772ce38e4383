#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "logs/log/reader.hpp"
#include "logs/log/recording_file.hpp"
#include "tests/complaint.hpp"
#include "tests/logs/log/sample_recording.hpp"
#include "tests/logs/log/upkie_log.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::logs {
namespace {

using nlohmann::json;
using test::pack;
using test::upkie_record;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<json> upkie_records(int count) {
  std::vector<json> records;
  for (int i = 0; i < count; ++i) records.push_back(upkie_record(1e-3 * i));
  return records;
}

struct Read {
  std::size_t rows = 0;
  std::vector<std::string> warnings;
  std::string error;
};

Read read(const std::string& log) {
  std::istringstream stream(log);
  LogReader reader(test::stream_source(stream), "run.mpack");
  Read result;
  try {
    while (reader.next()) ++result.rows;
  } catch (const InputError& error) {
    result.error = error.what();
  }
  result.warnings = reader.warnings();
  return result;
}

TEST(UglyLogs, ACutLastRecordIsReportedAndTheRestIsUsed) {
  const std::string whole = pack(upkie_records(3));
  const std::size_t two = pack(upkie_records(2)).size();
  for (const std::size_t size : {two + 1, two + 7, whole.size() - 300, whole.size() - 1}) {
    const Read result = read(whole.substr(0, size));
    EXPECT_EQ(result.rows, 2U);
    EXPECT_THAT(result.error, IsEmpty());
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_THAT(result.warnings[0],
                AllOf(HasSubstr("run.mpack"), HasSubstr("byte " + std::to_string(two)),
                      HasSubstr("cut off")));
  }
  EXPECT_THAT(read(whole).warnings, IsEmpty());
}

TEST(UglyLogs, GarbageIsNamedByItsOffset) {
  const std::string good = pack(upkie_records(2));
  for (const std::string& garbage :
       {std::string("hello"), std::string("\xc1", 1), std::string("\x83\xc1", 2)}) {
    const Read result = read(good + garbage);
    EXPECT_EQ(result.rows, 2U);
    EXPECT_THAT(result.error, HasSubstr("run.mpack: byte "));
    const std::size_t at = std::stoul(result.error.substr(result.error.find("byte ") + 5));
    EXPECT_GE(at, good.size());
    EXPECT_LE(at, good.size() + garbage.size());
  }
  EXPECT_THAT(read("name: stairs\n").error, HasSubstr("byte 0"));
}

TEST(UglyLogs, AMissingFileIsAnError) {
  EXPECT_THROW(LogReader("/nonexistent/run.mpack"), InputError);
  const ScratchFolder folder;
  EXPECT_THROW(read_recording(folder.path()), InputError) << "a folder is no log";
}

TEST(UglyLogs, AllMissingKeysAreNamedTogether) {
  std::vector<json> records = upkie_records(50);
  for (json& record : records) {
    record.erase("time");
    record["observation"].erase("time");
    record["observation"]["servo"]["left_knee"].erase("torque");
    record["observation"]["imu"]["linear_acceleration"] = {1.0, 2.0};
  }
  const std::string error = read(pack(records)).error;
  EXPECT_THAT(
      error, AllOf(HasSubstr("observation.time"), HasSubstr("observation.servo.left_knee.torque, "),
                   HasSubstr("observation.imu.linear_acceleration (2 numbers instead of 3)")));
  EXPECT_THAT(error, ::testing::Not(HasSubstr("right_knee")));
  EXPECT_THAT(error, ::testing::Not(HasSubstr("\n")));
}

TEST(UglyLogs, AnEndlessStreamWithoutNeededKeysIsGivenUp) {
  json record = upkie_record(0.0);
  record["observation"].erase("imu");
  EXPECT_THAT(read(pack(std::vector<json>(2500, record))).error, HasSubstr("observation.imu"));
}

TEST(UglyLogs, RecordsOfAStartingSpineAreSkippedAndCounted) {
  std::vector<json> records = upkie_records(5);
  records[0] = {{"config", {{"bullet", {{"gui", false}}}}}, {"time", 1.0}};
  records[1]["observation"].erase("servo");
  const Read result = read(pack(records));
  EXPECT_EQ(result.rows, 3U);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_THAT(result.warnings[0], HasSubstr("2 of 5 records"));
}

TEST(UglyLogs, NumbersOfAnotherKindAndUnknownKeysAreTaken) {
  json record = upkie_record(7.25);
  record["observation"]["servo"]["left_hip"]["torque"] = -3;
  record["observation"]["servo"]["left_knee"]["torque"] = 70000;
  record["observation"]["imu"]["angular_velocity"] = {1, -2, 0};
  record["extra"] = {{"observation", {{"time", 5.0}}}, {"list", {1, {{"imu", 2}}, "three"}}};
  record["observation"]["servo"]["tail"] = {{"position", 9.0}};
  std::istringstream stream(pack({record}));
  LogReader reader(test::stream_source(stream), "log");
  EXPECT_EQ(reader.start_time(), 0.0);
  const models::Observation o = reader.next()->observation;
  EXPECT_EQ(reader.start_time(), 107.25);
  EXPECT_EQ(o.time, 0.0);
  EXPECT_EQ(o.servo[0].torque, -3.0);
  EXPECT_EQ(o.servo[1].torque, 70000.0);
  EXPECT_EQ(o.imu.angular_velocity, Eigen::Vector3d(1.0, -2.0, 0.0));
}

TEST(UglyLogs, AnEmptyKeyIsAKeyThatWeDoNotKnow) {
  json record = upkie_record(0.0);
  for (json* map : {&record, &record["observation"], &record["observation"]["servo"],
                    &record["observation"]["imu"]}) {
    (*map)[""] = 1.0;
  }
  const std::string smallest("\x81\xa0\xc0", 3);
  for (const std::string& wider :
       {std::string("\x81\xd9\x00\xc0", 4), std::string("\x81\xda\x00\x00\xc0", 5),
        std::string("\x81\xdb\x00\x00\x00\x00\xc0", 7), smallest}) {
    std::string log = wider;
    log.append(pack({record})).append(wider);
    const Read result = read(log);
    EXPECT_EQ(result.rows, 1U);
    EXPECT_EQ(result.error, "");
  }
  EXPECT_THAT(read(smallest).error, HasSubstr("observation.servo.left_hip.position"));
}

TEST(UglyLogs, ATextInAKeyThatIsAListOrAMapIsNoKey) {
  const std::string good = pack({upkie_record(0.0)});
  json other = upkie_record(5.0);
  const std::vector<std::uint8_t> observation = json::to_msgpack(other["observation"]);
  const std::string value(observation.begin(), observation.end());
  for (const std::string& key : {std::string("\x91\xab") + "observation",
                                 std::string("\x81\xab") + "observation" + "\xc0"}) {
    std::string log = "\x81";
    log += key;
    log += value;
    const Read result = read(log + good);
    EXPECT_EQ(result.rows, 1U) << "the first record has no observation";
    EXPECT_EQ(result.error, "");
  }
}

TEST(UglyLogs, RecordsBeforeTheFirstFiniteTimeAreLeftOutAndNamed) {
  std::vector<json> records = upkie_records(6);
  records[0]["observation"]["time"] = std::nan("");
  records[1]["observation"]["time"] = HUGE_VAL;
  const std::string log = pack(records);
  const Read result = read(log);
  EXPECT_EQ(result.rows, 4U);
  EXPECT_EQ(result.error, "");
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_THAT(result.warnings[0],
              AllOf(HasSubstr("run.mpack: byte 0: the time of record 1 is not a finite number"),
                    HasSubstr("and 1 more")));
  std::istringstream stream(log);
  LogReader reader(test::stream_source(stream), "run.mpack");
  EXPECT_EQ(reader.info().control_period_us, 1000);
  EXPECT_EQ(reader.next()->observation.time, 0.0);
  EXPECT_EQ(reader.skipped(), log.substr(0, pack({records[0], records[1]}).size()))
      << "a copy of the log keeps them";
}

TEST(UglyLogs, ATimeThatIsNotFiniteLaterIsLeftToTheSignalGuard) {
  std::vector<json> records = upkie_records(5);
  records[2]["observation"]["time"] = std::nan("");
  std::istringstream stream(pack(records));
  LogReader reader(test::stream_source(stream), "run.mpack");
  EXPECT_EQ(reader.info().control_period_us, 1000);
  std::vector<bool> finite;
  while (const std::optional<LogRow> row = reader.next()) {
    finite.push_back(std::isfinite(row->observation.time));
  }
  EXPECT_EQ(finite, (std::vector<bool>{true, true, false, true, true}));
}

TEST(UglyLogs, ALogWithoutAnyFiniteTimeIsRefused) {
  std::vector<json> records = upkie_records(3);
  for (json& record : records) record["observation"]["time"] = std::nan("");
  EXPECT_THAT(read(pack(records)).error, HasSubstr("byte 0: the time of record 1 is not a finite"));
  EXPECT_THAT(read(pack(std::vector<json>(2500, records[0]))).error, HasSubstr("nor is any after"));
}

TEST(UglyLogs, LogsThatAreRefusedNameTheReason) {
  EXPECT_THAT(read("").error, HasSubstr("empty"));
  EXPECT_THAT(read("\x81").error, HasSubstr("byte 0"));
  const std::vector<std::pair<json, const char*>> configs = {
      {{{"scenario", "caf\xe9"}},
       "run.mpack: config.touchdown: scenario: not UTF-8 from byte 3 on"},
      {{{"scenario_yaml", "name: \xff"}}, "scenario_yaml: not UTF-8 from byte 6 on"},
      {{{"outcome", "exploded"}}, "exploded"},
      {{{"seed", "one"}}, "config.touchdown"},
      {{{"control_period_us", 0}}, "control_period_us"}};
  for (const auto& [config, expected] : configs) {
    json record = upkie_record(0.0);
    record["config"]["touchdown"] = config;
    EXPECT_THAT(read(pack({record})).error, HasSubstr(expected));
  }
  struct Value {
    const char* part;
    const char* key;
    json value;
    const char* expected;
  };
  const std::vector<Value> values = {
      {"imu",
       "orientation",
       {1, 0, 0, 0, 0},
       "missing: observation.imu.orientation (5 numbers instead of 4)"},
      {"imu", "orientation", {1, 0, 0}, "observation.imu.orientation (3 numbers instead of 4)"},
      {"imu", "orientation", 1.0, "(1 number instead of 4)"},
      {"servo", "torque", true,
       "observation.servo.left_knee.torque (true or false instead of a number)"},
      {"servo", "torque", "1.5", "torque (a text instead of a number)"},
      {"imu", "linear_acceleration", {1.0, false, 2.0}, "(true or false instead of numbers)"}};
  for (const auto& [part, key, value, expected] : values) {
    json record = upkie_record(0.0);
    json& parent = record["observation"][part];
    (parent.contains("left_knee") ? parent["left_knee"] : parent)[key] = value;
    EXPECT_THAT(read(pack({record})).error, HasSubstr(expected));
  }
}

TEST(UglyLogs, RecordsWithSomethingElseThanNumbersAreLeftOutAndNamed) {
  std::vector<json> records = upkie_records(9);
  for (const std::size_t k : {3U, 6U}) {
    records[k]["observation"]["servo"]["left_knee"]["torque"] = true;
  }
  const Read result = read(pack(records));
  EXPECT_EQ(result.rows, 7U);
  ASSERT_EQ(result.warnings.size(), 2U);
  EXPECT_THAT(result.warnings[1],
              AllOf(HasSubstr("record 4 has observation.servo.left_knee.torque (true or false"),
                    HasSubstr("; 1 more like it")));
}

TEST(UglyLogs, FlippedBytesNeverDoMoreThanAnError) {
  const std::string good = pack(upkie_records(3));
  std::mt19937 random(1);
  for (int trial = 0; trial < 3000; ++trial) {
    std::string bad = good;
    for (int flips = 0; flips < 3; ++flips) {
      bad[random() % bad.size()] = static_cast<char>(random() % 256);
    }
    const Read result = read(bad);
    EXPECT_LE(result.rows, 4U);
  }
}

TEST(UglyLogs, ALiveStreamGivesARowAsSoonAsItIsThere) {
  // A pipe in place of standard input's: the writer waits for the reader before it goes on.
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  LogReader reader("/proc/self/fd/" + std::to_string(ends[0]));
  for (int i = 0; i < 3; ++i) {
    const std::string record = pack({upkie_record(0.001 * i)});
    const std::size_t half = record.size() / 2;
    ASSERT_EQ(::write(ends[1], record.data(), half), static_cast<ssize_t>(half));
    ASSERT_EQ(::write(ends[1], record.data() + half, record.size() - half),
              static_cast<ssize_t>(record.size() - half));
    EXPECT_TRUE(reader.next().has_value());
  }
  ::close(ends[1]);
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_FALSE(reader.next().has_value()) << "the end stays the end";
  ::close(ends[0]);
}

TEST(UglyLogs, ARecordThatWasWrittenTwiceCountsOnce) {
  std::vector<json> records;
  for (const json& record : upkie_records(40)) {
    records.push_back(record);
    records.push_back(record);
    records.back()["time"] = 1e9;  // its logger's clock differs
  }
  std::istringstream stream(pack(records));
  LogReader reader(test::stream_source(stream), "log");
  EXPECT_EQ(reader.info().control_period_us, 1000);
  std::size_t rows = 0;
  while (reader.next()) ++rows;
  EXPECT_EQ(rows, 40U);
  EXPECT_THAT(reader.warnings(), ElementsAre(HasSubstr("40 of 80 records repeat the one before")));
}

TEST(UglyLogs, ANumberOfAServoThatIsMissingNowAndThenIsHeld) {
  std::vector<json> records = upkie_records(60);
  const auto servo = [&](std::size_t k, const char* name) -> json& {
    return records[k]["observation"]["servo"][name];
  };
  for (const std::size_t k : {7U, 20U, 21U}) servo(k, "left_knee").erase("torque");
  servo(20, "right_hip")["velocity"] = nullptr;
  for (std::size_t k = 30; k < 55; ++k) records[k]["observation"]["servo"].erase("left_wheel");
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (servo(k, "left_knee").contains("torque")) {
      servo(k, "left_knee")["torque"] = static_cast<double>(k);
    }
  }
  std::istringstream stream(pack(records));
  LogReader reader(test::stream_source(stream), "log");
  EXPECT_EQ(reader.info().control_period_us, 1000);
  std::vector<models::Observation> rows;
  while (const std::optional<LogRow> row = reader.next()) rows.push_back(row->observation);
  ASSERT_EQ(rows.size(), 60U);
  EXPECT_EQ(rows[7].servo[1].torque, 6.0);
  EXPECT_EQ(rows[21].servo[1].torque, 19.0);
  EXPECT_EQ(rows[20].servo[3].velocity, rows[19].servo[3].velocity);
  EXPECT_EQ(rows[31].servo[2].torque, rows[29].servo[2].torque);
  EXPECT_TRUE(std::isnan(rows[54].servo[2].torque)) << "not for longer than a gap";
  EXPECT_EQ(rows[54].servo[1].torque, 54.0);
  EXPECT_THAT(reader.warnings(),
              ElementsAre(AllOf(HasSubstr("records lack numbers of servos: they are held"),
                                HasSubstr("for up to 20 ms; 5 records lack them for longer"))));
}

TEST(UglyLogs, NumbersOfServosThatAreMissingForLongerAreToldWhereNoneIsHeld) {
  std::vector<json> records = upkie_records(60);
  for (std::size_t k = 0; k < records.size(); ++k) {
    records[k]["observation"]["time"] = 0.03 * static_cast<double>(k);
    if (k % 2 == 1) records[k]["observation"]["servo"].erase("left_wheel");
  }
  std::istringstream stream(pack(records));
  LogReader reader(test::stream_source(stream), "log");
  while (reader.next()) {
  }
  EXPECT_THAT(reader.warnings(),
              ElementsAre("log: 30 of 60 records lack numbers of servos for longer than 20 ms"));
}

/// As Upkie's own programs log, if the observation has no time.
TEST(UglyLogs, StampsAreThoseOfTheRecordsWhoseObservationsHaveNoTime) {
  std::vector<json> records = upkie_records(40);
  for (std::size_t k = 0; k < records.size(); ++k) {
    records[k]["observation"].erase("time");
    records[k]["time"] = 1.7e9 + 0.001 * static_cast<double>(k);
  }
  const std::string bytes = pack(records);
  std::istringstream stream(bytes);
  LogReader reader(test::stream_source(stream), "log");
  for (std::int64_t k = 0; reader.next(); ++k) {
    EXPECT_NEAR(static_cast<double>(reader.stamp() - 1'700'000'000'000'000'000 - 1'000'000 * k),
                0.0, 200.0);
  }
}

TEST(UglyLogs, TimesInAnotherUnitThanSecondsAreRefusedByName) {
  for (const auto& [factor, unit] : std::vector<std::pair<double, std::string>>{
           {1e3, "milliseconds"}, {1e6, "microseconds"}, {1e9, "nanoseconds"}}) {
    std::vector<json> records = upkie_records(50);
    for (json& record : records) {
      const double time = record["observation"]["time"];
      record["observation"]["time"] = factor * time;
    }
    std::istringstream stream(pack(records));
    LogReader reader(test::stream_source(stream), "log");
    EXPECT_THAT(complaint_of([&] { (void)reader.info(); }), HasSubstr("look like " + unit));
  }
}

/// The time of step k of a log with a period (s), from its start.
using Times = double (*)(double period, double k);

/// The complaint about a log that states its period, with these times.
std::string complaint_about_stated(std::int64_t period_us, double scale, Times times) {
  const ScratchFolder folder;
  Recording log = test::sample_recording(60, false);
  log.info.control_period_us = period_us;
  for (std::size_t k = 0; k < log.steps(); ++k) {
    log.observation[k].time =
        scale * times(1e-6 * static_cast<double>(period_us), static_cast<double>(k));
  }
  write_recording(log, folder / "stated.mpack");
  return complaint_of([&] { (void)read_recording(folder / "stated.mpack"); });
}

TEST(UglyLogs, ThatStateTheirPeriodAreReadInSecondsOnly) {
  const std::vector<Times> any_unit = {
      [](double dt, double k) { return dt * k; },
      [](double dt, double k) { return 1.7e9 + dt * k; },  // since 1970
      [](double dt, double k) { return dt * (k + (std::fmod(k, 2.0) == 0.0 ? 0.3 : 0.0)); },
      [](double dt, double k) { return dt * (k + (k > 4.0 ? 50.0 : 0.0)); }};  // with a gap
  const std::vector<Times> seconds = {
      any_unit[0], [](double dt, double k) { return 10.0 * dt * k; },  // every tenth record only
      [](double dt, double k) { return dt * k + 5.0 * std::min(k, 4.0); }};  // pauses at the start
  for (const std::int64_t period : {500, 1000, 5000, 10000}) {
    for (const auto& [factor, unit] : std::vector<std::pair<double, std::string>>{
             {1e3, "milliseconds"}, {1e6, "microseconds"}, {1e9, "nanoseconds"}}) {
      for (const Times times : any_unit) {
        EXPECT_THAT(complaint_about_stated(period, factor, times),
                    AllOf(HasSubstr("stated.mpack: observation.time: expected seconds"),
                          HasSubstr("look like " + unit)));
      }
    }
    for (const Times times : seconds)
      EXPECT_EQ(complaint_about_stated(period, 1.0, times), "no complaint");
  }
}

TEST(UglyLogs, ConsumesALongLogAtAConstantMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer keeps freed memory, which is what is measured here";
#endif
  const std::string chunk = pack(upkie_records(100));
  const auto resident_kb = [] {
    std::ifstream status("/proc/self/statm");
    long total = 0;
    long resident = 0;
    status >> total >> resident;
    return resident * (::sysconf(_SC_PAGESIZE) / 1024);
  };
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  std::thread writer([&] {
    for (int i = 0; i < 300; ++i) {
      std::size_t done = 0;
      while (done < chunk.size()) {
        const ssize_t size = ::write(ends[1], chunk.data() + done, chunk.size() - done);
        if (size <= 0) break;
        done += static_cast<std::size_t>(size);
      }
    }
    ::close(ends[1]);
  });
  LogReader reader("/proc/self/fd/" + std::to_string(ends[0]));
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(reader.next().has_value());
  const long before = resident_kb();
  std::size_t rows = 1000;
  while (reader.next()) ++rows;
  writer.join();
  ::close(ends[0]);
  EXPECT_EQ(rows, 30000U);
  EXPECT_LT(resident_kb() - before, 2000) << "of about " << 300 * chunk.size() / 1024 << " kB read";
}

}  // namespace
}  // namespace touchdown::logs

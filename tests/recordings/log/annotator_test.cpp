#include "recordings/log/annotator.hpp"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "recordings/log/reader.hpp"
#include "tests/recordings/log/upkie_log.hpp"

namespace touchdown::recordings {
namespace {

using nlohmann::json;
using testing::pack;
using testing::upkie_record;

struct Beliefs {
  Belief belief;
  Evidence evidence;
};

Beliefs beliefs_of(int i) {
  const double x = 0.01 * i;
  return {.belief = {{{{x + 13, true}, {x + 14, false}}}, x + 15, x + 16, SignalStatus::gap},
          .evidence = {{{{x + 1, x + 2, x + 3}, {}}},
                       {x + 4, x + 5, x + 6, x + 7, x + 8, x + 10, x + 9}}};
}

json expected(json record, int i) {
  const double x = 0.01 * i;
  json& observation = record["observation"];
  observation["measurement_model"] = {
      {"contact_likelihood", x + 1}, {"no_contact_likelihood", x + 2}, {"p_contact", x + 3}};
  observation["transition_model"] = {{"power", x + 4},
                                     {"median_frequency", x + 5},
                                     {"filtered_median_freq", x + 6},
                                     {"p_switch", x + 7},
                                     {"p_landing", x + 8},
                                     {"p_landing_p_switch", x + 9},
                                     {"p_takeoff_p_switch", x + 10}};
  observation["contact_filter"] = {{"p_contact", x + 13},
                                   {"p_contact_smooth", nullptr},
                                   {"left_wheel", {{"p_contact", x + 13}, {"contact", true}}},
                                   {"right_wheel", {{"p_contact", x + 14}, {"contact", false}}},
                                   {"p_any_wheel", x + 15},
                                   {"p_both_wheels", x + 16},
                                   {"status", "gap"}};
  return record;
}

/// As the other library reads it; null for the NaN of what no estimator computes, because nothing
/// equals NaN.
std::vector<json> unpack(const std::string& log) {
  std::vector<json> records = testing::unpack(log);
  for (json& record : records) {
    const json::json_pointer smooth("/observation/contact_filter/p_contact_smooth");
    if (record.contains(smooth) && std::isnan(record[smooth].get<double>())) {
      record[smooth] = nullptr;
    }
  }
  return records;
}

std::string annotated(const std::string& log, bool look_ahead = false) {
  std::istringstream in(log);
  std::ostringstream out;
  LogReader reader(testing::stream_source(in), "log");
  LogAnnotator annotator(out);
  if (look_ahead) reader.info();
  int i = 0;
  while (reader.next()) {
    annotator.copy(reader.skipped());
    const Beliefs said = beliefs_of(i++);
    annotator.annotate(reader.record(), reader.outline(), said.belief, said.evidence);
  }
  annotator.copy(reader.skipped());
  return out.str();
}

TEST(Annotator, AddsTheKeysOfContactAgentAndKeepsTheRest) {
  const std::vector<json> records = {upkie_record(0.0), upkie_record(0.001)};
  for (const bool look_ahead : {false, true}) {
    const std::vector<json> result = unpack(annotated(pack(records), look_ahead));
    ASSERT_EQ(result.size(), 2U);
    EXPECT_EQ(result[0], expected(records[0], 0));
    EXPECT_EQ(result[1], expected(records[1], 1));
  }
}

TEST(Annotator, ReplacesBeliefsThatAreThereAlready) {
  const std::string log = pack({upkie_record(0.0), upkie_record(0.001)});
  const std::string once = annotated(log);
  EXPECT_EQ(unpack(annotated(once)), unpack(once));
  // The authors' own beliefs, somewhere in between, with keys that we do not write.
  json record = expected(upkie_record(0.0), 7);
  record["observation"]["contact_filter"]["debug"] = {1, 2};
  EXPECT_EQ(unpack(annotated(pack({record}))).at(0), expected(upkie_record(0.0), 0));
}

TEST(Annotator, ReplacesBeliefsThatEndTheObservationOrTheRecord) {
  for (const char* tail : {"", "zzz"}) {
    // `observation` as the last key or not, and in it a belief as the last key.
    nlohmann::ordered_json by_hand;
    const json source = upkie_record(0.0);
    by_hand["time"] = source["time"];
    for (const auto& [key, value] : source["observation"].items()) {
      by_hand["observation"][key] = value;
    }
    by_hand["observation"]["transition_model"] = {{"power", 1}};
    if (*tail != '\0') by_hand[tail] = 1;
    const auto bytes = nlohmann::ordered_json::to_msgpack(by_hand);
    json result = json::from_msgpack(bytes);
    result["observation"] = expected(upkie_record(0.0), 0)["observation"];
    EXPECT_EQ(unpack(annotated(std::string(bytes.begin(), bytes.end()))).at(0), result);
  }
}

TEST(Annotator, CopiesSkippedRecordsAtBothEnds) {
  json starting = upkie_record(0.0);
  starting["observation"].erase("imu");
  const std::vector<json> records = {starting, upkie_record(0.001), starting, starting};
  const std::vector<json> result = unpack(annotated(pack(records), true));
  ASSERT_EQ(result.size(), 4U);
  EXPECT_EQ(result[0], starting);
  EXPECT_EQ(result[1], expected(records[1], 0));
  EXPECT_EQ(result[3], starting);
}

TEST(Annotator, AnObservationOfMoreThanFifteenKeysGetsAWiderHeader) {
  json record = upkie_record(0.0);
  for (int i = 0; i < 14; ++i) record["observation"]["extra" + std::to_string(i)] = i;
  EXPECT_EQ(unpack(annotated(pack({record}))).at(0), expected(record, 0));
}

TEST(Annotator, LongKeysAreKept) {
  json record = expected(upkie_record(0.0), 3);  // so that entries are cut out and moved
  record["observation"][std::string(40, 'k')] = 1;
  record["observation"][std::string(300, 'z')] = "text";
  json result = expected(upkie_record(0.0), 0);
  result["observation"][std::string(40, 'k')] = 1;
  result["observation"][std::string(300, 'z')] = "text";
  EXPECT_EQ(unpack(annotated(pack({record}))).at(0), result);
}

TEST(Annotator, AMapCalledObservationElsewhereIsLeftAlone) {
  json record = upkie_record(0.0);
  record["a"] = {{"observation", {{"contact_filter", 1}}}};
  record["zoo"] = {{"observation", {{"contact_filter", 1}}}};
  EXPECT_EQ(unpack(annotated(pack({record}))).at(0), expected(record, 0));
}

TEST(Annotator, ARecordWithoutObservationIsRefused) {
  std::ostringstream out;
  LogAnnotator annotator(out);
  const auto annotate = [&](const std::string& record) {
    LogParser parser;
    std::size_t length = 0;
    parser.parse(record, length);
    annotator.annotate(record, parser.outline(), {}, {});
  };
  EXPECT_THROW(annotate(pack({{{"time", 1.0}}})), InputError);
  EXPECT_THROW(annotate(pack({{{"observation", 1.0}}})), InputError);
  EXPECT_THROW(annotate(""), InputError);
}

}  // namespace
}  // namespace touchdown::recordings

#include "logs/log/annotator.hpp"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "logs/log/reader.hpp"
#include "tests/logs/log/upkie_log.hpp"

namespace touchdown::logs {
namespace {

using nlohmann::json;
using test::pack;
using test::upkie_record;

struct Beliefs {
  Belief belief;
  Evidence evidence;
};

Beliefs beliefs_of(int i) {
  const double x = 0.01 * i;
  return {.belief = {{{{x + 13, true, {x + 17, x + 18}}, {x + 14, false, {x + 19, x + 20}}}},
                     x + 15,
                     x + 16,
                     SignalStatus::gap},
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
  observation["contact_filter"] = {
      {"p_contact", x + 13},
      {"p_contact_smooth", nullptr},
      {"left_wheel",
       {{"p_contact", x + 13}, {"contact", true}, {"load", x + 17}, {"load_deviation", x + 18}}},
      {"right_wheel",
       {{"p_contact", x + 14}, {"contact", false}, {"load", x + 19}, {"load_deviation", x + 20}}},
      {"p_any_wheel", x + 15},
      {"p_both_wheels", x + 16},
      {"status", "gap"}};
  return record;
}

/// As the other library reads it. Values that no estimator computes are NaN; they are null here,
/// because NaN never equals NaN.
std::vector<json> unpack(const std::string& log) {
  std::vector<json> records = test::unpack(log);
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
  LogReader reader(test::stream_source(in), "log");
  LogAnnotator annotator(out);
  if (look_ahead) reader.info();
  int i = 0;
  while (reader.next()) {
    annotator.copy(reader.skipped());
    const Beliefs beliefs = beliefs_of(i++);
    annotator.annotate(reader.record(), beliefs.belief, beliefs.evidence);
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

TEST(Annotator, KeepsEmptyKeysWhereverTheyStand) {
  json record = expected(upkie_record(0.0), 3);
  record[""] = nullptr;
  record["observation"][""] = {{"", 1}};
  record["observation"]["servo"][""] = 2;
  json result = expected(upkie_record(0.0), 0);
  result[""] = nullptr;
  result["observation"][""] = {{"", 1}};
  result["observation"]["servo"][""] = 2;
  EXPECT_EQ(unpack(annotated(pack({record}))).at(0), result);
}

/// A value as the other library packs it, without the map around it.
std::string packed(const json& value) {
  const std::vector<std::uint8_t> bytes = json::to_msgpack(value);
  return {bytes.begin(), bytes.end()};
}

/// Entries of a map, one after the other.
std::string entries(const json& map) {
  std::string bytes;
  for (const auto& [key, value] : map.items()) bytes += packed(key) + packed(value);
  return bytes;
}

std::string map_of(std::size_t count, const std::string& entries) {
  return std::string("\xde") + static_cast<char>(count >> 8U) + static_cast<char>(count & 0xffU) +
         entries;
}

/// Keys that only MessagePack has: numbers, binary, lists and maps, one of them with the name of a
/// belief in it. The other library reads no such maps, so what is expected is put together by hand.
TEST(Annotator, KeysThatAreNoTextsAreKeptAndCountedInTheirPlaces) {
  const std::string belief = packed("contact_filter") + packed({{"p_contact", 0.5}});
  const std::string odd = packed(7) + packed(true) +
                          std::string(
                              "\xc4\x02"
                              "ab",
                              4) +
                          packed(1.5) + packed(json::array({"contact_filter", 1})) +
                          packed("list") + packed({{"contact_filter", 1}}) + packed("map") +
                          std::string("\xd4\x01x", 3) + packed(nullptr);
  const json record = upkie_record(0.0);
  const json& observation = record["observation"];
  const std::size_t count = observation.size() + 5;
  const std::string before = packed("time") + packed(1.0);
  const std::string after = packed({{"contact_filter", 2}}) + packed({{"contact_filter", 3}}) +
                            packed(5) + packed({{"measurement_model", 4}});
  const auto around = [&](std::size_t size, const std::string& inside) {
    return map_of(4, before + packed("observation") + map_of(size, inside) + after);
  };
  const std::string result = annotated(around(count + 1, entries(observation) + belief + odd));
  const json added = expected(record, 0)["observation"];
  std::string expected_start = map_of(4, before + packed("observation"));
  ASSERT_TRUE(result.starts_with(expected_start));
  ASSERT_TRUE(result.ends_with(entries(observation) + odd + after));
  // Between them: the header of the larger map, and the beliefs, which alone are read here.
  const std::size_t begin = expected_start.size();
  const std::size_t end = result.size() - (entries(observation) + odd + after).size();
  std::string beliefs = result.substr(begin, end - begin);
  ASSERT_EQ(static_cast<unsigned char>(beliefs[0]), 0x80U | (count + 3));
  beliefs[0] = static_cast<char>(0x83);
  const json read = json::from_msgpack(beliefs);
  for (const char* const group : {"measurement_model", "transition_model"}) {
    EXPECT_EQ(read[group], added[group]);
  }
  EXPECT_EQ(read["contact_filter"]["status"], "gap");
}

TEST(Annotator, OfTwoObservationsTheLastIsAnnotated) {
  const json record = upkie_record(0.0);
  const std::string key = packed("observation");
  const std::string log = map_of(
      2, key + packed({{"contact_filter", 1}, {"x", 2}}) + key + packed(record["observation"]));
  const json result = unpack(annotated(log)).at(0);  // which keeps the last of two equal keys
  EXPECT_EQ(result["observation"], expected(record, 0)["observation"]);
}

TEST(Annotator, ARecordThatIsCutOffIsRefused) {
  const std::string whole = pack({upkie_record(0.0)});
  std::ostringstream out;
  LogAnnotator annotator(out);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(annotator.annotate(whole.substr(0, size), {}, {}), InputError) << size;
  }
  EXPECT_EQ(out.str(), "");
}

TEST(Annotator, ARecordWithoutObservationIsRefused) {
  std::ostringstream out;
  LogAnnotator annotator(out);
  const auto annotate = [&](const std::string& record) { annotator.annotate(record, {}, {}); };
  EXPECT_THROW(annotate(pack({{{"time", 1.0}}})), InputError);
  EXPECT_THROW(annotate(pack({{{"observation", 1.0}}})), InputError);
  EXPECT_THROW(annotate(""), InputError);
}

}  // namespace
}  // namespace touchdown::logs

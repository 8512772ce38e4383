#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/refusals/readers.hpp"
#include "tests/refusals/table.hpp"

namespace touchdown::refusals {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The names of the tables beside this file.
std::vector<std::string> tables() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(TOUCHDOWN_SOURCE_DIR "/tests/refusals")) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  }
  return names;
}

class Refusals : public ::testing::TestWithParam<std::string> {};

TEST_P(Refusals, AreThoseOfTheTable) {
  const std::string file =
      fmt::format("{}/tests/refusals/{}.yaml", TOUCHDOWN_SOURCE_DIR, GetParam());
  for (const Failure& failure : failures_of(YAML::LoadFile(file), names_of_tables())) {
    ADD_FAILURE() << file << ':' << failure.line << ": " << failure.words;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Refusals, ::testing::ValuesIn(tables()),
                         [](const auto& table) { return table.param; });

/// The failures of rows about the profile `torque: {delay: 0.1}`, which is read without a
/// complaint.
std::vector<std::string> failures_of_rows(const std::string& rows) {
  std::vector<std::string> words;
  for (const Failure& failure : failures_of(
           YAML::Load("reader: profile\ngroups:\n- files: {s.yaml: 'torque: {delay: 0.1}'}\n" +
                      rows),
           names_of_tables())) {
    words.push_back(fmt::format("{}: {}", failure.line, failure.words));
  }
  return words;
}

TEST(TablesOfRefusals, NameEachRowThatDoesNotHold) {
  EXPECT_THAT(failures_of_rows("  from: '0.1'\n"
                               "  refused:\n"
                               "  - {to: [11, 12], at: '1:17', says: expected a number from 0}\n"
                               "  - {to: [11, 0.2, 12], says: torque.delay}\n"
                               "  - {from: dealy, to: delay, says: torque.delay}\n"
                               "  - {to: 11, at: '1:16', says: torque.delay}\n"
                               "  - {to: 11, at: other.yaml, says: torque.delay}\n"
                               "  - {to: 11, says: [torque.delay, from 1]}\n"
                               "  - {to: 11, says: torque.delay, lacks: number}\n"
                               "  - {to: 11}\n"
                               "  taken:\n"
                               "  - {to: [0.3, 13]}\n"),
              ElementsAre(HasSubstr("7: '0.2': is not refused"),
                          HasSubstr("8: 'delay': there is no 'dealy' in the file"),
                          HasSubstr("9: '11': not at 's.yaml:1:16:': s.yaml:1:17"),
                          HasSubstr("10: '11': not at 'other.yaml': s.yaml"),
                          HasSubstr("11: '11': does not say 'from 1': s.yaml"),
                          HasSubstr("12: '11': says 'number': s.yaml"),
                          HasSubstr("13: '11': no words are expected"),
                          HasSubstr("15: '13': is refused: s.yaml")));
}

TEST(TablesOfRefusals, HaveNoKeysOrReadersThatAreUnknown) {
  EXPECT_THROW(failures_of_rows("  refused:\n  - {form: a, to: b, says: c}\n"), std::runtime_error);
  EXPECT_THROW(failures_of_rows("  reader: robto\n"), std::runtime_error);
  EXPECT_THROW(failures_of_rows("  refsed: []\n"), std::runtime_error);
}

}  // namespace
}  // namespace touchdown::refusals

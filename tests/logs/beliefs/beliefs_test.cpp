#include "logs/log/beliefs.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "logs/log/packing.hpp"
#include "logs/model_file.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::logs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using Step = std::map<std::string, double>;

/// Dictionaries one after the other, decisions as booleans.
std::string dictionaries(const std::vector<Step>& steps) {
  msgpack::sbuffer bytes;
  LogPacker packer(bytes);
  for (const Step& step : steps) {
    packer.pack_map(static_cast<std::uint32_t>(step.size()));
    for (const auto& [name, value] : step) {
      pack_text(packer, name);
      if (name.starts_with("contact")) {
        packer.pack(value != 0.0);
      } else {
        pack_float64(bytes, value);
      }
    }
  }
  return {bytes.data(), bytes.size()};
}

const std::vector<Step> two_steps = {
    {{"time", 0.0}, {"p_left", 0.25}, {"p_right", 1.0}, {"contact_left", 1}, {"contact_right", 1}},
    {{"time", 0.001}, {"p_left", 1e-9}, {"p_right", 0}, {"contact_left", 0}, {"contact_right", 1}}};

void expect_two_steps(const Beliefs& beliefs) {
  EXPECT_THAT(beliefs.time, ElementsAre(0.0, 0.001));
  EXPECT_THAT(beliefs.p_contact[0], ElementsAre(0.25, 1e-9));
  EXPECT_THAT(beliefs.p_contact[1], ElementsAre(1.0, 0.0));
  EXPECT_THAT(beliefs.contact[0], ElementsAre(1, 0));
  EXPECT_THAT(beliefs.contact[1], ElementsAre(1, 1));
}

TEST(Beliefs, AreTheSameInAllFormats) {
  const ScratchFolder folder;
  expect_two_steps(read_beliefs(folder.write(
      "a.csv",
      "p_right, time ,contact_right,p_left,contact_left\n1,0,1,.25,True\n0,1e-3,true,1e-9,0\n")));
  expect_two_steps(read_beliefs(folder.write("a.mpack", dictionaries(two_steps))));
  ModelArrays arrays;
  for (const Step& step : two_steps) {
    for (const auto& [name, value] : step) {
      arrays[name].shape = {2};
      arrays[name].data.push_back(value);
    }
  }
  write_npz(arrays, folder / "a.npz");
  expect_two_steps(read_beliefs(folder / "a.npz"));
}

TEST(Beliefs, DecideAtOneHalfWhereNothingIsDecided) {
  const ScratchFolder folder;
  const Beliefs beliefs =
      read_beliefs(folder.write("a.csv", "time,p_left,p_right\n0,0.5,0.49\n1,0.4,0.6\n"));
  EXPECT_THAT(beliefs.contact[0], ElementsAre(1, 0));
  EXPECT_THAT(beliefs.contact[1], ElementsAre(0, 1));
}

TEST(Beliefs, OfOtherSystemsTextsAreRead) {
  const ScratchFolder folder;
  const Beliefs beliefs = read_beliefs(
      folder.write("a.csv", "\xef\xbb\xbftime,p_left,p_right\r\n0,1,0\r\n0.5,0,1\r\n\r\n"));
  EXPECT_THAT(beliefs.time, ElementsAre(0.0, 0.5));
  EXPECT_THAT(beliefs.place(1), HasSubstr("a.csv:3"));
}

TEST(Beliefs, InDictionariesThatAreWrongAreRefusedByTheirNumber) {
  const ScratchFolder folder;
  const auto complaint = [&](const std::string& bytes, const std::string& expected) {
    folder.write("a.mpack", bytes);
    EXPECT_THAT([&] { read_beliefs(folder / "a.mpack"); },
                ThrowsMessage<InputError>(HasSubstr(expected)));
  };
  const std::string good = dictionaries(two_steps);
  complaint(good.substr(0, good.size() - 1), "a.mpack: dictionary 1: is cut off");
  complaint(good + "\xc1", "a.mpack: dictionary 2: is not a MessagePack dictionary");
  complaint(good + "\x93\x01\x02\x03", "a.mpack: dictionary 2: expected a dictionary");
  complaint(std::string("\xdf\xff\xff\xff\xff", 5), "a.mpack: dictionary 0: is ");
  complaint(dictionaries({{{"time", 0.0}, {"p_left", 0.5}}}), "dictionary 0: 'p_right' is missing");
  complaint(good + dictionaries({{{"time", 1.0}, {"p_left", 0.5}, {"p_right", 0.5}}}),
            "dictionary 2: expected the names of the first: ");
  complaint("\x80", "dictionary 0: 'time' is missing");
  complaint("", "a.mpack: holds no beliefs");
}

}  // namespace
}  // namespace touchdown::logs

#include "estimator/npz/npz.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/model_file.hpp"
#include "tests/complaint.hpp"
#include "tests/python_with_numpy.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::logs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

ModelArrays sample_arrays() {
  return {{"one", {{3}, {1.0, -0.0, 1e-310}}},
          {"two", {{2, 3}, {1.5, 2.5, 3.5, 4.5, 5.5, 6.5}}},
          {"none", {{0}, {}}}};
}

template <typename T>
std::string raw(std::initializer_list<T> values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.begin(), bytes.size());
  return bytes;
}

bool runs(const std::string& script, const ScratchFolder& folder) {
  std::ofstream(folder / "script.py") << "import numpy as np\n" << script;
  return std::system(("cd " + folder.path().string() + " && " + python_with_numpy() + " script.py")
                         .c_str()) == 0;
}

TEST(Npz, GivesBackWhatWasWritten) {
  const ScratchFolder folder;
  write_npz(sample_arrays(), folder / "a.npz");
  const ModelArrays back = read_npz(folder / "a.npz");
  ASSERT_EQ(back.size(), 3U);
  for (const auto& [name, array] : sample_arrays()) {
    EXPECT_EQ(back.at(name).shape, array.shape);
    EXPECT_EQ(back.at(name).data, array.data);
  }
  EXPECT_TRUE(std::signbit(back.at("one").data[1]));
}

TEST(Npz, LargeArraysTakeLessRoomAndComeBackToTheBit) {
  const ScratchFolder folder;
  ModelArray grid{{400, 500}, {}};
  for (std::size_t i = 0; i < 200'000; ++i) {
    const std::size_t block = i / 64;
    grid.data.push_back(std::log(1e-3 + static_cast<double>(block)));
  }
  write_npz({{"grid", grid}}, folder / "a.npz");
  EXPECT_LT(std::filesystem::file_size(folder / "a.npz"), 400'000U);  // of 1,600,000
  EXPECT_EQ(read_npz(folder / "a.npz").at("grid").data, grid.data);
  if (python_with_numpy().empty()) return;
  EXPECT_TRUE(
      runs("assert abs(np.load('a.npz')['grid'][399, 499] - np.log(3124.001)) < 1e-12", folder));
}

TEST(Npz, SmallArraysAreDeflatedWhereAllAre) {
  const ScratchFolder folder;
  const ModelArrays labels = {{"contact", {{4000}, std::vector<double>(4000, 1.0)}}};
  const std::string large = to_npz(labels, "labels.npz", Deflated::large);
  const std::string all = to_npz(labels, "labels.npz", Deflated::all);
  EXPECT_GT(large.size(), 32'000U);
  EXPECT_LT(all.size(), 1'000U);
  EXPECT_EQ(read_npz(folder.write("all.npz", all)).at("contact").data, labels.at("contact").data);
}

TEST(Npz, SameArraysGiveTheSameBytesAtAnyTimeAndPlace) {
  const ScratchFolder folder;
  ::setenv("TZ", "UTC", 1);
  write_npz(sample_arrays(), folder / "a.npz");
  ::setenv("TZ", "Asia/Tokyo", 1);
  ::tzset();
  write_npz(sample_arrays(), folder / "b.npz");
  ::unsetenv("TZ");
  ::tzset();
  EXPECT_EQ(read_file(folder / "a.npz"), read_file(folder / "b.npz"));
}

TEST(Npz, NumPyReadsOursWithNamesShapesAndTypes) {
  if (python_with_numpy().empty()) GTEST_SKIP() << "python3 with NumPy is not installed";
  const ScratchFolder folder;
  write_npz(sample_arrays(), folder / "a.npz");
  EXPECT_TRUE(runs(R"(
a = np.load('a.npz')
assert sorted(a.keys()) == ['none', 'one', 'two']
assert a['two'].dtype == np.float64 and a['two'].shape == (2, 3) and a['two'].flags.c_contiguous
assert a['one'].shape == (3,) and a['none'].shape == (0,)
assert (a['two'] == [[1.5, 2.5, 3.5], [4.5, 5.5, 6.5]]).all()
)",
                   folder));
}

TEST(Npz, ReadsNumPysDeflatedAndSinglePrecision) {
  if (python_with_numpy().empty()) GTEST_SKIP() << "python3 with NumPy is not installed";
  const ScratchFolder folder;
  ASSERT_TRUE(runs(R"(
two = np.arange(6.0).reshape(2, 3)
np.savez_compressed('a.npz', two=two, single=two.astype('f4'), zeros=np.zeros((500, 400)))
)",
                   folder));
  const ModelArrays arrays = read_npz(folder / "a.npz");
  EXPECT_THAT(arrays.at("two").shape, ElementsAre(2, 3));
  EXPECT_THAT(arrays.at("two").data, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(arrays.at("single").data, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(arrays.at("zeros").data, std::vector<double>(200000, 0.0));
}

TEST(Npz, NamesTheLineOfNumPyThatMendsAnArray) {
  if (python_with_numpy().empty()) GTEST_SKIP() << "python3 with NumPy is not installed";
  const std::vector<std::pair<std::string, std::vector<double>>> cases = {
      {"np.asfortranarray([[1.0, 2], [3, 4]])", {1, 2, 3, 4}},
      {"np.arange(4.0).reshape(2, 2).T", {0, 2, 1, 3}},
      {"np.array([1.5, 2.5], '>f8')", {1.5, 2.5}},
      {"np.array([1.5, 2.5], 'f2')", {1.5, 2.5}},
      {"np.array(['2024-02-28T21:56:41.5'], 'M8[ms]')", {1709157401.5}},
      {"np.array([1500], 'm8[ms]')", {1.5}},
      {"np.array([[1.5, 2], [3, True]], object)", {1.5, 2, 3, 1}},
      {"np.fromiter(([1.5, 2], np.array([3, 4])), object)", {1.5, 2, 3, 4}}};
  for (const auto& [made, numbers] : cases) {
    const ScratchFolder folder;
    ASSERT_TRUE(runs("np.savez('a.npz', a=" + made + ")", folder));
    const std::string complaint = complaint_of([&] { read_npz(folder / "a.npz"); });
    const std::size_t end = complaint.find(" makes ");
    const std::string line =
        complaint.substr(0, end).substr(complaint.substr(0, end).rfind(": ") + 2);
    ASSERT_TRUE(
        runs("array = np.load('a.npz', allow_pickle=True)['a']\nnp.savez('a.npz', a=" + line + ")",
             folder))
        << complaint;
    EXPECT_EQ(read_npz(folder / "a.npz").at("a").data, numbers) << complaint;
  }
}

TEST(Npz, ReadsNumPysWholeNumbersAndBools) {
  if (python_with_numpy().empty()) GTEST_SKIP() << "python3 with NumPy is not installed";
  const ScratchFolder folder;
  ASSERT_TRUE(runs(R"(
types = 'i1 i2 i4 i8 u1 u2 u4 u8'.split()
np.savez('a.npz', flags=np.array([True, False]),
         **{t: np.array([np.iinfo(t).min, 3, np.iinfo(t).max // 1000], t) for t in types})
)",
                   folder));
  const ModelArrays arrays = read_npz(folder / "a.npz");
  EXPECT_THAT(arrays.at("flags").data, ElementsAre(1, 0));
  EXPECT_THAT(arrays.at("i1").data, ElementsAre(-128, 3, 0));
  EXPECT_THAT(arrays.at("i2").data, ElementsAre(-32768, 3, 32));
  EXPECT_THAT(arrays.at("i4").data, ElementsAre(-2147483648.0, 3, 2147483));
  EXPECT_THAT(arrays.at("i8").data, ElementsAre(-0x1p63, 3, 9223372036854775.0));
  EXPECT_THAT(arrays.at("u1").data, ElementsAre(0, 3, 0));
  EXPECT_THAT(arrays.at("u2").data, ElementsAre(0, 3, 65));
  EXPECT_THAT(arrays.at("u4").data, ElementsAre(0, 3, 4294967));
  EXPECT_THAT(arrays.at("u8").data, ElementsAre(0, 3, 18446744073709551.0));
}

TEST(Npz, GivesWhatFloat64DoesNotHoldOfWholeNumbers) {
  if (python_with_numpy().empty()) GTEST_SKIP() << "python3 with NumPy is not installed";
  const ScratchFolder folder;
  ASSERT_TRUE(runs(R"(
stamps = [1732540000002345679, 3, -1732540000002345679]
np.savez('a.npz', i8=np.array(stamps, 'i8'), u8=np.array(stamps[:2], 'u8'), f8=np.array([.1]))
)",
                   folder));
  const ModelArrays rounded = read_npz(folder / "a.npz");
  const ModelArrays rest = read_npz(folder / "a.npz", {}, NpyPart::rest);
  for (const char* name : {"i8", "u8"}) {
    EXPECT_EQ(std::int64_t(rounded.at(name).data[0]) + std::int64_t(rest.at(name).data[0]),
              1732540000002345679);
    EXPECT_EQ(rest.at(name).data[1], 0.0);
  }
  EXPECT_EQ(rest.at("i8").data[2], -rest.at("i8").data[0]);
  EXPECT_EQ(rest.at("f8").data[0], 0.0);
}

TEST(Npy, HeaderIsPaddedAsNumPyAsks) {
  const std::string bytes = to_npy({{1}, {2.0}});
  ASSERT_EQ(bytes.size(), 128U + 8U);
  EXPECT_EQ(bytes[127], '\n');
  EXPECT_THROW(to_npy({{3}, {1.0}}), Error);
}

TEST(Npy, IsRefusedIfItsHeaderIsCutOff) {
  const std::string bytes = to_npy({{1}, {2.0}});
  EXPECT_THAT(complaint_of([&] { from_npy(bytes.substr(0, 40), "a.npy"); }), HasSubstr("cut off"));
}

TEST(Npz, OfAnArrayThatIsNotNeededNothingIsRead) {
  const ScratchFolder folder;
  ModelArrays arrays = sample_arrays();
  write_npz(arrays, folder / "a.npz");
  std::string bytes = read_file(folder / "a.npz");
  const std::size_t number = bytes.find(raw<double>({4.5}));
  ASSERT_NE(number, std::string::npos);
  bytes[number] = static_cast<char>(bytes[number] ^ 1);  // breaks the checksum of "two"
  std::ofstream(folder / "a.npz", std::ios::binary) << bytes;
  const ModelArrays read =
      read_npz(folder / "a.npz", [](std::string_view name) { return name == "one"; });
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read.at("one").data, arrays["one"].data);
  EXPECT_THROW(read_npz(folder / "a.npz"), InputError);
  EXPECT_THAT(npz_names(folder / "a.npz"), ::testing::UnorderedElementsAre("one", "two", "none"));
}

TEST(Npz, BrokenFilesAreOneClearError) {
  const ScratchFolder folder;
  const auto fails = [&](const std::string& bytes) {
    folder.write("bad.npz", bytes);
    const std::string text = complaint_of([&] { read_npz(folder / "bad.npz"); });
    return text.find("bad.npz") != std::string::npos && text.find('\n') == std::string::npos;
  };
  write_npz(sample_arrays(), folder / "good.npz");
  const std::string good = read_file(folder / "good.npz");
  EXPECT_TRUE(fails(good.substr(0, good.size() / 2)));
  EXPECT_TRUE(fails(good.substr(0, good.size() - 1)));
  std::string flipped;
  const std::size_t number = good.find(raw<double>({4.5}));
  ASSERT_NE(number, std::string::npos);
  flipped = good;
  flipped[number] = static_cast<char>(flipped[number] ^ 1);
  EXPECT_TRUE(fails(flipped)) << "the checksum does not fit";
  EXPECT_THROW(read_npz(folder / "absent.npz"), InputError);
  EXPECT_THROW(read_npz(folder.path()), InputError);
}

TEST(Npz, FlippedBytesNeverDoMoreThanAnError) {
  const ScratchFolder folder;
  write_npz(sample_arrays(), folder / "good.npz");
  const std::string good = read_file(folder / "good.npz");
  std::mt19937 random(2);
  for (int trial = 0; trial < 300; ++trial) {
    std::string bad = good;
    bad[random() % bad.size()] = static_cast<char>(random() % 256);
    std::ofstream(folder / "bad.npz", std::ios::binary) << bad;
    try {
      EXPECT_LE(read_npz(folder / "bad.npz").size(), 3U);
    } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): the answer that is expected
    }
  }
}

TEST(Npz, LeavesNothingBehindWhereItCannotWrite) {
  EXPECT_THROW(write_npz(sample_arrays(), "/proc/a.npz"), Error);
}

}  // namespace
}  // namespace touchdown::logs

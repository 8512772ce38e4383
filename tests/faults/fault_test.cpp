#include <cerrno>
#include <functional>
#include <iostream>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/started_program.hpp"
#include "tests/faults/outcome.hpp"
#include "tests/faults/small_experiment.hpp"

namespace touchdown::faults {
namespace {

using ::testing::IsEmpty;

cli::Ended ended(const std::string& command, const ScratchFolder& folder,
                 const std::vector<std::string>& environment = {}) {
  return cli::StartedProgram(command, folder.path(), environment).end();
}

/// Smaller allocations (bytes) hold names and lines; there are too many to refuse each.
constexpr std::uint64_t smallest_allocation = 2048;

/// Writes the files of a command and returns the command.
using Command = std::function<std::string(const ScratchFolder&)>;

/// A command, its files without faults, and its numbers of calls of each kind.
struct Case {
  Case(Command given, std::uint32_t counted) : command(std::move(given)) {
    const ScratchFolder folder;
    const Injection injection(folder.path());
    injection->counted = counted;
    injection->smallest_allocation = smallest_allocation;
    const cli::Ended end = ended(command(folder), folder, injection.environment());
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    expected = files_of(folder / "a");
    for (std::size_t k = 0; k < kinds; ++k) calls.at(k) = injection->of_kind.at(k);
    bytes = static_cast<std::uint64_t>(injection->written);
  }

  /// Errors of a run that `disturb` disturbs, and of the same command afterwards.
  template <typename Disturb>
  std::vector<std::string> wrong(const Disturb& disturb) const {
    const ScratchFolder folder;
    const Injection injection(folder.path());
    disturb(*injection);
    const cli::Ended end = ended(command(folder), folder, injection.environment());
    std::vector<std::string> all = wrong_in(end, injection, files_of(folder / "a"), expected);
    const Plan::Refused& first = injection->first.front();
    const std::string what = fmt::format(
        "{} of {}: ", kind_names.at(static_cast<std::size_t>(first.what)), first.path.data());
    for (const std::string& one :
         wrong_after(ended(command(folder), folder), folder / "a", expected)) {
      all.push_back(one);
    }
    for (std::string& one : all) one.insert(0, what);
    return all;
  }

  Files expected;
  std::array<std::uint64_t, kinds> calls{};
  std::uint64_t bytes = 0;
  Command command;
};

/// Refuses calls of these kinds, evenly spaced: `some` of each, or `many` if all are requested.
void expect_nothing_wrong(const Case& one, const std::vector<Kind>& refused, std::uint64_t some,
                          std::uint64_t many = std::numeric_limits<std::uint64_t>::max()) {
  std::size_t wrong_outcomes = 0;
  for (const Kind kind : refused) {
    std::size_t faults = 0;
    const std::uint64_t calls = one.calls.at(static_cast<std::size_t>(kind));
    const std::uint64_t step = std::max<std::uint64_t>(1, calls / (all_of_them() ? many : some));
    for (std::uint64_t n = 1 + step / 2; n <= calls; n += step) {
      const std::vector<std::string> wrong = one.wrong([&](Plan& plan) {
        plan.counted = bit(kind);
        plan.smallest_allocation = smallest_allocation;
        plan.nth = n;
        plan.error = kind == Kind::allocation ? ENOMEM : n % 2 == 0 ? EIO : ENOSPC;
      });
      EXPECT_THAT(wrong, IsEmpty()) << kind_names.at(static_cast<std::size_t>(kind)) << ' ' << n;
      ++faults;
      wrong_outcomes += wrong.empty() ? 0 : 1;
    }
    std::cout << fmt::format("{}: {} of {} calls refused, one at a time\n",
                             kind_names.at(static_cast<std::size_t>(kind)), faults, calls)
              << std::flush;
  }
  std::cout << fmt::format("{} wrong outcomes\n", wrong_outcomes);
}

TEST(Faults, OfFilesLeaveThemWholeOrAbsentAndAreReported) {
  const Case one(small_run_without_pictures, all_files | bit(Kind::allocation));
  expect_nothing_wrong(one,
                       {Kind::read, Kind::write, Kind::open, Kind::rename, Kind::flush,
                        Kind::folder, Kind::link, Kind::resize},
                       2);
}

TEST(Faults, OfMemoryLeaveFilesWholeOrAbsentAndAreReported) {
  const Case one(small_run_without_pictures, all_files | bit(Kind::allocation));
  expect_nothing_wrong(one, {Kind::allocation}, 6);
}

TEST(Faults, OfDrawingLeaveFilesWholeOrAbsentAndAreReported) {
  const Case one(small_run, all_files & ~bit(Kind::read));
  expect_nothing_wrong(one, {Kind::write, Kind::open, Kind::rename, Kind::flush, Kind::folder}, 1,
                       12);
}

TEST(Faults, OfAFilmLeaveItWholeOrAbsentAndAreReported) {
  const Case one(small_film, all_files & ~bit(Kind::read));
  expect_nothing_wrong(one, {Kind::write, Kind::open, Kind::rename, Kind::flush, Kind::folder}, 1);
}

TEST(Disk, ThatIsFullAtAnySizeLeavesFilesWholeOrAbsentAndIsReported) {
  const Case one(small_run_without_pictures, all_files | bit(Kind::allocation));
  constexpr std::uint64_t page = 4096;
  const std::uint64_t step = all_of_them() ? page : page * (1 + one.bytes / page / 8);
  std::size_t wrong_outcomes = 0;
  std::size_t sizes = 0;
  for (std::uint64_t size = 0; size < one.bytes; size += step) {
    const std::vector<std::string> wrong =
        one.wrong([&](Plan& plan) { plan.disk = static_cast<std::int64_t>(size); });
    EXPECT_THAT(wrong, IsEmpty()) << size << " bytes";
    ++sizes;
    wrong_outcomes += wrong.empty() ? 0 : 1;
  }
  std::cout << fmt::format("{} sizes of a disk for {} bytes, {} wrong outcomes\n", sizes, one.bytes,
                           wrong_outcomes);
}

}  // namespace
}  // namespace touchdown::faults

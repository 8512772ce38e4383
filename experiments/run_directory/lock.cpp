#include "experiments/run_directory/lock.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <optional>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/progress.hpp"

namespace touchdown::experiments {

namespace fs = std::filesystem;

namespace {

/// A process that holds a lock: one line of the lock file.
struct Holder {
  pid_t process = 0;
  std::string host;
  std::string since;
  std::string command;
};

std::string this_host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string line_of(const Holder& holder) {
  std::string command = holder.command;
  std::replace_if(
      command.begin(), command.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return fmt::format("{}\t{}\t{}\t{}\n", holder.process, holder.host, holder.since, command);
}

std::vector<Holder> holders_in(const std::string& lines) {
  std::vector<Holder> holders;
  std::istringstream text(lines);
  for (Holder one; text >> one.process >> one.host && text.ignore(1);) {
    if (!std::getline(text, one.since, '\t') || !std::getline(text, one.command)) break;
    holders.push_back(one);
  }
  return holders;
}

/// Some processes of a shared lock may be dead. Those on other machines count as alive.
std::optional<Holder> living_holder(const fs::path& file) {
  std::vector<Holder> holders;
  try {
    holders = holders_in(read_file(file));
  } catch (const Error&) {
    return std::nullopt;
  }
  const std::string here = this_host();
  const auto alive = std::find_if(holders.rbegin(), holders.rend(), [&](const Holder& one) {
    return one.host != here || ::kill(one.process, 0) == 0 || errno != ESRCH;
  });
  return alive == holders.rend() ? std::nullopt : std::optional(*alive);
}

std::string holder_text(const fs::path& file) {
  const std::optional<Holder> holder = living_holder(file);
  if (!holder) return "another process";
  return fmt::format("process {} on {} since {} ({})", holder->process, holder->host, holder->since,
                     holder->command);
}

std::shared_ptr<const int> opened(const fs::path& file, int flags) {
  constexpr mode_t mode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
  const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, mode);
  if (descriptor < 0) return nullptr;
  return {new int(descriptor), [](const int* one) {
            ::close(*one);
            delete one;
          }};
}

/// Whether the path still leads to the opened file: the directory may have been removed meanwhile.
bool is_still_there(const fs::path& file, int descriptor) {
  struct stat there = {};
  struct stat here = {};
  return ::stat(file.c_str(), &there) == 0 && ::fstat(descriptor, &here) == 0 &&
         there.st_dev == here.st_dev && there.st_ino == here.st_ino;
}

enum class LockResult { taken, busy, no_locks };

LockResult try_lock(int descriptor, Access access) {
  const int operation = (access == Access::alone ? LOCK_EX : LOCK_SH) | LOCK_NB;
  int result = 0;
  do {
    result = ::flock(descriptor, operation);
  } while (result != 0 && errno == EINTR);
  if (result == 0) return LockResult::taken;
  return errno == EWOULDBLOCK ? LockResult::busy : LockResult::no_locks;
}

/// Children of a killed process inherit its locks until they die: this long at most.
constexpr std::chrono::seconds dying(5);

/// Retries until `until`, and for `dying` longer if no registered holder is alive.
LockResult wait_for_lock(const fs::path& file, int descriptor, Access access,
                         std::chrono::steady_clock::time_point until) {
  for (;;) {
    const LockResult result = try_lock(descriptor, access);
    if (result == LockResult::no_locks) {
      print_message(
          fmt::format("touchdown: {}: cannot be locked: {}: start no other command on this "
                      "directory meanwhile\n",
                      file.string(), std::generic_category().message(errno)));
    }
    if (result != LockResult::busy) return result;
    const auto now = std::chrono::steady_clock::now();
    if (now >= until && (now >= until + dying || living_holder(file))) return result;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void sign(int descriptor, Access access, const std::string& command) {
  const Holder holder{::getpid(), this_host(),
                      fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::floor<std::chrono::seconds>(
                                                   std::chrono::system_clock::now()))),
                      command};
  const std::string line = line_of(holder);
  // Errors are ignored: the lock holds on a full disk, too.
  if (access == Access::alone && ::ftruncate(descriptor, 0) != 0) return;
  [[maybe_unused]] const ssize_t written = ::write(descriptor, line.data(), line.size());
}

[[noreturn]] void refuse(const fs::path& directory) {
  throw Error(fmt::format("{}: is in use by {}: wait until it has ended", directory.string(),
                          holder_text(lock_file(directory))));
}

}  // namespace

fs::path lock_file(const fs::path& directory) { return directory / "state" / "lock"; }

DirectoryLock::DirectoryLock(const fs::path& directory, Access access, const std::string& command,
                             std::chrono::milliseconds patience)
    : file_(lock_file(directory)) {
  const fs::path& file = file_;
  const auto until = std::chrono::steady_clock::now() + patience;
  for (;;) {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    descriptor_ = opened(file, O_RDWR | O_APPEND | O_CREAT);
    if (!descriptor_) {
      if (!error) error.assign(errno, std::generic_category());
      throw Error(fmt::format("{}: cannot be opened: {}", file.string(), error.message()));
    }
    const LockResult result = wait_for_lock(file, *descriptor_, access, until);
    if (result == LockResult::taken && !is_still_there(file, *descriptor_)) continue;
    if (result == LockResult::busy) refuse(directory);
    break;
  }
  sign(*descriptor_, access, command);
}

DirectoryLock DirectoryLock::for_reading(const fs::path& directory, const std::string& command) {
  DirectoryLock lock;
  lock.file_ = lock_file(directory);
  const fs::path& file = lock.file_;
  lock.descriptor_ = opened(file, O_RDWR | O_APPEND);
  if (!lock.descriptor_) lock.descriptor_ = opened(file, O_RDONLY);
  if (!lock.descriptor_) return lock;
  const auto now = std::chrono::steady_clock::now();
  if (wait_for_lock(file, *lock.descriptor_, Access::shared, now) == LockResult::busy) {
    refuse(directory);
  }
  sign(*lock.descriptor_, Access::shared, command);
  return lock;
}

bool DirectoryLock::is_in_place() const {
  return !descriptor_ || is_still_there(file_, *descriptor_);
}

}  // namespace touchdown::experiments

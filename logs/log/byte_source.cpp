#include "logs/log/byte_source.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <optional>
#include <poll.h>
#include <string>
#include <string_view>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"

namespace touchdown::logs {

namespace {

struct Descriptor {
  int number;
  explicit Descriptor(int descriptor) : number(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number > STDIN_FILENO) ::close(number);
  }
};

/// Waits until bytes are available or `stop` is true. Each wait is short, since a signal may arrive
/// right before it.
void wait_for_bytes(int descriptor, const std::atomic<bool>& stop) {
  constexpr int milliseconds = 100;
  pollfd wait{descriptor, POLLIN, 0};
  while (!stop && ::poll(&wait, 1, milliseconds) == 0) {
  }
}

/// Whether a path stands for a descriptor of this process, such as a shell's <(…): to open it does
/// not wait, as it does for a pipe with a name.
bool is_opened_already(std::string_view name) {
  return name == "/dev/stdin" || name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/");
}

/// A log in another layout, which is read with a mapping.
struct OtherLog {
  const char* kind;
  const char* read;     ///< what the commands then read
  const char* example;  ///< a mapping to begin with
};

/// Nothing for a path that may be a log in Upkie's layout.
std::optional<OtherLog> other_log(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (is_folder(path)) return OtherLog{"a folder", "a ROS 2 bag", "ros2_bag.yaml"};
  if (extension == ".csv" || extension == ".tsv") return OtherLog{"a CSV file", "it", "robot.yaml"};
  if (extension == ".npz") return OtherLog{"a file of NumPy's arrays", "it", "robot.yaml"};
  if (extension == ".mcap" || extension == ".db3" || extension == ".zstd") {
    return OtherLog{"a ROS 2 bag", "a ROS 2 bag", "ros2_bag.yaml"};
  }
  return std::nullopt;
}

/// The path of an example of a mapping for whoever reads it: in a checkout or an installation.
std::string example_path(const char* name) {
  const std::filesystem::path example = std::filesystem::path("examples/mapping") / name;
  try {
    return find_program_file(example).string();
  } catch (const InputError&) {  // a program without its files
    return example.string();
  }
}

}  // namespace

void require_no_gzip(const std::filesystem::path& path) {
  if (extension_of(path) != ".gz") return;
  throw InputError(
      fmt::format("{0}: is compressed with gzip: `gunzip -k {0}` first", path.string()));
}

ByteSource file_source(const std::filesystem::path& path, const std::atomic<bool>* stop) {
  const std::string name = path.string();
  const std::optional<OtherLog> other = other_log(path);
  if (other && is_there(path)) {
    throw InputError(fmt::format(
        "{}: is {}, expected a log in Upkie's layout; `touchdown estimate`, `check` and `convert` "
        "read {} with --mapping FILE.yaml: start from a copy of {}",
        name, other->kind, other->read, example_path(other->example)));
  }
  require_no_gzip(path);
  if (name != "-" && !is_opened_already(name)) require_file(name);
  const int opened =
      name == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);  // NOLINT
  if (opened < 0) complain_unreadable(name, {errno, std::generic_category()}, "opened");
  const auto descriptor = std::make_shared<Descriptor>(opened);
  return [descriptor, name, stop](std::span<char> buffer) {
    while (true) {
      if (stop != nullptr) wait_for_bytes(descriptor->number, *stop);
      if (stop != nullptr && *stop) return std::size_t{0};
      const ssize_t size = ::read(descriptor->number, buffer.data(), buffer.size());
      if (size >= 0) return static_cast<std::size_t>(size);
      if (errno == EINTR) continue;
      complain_unreadable(name, {errno, std::generic_category()});
    }
  };
}

}  // namespace touchdown::logs

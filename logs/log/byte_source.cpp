#include "logs/log/byte_source.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fcntl.h>
#include <initializer_list>
#include <memory>
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

/// What a path is if it is no log in Upkie's layout, but read with a mapping; else empty.
std::string kind_of_other_log(const std::filesystem::path& path) {
  std::string name = path.string();
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto ends_with_any = [&](std::initializer_list<const char*> extensions) {
    return std::ranges::any_of(extensions, [&](const char* one) { return name.ends_with(one); });
  };
  if (is_folder(path)) return "a folder";
  if (ends_with_any({".csv", ".tsv"})) return "a CSV file";
  if (ends_with_any({".npz"})) return "a file of NumPy's arrays";
  if (ends_with_any({".mcap", ".db3", ".zstd"})) return "a ROS 2 bag";
  return {};
}

}  // namespace

ByteSource file_source(const std::filesystem::path& path, const std::atomic<bool>* stop) {
  const std::string name = path.string();
  const std::string other = kind_of_other_log(path);
  if (!other.empty() && is_there(path)) {
    const bool is_table = other.ends_with("file") || other.ends_with("arrays");
    throw InputError(fmt::format(
        "{}: is {}, expected a log in Upkie's layout; `touchdown estimate`, `check` and `export` "
        "read {} with --mapping FILE.yaml: start from a copy of examples/mapping/{}",
        name, other, is_table ? "it" : "a ROS 2 bag", is_table ? "robot.yaml" : "ros2_bag.yaml"));
  }
  if (path.extension() == ".gz") {
    throw InputError(fmt::format("{0}: is compressed with gzip: `gunzip -k {0}` first", name));
  }
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

#include "render/gnuplot/process.hpp"

#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <sstream>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::render {

namespace {

using namespace std::string_view_literals;

/// The last bytes of a complete file, by extension.
const std::map<std::string, std::string_view> file_endings = {
    {".png", "\0\0\0\0IEND\xae\x42\x60\x82"sv}, {".svg", "</svg>"sv}, {".pdf", "%%EOF"sv}};

[[noreturn]] void fail(const std::filesystem::path& final_path, int reason) {
  const std::string why = reason == 0 ? "" : ": " + std::generic_category().message(reason);
  throw Error(fmt::format("{}: cannot be written{}", final_path.string(), why));
}

/// Reports write errors that the disk reveals only when its buffers are flushed.
void flush(const std::filesystem::path& path, const std::filesystem::path& final_path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) fail(final_path, reason);
}

/// The line of gnuplot's messages that names the error.
std::string first_reason(const std::string& complaints) {
  std::istringstream lines(complaints);
  std::string line, last;
  while (std::getline(lines, line)) {
    if (line.find("line ") != std::string::npos) return line;
    if (line.find_first_not_of(" ^\t") != std::string::npos) last = line;
  }
  return last;
}

/// Without them gnuplot draws a figure without fonts or data, and reports success.
void require_descriptors() {
  constexpr rlim_t needed = 16;
  rlimit limit = {};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= needed) return;
  throw Error(fmt::format("gnuplot needs {} file descriptors, and the limit is {} (ulimit -n)",
                          needed, limit.rlim_cur));
}

/// gnuplot only warns of data that it cannot read.
bool lacks_data(const std::string& complaints) {
  return complaints.find("Cannot find or open file") != std::string::npos;
}

/// This process's environment, but in UTC: gnuplot writes the time zone into every PDF.
std::vector<char*> environment_in_utc() {
  static std::string zone = "TZ=UTC0";
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!std::string_view(*variable).starts_with("TZ=")) variables.push_back(*variable);
  }
  variables.push_back(zone.data());
  variables.push_back(nullptr);
  return variables;
}

/// Whether a drawing of another program ends as its file type does: a PNG with its last chunk, an
/// SVG with `</svg>`, a PDF with `%%EOF`.
bool is_whole(const std::filesystem::path& drawing) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(drawing, ignored)) return false;
  std::string content = read_file(drawing);
  while (content.ends_with('\n')) content.pop_back();
  return content.ends_with(file_endings.at(drawing.extension().string()));
}

}  // namespace

void write_whole(const std::filesystem::path& path, std::string_view content,
                 const std::filesystem::path& final_path) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) fail(final_path, errno);
  flush(path, final_path);
}

void require_whole(const std::filesystem::path& drawing, const std::filesystem::path& final_path) {
  if (is_whole(drawing)) {
    flush(drawing, final_path);
    return;
  }
  throw Error(fmt::format("{}: cannot be written: gnuplot left it unfinished; is the disk full?",
                          final_path.string()));
}

std::string file_argument(const std::string& name) {
  const bool is_plain = !name.empty() && (std::isalnum(static_cast<unsigned char>(name[0])) != 0 ||
                                          static_cast<unsigned char>(name[0]) >= 0x80);
  return is_plain ? name : "./" + name;
}

std::string gnuplot_complaint(const std::filesystem::path& folder, const std::string& script) {
  // -d ignores ~/.gnuplot: the user's settings are commands, and would change the figure.
  std::array<std::string, 3> words = {"gnuplot", "-d", file_argument(script)};
  const std::array<char*, 4> arguments = {words[0].data(), words[1].data(), words[2].data(),
                                          nullptr};
  const std::vector<char*> environment = environment_in_utc();
  std::array<int, 2> ends = {};
  require_descriptors();
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw Error(fmt::format("no pipe for gnuplot: {}", std::strerror(errno)));
  }
  const pid_t pid = ::fork();
  if (pid < 0) throw Error(fmt::format("no process for gnuplot: {}", std::strerror(errno)));
  if (pid == 0) {
    // Ctrl-C at a terminal reaches every process of a group. It stops this program between two
    // figures, so gnuplot gets a group of its own, and dies with this program only.
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(ends[1], STDERR_FILENO);
    ::dup2(::open("/dev/null", O_RDWR), STDIN_FILENO);
    ::dup2(STDIN_FILENO, STDOUT_FILENO);
    if (::chdir(folder.c_str()) != 0) ::_exit(126);
    ::execvpe(arguments[0], arguments.data(), environment.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  std::string complaints;
  std::array<char, 4096> buffer;
  for (ssize_t got = 0; (got = ::read(ends[0], buffer.data(), buffer.size())) != 0;) {
    if (got < 0 && errno != EINTR) break;
    if (got > 0) complaints.append(buffer.data(), static_cast<std::size_t>(got));
  }
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw Error("gnuplot is not installed: the figures need the package gnuplot-nox");
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !lacks_data(complaints)) return {};
  return complaints.empty() ? "it failed and gave no reason" : first_reason(complaints);
}

}  // namespace touchdown::render

#include "render/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/gnuplot_style.hpp"
#include "render/pdf_date.hpp"
#include "render/video_writer.hpp"

namespace touchdown {
namespace {

/// A folder that is gone afterwards, with what was not moved out of it.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::filesystem::path& stem) {
    try {
      const std::filesystem::path parent = std::filesystem::absolute(stem).parent_path();
      std::filesystem::create_directories(parent);
      path_ = parent / fmt::format(".{}.{}.part", stem.filename().string(), ::getpid());
      std::filesystem::create_directory(path_);
    } catch (const std::filesystem::filesystem_error& error) {
      throw Error(fmt::format("{}: cannot be written: {}", stem.string(), error.code().message()));
    }
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Runs gnuplot on `script` in `folder`; returns what it complained about.
std::string run_gnuplot(const std::filesystem::path& folder, const std::string& script) {
  std::array<int, 2> ends = {};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("no pipe for gnuplot");
  const pid_t pid = ::fork();
  if (pid < 0) throw Error("no process for gnuplot");
  if (pid == 0) {
    ::dup2(ends[1], STDERR_FILENO);
    ::dup2(::open("/dev/null", O_RDWR), STDIN_FILENO);
    ::dup2(STDIN_FILENO, STDOUT_FILENO);
    if (::chdir(folder.c_str()) != 0) ::_exit(126);
    ::execlp("gnuplot", "gnuplot", script.c_str(), static_cast<char*>(nullptr));
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
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    if (complaints.empty()) complaints = "it failed and did not say why";
  } else {
    complaints.clear();  // warnings
  }
  return complaints;
}

/// Of gnuplot's complaints, the line that says what is wrong.
std::string first_reason(const std::string& complaints) {
  std::istringstream lines(complaints);
  std::string line, last;
  while (std::getline(lines, line)) {
    if (line.find("line ") != std::string::npos) return line;
    if (line.find_first_not_of(" ^\t") != std::string::npos) last = line;
  }
  return last;
}

void write(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

}  // namespace

Figure draw_figure(const std::filesystem::path& stem, int width, int height,
                   const std::string& commands, const std::vector<PlotData>& data) {
  require_writable(stem.string() + ".png");
  const ScratchFolder scratch(stem);
  const std::string name = stem.filename().string();
  const std::string script = fmt::format(
      "# Draws {0}.png, {0}.svg and {0}.pdf: gnuplot {0}.gp\n"
      "load 'style.gp'\n"
      "do for [format in \"png svg pdf\"] {{\n"
      "eval terminal(format, {1}, {2})\n"
      "set output {3}.format\n"
      "{4}"
      "unset output\n"
      "}}\n",
      name, width, height, gnuplot_text(name + "."), commands);
  write(scratch.path() / (name + ".gp"), script);
  write(scratch.path() / "style.gp", gnuplot_style);
  std::vector<std::string> files = {"style.gp", name + ".gp", name + ".png", name + ".svg",
                                    name + ".pdf"};
  for (const PlotData& table : data) {
    write(scratch.path() / table.name, table.content);
    files.push_back(table.name);
  }
  const std::string complaints = run_gnuplot(scratch.path(), name + ".gp");
  if (!complaints.empty()) {
    throw Error(fmt::format("{}: gnuplot: {}", stem.string(), first_reason(complaints)));
  }
  remove_pdf_date(scratch.path() / (name + ".pdf"));
  const std::filesystem::path folder = std::filesystem::absolute(stem).parent_path();
  try {
    for (const std::string& file : files) {
      std::filesystem::rename(scratch.path() / file, folder / file);
    }
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(fmt::format("{}: cannot be written: {}", stem.string(), error.code().message()));
  }
  return {stem.string() + ".png", stem.string() + ".svg", stem.string() + ".pdf"};
}

std::string gnuplot_text(std::string_view text) {
  std::string result = "'";
  for (const char letter : text) {
    if (letter == '\n') {
      result += "'.\"\\n\".'";
    } else if (letter == '\'') {
      result += "'.\"'\".'";  // gnuplot's own '' fails at the beginning of a text
    } else if (letter == '@') {
      result += "'.\"\\100\".'";  // a macro's sign, even within quotes
    } else if (static_cast<unsigned char>(letter) >= 0x20) {
      result += letter;
    }
  }
  return result + "'";
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "NaN"; }

std::string wrapped(std::string_view text, std::size_t columns) {
  std::string result;
  std::size_t used = 0;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    // Letters, not bytes, count: UTF-8 continuation bytes begin with 10.
    const auto letters =
        static_cast<std::size_t>(std::count_if(word.begin(), word.end(), [](char c) {
          return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
        }));
    if (used > 0 && used + 1 + letters > columns) {
      result += '\n';
      used = 0;
    } else if (used > 0) {
      result += ' ';
      ++used;
    }
    result += word;
    used += letters;
  }
  return result;
}

}  // namespace touchdown

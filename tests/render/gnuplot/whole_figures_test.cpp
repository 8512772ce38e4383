#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <qpdf/qpdf-c.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/gnuplot/figure.hpp"
#include "render/gnuplot/process.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

/// Sets an environment variable for the lifetime of this object.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] =
        entry.is_regular_file() ? read_file(entry.path()) : "";
  }
  return files;
}

class WholeFigures : public ::testing::Test {
 protected:
  void draw(const std::string& commands = "plot x\n") const {
    draw_figure(folder_ / "line", 300, 200, commands, {{"line.dat", "1\t2\n"}});
  }
  /// A gnuplot that draws, truncates its output, and reports success, as the real one does when the
  /// disk is full.
  std::string path_with_cutting_gnuplot(const std::string& victim) const {
    const fs::path program = tools_ / "gnuplot";
    std::ofstream(program) << "#!/bin/sh\nPATH=" << std::getenv("PATH")
                           << "\ngnuplot \"$@\" || exit\nfor f in " << victim
                           << "; do head -c 200 $f >cut; mv cut $f; done\n";
    fs::permissions(program, fs::perms::owner_all);
    return tools_.path().string() + ":" + std::getenv("PATH");
  }

  const ScratchFolder scratch_, tools_;
  const fs::path folder_ = scratch_.path();
};

TEST_F(WholeFigures, AnUnfinishedDrawingDoesNotReplaceThePreviousOne) {
  draw();
  const auto before = files_in(folder_);
  ASSERT_EQ(before.size(), 5U);
  for (const char* victim : {"line.png", "line.svg", "line.pdf"}) {
    const Variable path("PATH", path_with_cutting_gnuplot(victim));
    EXPECT_THAT(
        [&] { draw("plot -x\n"); },
        ThrowsMessage<Error>(AllOf(HasSubstr((folder_ / victim).string()),
                                   HasSubstr("cannot be written"), Not(HasSubstr(".part")))));
    EXPECT_TRUE(files_in(folder_) == before) << victim;
  }
}

TEST_F(WholeFigures, AFullDiskIsAnErrorThatNamesTheFileAndLeavesNothing) {
  draw();
  const auto before = files_in(folder_);
  const pid_t child = ::fork();
  if (child == 0) {
    // A limit on the size of all files of this process and of the programs that it starts.
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit most{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &most);
    try {
      draw("plot -x\n");
    } catch (const Error& error) {
      const std::string message = error.what();
      const bool named = message.find((folder_ / "line").string() + ".") != std::string::npos;
      ::_exit(named && message.find("cannot be written") != std::string::npos ? 42 : 1);
    }
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_TRUE(files_in(folder_) == before);
}

TEST_F(WholeFigures, FailedWritesAreErrorsWithTheFinalName) {
  EXPECT_THAT([] { write_whole("/dev/full", "text", "figures/a.dat"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("figures/a.dat: cannot be written"),
                                         HasSubstr("No space left"))));
}

TEST_F(WholeFigures, DrawingsAreWholeIfTheyEndAsTheirFileTypeDoes) {
  draw();
  for (const char* kind : {"line.png", "line.svg", "line.pdf"}) {
    const std::string content = read_file(folder_ / kind);
    EXPECT_TRUE(is_whole(folder_ / kind)) << kind;
    for (const std::size_t size : {content.size() - 4, content.size() / 2, std::size_t{0}}) {
      std::ofstream(folder_ / kind, std::ios::binary) << content.substr(0, size);
      EXPECT_FALSE(is_whole(folder_ / kind)) << kind << " of " << size << " bytes";
    }
    fs::remove(folder_ / kind);
    EXPECT_FALSE(is_whole(folder_ / kind));
  }
}

TEST_F(WholeFigures, AnOptionalFigureStaysAfterAnError) {
  const std::string script = "set terminal pngcairo\nset output 'training.png'\nplot x\n";
  ASSERT_EQ(try_gnuplot(folder_ / "training.gp", script), folder_ / "training.png");
  const std::string before = read_file(folder_ / "training.png");
  const Variable path("PATH", path_with_cutting_gnuplot("training.png"));
  EXPECT_TRUE(try_gnuplot(folder_ / "training.gp", script + "plot -x\n").empty());
  EXPECT_TRUE(read_file(folder_ / "training.png") == before);
  EXPECT_EQ(files_in(folder_).size(), 2U);
}

TEST_F(WholeFigures, UserSettingsOfGnuplotAreIgnored) {
  draw();
  const std::string before = read_file(folder_ / "line.png");
  const std::string marker = (tools_ / "was_here").string();
  std::ofstream(tools_ / ".gnuplot")
      << "system 'touch " << marker << "'\nset samples 2\nset border 0\n";
  const Variable home("HOME", tools_.path().string());
  draw();
  EXPECT_FALSE(fs::exists(marker));
  EXPECT_TRUE(read_file(folder_ / "line.png") == before);
}

TEST_F(WholeFigures, AreTheSameInEveryTimeZone) {
  const Variable here("TZ", "UTC0");
  draw();
  const auto before = files_in(folder_);
  for (const char* zone : {"Asia/Kolkata", "America/St_Johns", "XXX-5:30"}) {
    const Variable there("TZ", zone);
    draw();
    EXPECT_TRUE(files_in(folder_) == before) << zone;
  }
}

TEST_F(WholeFigures, FilesOfTheUserAreNotReplaced) {
  std::ofstream(folder_ / "style.gp") << "mine";
  draw();
  EXPECT_EQ(read_file(folder_ / "style.gp"), "mine");
  draw();  // its own files it may replace
  for (const char* name : {"results.dat", "results.gp", "results.pdf"}) {
    std::ofstream(folder_ / name) << "mine";
    EXPECT_THAT(
        [&] {
          draw_figure(folder_ / "results", 300, 200, "plot x\n", {{"results.dat", "1\n"}});
        },
        ThrowsMessage<InputError>(
            AllOf(HasSubstr((folder_ / name).string()), HasSubstr("another name"))));
    EXPECT_EQ(read_file(folder_ / name), "mine");
    EXPECT_FALSE(fs::exists(folder_ / "results.png"));
    fs::remove(folder_ / name);
  }
}

/// A page with its producer and creation time, as text or in a packed stream, as cairo writes it
/// from 1.18 on.
std::string drawn_at(const std::string& date, qpdf_object_stream_e streams) {
  qpdf_data document = qpdf_init();
  qpdf_empty_pdf(document);
  qpdf_set_info_key(document, "/Producer", "a plotter");
  qpdf_set_info_key(document, "/CreationDate", date.c_str());
  qpdf_init_write_memory(document);
  qpdf_set_object_stream_mode(document, streams);
  qpdf_set_static_ID(document, QPDF_TRUE);
  qpdf_write(document);
  const unsigned char* bytes = qpdf_get_buffer(document);
  std::string pdf(bytes, bytes + qpdf_get_buffer_length(document));
  qpdf_cleanup(&document);
  return pdf;
}

class DatelessPdf : public ::testing::TestWithParam<qpdf_object_stream_e> {};

TEST_P(DatelessPdf, IsTheSameWheneverItWasDrawn) {
  const std::string one = drawn_at("D:20261121075601Z", GetParam());
  const std::string other = drawn_at("D:20270307101112+01'00", GetParam());
  ASSERT_NE(one, other);
  EXPECT_EQ(dateless_pdf(one, "a.pdf"), dateless_pdf(other, "a.pdf"));
}

INSTANTIATE_TEST_SUITE_P(Info, DatelessPdf, ::testing::Values(qpdf_o_disable, qpdf_o_generate));

TEST(DatelessPdf, KeepsOtherMetadata) {
  EXPECT_THAT(dateless_pdf(drawn_at("D:2026", qpdf_o_disable), "a.pdf"),
              AllOf(HasSubstr("a plotter"), Not(HasSubstr("D:2026"))));
}

TEST(DatelessPdf, AnInvalidPdfIsAnErrorWithItsName) {
  for (const char* text : {"", "no PDF", "%PDF-1.5\n1 0 obj"}) {
    EXPECT_THAT([&] { dateless_pdf(text, "curve.pdf"); },
                ThrowsMessage<Error>(StartsWith("curve.pdf")))
        << text;
  }
}

TEST(DatelessPdf, FiguresAreDateless) {
  const ScratchFolder folder;
  const Figure figure = draw_figure(folder / "line", 200, 100, "plot x\n", {});
  const std::string pdf = read_file(figure.pdf);
  EXPECT_EQ(dateless_pdf(pdf, "line.pdf"), pdf);
}

}  // namespace
}  // namespace touchdown::render

#include "core/files.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

class Files : public ::testing::Test {
 protected:
  const ScratchFolder scratch_;
  const std::filesystem::path folder_ = scratch_.path();
};

TEST_F(Files, AreWrittenWholeIntoFoldersThatAreMade) {
  const auto path = folder_ / "a" / "b" / "file.csv";
  const std::string content("x,y\n\0\xff", 6);
  write_atomically(path, content);
  EXPECT_EQ(read_file(path), content);
  for (const char* other : {"shorter", ""}) {
    write_atomically(path, other);
    EXPECT_EQ(read_file(path), other);
  }
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder_);
  write_atomically("plain.txt", "x");
  std::filesystem::current_path(before);
  EXPECT_EQ(read_file(folder_ / "plain.txt"), "x");
  EXPECT_THROW(write_atomically(folder_ / "plain.txt" / "below", "x"), Error);
  EXPECT_THROW(write_atomically("/proc/file", "x"), Error);
}

TEST_F(Files, AWriterThatThrowsLeavesTheOldFileOrNone) {
  const auto path = folder_ / "file.mp4";
  std::filesystem::path seen;
  const auto fail_halfway = [&](const std::filesystem::path& temporary) {
    seen = temporary;
    std::ofstream(temporary) << "half";
    EXPECT_TRUE(std::filesystem::exists(temporary));
    throw Error("the encoder died");
  };
  EXPECT_THROW(write_atomically(path, fail_halfway), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  EXPECT_EQ(seen.parent_path(), folder_) << "a rename must not cross file systems";
  EXPECT_EQ(seen.extension(), ".mp4") << "writers choose their format by it";
  EXPECT_THROW(write_atomically(path, [](const std::filesystem::path&) {}), Error)
      << "a writer that writes nothing";
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  write_atomically(path, "old");
  EXPECT_THROW(write_atomically(path, fail_halfway), Error);
  EXPECT_EQ(read_file(path), "old");
}

TEST_F(Files, APartFolderIsNewEvenIfItsNameIsGuessed) {
  // A link under a guessed name would lead into another folder.
  const auto elsewhere = folder_ / "elsewhere";
  std::filesystem::create_directory(elsewhere);
  write_atomically(elsewhere / "precious", "x");
  std::filesystem::create_directory_symlink(
      elsewhere, folder_ / (".figure." + std::to_string(::getpid()) + ".part"));
  {
    const PartFolder first(folder_ / "figure");
    const PartFolder second(folder_ / "figure");
    EXPECT_NE(first.path(), second.path());
    for (const PartFolder* folder : {&first, &second}) {
      EXPECT_FALSE(std::filesystem::is_symlink(folder->path()));
      EXPECT_TRUE(std::filesystem::is_empty(folder->path()));
      EXPECT_EQ(std::filesystem::status(folder->path()).permissions(),
                std::filesystem::perms::owner_all);
    }
  }
  EXPECT_EQ(read_file(elsewhere / "precious"), "x");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 2);
}

TEST_F(Files, OneThatCannotBeReadToItsEndIsAnErrorAndNoShorterFile) {
  // Nothing is mapped at its beginning: to read there is an I/O error.
  EXPECT_THAT([] { read_file("/proc/self/mem"); },
              ::testing::ThrowsMessage<Error>("/proc/self/mem: cannot be read"));
}

TEST_F(Files, ThatAreNotRegularAreRefusedAtOnce) {
  std::filesystem::create_symlink("/dev/zero", folder_ / "zero");
  std::filesystem::create_symlink("b", folder_ / "a");
  std::filesystem::create_symlink("a", folder_ / "b");
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);  // without a writer
  std::filesystem::create_symlink("pipe", folder_ / "to_pipe");
  scratch_.write("file", "x");
  std::filesystem::create_symlink("file", folder_ / "to_file");
  const auto complaint = [&](const std::filesystem::path& path) {
    return complaint_of([&] { (void)read_file(path); });
  };
  for (const char* const special : {"zero", "pipe", "to_pipe"}) {
    EXPECT_THAT(complaint(folder_ / special), ::testing::EndsWith(": is not a regular file"));
  }
  EXPECT_THAT(complaint("/dev/null"), ::testing::EndsWith(": is not a regular file"));
  EXPECT_THAT(complaint(folder_), ::testing::EndsWith(": is a folder, expected a file"));
  EXPECT_THAT(complaint(folder_ / "none"), ::testing::EndsWith(": no such file"));
  EXPECT_THAT(complaint(folder_ / "a"), ::testing::HasSubstr(": cannot be opened: "));
  EXPECT_THAT(complaint(folder_ / std::string(300, 'x')),
              ::testing::HasSubstr(": cannot be opened: "));
  EXPECT_THAT(complaint(folder_ / "file" / "below"), ::testing::HasSubstr("file/below: "));
  EXPECT_EQ(read_file(folder_ / "to_file"), "x");
  for (const std::string name : {"zero", "pipe", "file"}) EXPECT_TRUE(is_there(folder_ / name));
  const std::string long_name(300, 'x');
  for (const std::string& name : {std::string("none"), std::string("a"), long_name}) {
    EXPECT_FALSE(is_there(folder_ / name)) << name;
  }
}

TEST_F(Files, AStreamThatFailsIsReportedByTheNameOfItsFile) {
  const auto path = folder_ / "beliefs.csv";
  const auto complaint = [&](const std::function<void(std::ostream&)>& write) {
    return complaint_of<Error>([&] { write_stream_atomically(path, write); });
  };
  EXPECT_EQ(complaint([](std::ostream& file) { file << "x"; }), "no complaint");
  EXPECT_EQ(read_file(path), "x");
  const std::string expected = fmt::format("{}: cannot be written", path.string());
  EXPECT_THAT(complaint([](std::ostream& file) { file.setstate(std::ios::badbit); }),
              ::testing::StartsWith(expected));
  EXPECT_THAT(complaint([](std::ostream& file) {
                file.setstate(std::ios::badbit);
                throw Error("the log cannot be written");
              }),
              ::testing::StartsWith(expected));
  EXPECT_EQ(complaint([](std::ostream&) { throw Error("a record is broken"); }),
            "a record is broken");
  EXPECT_EQ(read_file(path), "x");  // as before
}

TEST_F(Files, DoNotReplaceDevicesAndPipes) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder_ / "zero");
  std::filesystem::create_symlink("pipe", folder_ / "to_pipe");
  for (const char* const special : {"pipe", "zero", "to_pipe"}) {
    EXPECT_THROW(write_atomically(folder_ / special, "x"), Error) << special;
    EXPECT_FALSE(std::filesystem::is_regular_file(folder_ / special)) << special;
  }
  std::filesystem::create_symlink("nowhere", folder_ / "dangling");
  write_atomically(folder_ / "dangling", "x");
  EXPECT_EQ(read_file(folder_ / "dangling"), "x");
}

TEST_F(Files, OfAFolderAreListedInOrderAndThoseOfNoFolderAreNone) {
  using ::testing::ElementsAre;
  using ::testing::IsEmpty;
  scratch_.write("b", "12");
  scratch_.write("a/c", "123");
  std::filesystem::create_directory_symlink("a", folder_ / "link");
  const std::filesystem::path f = folder_;
  EXPECT_THAT(entries_in(f), ElementsAre(f / "a", f / "b", f / "link"));
  EXPECT_THAT(entries_below(f), ElementsAre(f / "a", f / "a" / "c", f / "b", f / "link"));
  for (const char* const none : {"none", "b", "none/below", "b/below"}) {
    EXPECT_THAT(entries_in(f / none), IsEmpty()) << none;
    EXPECT_THAT(entries_below(f / none), IsEmpty()) << none;
  }
  EXPECT_TRUE(is_folder(f / "link"));
  EXPECT_FALSE(is_folder(f / "b"));
  EXPECT_EQ(size_of_file(f / "b"), 2U);
  EXPECT_EQ(size_of_file(f / "none"), 0U);
  EXPECT_EQ(size_of_file(f), 0U) << "a folder";
}

TEST_F(Files, OfAFolderThatCannotBeReadAreAnErrorAndNotNone) {
  std::filesystem::create_symlink("b", folder_ / "a");
  std::filesystem::create_symlink("a", folder_ / "b");
  const std::filesystem::path long_name = folder_ / std::string(300, 'x');
  for (const std::filesystem::path& path : {folder_ / "a", long_name}) {
    EXPECT_THROW(entries_in(path), InputError);
    EXPECT_THROW(entries_below(path), InputError);
    EXPECT_FALSE(is_folder(path));
  }
}

/// Calls `use` while the process can open no more files.
template <typename Use>
std::string without_descriptors(const Use& use) {
  rlimit before = {};
  ::getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none = {0, before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &none);
  std::string complaint = "none";
  try {
    use();
  } catch (const InputError& error) {
    complaint = "InputError";
  } catch (const Error& error) {
    complaint = error.what();
  }
  ::setrlimit(RLIMIT_NOFILE, &before);
  return complaint;
}

TEST_F(Files, WithoutADescriptorLeftAreNoFaultOfTheRequest) {
  using ::testing::StartsWith;
  scratch_.write("file", "x");
  const std::string file = (folder_ / "file").string();
  EXPECT_THAT(without_descriptors([&] { (void)read_file(file); }),
              StartsWith(file + ": cannot be opened: "));
  EXPECT_THAT(without_descriptors([&] { (void)entries_in(folder_); }),
              StartsWith(folder_.string() + ": cannot be read: "));
  EXPECT_THAT(without_descriptors([&] { (void)entries_below(folder_); }),
              StartsWith(folder_.string() + ": cannot be read: "));
  EXPECT_THAT(without_descriptors([&] { write_atomically(file, "y"); }),
              StartsWith(file + ": cannot be written: "));
  EXPECT_EQ(read_file(file), "x");
}

TEST(TemporaryFolder, ThatIsNoneIsNamed) {
  for (const char* const wrong : {"/nonexistent/tmp", "/dev/null", "/etc/passwd"}) {
    const TemporaryFilesIn there(wrong);
    EXPECT_THAT(complaint_of([] { (void)temporary_folder(); }),
                ::testing::StartsWith(std::string(wrong) + ": no folder"));
  }
}

TEST(AbsolutePath, NeedsAWorkingDirectory) {
  EXPECT_EQ(absolute_path("/a/b"), "/a/b");
  EXPECT_EQ(absolute_path("a"), std::filesystem::current_path() / "a");
  EXPECT_EQ(absolute_path(""), std::filesystem::current_path() / "");
  const std::filesystem::path before = std::filesystem::current_path();
  {
    const ScratchFolder gone;
    std::filesystem::current_path(gone.path());
  }
  EXPECT_THROW((void)absolute_path("a"), Error);
  EXPECT_EQ(absolute_path("/a"), "/a");
  std::filesystem::current_path(before);
}

TEST(NameWord, IsOneWordThatLeadsNowhereElseAndMovesNoTerminal) {
  for (const std::string& good :
       {std::string("stairs"), std::string("stairs_authors"), std::string("-3"),
        std::string("Größe"), std::string("a,b"), std::string("日本"), std::string(100, 'x')}) {
    EXPECT_TRUE(is_name_word(good)) << good;
  }
  for (const std::string bad :
       {"", ".", "..", "../x", "a/b", "/etc", "a\\b", ".hidden", "a b", "a\tb", "a\nb", "a\rb",
        "a\x1b[31m", "a\x7f", "a\xc2\x9b", "stairs.yaml"}) {
    EXPECT_FALSE(is_name_word(bad)) << bad;
  }
  EXPECT_FALSE(is_name_word(std::string("a\0b", 3)));
  EXPECT_FALSE(is_name_word(std::string(101, 'x')));
}

TEST(PartName, IsRecognisedAndKeepsTheExtension) {
  const std::filesystem::path file = part_path("folder/success.csv");
  EXPECT_EQ(file.parent_path(), "folder");
  EXPECT_EQ(file.extension(), ".csv");
  EXPECT_TRUE(is_part_file_name(file.filename())) << file;
  EXPECT_TRUE(is_part_file_name(part_path("key").filename()));
  EXPECT_TRUE(is_part_folder_name(part_folder_path("folder/success_mujoco").filename()));
  EXPECT_NE(part_path("a"), part_path("a"));
}

TEST(PartName, IsNotMistakenForOtherHiddenNames) {
  for (const char* name : {".part", ".my.part.notes", ".config.part", "success.12.0123abcd.part",
                           ".a.partition", ".film.12.part.mkv", ".film.part.12.0123abcd",
                           ".film.12.0123abcd.part.tar.gz", ".film.12.0123abcd.parts"}) {
    EXPECT_FALSE(is_part_file_name(name)) << name;
    EXPECT_FALSE(is_part_folder_name(name)) << name;
  }
}

}  // namespace
}  // namespace touchdown

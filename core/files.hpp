#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace touchdown {

/// Whether a text of a user's file can be part of a file or folder name: one word of at most 100
/// bytes without path characters (`/`, `\`, `.`), blanks or control characters.
bool is_name_word(std::string_view text);

/// The error message for a text that is not such a word.
inline constexpr const char* expected_name_word = "expected a word that can name a folder";

/// Whether the whole name matches a regular expression (ECMAScript).
bool has_shape(const std::string& name, const std::string& shape);

/// A temporary path beside `path` for a file that is renamed to `path` once it is complete. The
/// name is hidden, and contains the process number and random digits, so that no other process uses
/// or guesses it. The extension stays last: encoders and plotters choose their format by it.
std::filesystem::path part_path(const std::filesystem::path& path);
/// The same for a folder.
std::filesystem::path part_folder_path(const std::filesystem::path& path);

/// Whether a name has the form of those that the functions above make.
bool is_part_file_name(const std::filesystem::path& name);
bool is_part_folder_name(const std::filesystem::path& name);

/// Writes a file completely or not at all. `write` fills a temporary file beside `path`. The
/// temporary file replaces `path` once `write` has returned and the data is on the disk. Creates
/// missing folders. Errors: `Error` when the file cannot be written; any exception of `write`.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for content in memory.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for a stream that `write` fills. Errors: `Error` with the file's name if the stream
/// failed, on a full disk for example, whatever `write` made of it.
void write_stream_atomically(const std::filesystem::path& path,
                             const std::function<void(std::ostream& stream)>& write);

/// Appends to a file in one step, so that several processes may do so at once. Creates the file and
/// missing folders; follows no link at the end of the path. Errors: `Error`.
void append_to_file(const std::filesystem::path& path, std::string_view content);

/// The extension of a file's name in lower case, because some systems write names in capitals.
std::string extension_of(const std::filesystem::path& file);

/// Whether a file or folder is there. What cannot be looked at, such as a file in a folder without
/// permission, is not.
bool is_there(const std::filesystem::path& path) noexcept;

/// Whether a folder, or a link to one, is there.
bool is_folder(const std::filesystem::path& path) noexcept;

/// Bytes of a file; 0 if it is not there.
std::uintmax_t size_of_file(const std::filesystem::path& path) noexcept;

/// The paths of all entries of a folder, sorted; none if there is no such folder. Errors: those of
/// `complain_unreadable`: a folder that cannot be read is no empty one.
std::vector<std::filesystem::path> entries_in(const std::filesystem::path& folder);

/// The same for the folder and all folders below it. Links to folders are not followed.
std::vector<std::filesystem::path> entries_below(const std::filesystem::path& folder);

/// The folder for temporary files: that of `TMPDIR`, else /tmp. Errors: `InputError` if it is none.
std::filesystem::path temporary_folder();

/// The path from the root. Errors: `Error` when the working directory is gone.
std::filesystem::path absolute_path(const std::filesystem::path& path);

/// Errors: always, "`name`: cannot be `done`: `why`". `std::bad_alloc` if memory is short, `Error`
/// if the system has no descriptor left or the disk fails, `InputError` for all that the request is
/// to blame for.
[[noreturn]] void complain_unreadable(const std::string& name, const std::error_code& why,
                                      std::string_view done = "read");

/// Errors: `InputError` with the reason, unless `path` is a regular file or a link to one. Opens
/// nothing: a pipe would wait for its writer, a device would not end.
void require_regular_file(const std::filesystem::path& path);

/// The whole file. Errors: `InputError` when it cannot be read or is no regular file.
std::string read_file(const std::filesystem::path& path);

/// Throws `Error` if no file can be made at `path`. Called before long work, not after it.
void require_writable(const std::filesystem::path& path);

/// A hidden temporary folder beside the output `stem`. The destructor deletes it with everything
/// that was not moved out of it. Errors: `Error` when it cannot be made.
class PartFolder {
 public:
  explicit PartFolder(const std::filesystem::path& stem);
  ~PartFolder();
  PartFolder(const PartFolder&) = delete;
  PartFolder& operator=(const PartFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace touchdown

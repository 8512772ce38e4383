#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace touchdown {

/// A hash of content, equal on every machine: FNV-1a, 64 bit. The boundaries between parts count:
/// moving text from one part to the next changes the hash.
class Fingerprint {
 public:
  Fingerprint& add(std::string_view part) {
    for (const char byte : part) mix(static_cast<unsigned char>(byte));
    for (std::uint64_t size = part.size(), i = 0; i < 8; ++i, size >>= 8U) mix(size & 0xffU);
    return *this;
  }

  std::uint64_t value() const { return state_; }
  /// Sixteen hexadecimal digits.
  std::string text() const;

 private:
  void mix(std::uint64_t byte) { state_ = (state_ ^ byte) * 0x100000001b3ULL; }

  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

/// The fingerprint of a file's content. Errors: those of `read_file`.
std::string file_fingerprint(const std::filesystem::path& file);

/// The path of the running program, or of the shared library that contains this code.
std::filesystem::path own_binary();

/// The fingerprint of that file.
std::string build_fingerprint();

/// The commit of the sources that a program was built from, as in `git describe`; it ends with
/// "-dirty" if files had changed. The build writes it to a file beside the program, so that a
/// commit alone does not change the program. Returns a text that begins with "unknown" without that
/// file.
std::string build_commit(const std::filesystem::path& program = own_binary());

}  // namespace touchdown

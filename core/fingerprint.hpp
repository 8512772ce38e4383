#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace touchdown {

/// A short name for content: equal content has an equal name on every machine. FNV-1a, 64 bit; the
/// parts are told apart, so that moving text from one to the next changes the name.
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

/// The program that is running, or the shared library that holds this code inside of another one.
std::filesystem::path own_binary();

/// A name for it: equal ones have equal names.
std::string build_fingerprint();

/// The commit of the sources that a program was built from, as `git describe` calls it; "-dirty" at
/// its end where files had been changed since. The build notes it in a file beside the program, so
/// that a commit alone makes no other program. Says so when there is no such note.
std::string build_commit(const std::filesystem::path& program = own_binary());

}  // namespace touchdown

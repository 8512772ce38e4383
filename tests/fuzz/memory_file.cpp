#include "tests/fuzz/memory_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace touchdown::fuzz {

MemoryFile::MemoryFile(std::string_view content) : descriptor_(::memfd_create("fuzz", 0)) {
  set_content(content);
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::filesystem::path MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(descriptor_);
}

void MemoryFile::set_content(std::string_view content) {
  if (::ftruncate(descriptor_, 0) != 0) std::abort();
  off_t offset = 0;
  while (!content.empty()) {
    const ssize_t size = ::pwrite(descriptor_, content.data(), content.size(), offset);
    if (size <= 0) std::abort();
    content.remove_prefix(static_cast<std::size_t>(size));
    offset += size;
  }
}

namespace {

std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t crc = ~0U;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

void put(std::string& bytes, std::size_t number, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(number >> (8 * i));
}

}  // namespace

std::string archive_of(std::string_view input, const std::vector<std::string>& names) {
  std::string file;
  std::string directory;
  std::set<std::string> present;
  while (input.size() >= 3) {
    const auto byte = [&](std::size_t i) {
      return static_cast<std::size_t>(static_cast<unsigned char>(input[i]));
    };
    const std::string name = names[byte(0) % names.size()] + ".npy";
    const std::string_view content = input.substr(3, byte(1) | byte(2) << 8U);
    input.remove_prefix(3 + content.size());
    if (!present.insert(name).second) continue;
    const std::size_t offset = file.size();
    std::string about;  // common part of the local and the central header
    put(about, 20, 2);  // version
    put(about, 0, 2);   // flags
    put(about, 0, 2);   // stored
    put(about, 0x00210000U, 4);
    put(about, checksum(content), 4);
    put(about, content.size(), 4);
    put(about, content.size(), 4);
    put(about, name.size(), 2);
    put(about, 0, 2);
    file += "PK\x03\x04";
    file += about;
    file += name;
    file += content;
    directory += "PK\x01\x02";
    put(directory, 20, 2);
    directory += about;
    directory.append(10, '\0');
    put(directory, offset, 4);
    directory += name;
  }
  std::string end = "PK\x05\x06";
  put(end, 0, 4);
  put(end, present.size(), 2);
  put(end, present.size(), 2);
  put(end, directory.size(), 4);
  put(end, file.size(), 4);
  put(end, 0, 2);
  file += directory;
  file += end;
  return file;
}

}  // namespace touchdown::fuzz

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "logs/bags/message.hpp"
#include "tests/bag_writer.hpp"

namespace touchdown::test {

/// Two topics with messages of different sizes.
inline TestBag two_topics(std::size_t begin, std::size_t end, std::size_t wider = 1) {
  TestBag bag{{{"/a", "pkg/msg/A"}, {"/b", "pkg/msg/B"}}, {}};
  for (std::size_t k = begin; k < end; ++k) {
    bag.messages.push_back({k % 3 == 0 ? std::size_t{1} : std::size_t{0},
                            static_cast<std::int64_t>(1000 + 10 * k),
                            fmt::format("message {} {}", k, std::string(wider * (k % 7), 'x'))});
  }
  return bag;
}

inline std::string line_of(std::int64_t time, const std::string& topic, const std::string& type,
                           std::string_view data) {
  return fmt::format("{} {} {} {}", time, topic, type, data);
}

inline std::vector<std::string> lines_of(const TestBag& bag) {
  std::vector<std::string> all;
  for (const auto& message : bag.messages) {
    const auto& topic = bag.topics[message.topic];
    all.push_back(line_of(message.time, topic.name, topic.type, message.data));
  }
  return all;
}

struct ReadBag {
  std::vector<std::string> messages;  ///< as those of `lines_of`
  std::string notes;                  ///< joined
  std::vector<logs::BagTopic> topics;
  std::string error;
};

/// What a reader of a bag, or of one of its files, gives.
template <typename Reader>
ReadBag read_bag(const std::filesystem::path& path, const logs::TopicFilter& wanted = {}) {
  ReadBag result;
  try {
    Reader reader(path, wanted);
    logs::BagMessage message;
    while (reader.next(message)) {
      const logs::BagTopic& topic = reader.topics()[message.topic];
      result.messages.push_back(line_of(message.time, topic.name, topic.type, message.data));
    }
    if constexpr (requires { reader.note(); }) {
      result.notes = reader.note();
    } else {
      result.notes = fmt::format("{}", fmt::join(reader.notes(), "\n"));
    }
    result.topics = reader.topics();
  } catch (const InputError& error) {
    result.error = error.what();
  }
  return result;
}

}  // namespace touchdown::test

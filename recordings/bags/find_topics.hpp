#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/bags/topic_rows.hpp"

namespace touchdown::recordings {

/// The topics of these names in a bag. Errors: `InputError`, which lists the bag's topics with
/// their types and numbers of messages, for a topic that is not there, has another type or
/// encoding, or has no readable message.
std::vector<SignalTopic> find_signal_topics(const std::filesystem::path& bag,
                                            const std::vector<std::string>& names);

/// The only topic of this type in a bag. Errors: `InputError` as above if it has none or several.
std::string only_topic_of_type(const std::filesystem::path& bag, const std::string& type);

}  // namespace touchdown::recordings

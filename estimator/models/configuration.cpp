#include "estimator/models/configuration.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

#include "core/error.hpp"
#include "estimator/members.hpp"
#include "estimator/numerics/number_text.hpp"

namespace touchdown {

namespace {

using Names = std::span<const char* const>;

/// Writes each visited member under its key.
class MemberWriter {
 public:
  void operator()(const std::string& key, const double& value, const Range& /*range*/) {
    text[key] = text_of(value);
  }
  void operator()(const std::string& key, const int& value) { text[key] = std::to_string(value); }
  void operator()(const std::string& key, const bool& value) {
    text[key] = value ? "true" : "false";
  }
  template <typename Enum>
  void choose(const std::string& key, Names names, const Enum& value) {
    text[key] = names[static_cast<std::size_t>(value)];
  }

  ConfigurationText text;
};

/// Reads each visited member from its key, if the key exists.
class MemberReader {
 public:
  explicit MemberReader(const ConfigurationText& text) : left_(text) {}

  /// Ranges are those of whole configurations (`check_members`).
  void operator()(const std::string& key, double& value, const Range& range) {
    take(key, range.text, [&](const std::string& text) {
      const std::optional<double> number = number_of(text);
      if (!number || std::abs(*number) > Range::any.high) return false;
      value = *number;
      return true;
    });
  }
  void operator()(const std::string& key, int& value) {
    take(key, "a whole number", [&](const std::string& text) {
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      return error == std::errc{} && end == text.data() + text.size();
    });
  }
  void operator()(const std::string& key, bool& value) {
    take(key, "true or false", [&](const std::string& text) {
      value = text == "true";
      return value || text == "false";
    });
  }
  template <typename Enum>
  void choose(const std::string& key, Names names, Enum& value) {
    std::string expected;
    for (const char* name : names) expected.append(expected.empty() ? "" : " or ").append(name);
    take(key, expected, [&](const std::string& text) {
      const auto found = std::find(names.begin(), names.end(), text);
      if (found == names.end()) return false;
      value = static_cast<Enum>(found - names.begin());
      return true;
    });
  }

  /// Errors: `InputError` for a key without a member.
  void finish() const {
    if (left_.empty()) return;
    throw InputError("metadata: configuration." + left_.begin()->first +
                     ": is not known: was it written by a newer version?");
  }

 private:
  template <typename Read>
  void take(const std::string& key, const std::string& expected, const Read& read) {
    const auto found = left_.find(key);
    if (found == left_.end()) return;
    if (!read(found->second)) {
      throw InputError("metadata: configuration." + key + ": '" + found->second +
                       "' is no value for it: expected " + expected);
    }
    left_.erase(found);
  }

  ConfigurationText left_;
};

template <typename Config>
ConfigurationText written(const Config& config) {
  MemberWriter writer;
  members(writer, config);
  return writer.text;
}

template <typename Config>
void read(Config& config, const ConfigurationText& text) {
  MemberReader reader(text);
  members(reader, config);
  SignalBounds of_robot;  // `signal_bounds_of` reads these
  members(reader, of_robot);
  reader.finish();
}

}  // namespace

ConfigurationText text_of(const BayesFilterConfig& config) { return written(config); }
ConfigurationText text_of(const NeuralEstimatorConfig& config) { return written(config); }
ConfigurationText text_of(const LoadFilterConfig& config) { return written(config); }

void put_into(ConfigurationText& configuration, const LegGeometry& geometry) {
  for (auto& [key, value] : written(geometry)) configuration[key] = value;
}

void configure(BayesFilterConfig& config, const ConfigurationText& text) { read(config, text); }
void configure(NeuralEstimatorConfig& config, const ConfigurationText& text) { read(config, text); }
void configure(LoadFilterConfig& config, const ConfigurationText& text) { read(config, text); }
SignalBounds signal_bounds_of(const ConfigurationText& text) {
  SignalBounds bounds;
  MemberReader reader(text);
  members(reader, bounds);
  check_members(bounds);
  return bounds;
}

bool is_signal_bound(const std::string& key) {
  static const ConfigurationText all = [] {
    MemberWriter writer;
    const SignalBounds defaults;
    members(writer, defaults);
    return writer.text;
  }();
  return all.contains(key);
}

BayesFilterConfig at_rate(BayesFilterConfig config, double sample_rate) {
  config.transition.window = std::max(
      2,
      static_cast<int>(std::lround(config.transition.window * sample_rate / config.sample_rate)));
  config.sample_rate = sample_rate;
  return config;
}

}  // namespace touchdown

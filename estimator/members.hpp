#pragma once

#include <concepts>
#include <span>
#include <string>
#include <type_traits>

namespace touchdown {

/// The values that a number of a configuration may have, ends included.
struct Range {
  double low = -1e15;
  double high = 1e15;  ///< beyond any quantity
  const char* text = "a number";

  static const Range any, positive, not_negative, share, inner_share;
};
inline constexpr Range Range::any = {};
inline constexpr Range Range::positive = {1e-15, 1e15, "a positive number"};
inline constexpr Range Range::not_negative = {0.0, 1e15, "0 or more"};
inline constexpr Range Range::share = {0.0, 1.0, "0 to 1"};
inline constexpr Range Range::inner_share = {1e-9, 1.0 - 1e-9, "more than 0 and less than 1"};

/// A configuration, also a constant one.
template <typename Given, typename Config>
concept MembersOf = std::same_as<std::remove_const_t<Given>, Config>;

// Beside each configuration stands the one list of its members: `members(visit, config)` calls
// `visit(key, member, range)` for each number, `visit(key, member)` for whole numbers and flags,
// and `visit.choose(key, names, member)` for enumerations. Checks, the texts of model files and the
// keys of `--set` follow from it.

/// Errors: `InputError` for a number beyond its range, or NaN.
class RangeCheck {
 public:
  void operator()(const std::string& key, double value, const Range& range) const;
  template <std::integral Whole>
  void operator()(const std::string& /*key*/, const Whole& /*value*/) const {}
  template <typename Enum>
  void choose(const std::string& /*key*/, std::span<const char* const> /*names*/,
              const Enum& /*value*/) const {}
};

/// Errors: as `RangeCheck`.
template <typename Config>
void check_members(const Config& config) {
  const RangeCheck check;
  members(check, config);
}

}  // namespace touchdown

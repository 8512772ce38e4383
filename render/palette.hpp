#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown::render {

/// Colours (0xRRGGBB) of curves, by line type: Okabe and Ito's, which colour-blind readers can
/// distinguish, darkest first; then a dark grey and a brown.
inline constexpr std::array<unsigned, 8> line_colours = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                                         0xe69f00, 0x56b4e9, 0x22262b, 0x8c6d31};

/// The colour of a line type, which counts from 1. Beyond the last colour they repeat.
constexpr unsigned line_colour(std::size_t line_type) {
  return line_colours[(line_type - 1) % line_colours.size()];
}

/// The line type of an estimator: its place among all `estimators` of the experiment, from 1. All
/// figures and films of an experiment use it, so that one estimator has one colour.
inline std::size_t line_type_of(const std::vector<std::string>& estimators,
                                std::string_view estimator) {
  const auto found = std::find(estimators.begin(), estimators.end(), estimator);
  return static_cast<std::size_t>(found - estimators.begin()) % line_colours.size() + 1;
}

/// Colours of the contact sources that are not estimators.
inline constexpr unsigned truth_colour = 0x22262b, always_contact_colour = 0x8a929b;

/// Stops of the colour scale of maps, from dark to bright: viridis. Its order is visible to
/// colour-blind readers and in grey print, and most of its steps are easy to distinguish.
inline constexpr std::array<unsigned, 10> viridis = {0x440154, 0x482878, 0x3e4989, 0x31688e,
                                                     0x26828e, 0x1f9e89, 0x35b779, 0x6ece58,
                                                     0xb5de2b, 0xfde725};

/// The shares at both ends of that scale (%); shares beyond have the end's colour. Good estimators
/// are so close to 100 % that their colours would look alike, while their distances from it differ
/// by a factor of ten. The colours are therefore logarithmic in this distance, and mean the same in
/// every engine, experiment and figure.
inline constexpr double lowest_shade = 70.0, highest_shade = 99.9;

/// Like viridis, with less colour of its own: cividis. For maps with coloured lines on them.
inline constexpr std::array<unsigned, 10> cividis = {0x00224e, 0x123570, 0x3b496c, 0x575d6d,
                                                     0x707173, 0x8a8678, 0xa59c74, 0xc3b369,
                                                     0xe1cc55, 0xfee838};

}  // namespace touchdown::render

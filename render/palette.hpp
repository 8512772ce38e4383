#pragma once

#include <array>

namespace touchdown::render {

/// Colours (0xRRGGBB) of curves that stay apart for colour-blind readers: Okabe and Ito's, darkest
/// first.
inline constexpr std::array<unsigned, 6> okabe_ito = {0x0072b2, 0xd55e00, 0x009e73,
                                                      0xcc79a7, 0xe69f00, 0x56b4e9};

/// Stops of a scale, from dark to bright, that stays in order for colour-blind readers and in grey
/// print and tells most steps apart: viridis. Of maps.
inline constexpr std::array<unsigned, 10> viridis = {0x440154, 0x482878, 0x3e4989, 0x31688e,
                                                     0x26828e, 0x1f9e89, 0x35b779, 0x6ece58,
                                                     0xb5de2b, 0xfde725};

/// Likewise with little colour of its own: cividis. Of what has coloured lines upon it.
inline constexpr std::array<unsigned, 10> cividis = {0x00224e, 0x123570, 0x3b496c, 0x575d6d,
                                                     0x707173, 0x8a8678, 0xa59c74, 0xc3b369,
                                                     0xe1cc55, 0xfee838};

}  // namespace touchdown::render

#pragma once
#include <array>
#include <cstdint>

namespace ridgeline {

/// One glyph of the 5 x 7 face: 35 bits, rows from the top, the leftmost column first.
struct Glyph {
  char letter = ' ';
  std::uint64_t bits = 0;
};

inline constexpr int glyph_columns = 5;
inline constexpr int glyph_rows = 7;

/// Capitals, digits and the signs that status lines need; anything else is left blank.
inline constexpr std::array font{
    Glyph{'(', 0x088842082ULL}, Glyph{')', 0x208210888ULL}, Glyph{'+', 0x0084f9080ULL},
    Glyph{',', 0x000003188ULL}, Glyph{'-', 0x000070000ULL}, Glyph{'.', 0x00000018cULL},
    Glyph{'/', 0x042222210ULL}, Glyph{'0', 0x3a33ae62eULL}, Glyph{'1', 0x11842108eULL},
    Glyph{'2', 0x3a213221fULL}, Glyph{'3', 0x78217043eULL}, Glyph{'4', 0x08ca97c42ULL},
    Glyph{'5', 0x7e1e0862eULL}, Glyph{'6', 0x3a10f462eULL}, Glyph{'7', 0x7c2211084ULL},
    Glyph{'8', 0x3a317462eULL}, Glyph{'9', 0x3a317842eULL}, Glyph{':', 0x018c03180ULL},
    Glyph{'<', 0x088882082ULL}, Glyph{'=', 0x001f07c00ULL}, Glyph{'A', 0x3a31fc631ULL},
    Glyph{'B', 0x7a31f463eULL}, Glyph{'C', 0x3a308422eULL}, Glyph{'D', 0x7a318c63eULL},
    Glyph{'E', 0x7e10f421fULL}, Glyph{'F', 0x7e10f4210ULL}, Glyph{'G', 0x3a30bc62eULL},
    Glyph{'H', 0x4631fc631ULL}, Glyph{'I', 0x38842108eULL}, Glyph{'J', 0x1c4210a4cULL},
    Glyph{'K', 0x4654c5251ULL}, Glyph{'L', 0x42108421fULL}, Glyph{'M', 0x4775ac631ULL},
    Glyph{'N', 0x4739ace71ULL}, Glyph{'O', 0x3a318c62eULL}, Glyph{'P', 0x7a31f4210ULL},
    Glyph{'Q', 0x3a318d64dULL}, Glyph{'R', 0x7a31f5251ULL}, Glyph{'S', 0x3e107043eULL},
    Glyph{'T', 0x7c8421084ULL}, Glyph{'U', 0x46318c62eULL}, Glyph{'V', 0x46318a944ULL},
    Glyph{'W', 0x4631ad771ULL}, Glyph{'X', 0x462a22a31ULL}, Glyph{'Y', 0x462a21084ULL},
    Glyph{'Z', 0x7c222221fULL},
};

/// Bits of a letter; lower case is drawn as capitals, `_` as a space.
constexpr std::uint64_t glyph_bits(char letter) {
  if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  for (const Glyph& glyph : font) {
    if (glyph.letter == letter) return glyph.bits;
  }
  return 0;
}

}  // namespace ridgeline

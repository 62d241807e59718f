// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/stroke_font.h"

#include <algorithm>

namespace toile {
namespace {

// Strokes of the characters from '!' to '~' as pairs of digits x, y on a grid: baseline y = 2, small letters to 6,
// capitals to 8. A space divides strokes.
constexpr std::array<std::string_view, 94> kGlyphs = {
    "0804 0202",                           // !
    "0807 2827",                           // "
    "1218 3238 0444 0646",                 // #
    "473818070615354443321203 2921",       // $
    "0248 0708181707 3233434232",          // %
    "4206071827260403122243",              // &
    "0807",                                // '
    "18070312",                            // (
    "08171302",                            // )
    "0543 0345 2226",                      // *
    "0444 2226",                           // +
    "1201",                                // ,
    "0434",                                // -
    "0202",                                // .
    "0248",                                // /
    "180703123243473818",                  // 0
    "071812",                              // 1
    "07183847460242",                      // 2
    "07183847463515 354443321203",         // 3
    "32380444",                            // 4
    "480805354443321203",                  // 5
    "4738180703123243443505",              // 6
    "084812",                              // 7
    "15060718384746351504031232434435",    // 8
    "0312324347381807061545",              // 9
    "0202 0505",                           // :
    "1201 1515",                           // ;
    "360432",                              // <
    "0333 0535",                           // =
    "063402",                              // >
    "07183847462524 2222",                 // ?
    "3324343626152433454738180703123242",  // @
    "022842 1434",                         // A
    "02083847463505 3544433202",           // B
    "4738180703123243",                    // C
    "02082846442202",                      // D
    "48080242 0535",                       // E
    "480802 0535",                         // F
    "47381807031232434525",                // G
    "0208 4248 0545",                      // H
    "0208",                                // I
    "3833221203",                          // J
    "0208 4804 1542",                      // K
    "080232",                              // L
    "0208254842",                          // M
    "02084248",                            // N
    "180703123243473818",                  // O
    "02083847463505",                      // P
    "180703123243473818 2442",             // Q
    "02083847463505 2542",                 // R
    "473818070615354443321203",            // S
    "0848 2822",                           // T
    "080312324348",                        // U
    "082248",                              // V
    "0812263248",                          // W
    "0248 0842",                           // X
    "082548 2522",                         // Y
    "08480242",                            // Z
    "18080212",                            // [
    "0842",                                // backslash
    "08181202",                            // ]
    "062846",                              // ^
    "0141",                                // _
    "0817",                                // `
    "3632 3526160503122233",               // a
    "0802 0516263533221203",               // b
    "3526160503122233",                    // c
    "3832 3526160503122233",               // d
    "04343526160503122233",                // e
    "281712 0626",                         // f
    "3631201001 3526160503122233",         // g
    "0802 0516263532",                     // h
    "0602 0808",                           // i
    "161100 1818",                         // j
    "0802 3603 1432",                      // k
    "0802",                                // l
    "0602 05162522 25364542",              // m
    "0602 0516263532",                     // n
    "160503122233352616",                  // o
    "0600 0516263533221203",               // p
    "3630 3526160503122233",               // q
    "0602 051626",                         // r
    "35261605142433221203",                // s
    "181322 0626",                         // t
    "0603122233 3632",                     // u
    "062246",                              // v
    "0612243246",                          // w
    "0236 0632",                           // x
    "0622 4610",                           // y
    "06360232",                            // z
    "28171605141322",                      // {
    "0802",                                // |
    "08171625141302",                      // }
    "04153445",                            // ~
};

constexpr double kCapHeight = 6.0, kBaseline = 2.0, kGlyphGap = 2.0, kSpace = 3.0;

std::string_view glyph(char c) {
  if (c > ' ' && c <= '~') return kGlyphs[static_cast<std::size_t>(c - '!')];
  return kGlyphs[static_cast<std::size_t>('?' - '!')];
}

double glyph_width(std::string_view strokes) {
  int width = 0;
  bool is_x = true;
  for (const char c : strokes) {
    if (c == ' ') continue;
    if (is_x) width = std::max(width, c - '0');
    is_x = !is_x;
  }
  return width;
}

bool continues_utf8(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

}  // namespace

std::vector<std::vector<Vec2>> text_strokes(std::string_view text, double height) {
  std::vector<std::vector<Vec2>> strokes;
  const double unit = height / kCapHeight;
  double pen = 0.0;
  for (const char c : text) {
    if (continues_utf8(c)) continue;
    if (c == ' ') {
      pen += kSpace;
      continue;
    }
    const std::string_view digits = glyph(c);
    strokes.emplace_back();
    for (std::size_t i = 0; i < digits.size();) {
      if (digits[i] == ' ') {
        strokes.emplace_back();
        ++i;
        continue;
      }
      strokes.back().push_back(unit * Vec2(pen + digits[i] - '0', digits[i + 1] - '0' - kBaseline));
      i += 2;
    }
    pen += glyph_width(digits) + kGlyphGap;
  }
  return strokes;
}

double text_width(std::string_view text, double height) {
  double pen = 0.0;
  for (const char c : text)
    if (!continues_utf8(c)) pen += c == ' ' ? kSpace : glyph_width(glyph(c)) + kGlyphGap;
  return std::max(0.0, pen - kGlyphGap) * height / kCapHeight;
}

}  // namespace toile

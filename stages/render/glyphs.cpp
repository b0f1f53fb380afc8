// Each glyph is a little program: "M x y" lifts the pen and sets it down, "L x y" draws a line, "A x y rx ry from to"
// draws an arc of the ellipse around (x, y) from one angle to another (degrees, counter-clockwise), after a line to its
// start, and "O" is an arc that lifts the pen first.
#include "stages/render/glyphs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

namespace lozenge {

namespace {

struct Source {
  char character;
  double width;
  const char* program;
};

constexpr Source kSources[] = {
    {' ', 1.8, ""},
    {'!', 0, "M 0 7 L 0 2.2 M 0 0.1 L 0 0"},
    {'"', 1.6, "M 0 7 L 0 5 M 1.6 7 L 1.6 5"},
    {'#', 4.4, "M 1.2 0 L 2 7 M 2.8 0 L 3.6 7 M 0 2.2 L 4.4 2.2 M 0 4.8 L 4.4 4.8"},
    {'$', 4.2, "O 2.1 5 2 1.5 30 270 A 2.1 1.9 2.1 1.6 90 -150 M 2.1 7.6 L 2.1 -0.6"},
    {'%', 6.2, "O 1.4 5.6 1.4 1.4 0 360 O 4.8 1.4 1.4 1.4 0 360 M 5.3 7 L 0.9 0"},
    {'&', 5, "M 5 0 L 1 5 A 2 5.7 1.2 1.3 190 -60 L 0.6 2.6 A 1.9 1.6 1.7 1.6 160 330 L 4.8 3.2"},
    {'\'', 0, "M 0 7 L 0 5"},
    {'(', 1.5, "O 3.4 3 3.4 5 125 235"},
    {')', 1.5, "O -1.9 3 3.4 5 55 -55"},
    {'*', 3, "M 1.5 7 L 1.5 4 M 0.2 6.25 L 2.8 4.75 M 2.8 6.25 L 0.2 4.75"},
    {'+', 4, "M 2 5 L 2 1 M 0 3 L 4 3"},
    {',', 0.4, "M 0.3 0.2 L 0 -1.3"},
    {'-', 2.4, "M 0 2.7 L 2.4 2.7"},
    {'.', 0, "M 0 0.1 L 0 0"},
    {'/', 2.8, "M 0 -0.8 L 2.8 7.4"},
    {'0', 4.4, "O 2.2 3.5 2.2 3.5 90 450"},
    {'1', 1.9, "M 0 5.5 L 1.9 7 L 1.9 0"},
    {'2', 4.2, "O 2.1 4.95 2.05 2.05 165 -35 L 0 0 L 4.2 0"},
    {'3', 4.2, "O 2 5.3 1.8 1.7 150 -90 A 2 1.8 2.2 1.8 90 -150"},
    {'4', 4.6, "M 3.4 0 L 3.4 7 L 0 2 L 4.6 2"},
    {'5', 4.2, "M 3.9 7 L 0.7 7 L 0.4 3.9 A 2 2.25 2.2 2.25 130 -145"},
    {'6', 4.4, "M 3.3 7 L 0.4 3.4 M 0 2.2 A 2.2 2.2 2.2 2.2 180 540"},
    {'7', 4.2, "M 0 7 L 4.2 7 L 1.4 0"},
    {'8', 4.4, "O 2.2 5.35 1.8 1.65 90 450 O 2.2 1.85 2.2 1.85 90 450"},
    {'9', 4.4, "M 1.1 0 L 4 3.6 M 4.4 4.8 A 2.2 4.8 2.2 2.2 0 360"},
    {':', 0, "M 0 4.3 L 0 4.2 M 0 0.1 L 0 0"},
    {';', 0.4, "M 0.3 4.3 L 0.3 4.2 M 0.3 0.2 L 0 -1.3"},
    {'<', 3.6, "M 3.6 5 L 0 3 L 3.6 1"},
    {'=', 3.8, "M 0 3.9 L 3.8 3.9 M 0 1.9 L 3.8 1.9"},
    {'>', 3.6, "M 0 5 L 3.6 3 L 0 1"},
    {'?', 3.6, "O 1.8 5.2 1.8 1.8 165 -50 L 1.8 2.9 L 1.8 2.1 M 1.8 0.1 L 1.8 0"},
    {'@', 7, "O 3.5 3 1.5 1.7 0 360 M 5 4.7 L 5 2.2 A 5.9 2.6 0.9 1.2 200 360 A 3.5 3 3.5 3.6 5 310"},
    {'A', 5.4, "M 0 0 L 2.7 7 L 5.4 0 M 1 2.4 L 4.4 2.4"},
    {'B', 4.4, "M 0 3.7 L 2.6 3.7 A 2.6 5.35 1.7 1.65 -90 90 L 0 7 L 0 0 L 2.5 0 A 2.5 1.85 1.9 1.85 -90 90"},
    {'C', 5.3, "O 3.3 3.5 3.3 3.5 48 312"},
    {'D', 5, "M 0 0 L 0 7 L 1.7 7 A 1.7 3.5 3.3 3.5 90 -90 L 0 0"},
    {'E', 3.9, "M 3.9 7 L 0 7 L 0 0 L 3.9 0 M 0 3.6 L 3.4 3.6"},
    {'F', 3.8, "M 3.8 7 L 0 7 L 0 0 M 0 3.5 L 3.3 3.5"},
    {'G', 5.8, "O 3.3 3.5 3.3 3.5 48 335 L 6 3.2 L 3.7 3.2"},
    {'H', 4.8, "M 0 7 L 0 0 M 4.8 7 L 4.8 0 M 0 3.6 L 4.8 3.6"},
    {'I', 0, "M 0 7 L 0 0"},
    {'J', 2.8, "M 2.8 7 L 2.8 1.8 A 1.2 1.8 1.6 1.8 0 -140"},
    {'K', 4.6, "M 0 7 L 0 0 M 4.3 7 L 0 2.6 M 1.5 4.2 L 4.6 0"},
    {'L', 3.6, "M 0 7 L 0 0 L 3.6 0"},
    {'M', 6, "M 0 0 L 0 7 L 3 2.2 L 6 7 L 6 0"},
    {'N', 4.9, "M 0 0 L 0 7 L 4.9 0 L 4.9 7"},
    {'O', 6.4, "O 3.2 3.5 3.2 3.5 90 450"},
    {'P', 4.3, "M 0 0 L 0 7 L 2.4 7 A 2.4 5.15 1.9 1.85 90 -90 L 0 3.3"},
    {'Q', 6.4, "O 3.2 3.5 3.2 3.5 90 450 M 4 1.6 L 6.2 -0.5"},
    {'R', 4.5, "M 0 0 L 0 7 L 2.4 7 A 2.4 5.2 1.9 1.8 90 -90 L 0 3.4 M 2.3 3.4 L 4.5 0"},
    {'S', 4.2, "O 2.1 5.3 1.9 1.7 30 270 A 2.1 1.8 2.1 1.8 90 -150"},
    {'T', 4.8, "M 0 7 L 4.8 7 M 2.4 7 L 2.4 0"},
    {'U', 4.7, "M 0 7 L 0 2.35 A 2.35 2.35 2.35 2.35 180 360 L 4.7 7"},
    {'V', 5, "M 0 7 L 2.5 0 L 5 7"},
    {'W', 7.6, "M 0 7 L 1.9 0 L 3.8 6.6 L 5.7 0 L 7.6 7"},
    {'X', 4.8, "M 0 7 L 4.8 0 M 4.8 7 L 0 0"},
    {'Y', 4.8, "M 0 7 L 2.4 3.3 L 4.8 7 M 2.4 3.3 L 2.4 0"},
    {'Z', 4.5, "M 0 7 L 4.5 7 L 0 0 L 4.5 0"},
    {'[', 1.5, "M 1.5 7.6 L 0 7.6 L 0 -1 L 1.5 -1"},
    {'\\', 2.8, "M 0 7.4 L 2.8 -0.8"},
    {']', 1.5, "M 0 7.6 L 1.5 7.6 L 1.5 -1 L 0 -1"},
    {'^', 3, "M 0 4.8 L 1.5 7 L 3 4.8"},
    {'_', 4, "M 0 -0.8 L 4 -0.8"},
    {'`', 1, "M 0 7 L 1 5.8"},
    {'a', 4.4, "M 4.4 2.5 A 2.2 2.5 2.2 2.5 0 360 M 4.4 5 L 4.4 0"},
    {'b', 4.4, "M 0 7.4 L 0 0 M 0 2.5 A 2.2 2.5 2.2 2.5 180 540"},
    {'c', 3.9, "O 2.3 2.5 2.3 2.5 45 315"},
    {'d', 4.4, "M 4.4 7.4 L 4.4 0 M 4.4 2.5 A 2.2 2.5 2.2 2.5 0 360"},
    {'e', 4.5, "M 0 2.6 L 4.5 2.6 A 2.25 2.5 2.25 2.5 2 318"},
    {'f', 2.7, "O 2.3 6.1 1.3 1.3 65 180 L 1 0 M 0 4.8 L 2.5 4.8"},
    {'g', 4.4, "M 4.4 2.5 A 2.2 2.5 2.2 2.5 0 360 M 4.4 5 L 4.4 -0.2 A 2.2 -0.2 2.2 1.8 0 -145"},
    {'h', 4, "M 0 7.4 L 0 0 M 0 3 A 2 3 2 2 180 0 L 4 0"},
    {'i', 0, "M 0 5 L 0 0 M 0 7 L 0 6.9"},
    {'j', 1.2, "M 1.2 5 L 1.2 -0.8 A 0 -0.8 1.2 1.2 0 -90 M 1.2 7 L 1.2 6.9"},
    {'k', 3.8, "M 0 7.4 L 0 0 M 3.6 5 L 0 1.8 M 1.3 3 L 3.8 0"},
    {'l', 0, "M 0 7.4 L 0 0"},
    {'m', 6.8, "M 0 5 L 0 0 M 0 3.3 A 1.7 3.3 1.7 1.7 180 0 L 3.4 0 M 3.4 3.3 A 5.1 3.3 1.7 1.7 180 0 L 6.8 0"},
    {'n', 4, "M 0 5 L 0 0 M 0 3 A 2 3 2 2 180 0 L 4 0"},
    {'o', 4.6, "O 2.3 2.5 2.3 2.5 90 450"},
    {'p', 4.4, "M 0 5 L 0 -2 M 0 2.5 A 2.2 2.5 2.2 2.5 180 540"},
    {'q', 4.4, "M 4.4 5 L 4.4 -2 M 4.4 2.5 A 2.2 2.5 2.2 2.5 0 360"},
    {'r', 2.6, "M 0 5 L 0 0 M 0 2.9 A 2.1 2.9 2.1 2.1 180 75"},
    {'s', 3.5, "O 1.75 3.75 1.6 1.25 30 270 A 1.75 1.25 1.75 1.25 90 -150"},
    {'t', 2.7, "M 1 6.6 L 1 1.3 A 2.3 1.3 1.3 1.3 180 285 M 0 4.8 L 2.5 4.8"},
    {'u', 4, "M 0 5 L 0 2 A 2 2 2 2 180 360 M 4 5 L 4 0"},
    {'v', 4, "M 0 5 L 2 0 L 4 5"},
    {'w', 6.2, "M 0 5 L 1.55 0 L 3.1 4.7 L 4.65 0 L 6.2 5"},
    {'x', 3.7, "M 0 5 L 3.7 0 M 3.7 5 L 0 0"},
    {'y', 4.1, "M 0 5 L 2.1 0 M 4.1 5 L 1.3 -2"},
    {'z', 3.6, "M 0 5 L 3.6 5 L 0 0 L 3.6 0"},
    {'{', 1.8, "M 1.8 7.6 L 1 7 L 1 4 L 0 3.3 L 1 2.6 L 1 -0.4 L 1.8 -1"},
    {'|', 0, "M 0 7.6 L 0 -1"},
    {'}', 1.8, "M 0 7.6 L 0.8 7 L 0.8 4 L 1.8 3.3 L 0.8 2.6 L 0.8 -0.4 L 0 -1"},
    {'~', 4, "M 0 2.6 L 0.8 3.4 L 1.5 3.4 L 2.5 2.6 L 3.2 2.6 L 4 3.4"},
};

void append_arc(std::vector<Vec2d>& stroke, std::istringstream& program) {
  double x = 0, y = 0, rx = 0, ry = 0, from = 0, to = 0;
  program >> x >> y >> rx >> ry >> from >> to;
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const int steps = std::max(4, static_cast<int>(std::abs(to - from) / 10));
  for (int i = 0; i <= steps; ++i) {
    const double angle = (from + (to - from) * i / steps) * kDegree;
    stroke.emplace_back(x + rx * std::cos(angle), y + ry * std::sin(angle));
  }
}

Glyph parsed(const Source& source) {
  Glyph glyph;
  glyph.width = source.width;
  std::istringstream program(source.program);
  char command = 0;
  while (program >> command) {
    if (command == 'M' || command == 'O') glyph.strokes.emplace_back();
    if (command == 'A' || command == 'O') {
      append_arc(glyph.strokes.back(), program);
    } else {
      Vec2d p;
      program >> p.x >> p.y;
      glyph.strokes.back().push_back(p);
    }
  }
  return glyph;
}

std::array<Glyph, 128> all_glyphs() {
  std::array<Glyph, 128> glyphs;
  for (const Source& source : kSources) glyphs[static_cast<unsigned char>(source.character)] = parsed(source);
  return glyphs;
}

}  // namespace

const Glyph& glyph_of(char c) {
  static const std::array<Glyph, 128> glyphs = all_glyphs();
  const bool known = c >= ' ' && c <= '~';
  return glyphs[static_cast<unsigned char>(known ? c : '?')];
}

}  // namespace lozenge

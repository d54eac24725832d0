#include "sim/bench/svg_page.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/output/formatted.hpp"

namespace ridgeline::sim {
namespace {

constexpr double letter_px = 5.6, label_height_px = 11.0;

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

bool holds(const Box& outer, const Box& inner) {
  return inner.left >= outer.left && inner.right <= outer.right && inner.top >= outer.top &&
         inner.bottom <= outer.bottom;
}

}  // namespace

std::string xml_text(const std::string& words) {
  std::string text;
  for (const char c : words) {
    switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '>':
        text += "&gt;";
        break;
      case '"':
        text += "&quot;";
        break;
      default:
        text += c;
    }
  }
  return text;
}

SvgPage::SvgPage(double width, double height) {
  body_ = formatted(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
      "viewBox=\"0 0 %.0f %.0f\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n"
      "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
      width, height, width, height);
}

void SvgPage::line(double x0, double y0, double x1, double y1, const std::string& style) {
  body_ += formatted("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n", x0, y0, x1, y1,
                     style.c_str());
}

void SvgPage::polyline(const std::vector<std::pair<double, double>>& points,
                       const std::string& style) {
  body_ += "<polyline fill=\"none\" points=\"";
  for (const auto& [x, y] : points) body_ += formatted("%.1f,%.1f ", x, y);
  body_ += "\" " + style + "/>\n";
}

void SvgPage::marker(double x, double y, int shape, const std::string& colour, double size) {
  // Corners, turn of the first one, and how far every other one stands inside; 0 corners: a circle.
  constexpr struct {
    int corners;
    double turn, inner;
  } shapes[] = {{0, 0, 1},    {4, 0.125, 1}, {3, 0.75, 1},   {4, 0, 1},        {3, 0.25, 1},
                {5, 0.75, 1}, {6, 0, 1},     {8, 0.0625, 1}, {10, 0.75, 0.45}, {8, 0, 0.4}};
  const auto& [corners, turn, inner] = shapes[static_cast<std::size_t>(shape) % std::size(shapes)];
  if (corners == 0) {
    body_ += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\"/>\n", x, y, size,
                       colour.c_str());
    return;
  }
  body_ += "<polygon points=\"";
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (turn + static_cast<double>(k) / corners);
    const double radius = 1.25 * size * (inner < 1 ? 1.2 : 1.0) * (k % 2 == 0 ? 1.0 : inner);
    body_ += formatted("%.1f,%.1f ", x + radius * std::cos(angle), y + radius * std::sin(angle));
  }
  body_ += "\" fill=\"" + colour + "\"/>\n";
}

void SvgPage::ring(double x, double y, double radius, const std::string& style) {
  body_ += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"none\" %s/>\n", x, y,
                     radius, style.c_str());
}

void SvgPage::text(double x, double y, const std::string& words, const std::string& anchor,
                   const std::string& style) {
  body_ += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" %s>", x, y, anchor.c_str(),
                     style.c_str()) +
           xml_text(words) + "</text>\n";
}

void SvgPage::label(double x, double y, const std::string& words, const Box& frame,
                    const std::string& style) {
  const double width = letter_px * static_cast<double>(words.size()), half = 0.5 * label_height_px;
  constexpr double gap = 9.0;
  // Left edge and middle of the label, the best place first.
  const std::pair<double, double> places[] = {{x + gap, y - 11},         {x + gap, y},
                                              {x + gap, y + 11},         {x - gap - width, y - 11},
                                              {x - gap - width, y},      {x - gap - width, y + 11},
                                              {x - 0.5 * width, y - 15}, {x - 0.5 * width, y + 15}};
  for (const auto& [left, middle] : places) {
    const Box box{left, middle - half, left + width, middle + half};
    const bool free = std::none_of(taken_.begin(), taken_.end(),
                                   [&](const Box& other) { return overlap(box, other); });
    if (!free || !holds(frame, box)) continue;
    take(box);
    text(left, middle + 3.5, words, "start", style);
    return;
  }
}

}  // namespace ridgeline::sim

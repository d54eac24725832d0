#pragma once
#include <string>
#include <vector>

namespace ridgeline::sim {

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// A page of SVG that remembers which places are taken, so that no label stands on another.
/// Units: px of the page, y downwards.
class SvgPage {
 public:
  SvgPage(double width, double height);

  void line(double x0, double y0, double x1, double y1, const std::string& style);
  void polyline(const std::vector<std::pair<double, double>>& points, const std::string& style);
  /// One of 10 shapes round a point.
  void marker(double x, double y, int shape, const std::string& colour, double size);
  void ring(double x, double y, double radius, const std::string& style);
  /// `anchor`: start, middle or end.
  void text(double x, double y, const std::string& words, const std::string& anchor,
            const std::string& style);
  /// A label beside a point, where there is room inside `frame`; none where there is none.
  void label(double x, double y, const std::string& words, const Box& frame,
             const std::string& style);
  /// Marks a place as taken.
  void take(const Box& box) { taken_.push_back(box); }

  [[nodiscard]] std::string finished() const { return body_ + "</svg>\n"; }

 private:
  std::string body_;
  std::vector<Box> taken_;
};

/// The words with the characters that XML keeps for itself written out.
[[nodiscard]] std::string xml_text(const std::string& words);

}  // namespace ridgeline::sim
